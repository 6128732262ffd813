//! Materials at the harmonics of the motion asked for: liquids among them are refused or said first, and each has its name. (G16)

use crate::support::{Ran, folder_with, one_line, ran_in, ran_with};

/// Ellipsoid of 1 km in a rotation of 5 h, of a material with this rheology.
fn ellipsoid(rheology: &str) -> String {
    format!(
        "[body]\nname = \"body\"\n[material.rock]\ndensity = \"2 g/cm^3\"\nshear = \"1 GPa\"\npoisson = 0.25\n\
         rheology = {{ {rheology} }}\n[[ellipsoid]]\nsemi_axes = [\"1 km\", \"1 km\", \"0.6 km\"]\nmaterial = \"rock\"\n\
         [initial]\nwobble = {{ angle = \"45 deg\", rate = \"0.35 mrad/s\", mode = \"short-axis\" }}\n\
         [run]\nevolve = {{ until = \"5 deg\" }}\nsystems = [\"reduced\"]\nduration = \"1 d\"\n"
    )
}

fn said(ran: &Ran) -> String {
    one_line(&format!("{} {}", ran.stdout, ran.stderr))
}

const MAXWELL: &str = "kind = \"maxwell\", time = \"1e-3 s\"";
const LIQUID: &str = "the material of ellipsoid 1 flows in this motion like a liquid: at 1.16e-4 rad/s, a harmonic of it, its modulus \
                      is 1.16e-7 of the one given and its loss angle 90.0 degrees, above 45";

/// A Maxwell body of 1 ms is a liquid in a rotation of 5 h: refused, or said in the first line, with exit code 1.
#[test]
fn a_liquid_is_no_solid_at_its_own_harmonics() {
    let folder = folder_with(&ellipsoid(MAXWELL));
    for (command, first) in [
        ("evolve model.toml", "body: NO ANSWER: the material"),
        ("evolve model.toml --method average", "body: NO SOLID: the material"),
        ("check model.toml", "body: NO SOLID: the material"),
        ("simulate model.toml --times 0,1", "t,wx"),
        ("run model.toml -o out", ""),
    ] {
        let ran = ran_in(folder.path(), command);
        assert_eq!(ran.code, Some(1), "{command}: {ran:?}");
        assert!(ran.stdout.starts_with(first) && said(&ran).contains(LIQUID), "{command}: {ran:?}");
    }
    assert_eq!(ran_in(folder.path(), "check model.toml --json").json()["valid"], false);
    // also where the reduced equations are at the edge of their range
    let soft = ellipsoid(MAXWELL).replace("1 GPa", "1 kPa");
    let ran = ran_with(&soft, "simulate model.toml --times 0,1");
    assert!(ran.code == Some(1) && said(&ran).contains("edge of their range"), "{ran:?}");
}

/// A Kelvin–Voigt body of 1 d is more dashpot than spring in a rotation of 5 h.
#[test]
fn a_dashpot_is_no_solid_at_its_own_harmonics() {
    let folder = folder_with(&ellipsoid("kind = \"kelvin-voigt\", time = \"1 d\""));
    for command in ["evolve model.toml", "check model.toml", "simulate model.toml --times 0,1"] {
        let ran = ran_in(folder.path(), command);
        let told = said(&ran);
        assert_eq!(ran.code, Some(1), "{command}: {ran:?}");
        assert!(
            told.contains("the material of ellipsoid 1 resists this motion as a dashpot, not as a spring: at 2.33e-4 rad/s")
                && told.contains("above 45"),
            "{command}: {told}"
        );
    }
}

/// The same law where the motion is fast beside the time is a solid, and `Q = 1` is the limit.
#[test]
fn a_solid_at_its_own_harmonics_is_followed() {
    for (rheology, commands) in [
        ("kind = \"maxwell\", time = \"1 Myr\"", &["evolve model.toml", "check model.toml"][..]),
        ("kind = \"quality-factor\", Q = 1", &["evolve model.toml", "check model.toml"]),
        ("kind = \"kelvin-voigt\", time = \"1 min\"", &["evolve model.toml"]),
    ] {
        for command in commands {
            let ran = ran_with(&ellipsoid(rheology), command);
            assert!(ran.code == Some(0) && !said(&ran).contains("SOLID"), "{rheology}, {command}: {ran:?}");
        }
    }
}

/// Core of 1 GPa and mantle of 3 GPa with one quality factor.
fn layered(parts: &str) -> String {
    let material = |name: &str, shear: &str| {
        format!(
            "[material.{name}]\ndensity = 2000\nshear = \"{shear}\"\npoisson = 0.25\nrheology = {{ kind = \"quality-factor\", Q = 50 }}\n"
        )
    };
    let initial = "[initial]\nwobble = { angle = \"20 deg\", rate = 0.01, mode = \"short-axis\" }\n";
    format!("{}{}{parts}{initial}", material("core", "1 GPa"), material("mantle", "3 GPa"))
}

/// Two bricks side by side, each a set of its own, in the format of Gmsh 2.2.
fn bricks() -> String {
    let mut nodes = String::new();
    for (number, [x, y, z]) in (0..12).map(|i| [i % 3, i / 3 % 2, i / 6]).enumerate() {
        nodes.push_str(&format!("{} {x} {} {}\n", number + 1, 0.8 * f64::from(y), 0.5 * f64::from(z)));
    }
    let brick = |first: i32| [0, 1, 4, 3, 6, 7, 10, 9].map(|step| (first + step).to_string()).join(" ");
    format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 1 \"CORE\"\n3 2 \"MANTLE\"\n$EndPhysicalNames\n\
         $Nodes\n12\n{nodes}$EndNodes\n$Elements\n2\n1 5 2 1 1 {}\n2 5 2 2 2 {}\n$EndElements\n",
        brick(1),
        brick(2)
    )
}

/// Two materials of one rheology have a share each, by their names, in solids and in the layers of panels.
#[test]
fn shares_have_the_names_of_the_materials() {
    let sail = "[[panel]]\nname = \"whole\"\nrectangle = { sides = [[4, 0, 0], [0, 2, 0]], cells = [3, 2] }\n\
                layers = [{ material = \"core\", thickness = 0.02 }, { material = \"mantle\", thickness = 0.01 }]\n";
    let solid = "[[solid]]\nname = \"whole\"\nfile = \"bricks.msh\"\nmaterials = { CORE = \"core\", MANTLE = \"mantle\" }\n";
    for parts in [sail, solid] {
        let folder = folder_with(&layered(parts));
        std::fs::write(folder.path().join("bricks.msh"), bricks()).unwrap();
        let ran = ran_in(folder.path(), "evolve model.toml --json");
        let shares = ran.json()["dissipation"].clone();
        let [core, mantle] = ["whole core", "whole mantle"].map(|name| shares[name].as_f64().unwrap_or(0.0));
        assert!((core + mantle - 1.0).abs() < 1e-9 && core > 0.1 && mantle > 0.02, "{ran:?}");
    }
}

/// Density, modulus and Q as they were read stand in the answer and the record; a body of 2 m where 2 km were meant is seen.
#[test]
fn a_homogeneous_body_is_echoed() {
    let model = ellipsoid("kind = \"quality-factor\", Q = 250").replace(" km\"", " m\"");
    let folder = folder_with(&model);
    let text = one_line(&ran_in(folder.path(), "evolve model.toml").stdout);
    let radius = 0.6_f64.cbrt();
    let mass = 2000.0 * 4.0 / 3.0 * std::f64::consts::PI * 0.6;
    assert!(
        text.contains(
            "body 5027 kg, as a ball 0.8434 m in radius, 2000 kg/m^3, shear modulus 1.000e9 Pa, Q = 250"
        ),
        "{text}"
    );
    let record = ran_in(folder.path(), "evolve model.toml --json").json()["homogeneous"].clone();
    for (key, expected) in
        [("mass", mass), ("radius", radius), ("density", 2000.0), ("shear", 1e9), ("quality", 250.0)]
    {
        assert!((record[key].as_f64().unwrap() / expected - 1.0).abs() < 1e-12, "{key}: {record}");
    }
}

/// Beyond `√(4πGρ/3)`, 2.3 h at 2 g/cm³, a kilometre of loose rock breaks up, which is said first; a body of 2 m does not.
#[test]
fn a_spin_beyond_gravity_is_said_first() {
    let said_first =
        |model: &str| ran_with(model, "evolve model.toml").stderr.contains("no longer holds loose material");
    let fast = |period: f64| {
        let rate = format!("{:e}", std::f64::consts::TAU / (3600.0 * period));
        ellipsoid("kind = \"quality-factor\", Q = 100").replace("\"0.35 mrad/s\"", &rate)
    };
    assert!(said_first(&fast(2.0)) && !said_first(&fast(2.6)));
    assert!(!said_first(&fast(2.0).replace(" km\"", " m\"")));
    let torque = "[[force]]\nkind = \"torque\"\ntorque = [0.0, 0.0, 1e4]\n";
    let driven = fast(2.6).replace("until = \"5 deg\"", "duration = \"1 kyr\"") + torque;
    let ran = ran_with(&driven, "evolve model.toml");
    assert!(one_line(&ran.stderr).contains("At the end the body turns once in"), "{ran:?}");
}
