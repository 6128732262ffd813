//! `modes` under forces and on supports: the text of the steady state, and every refusal.

use serde_json::Value;

use crate::support::{MODEL, ROOT, Ran, one_line, ran_with};

/// A body that hangs from a point, 0.5 m below it; its moments about that point are 10.25, 14 and 16 kg m2.
const PENDULUM: &str = "\
[carrier]
mass = 40.0
center_of_mass = [0.0, 0.0, 0.0]
inertia = [9.0, 13.0, 16.0]
[support]
kind = \"fixed-point\"
point = [0.0, 0.0, 0.5]
[[force]]
name = \"weight\"
kind = \"uniform-gravity\"
acceleration = [0.0, 0.0, -9.81]
";

fn object(ran: &Ran) -> Value {
    assert_eq!(ran.code, Some(0), "{ran:?}");
    ran.json()
}

fn frequencies(object: &Value) -> Vec<f64> {
    object["modes"].as_array().unwrap().iter().map(|mode| mode["frequency"].as_f64().unwrap()).collect()
}

#[test]
fn a_pendulum_at_rest_has_its_two_frequencies() {
    let object = object(&ran_with(PENDULUM, "modes model.toml --json"));
    let expected = [23.0, 19.0].map(|I| f64::sqrt(40.0 * 9.81 * 0.5 / I));
    for (found, expected) in frequencies(&object).iter().zip(expected) {
        assert!((found / expected - 1.0).abs() < 1e-12, "{object:#}");
    }
    assert_eq!(object["modes"].as_array().unwrap().len(), 2);
    assert_eq!((&object["stable"], &object["steady_state"]["rate"]), (&Value::from(true), &Value::from(0.0)));
    let text = ran_with(PENDULUM, "modes model.toml").stdout;
    assert!(one_line(&text).contains("neither decays nor grows. The body rests."), "{text}");
}

#[test]
fn a_body_that_is_turned_over_is_said_to_be_unstable_first() {
    let over =
        format!("{PENDULUM}[initial]\nangular_velocity = [0.0, 0.0, 0.0]\nattitude = [0.0, 1.0, 0.0, 0.0]\n");
    let ran = ran_with(&over, "modes model.toml");
    let (_, told) = ran.stdout.split_once(": ").unwrap();
    assert!(one_line(told).starts_with("The steady state under the forces is UNSTABLE"), "{told}");
}

#[test]
fn the_angular_velocity_asked_for_is_the_rate() {
    let object = object(&ran_with(PENDULUM, "modes model.toml --json --spin 0,0,0.3"));
    assert!((object["steady_state"]["rate"].as_f64().unwrap() - 0.3).abs() < 1e-12, "{object:#}");
}

#[test]
fn what_has_no_steady_state_is_refused_in_words() {
    let eccentric = std::fs::read_to_string(format!("{ROOT}/examples/gravity-gradient/model.toml")).unwrap();
    let circular = eccentric.replace("eccentricity = 0.072, ", "");
    let timed = format!(
        "{MODEL}\n[[force]]\nname = \"shaker\"\nkind = \"expression\"\non = \"tip\"\nforce = [\"0\", \"0\", \"sin(t)\"]\n"
    );
    let wheel =
        "[[wheel]]\nname = \"w\"\naxis = [0.0, 0.0, 1.0]\ninertia = 0.1\nspeed = { formula = \"10*t\" }\n";
    let cases = [
        (eccentric.as_str(), "", 1, "is eccentric (0.072)"),
        (circular.as_str(), "--spin 0,0,1", 1, "sets the rate and the axis"),
        (circular.as_str(), "--axis least", 2, "--axis names a principal axis"),
        (timed.as_str(), "", 1, "the force \"shaker\" changes with time"),
        (&format!("{PENDULUM}{wheel}"), "", 1, "a momentum wheel changes its speed"),
        (&format!("{MODEL}{wheel}"), "", 1, "a momentum wheel changes its speed"),
    ];
    for (model, options, code, message) in cases {
        let ran = ran_with(model, format!("modes model.toml {options}").trim_end());
        assert_eq!(ran.code, Some(code), "{ran:?}");
        assert!(one_line(&format!("{}{}", ran.stdout, ran.stderr)).contains(message), "{ran:?}");
    }
    let ran = ran_with(&circular, "modes model.toml --json");
    let names: Vec<_> =
        object(&ran)["modes"].as_array().unwrap().iter().map(|mode| mode["name"].clone()).collect();
    assert!(names.contains(&"pitch".into()) && names.contains(&"roll-yaw".into()), "{names:?}");
}

/// Uniform gravity does nothing to a free body: its modes are those without.
#[test]
fn a_free_body_that_falls_has_the_modes_of_one_that_does_not() {
    let falling =
        format!("{MODEL}\n[[force]]\nkind = \"uniform-gravity\"\nacceleration = [0.0, 0.0, -9.81]\n");
    let [a, b] = [MODEL, &falling].map(|model| ran_with(model, "modes model.toml").stdout);
    assert_eq!(a, b);
}

#[test]
fn check_tells_of_the_steady_state_in_a_sentence() {
    let model = format!("{PENDULUM}[initial]\nangular_velocity = [0.0, 0.0, 0.3]\n");
    let ran = ran_with(&model, "check model.toml");
    assert!(one_line(&ran.stdout).contains("Steady state under the forces No small motion"), "{ran:?}");
}

/// A pendulum with a ball of liquid, `(J + 5 I i₂(κ)/κ i₁(κ)) s² + mgl = 0` with `κ² = a²s/ν` and modified spherical Bessel functions: roots
/// found by Newton's method elsewhere.
#[test]
fn a_pendulum_with_a_ball_of_liquid_swings_and_decays_as_its_closed_form() {
    let cases = [
        ("1e-6", 0.004673209354067821, 10.023330122176924),
        ("1e-3", 0.0681782851932305, 9.886670776729476),
        ("0.1", 0.0014054615611081192, 9.82139232540962),
    ];
    for (viscosity, decay, frequency) in cases {
        let model = format!(
            "[carrier]\nmass = 2.0\ncenter_of_mass = [0.0, 0.0, -0.05]\ninertia = [0.006, 0.006, 0.01]\n\
             [support]\nkind = \"fixed-point\"\npoint = [0.0, 0.0, 0.0]\n\
             [[force]]\nkind = \"uniform-gravity\"\nacceleration = [0.0, 0.0, -9.81]\n\
             [[cavity]]\nname = \"tank\"\nshape = \"sphere\"\nradius = 0.05\ncenter = [0.0, 0.0, -0.05]\n\
             density = 1000.0\nkinematic_viscosity = {viscosity}\n"
        );
        let object = object(&ran_with(&model, "modes model.toml --json"));
        let modes = object["modes"].as_array().unwrap();
        let swing = modes.iter().find(|mode| mode["name"] == "rotation").unwrap();
        let [found, rate] = ["decay_rate", "frequency"].map(|key| swing[key].as_f64().unwrap());
        assert!((found / decay - 1.0).abs() < 1e-8 && (rate / frequency - 1.0).abs() < 1e-10, "{swing:#}");
    }
}
