//! Structures whose modes were once not found, or lost in rounding.

use serde_json::Value;

use crate::support::ran_with;

/// Panels with a viscoelastic core on hinges: their rotations in the plane have stiffness and loss and no mass.
const ARRAY: &str = r#"
[carrier]
mass = 300.0
center_of_mass = [0.0, 0.0, 0.0]
inertia = [60.0, 80.0, 90.0]

[material.skin]
density = "1.6 g/cm^3"
young = ["130 GPa", "9 GPa", "9 GPa"]          # along the fibres and across them
poisson = [0.3, 0.3, 0.45]                     # 12, 13, 23
shear = ["5 GPa", "5 GPa", "3 GPa"]            # 12, 13, 23

[material.core]
density = 50
young = "70 MPa"
poisson = 0.2
rheology = { kind = "kelvin-voigt", time = "20 ms" }

[[panel]]
name = "inner"
rectangle = { sides = [[1.5, 0, 0], [0, 2, 0]], cells = [3, 4] }
position = [0.6, -1.0, 0.0]
layers = [
    { material = "skin", thickness = "0.3 mm", angle = "45 deg" },
    { material = "core", thickness = "15 mm" },
    { material = "skin", thickness = "0.3 mm", angle = "45 deg" },
]

[[panel]]
name = "outer"
rectangle = { sides = [[1.5, 0, 0], [0, 2, 0]], cells = [3, 4] }
position = [2.1, -1.0, 0.0]
layers = [
    { material = "skin", thickness = "0.3 mm", angle = "-45 deg" },
    { material = "core", thickness = "15 mm" },
    { material = "skin", thickness = "0.3 mm", angle = "-45 deg" },
]

[[connection]]                                 # two brackets on the carrier
from = "carrier"
to = { part = "inner", set = "left" }
hinge = [0, 1, 0]
stiffness = "800 N m/rad"
damping = "4 N m s/rad"

[[connection]]                                 # a line of hinges between the panels
from = { part = "inner", set = "right" }
to = { part = "outer", set = "left" }
hinge = [0, 1, 0]
stiffness = "500 N m/rad"
damping = "4 N m s/rad"

[initial]
angular_velocity = [0.002, 0.0, 0.05]
"#;

/// Floating beams with an isotropic spring between nodes apart, which resists a rotation of the whole.
const BEAMS: &str = r#"
[material.al]
density = 2700
young = "70 GPa"
poisson = 0.33
[section.strap]
shape = "I"
width = "20 mm"
height = "30 mm"
web = "2 mm"
flange = "3 mm"
[section.c]
shape = "box"
width = "20 mm"
height = "30 mm"
thickness = "2 mm"
[[beam]]
name = "whip"
nodes = { root = [0, 0.4, 0], tip = [0, 1.4, 0], side = [0.5,1.4,0.2] }
lines = [["root", "tip"], ["tip","side"]]
section = "strap"
material = "al"
up = [0, 0, 1]
elements = 3
rayleigh = { mass = "0.01 1/s", stiffness = "0.3 ms" }
masses = [{ node = "tip", mass = 1.5, inertia = [0.1,0.1,0.1] }]
[[beam]]
name = "b2"
nodes = { root = [0, 0.4, 0], tip = [1, 0.4, 0.3] }
lines = [["root", "tip"]]
section = "c"
material = "al"
elements = 3
[[connection]]
from = { part = "whip", node = "root" }
to = { part = "b2", node = "root" }
hinge = [0, 0, 1]
stiffness = 40.0
damping = 1.0
[[spring]]
from = { part = "whip", node = "tip" }
to = { part = "b2", node = "tip" }
stiffness = 15.0
[[force]]
kind = "expression"
on = { part = "b2", node = "tip" }
force = ["-0.1*vx", "0", 0]
[reduction]
modes = 2
[initial]
angular_velocity = [0.3, 0.1, 1.0]
[run]
duration = "20 s"
samples = 11
"#;

fn numbers(object: &Value, key: &str) -> Vec<f64> {
    object[key].as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found / expected - 1.0).abs() <= tolerance, "{found:e} {expected:e}");
}

/// At order 5 the few coordinates hold motions without mass: `T2` was infinite, and no modes were found.
#[test]
fn motions_without_mass_leave_the_slow_ones_their_digits() {
    let at = |order: usize| ran_with(ARRAY, &format!("check model.toml --order {order} --json")).json();
    let plain = at(3);
    for order in [4, 5] {
        let found = at(order);
        close(found["T2"].as_f64().unwrap(), plain["T2"].as_f64().unwrap(), 1e-5);
        for mode in 0..6 {
            close(numbers(&found, "decay_rates")[mode], numbers(&plain, "decay_rates")[mode], 2e-3);
        }
        assert!(numbers(&found, "decay_rates").iter().all(|rate| *rate > 0.0));
        assert!(numbers(&found, "frequencies").iter().all(|frequency| *frequency < 1e8));
    }
    let constant = |order: usize| {
        let found =
            ran_with(ARRAY, &format!("modes model.toml --order {order} --axis greatest --json")).json();
        found["modes"][0]["time_constant"].as_f64().unwrap()
    };
    close(constant(5), constant(3), 1e-3);
}

/// The two lowest modes are the same however many are kept.
#[test]
fn modes_of_floating_beams_with_a_spring_are_found() {
    let of = |kept: usize| {
        let model = BEAMS.replace("modes = 2", &format!("modes = {kept}"));
        ran_with(&model, "check model.toml --json").json()
    };
    let (two, many) = (of(2), of(40));
    for mode in 0..2 {
        close(numbers(&two, "frequencies")[mode], numbers(&many, "frequencies")[mode], 1e-6);
    }
}
