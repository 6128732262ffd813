//! YORP of a model: `yorp` against `simulate` over an orbit, symmetric bodies, a lag of the heat, and refusals.

use std::f64::consts::TAU;

use quasirigid_io::model::System;
use quasirigid_math::rotation::Turn;
use quasirigid_math::vec3::minus;
use quasirigid_study::settings::PartialRun;
use quasirigid_study::yorp::{Yorp, YorpSettings};
use quasirigid_study::{Study, StudyError};

use super::sunlight::{CORNERS, FACES};
use crate::support::{close, history, study, table};

const ROCK: &str = "[material.rock]\ndensity = 2000\nshear = 1e9\npoisson = 0.25\n";
const SUN: f64 = 1.327_124_400_41e20;

/// A rock of some kilometres with the outline of a tetrahedron, and its spin.
fn rock(spin: f64, unit: f64, orbit: &str) -> (tempfile::TempDir, Study) {
    let folder = tempfile::tempdir().unwrap();
    let shape = CORNERS.map(|[x, y, z]| format!("v {x} {y} {z}\n")).concat()
        + &FACES.map(|[a, b, c]| format!("f {} {} {}\n", a + 1, b + 1, c + 1)).concat();
    std::fs::write(folder.path().join("shape.obj"), shape).unwrap();
    let model = format!(
        "[carrier]\nmass = 1e14\ncenter_of_mass = [900, 300, 200]\ninertia = {:?}\n\
         [initial]\nangular_velocity = [0, 0, {spin:e}]\n\
         [[force]]\nname = \"light\"\nkind = \"sunlight\"\nfile = \"shape.obj\"\nunit = \"3 km\"\ntolerance = 0.1\n{orbit}\n",
        [4.0, 5.0, 6.0].map(|moment| moment * unit)
    );
    let study = Study::read_from(&folder.path().join("model.toml"), model.as_bytes(), None).unwrap();
    (folder, study)
}

fn prompt(study: &Study) -> Yorp {
    study.yorp(YorpSettings::default()).unwrap_or_else(|error| panic!("{error}"))
}

/// Over an orbit with 120 rotations, more than the harmonics have: what the angular momentum gains is the mean torque over the time. The rest is
/// of the second order in the torque, and falls with the inertia.
#[test]
fn yorp_is_the_mean_of_simulate() {
    let period = TAU * ((1.1 * 149_597_870_700.0_f64).powi(3) / SUN).sqrt();
    let orbit = "orbit = { body = \"Sun\", semi_major_axis = \"1.1 au\", eccentricity = 0.3, inclination = \"50 deg\", periapsis = \"70 deg\", mean_anomaly = \"30 deg\" }";
    let off = [1e20, 1e21].map(|unit| {
        let (_folder, study) = rock(120.0 * TAU / period, unit, orbit);
        let found = prompt(&study);
        let now = found.now.unwrap();
        close(now.obliquity, 50f64.to_radians(), 1e-12);
        close(now.spin_rate, now.spin_torque / (6.0 * unit), 1e-12);
        close(now.obliquity_rate, now.obliquity_torque / (6.0 * unit * found.spin), 1e-12);
        let exact = PartialRun { tolerance: Some(1e-12), ..PartialRun::default() };
        let run = history(&study, &table(System::Rigid, &[0.0, period]), exact);
        let last = &run.run.last;
        let momentum = Turn::of(last.attitude).to_inertial(last.angular_momentum);
        let [_, across, along] = minus(momentum, [0.0, 0.0, found.spin * found.moment]);
        // the normal of the orbit is (0, -sin i, cos i), so that the obliquity rises towards +y
        [along / period / now.spin_torque - 1.0, across / period / now.obliquity_torque - 1.0]
    });
    println!("differences of spin and obliquity {off:?}");
    for (light, heavy) in off[0].iter().zip(off[1]) {
        assert!(heavy.abs() < 1e-3 && (light / heavy / 10.0 - 1.0).abs() < 0.05, "{off:?}");
    }
}

/// A lag turns and lowers the torque across the spin alone; the mean pressure of an eccentric orbit, and the times to double or halve.
#[test]
fn heat_that_lags_changes_the_obliquity_alone() {
    let (_folder, study) = rock(3e-4, 1e20, "direction = [1, 0, 0]\ndistance = \"2 au\"");
    let bare = prompt(&study);
    assert!(bare.now.is_none() && bare.curve.len() == 37 && bare.lag == 0.0 && bare.emission == 1.0);
    close(bare.pressure, 1361.0 / 299_792_458.0 / 4.0, 1e-12);
    let warm = study.yorp(YorpSettings { thermal_inertia: 200.0, ..YorpSettings::default() }).unwrap();
    // by hand: T0 = (0.9·340.25/(4·0.9·σ))^¼ = 196.8 K, Θ = 200·√3e-4/(4·0.9·σ·T0³)
    let t0 = (340.25 / (4.0 * 5.670_374_419e-8_f64)).powf(0.25);
    close(warm.thermal_parameter, 200.0 * 3e-4_f64.sqrt() / (3.6 * 5.670_374_419e-8 * t0.powi(3)), 1e-12);
    for (bare, warm) in bare.curve.iter().zip(&warm.curve) {
        assert_eq!(bare.spin_torque, warm.spin_torque);
        let times = [warm.doubling_time, warm.halving_time.map(|time| 2.0 * time)];
        assert!(times.iter().flatten().all(|time| (time * warm.spin_rate.abs() / 3e-4 - 1.0).abs() < 1e-12));
    }
    let most = |yorp: &Yorp| yorp.curve.iter().map(|at| at.obliquity_torque.abs()).fold(0.0, f64::max);
    assert!((most(&warm) / most(&bare) - 1.0).abs() > 0.05, "{} {}", most(&warm), most(&bare));
    let text = warm.text();
    assert!(
        text.contains("thermal parameter") && text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
}

#[test]
fn an_ellipsoid_keeps_its_spin() {
    let body = |rest: &str| {
        study(&format!("{ROCK}[[ellipsoid]]\nmaterial = \"rock\"\nsemi_axes = [300, 200, 150]\n{rest}"))
    };
    let light = "[[force]]\nkind = \"sunlight\"\ndirection = [1, 0, 0]\ndistance = \"1 au\"\n";
    let spinning = "[initial]\nangular_velocity = [0, 0, -3e-4]\n";
    let found = prompt(&body(&format!("{light}{spinning}")));
    assert_eq!(found.axis[2], -1.0);
    assert!(
        found.curve.iter().all(|at| at.spin_torque.abs() < 1e-12 * found.pressure * 300f64.powi(3)),
        "{found:?}"
    );
    let refusal = |rest: &str, settings: YorpSettings| match body(rest).yorp(settings) {
        Err(error @ StudyError::Yorp { .. }) => error.to_string(),
        other => panic!("{other:?}"),
    };
    let usual = YorpSettings::default();
    assert!(refusal(spinning, usual).contains("no sunlight"));
    assert!(refusal(&format!("{light}{light}{spinning}"), usual).contains("several"));
    assert!(refusal(&format!("{light}during = [[0, 1]]\n{spinning}"), usual).contains("windows"));
    assert!(
        refusal(&format!("{light}[initial]\nangular_velocity = [1e-4, 0, 0]\n"), usual)
            .contains("greatest inertia")
    );
    let good = format!("{light}{spinning}");
    assert!(refusal(&good, YorpSettings { albedo: 1.0, ..usual }).contains("albedo"));
    assert!(refusal(&good, YorpSettings { emissivity: 0.0, ..usual }).contains("emissivity"));
    assert!(refusal(&good, YorpSettings { thermal_inertia: -1.0, ..usual }).contains("thermal inertia"));
}
