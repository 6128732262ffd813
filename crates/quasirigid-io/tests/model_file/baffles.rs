//! Tanks with baffles, measured slosh and profiles from files: what is read, and refusals of mistakes. (U17)

use quasirigid::elements::{MeasuredSlosh, RingBaffle, Tank, TankDamping, TankShape};
use quasirigid_io::model::Model;
use tempfile::TempDir;

use super::{CARRIER, read, refusal_of, verdict};

const SPHERE: &str = "[[tank]]\nname = \"fuel\"\nshape = \"sphere\"\nradius = \"40 cm\"\n";
const LIQUID: &str = "fill = 0.4\ndensity = 1000\nsettled_by = { acceleration = [0, 0, \"-0.5 m/s^2\"] }\n";
const THIN: &str = "kinematic_viscosity = \"1 cSt\"\n";

fn tank(lines: &str) -> Tank {
    read(&format!("{CARRIER}{SPHERE}{LIQUID}{lines}")).assembly.tanks.remove(0)
}

/// The points of a profile in a file beside the model, or the refusal.
fn profile(csv: &str) -> Result<Vec<[f64; 2]>, String> {
    let folder = TempDir::new().unwrap();
    std::fs::write(folder.path().join("tank.csv"), csv).unwrap();
    let model = format!(
        "{CARRIER}[[tank]]\nname = \"fuel\"\nshape = \"profile\"\nprofile = \"tank.csv\"\n{LIQUID}{THIN}"
    );
    let found = Model::parse(&folder.path().join("model.toml"), &model);
    match found {
        Ok(model) => match &model.assembly.tanks[0].shape {
            TankShape::Profile { points } => Ok(points.clone()),
            shape => panic!("{shape:?}"),
        },
        Err(error) => Err(error.to_string()),
    }
}

#[test]
fn baffles_and_dirt_are_read() {
    let own = tank(&format!(
        "{THIN}surface = \"contaminated\"\nwave_amplitude = \"2 cm\"\nbaffles = [{{ height = -0.1, width = \"3 cm\" }}, {{ height = 0, width = 0.01 }}]\n"
    ));
    assert_eq!(own.damping, TankDamping::ContaminatedLayer(1e-6));
    let known = [RingBaffle { height: -0.1, width: 0.03 }, RingBaffle { height: 0.0, width: 0.01 }];
    assert_eq!((own.baffles.as_slice(), own.wave_amplitude), (&known[..], Some(0.02)));
    assert_eq!(tank(THIN).baffles, []);
}

#[test]
fn measured_modes_are_read() {
    let own = tank(&format!(
        "{THIN}measured = [{{ frequency = \"0.5 Hz\", mass = \"200 g\" }}, {{ damping_ratio = 0.02, stiffness = \"3 N/m\", damping = 0.1 }}]\n"
    ));
    let first =
        MeasuredSlosh { frequency: Some(std::f64::consts::PI), mass: Some(0.2), ..MeasuredSlosh::default() };
    let second =
        MeasuredSlosh { damping_ratio: Some(0.02), stiffness: 3.0, damping: 0.1, ..MeasuredSlosh::default() };
    assert_eq!(own.measured, [first, second]);
}

#[test]
fn profiles_are_read_from_files() {
    let known = Ok(vec![[0.0, -0.5], [0.25, 0.0], [0.0, 0.5]]);
    assert_eq!(profile("r,z\n0,-0.5\n0.25,0\n0,0.5\n"), known);
    assert_eq!(profile("r [mm],z [cm]\n0,-50\n250,0\n0,50\n"), known);
}

#[test]
fn files_that_are_no_profiles_are_refused() {
    let told = |csv: &str, words: &str| {
        let refusal = profile(csv).unwrap_err();
        assert!(refusal.contains("`profile`: ") && refusal.contains(words), "{refusal}");
        assert!(refusal.contains("columns r and z"), "{refusal}");
    };
    told("r,z,t\n0,1,2\n", "the table has 3 columns");
    told("z,r\n0,1\n", "the column \"z\" must be named \"r\"");
    told("r,z\n0,-1\n1,nan\n0,1\n", "row 2 has \"nan\" where a finite number is needed");
    told("r [kg],z\n0,-1\n1,0\n0,1\n", "kg");
    let absent =
        refusal_of("[[tank]]\nname = \"fuel\"\nshape = \"profile\"\nprofile = \"nowhere.csv\"\nfill = 0.5\n");
    assert!(absent.contains("nowhere.csv"), "{absent}");
}

#[test]
fn mistakes_in_baffles_and_measured_modes_are_refused() {
    let refused = |lines: &str| refusal_of(&format!("{SPHERE}{LIQUID}{lines}"));
    let told = |lines: &str, words: &str| assert!(refused(lines).contains(words), "{}", refused(lines));
    told("damping_ratio = 0.01\nsurface = \"contaminated\"\n", "a measured ratio has the surface in it");
    told(&format!("{THIN}surface = \"oily\"\n"), "`surface` cannot be \"oily\"");
    told(&format!("{THIN}baffles = [{{ height = 0.1 }}]\n"), "width");
    told(&format!("{THIN}measured = [{{ frequency = 0 }}]\n"), "frequency");
    let judged = |lines: &str| verdict(&format!("{CARRIER}{SPHERE}{LIQUID}{THIN}{lines}"));
    let many = judged("modes = 1\nmeasured = [{ mass = 1 }, { mass = 1 }]\n");
    assert!(
        many.contains("`measured` of tank \"fuel\": measured values of 2 slosh modes, and 1 are kept"),
        "{many}"
    );
}
