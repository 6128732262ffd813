//! Materials at the harmonics of the motion asked for: liquids among them are refused or said first. (G16)

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
        ("modes model.toml", "body: NO SOLID: the material"),
        ("simulate model.toml --times 0,1", "t,wx"),
        ("run model.toml -o out", ""),
    ] {
        let ran = ran_in(folder.path(), command);
        assert_eq!(ran.code, Some(1), "{command}: {ran:?}");
        assert!(ran.stdout.starts_with(first) && said(&ran).contains(LIQUID), "{command}: {ran:?}");
    }
    assert_eq!(ran_in(folder.path(), "check model.toml --json").json()["valid"], false);
    assert!(ran_in(folder.path(), "modes model.toml --json").json()["no_solid"].is_string());
    // also where the reduced equations are at the edge of their range
    let soft = ellipsoid(MAXWELL).replace("1 GPa", "1 kPa");
    let ran = ran_with(&soft, "simulate model.toml --times 0,1");
    assert!(ran.code == Some(1) && said(&ran).contains("edge of their range"), "{ran:?}");
}
