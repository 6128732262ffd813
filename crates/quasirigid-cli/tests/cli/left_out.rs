//! Losses that the equations of motion leave out are told first, to quiet callers too, and the exit code is 1.

use crate::support::{folder_with, one_line, ran_in};

/// A ball of water in a rotation that its slow flow does not follow.
const WATER: &str = "\
[carrier]
mass = 260.0
center_of_mass = [0, 0, 0]
inertia = [4, 4, 6]
[[cavity]]
shape = \"sphere\"
radius = 0.3
density = 1000.0
kinematic_viscosity = \"1e-6 m^2/s\"
modes = 2
[initial]
wobble = { angle = \"5 deg\", rate = \"1 rad/s\", mode = \"short-axis\" }
[run]
duration = \"20 s\"
systems = [\"full\"]
";

#[test]
fn liquids_that_the_equations_of_motion_do_not_hold_are_told_first() {
    let off = "with them the rate of a small nutation at this spin is off by 87 %";
    let folder = folder_with(WATER);
    for command in ["simulate model.toml --system full -q", "run model.toml -o out"] {
        let ran = ran_in(folder.path(), command);
        let said = one_line(&format!("{} {}", ran.stdout, ran.stderr));
        assert!(ran.code == Some(1) && said.contains(off), "{command}: {ran:?}");
    }
    assert!(std::fs::read_to_string(folder.path().join("out/report.html")).unwrap().contains(off));
}
