//! `modes` told as to a person: equal moments, overdamped motions, names, controllers.

use serde_json::Value;

use crate::support::{one_line, ran_with};

/// Flat spin of an ellipsoid of revolution with a rheology of its material.
fn ellipsoid(semi_axes: &str, rheology: &str) -> String {
    format!(
        "[material.rock]\ndensity = 2000\nshear = \"1 GPa\"\npoisson = 0.25\nrheology = {rheology}\n\
         [[ellipsoid]]\nname = \"e\"\nsemi_axes = {semi_axes}\nmaterial = \"rock\"\n\
         [initial]\nangular_velocity = [1e-5, 0, 3e-4]\n"
    )
}

fn greatest(model: &str) -> Value {
    ran_with(model, "modes model.toml --axis greatest --json").json()
}

/// The time of a wobble about flat spin at the angular velocity of the start, `−1/τω⁴K₄₄(1/C − 1/A)`: found elsewhere.
#[test]
fn a_prolate_body_in_flat_spin_decays_in_the_time_of_its_material() {
    let model = ellipsoid("[200, 100, 100]", "{ kind = \"kelvin-voigt\", time = 5.0 }");
    let found = ran_with(&model, "modes model.toml --spin 0,0,3.001666e-4 --json").json();
    let nutation = &found["modes"][0];
    let time = nutation["time_constant"].as_f64().unwrap() / (1e6 * 365.25 * 86400.0);
    assert!((time / 461.6 - 1.0).abs() < 3e-4, "{time} {nutation:#}"); // 4 digits known
    assert_eq!((&found["stable"], &nutation["name"]), (&true.into(), &"nutation".into()), "{found:#}");
}

#[test]
fn a_nutation_without_a_rate_is_neutral_and_no_instability() {
    for (rheology, moments) in [
        ("{ kind = \"quality-factor\", Q = 100 }", "[200, 100, 100]"),
        ("{ kind = \"maxwell\", time = 1000 }", "[200, 100, 100]"),
        ("{ kind = \"quality-factor\", Q = 100 }", "[200, 100.00000000001, 100]"),
    ] {
        let model = ellipsoid(moments, rheology);
        let found = greatest(&model);
        let nutation = &found["modes"][0];
        assert_eq!(
            (&nutation["neutral"], &nutation["time_constant"]),
            (&true.into(), &Value::Null),
            "{found:#}"
        );
        assert_eq!(found["stable"], true, "{found:#}");
        let text = ran_with(&model, "modes model.toml --axis greatest").stdout;
        assert!(one_line(&text).contains("the nutation is neutral to rounding"), "{text}");
    }
}

#[test]
fn a_sphere_has_no_nutation() {
    let model = ellipsoid("[100, 100, 100]", "{ kind = \"kelvin-voigt\", time = 5.0 }");
    let text = ran_with(&model, "modes model.toml --axis greatest").stdout;
    assert!(one_line(&text).contains("there is no nutation"), "{text}");
}

/// A tip mass on each side of a hub.
const TIPS: &str = "\
[carrier]
mass = 40.0
center_of_mass = [0.0, 0.0, 0.0]
inertia = [9.0, 13.0, 16.0]
[[point]]
name = \"tip 1\"
mass = 5.0
position = [0.4, 1.0, 0.5]
[[point]]
name = \"tip 2\"
mass = 5.0
position = [-0.4, 1.0, -0.5]
[[spring]]
from = \"tip 1\"
to = \"carrier\"
stiffness = 500.0
damping = 50.0
[[spring]]
from = \"tip 2\"
to = \"carrier\"
stiffness = 500.0
damping = 50.0
[initial]
angular_velocity = [\"-1.6 rpm\", \"11.88 rpm\", \"-0.48 rpm\"]
";

#[test]
fn every_mode_has_a_name_of_its_own_and_rounding_is_zero() {
    let found = ran_with(TIPS, "modes model.toml --json").json();
    for spin in found["steady_spins"].as_array().unwrap() {
        let names: Vec<&str> =
            spin["modes"].as_array().unwrap().iter().map(|mode| mode["name"].as_str().unwrap()).collect();
        let unique: std::collections::BTreeSet<_> = names.iter().collect();
        assert_eq!(unique.len(), names.len(), "{names:?}");
    }
    assert_eq!((&found["spin"][0], &found["spin"][2]), (&0.0.into(), &0.0.into()), "{:#}", found["spin"]);
}

#[test]
fn about_the_middle_axis_it_is_the_nutation_that_grows() {
    let text = ran_with(TIPS, "modes model.toml --axis middle").stdout;
    assert!(
        one_line(&text).contains("the spin is UNSTABLE: the nutation, which does not oscillate, GROWS"),
        "{text}"
    );
}

#[test]
fn overdamped_motions_come_last_and_in_a_line() {
    let heavy = TIPS.replace("damping = 50.0", "damping = 500.0");
    let [text, all] =
        ["", " --all"].map(|flag| ran_with(&heavy, &format!("modes model.toml --axis least{flag}")).stdout);
    assert!(one_line(&text).contains("overdamped motions, of"), "{text}");
    assert!(!all.contains("overdamped") && all.lines().count() > text.lines().count(), "{all}");
    let found = ran_with(&heavy, "modes model.toml --axis least --json").json();
    let overdamped: Vec<bool> =
        found["modes"].as_array().unwrap().iter().map(|mode| mode["overdamped"].as_bool().unwrap()).collect();
    assert!(overdamped.contains(&true) && overdamped.is_sorted(), "{overdamped:?}");
}

/// A spinner with two pendulums of liquid, and a controller of a rate.
fn spinner(torque: &str) -> String {
    let slosh = |name: &str, side: f64| {
        format!(
            "[[hinged]]\nname = \"{name}\"\nmass = 40.0\ncenter_of_mass = [{}, 0.0, 0.3]\ninertia = [0, 0, 0]\n\
             hinge = [{}, 0.0, 0.3]\naxes = [[0, 0, 1], [0, 1, 0]]\nstiffness = 1e-6\ndamping = 0.1\n",
            0.75 * side,
            0.5 * side
        )
    };
    format!(
        "[carrier]\nmass = 600.0\ncenter_of_mass = [0, 0, 0]\ninertia = [300, 320, 420]\n{}{}\
         [initial]\nangular_velocity = [0, 0, \"15 rpm\"]\n\
         [[force]]\nname = \"controller\"\nkind = \"expression\"\ntorque = [\"{torque}\", \"0\", \"0\"]\n",
        slosh("left", 1.0),
        slosh("right", -1.0)
    )
}

/// Eigenvalues of an own Lagrangian, found elsewhere; the direction of the angular momentum in space is none of them.
#[test]
fn under_a_rate_controller_the_direction_in_space_is_no_mode() {
    let found = ran_with(&spinner("-20*wx"), "modes model.toml --json").json();
    let modes = found["modes"].as_array().unwrap();
    let expected = [[0.0322, 0.5345], [0.0221, 2.3373], [0.0244, 2.4992], [0.0226, 2.8395], [0.0227, 2.8963]];
    assert_eq!(modes.len(), expected.len(), "{found:#}");
    for (mode, [decay, frequency]) in modes.iter().zip(expected) {
        let gaps = [("decay_rate", decay), ("frequency", frequency)]
            .map(|(key, value)| mode[key].as_f64().unwrap() - value);
        assert!(gaps.iter().all(|gap| gap.abs() < 6e-5), "{mode:#}"); // 4 decimals known
    }
    let nutation = &modes[0];
    assert_eq!(
        (&nutation["name"], &nutation["nutation"]),
        (&"nutation".into(), &true.into()),
        "{nutation:#}"
    );
    assert!(nutation["dissipation"]["force \"controller\""].as_f64().unwrap() > 0.5, "{nutation:#}");
}

#[test]
fn a_controller_that_gives_energy_has_a_share_below_zero() {
    let found = ran_with(&spinner("1*wx"), "modes model.toml --json").json();
    let share = found["modes"][0]["dissipation"]["force \"controller\""].as_f64().unwrap();
    assert!(share < 0.0, "{found:#}");
}

/// A proportional-derivative law beside a pendulum whose damper is weak: the controller takes what the rotation loses.
#[test]
fn a_controller_of_attitude_has_its_share_of_the_dissipation() {
    let model = "\
[carrier]
mass = 1500.0
center_of_mass = [0, 0, 0]
inertia = [1800, 1500, 2000]
[[hinged]]
name = \"slosh\"
mass = 500.0
center_of_mass = [0, 0, 0.2]
inertia = [0, 0, 0]
hinge = [0, 0, 0.6]
axes = [[1, 0, 0], [0, 1, 0]]
stiffness = 1e-6
damping = 0.5
[[force]]
name = \"LAE\"
kind = \"thrust\"
on = \"carrier\"
at = [0, 0, -1.0]
force = [0, 0, 400.0]
[initial]
angular_velocity = [0, 0, 0]
[[force]]
name = \"PD\"
kind = \"expression\"
torque = [\"-60*2*qw*qx-900*wx\", \"-60*2*qw*qy-900*wy\", \"-60*2*qw*qz-900*wz\"]
";
    let found = ran_with(model, "modes model.toml --json").json();
    let rotations: Vec<&Value> = found["modes"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|mode| mode["name"].as_str().unwrap().starts_with("rotation"))
        .collect();
    assert_eq!(rotations.len(), 6, "{found:#}");
    for mode in rotations {
        assert!(mode["dissipation"]["force \"PD\""].as_f64().unwrap() > 0.99, "{mode:#}");
    }
}
