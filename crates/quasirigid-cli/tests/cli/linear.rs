//! Linear models from the command line: names, states, refusals.

use std::fs;

use serde_json::Value;

use crate::support::{MODEL, folder_with, ran_in, ran_with};

fn numbers(object: &Value, key: &str) -> Vec<Vec<f64>> {
    serde_json::from_value(object[key].clone()).unwrap()
}

fn names(object: &Value, key: &str) -> Vec<String> {
    object[key]
        .as_array()
        .unwrap()
        .iter()
        .map(|channel| channel["name"].as_str().unwrap().to_owned())
        .collect()
}

fn linear(model: &str, options: &str) -> Value {
    let ran = ran_with(model, &format!("linear model.toml --json {options}"));
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    serde_json::from_str(&ran.stdout).unwrap()
}

#[test]
fn matrices_have_the_names_of_their_rows_and_columns() {
    let found =
        linear(MODEL, "--inputs torque.z,force.tip.x,force.y --outputs rate.z,acceleration.tip.x,attitude.y");
    assert_eq!(names(&found, "inputs"), ["torque.z", "force.tip.x", "force.y"]);
    assert_eq!(names(&found, "outputs"), ["rate.z", "acceleration.tip.x", "attitude.y"]);
    let states = names(&found, "states");
    assert_eq!(states.len(), 12);
    assert_eq!(&states[..4], ["attitude.x", "attitude.y", "attitude.z", "coordinate.tip x"]);
    let [A, B, C, D] = ["A", "B", "C", "D"].map(|key| numbers(&found, key));
    assert_eq!([A.len(), A[0].len(), B.len(), B[0].len()], [12, 12, 12, 3]);
    assert_eq!([C.len(), C[0].len(), D.len(), D[0].len()], [3, 12, 3, 3]);
    // a force at the mass of 1 kg accelerates it before anything else moves; the carrier of 40 kg does not
    assert!((D[1][1] - 1.0).abs() < 1e-12, "{D:?}");
    assert_eq!(D[0], [0.0; 3]);
    let spin = found["equilibrium"]["spin"].as_array().unwrap();
    assert!(spin.iter().any(|entry| entry.as_f64().unwrap() != 0.0));
    assert!(
        found["source"]["files"].is_array()
            && found["sentence"].as_str().unwrap().starts_with("About the steady spin of")
    );
}

#[test]
fn states_are_those_asked_for() {
    for (at, rate) in [("rest", [0.0; 3]), ("0,0,0", [0.0; 3])] {
        let found = linear(MODEL, &format!("--at {at}"));
        assert_eq!(found["equilibrium"]["spin"], serde_json::json!(rate));
        assert_eq!(found["sentence"], "About rest.");
    }
    let found = linear(MODEL, "--at 0,0,-0.4");
    let spin: [f64; 3] = serde_json::from_value(found["equilibrium"]["spin"].clone()).unwrap();
    assert!(
        (spin.iter().map(|entry| entry * entry).sum::<f64>().sqrt() - 0.4).abs() < 1e-12 && spin[2] < -0.39
    );
    let A = numbers(&found, "A");
    assert!((A[0][1] - spin[2]).abs() < 1e-15 && (A[1][0] + spin[2]).abs() < 1e-15, "{:?}", A[0]);
}

#[test]
fn wrong_names_are_refused_in_words() {
    for (options, said) in [
        (
            "--inputs torque.w",
            "\"torque.w\" is no input or output here; give torque.x, force.x, force.NODE.x",
        ),
        ("--outputs acceleration.tipp.x", "give one of the nodes, such as tip"),
        ("--outputs wheel.w.speed", "give the name of a [[rotor]] about one axis"),
        (
            "--inputs torque.x,torque.y,torque.x",
            "\"torque.x\" is no input or output here; give each name once",
        ),
        ("--at fast", "\"fast\" is no steady state; give --at rest, --at spin"),
        ("--at 1,2", "is no steady state"),
    ] {
        let refused = ran_with(MODEL, &format!("linear model.toml {options}"));
        let said_now = crate::support::one_line(refused.refusal());
        assert!(said_now.contains(said), "{said_now}");
    }
}

#[test]
fn a_rotor_is_a_wheel_with_a_torque_and_a_speed() {
    let rotor = "[[rotor]]\nname = \"momentum\"\naxis = [0, 0, 1]\ninertia = 0.2\nfriction = 0.001\n";
    let options = "--at rest --inputs wheel.momentum.torque --outputs rate.z,wheel.momentum.speed,momentum.z";
    let found = linear(&format!("{MODEL}{rotor}"), options);
    let (B, C) = (numbers(&found, "B"), numbers(&found, "C"));
    let rate = |output: usize| -> f64 { (0..B.len()).map(|state| C[output][state] * B[state][0]).sum() };
    // equal and opposite on the wheel and the body, whose angular momentum no motor changes
    assert!(rate(0) < 0.0 && rate(1) > 1.0 / 0.2, "{} {}", rate(0), rate(1));
    assert!(rate(2).abs() < 1e-12, "{}", rate(2));
}

#[test]
fn forces_that_hold_the_body_hold_its_model() {
    let force = "[[force]]\nkind = \"expression\"\ntorque = [\"-2*qx\", \"-2*qy\", \"-2*qz\"]\n";
    let rest = MODEL.replace("angular_velocity = [0.12, 0.035, 0.02]", "angular_velocity = [0, 0, 0]");
    let found = linear(&format!("{rest}{force}"), "--at rest");
    let A = numbers(&found, "A");
    let states = names(&found, "states");
    let row = states.iter().position(|name| name == "rate.z").unwrap();
    // a small turn about z is twice qz
    assert!(A[row][2] < -1.0 / 20.0, "{:?}", A[row]);
}

/// A spring of constant loss, in place of the dashpot.
fn lossy() -> String {
    MODEL.replace("damping = 30.0", "rheology = { kind = \"quality-factor\", Q = 20 }")
}

#[test]
fn what_a_material_costs_in_accuracy_is_said_first() {
    let found = linear(&lossy(), "--at rest --band 12,48");
    assert_eq!(found["accuracy"]["band"], serde_json::json!([12.0, 48.0]));
    assert!(found["accuracy"]["error"].as_f64().unwrap() < 0.1, "{}", found["accuracy"]);
    assert!(names(&found, "states").iter().any(|name| name == "lag.1.1.3"));
    let ran = ran_with(&lossy(), "linear model.toml --at rest --band 12,48");
    let first = crate::support::one_line(ran.stdout.lines().nth(2).unwrap());
    assert!(first.starts_with("The response to torques is within "), "{first}");
    for (band, said) in
        [("5", "a band is two frequencies"), ("5,1", "5 to 1 rad/s is no band of frequencies")]
    {
        let refused = ran_with(&lossy(), &format!("linear model.toml --band {band}"));
        let told = crate::support::one_line(&refused.stderr);
        assert!(refused.code == Some(2) && told.contains(said), "{told}");
    }
}

#[test]
fn a_momentum_wheel_has_a_torque_and_an_angular_momentum() {
    let wheel = "[[wheel]]\nname = \"w\"\naxis = [0, 3, 0]\nmomentum = 2.0\n";
    let options = "--at rest --inputs torque.x,wheel.w.torque --outputs rate.z,wheel.w.momentum,momentum.y";
    let found = linear(&format!("{MODEL}{wheel}"), options);
    assert_eq!(names(&found, "states").last().unwrap(), "wheel.w.momentum");
    let (B, C) = (numbers(&found, "B"), numbers(&found, "C"));
    let rate = |output: usize| -> f64 { (0..B.len()).map(|state| C[output][state] * B[state][1]).sum() };
    assert!((rate(1) - 1.0).abs() < 1e-12 && rate(2).abs() < 1e-12, "{} {}", rate(1), rate(2));
    let refused = ran_with(&format!("{MODEL}{wheel}"), "linear model.toml --outputs wheel.w.momentum");
    assert!(crate::support::one_line(refused.refusal()).contains("wheel.w.torque, is an input"));
}

#[test]
fn matrices_are_written_for_other_programs_and_replace_nothing() {
    let folder = folder_with(MODEL);
    let at = |line: &str| ran_in(folder.path(), &format!("linear model.toml {line}"));
    let first = at("-o plant.mat");
    assert_eq!(first.code, Some(0), "{}", first.stderr);
    assert!(first.stderr.contains("wrote plant.mat"), "{}", first.stderr);
    let bytes = fs::read(folder.path().join("plant.mat")).unwrap();
    assert!(bytes.starts_with(b"MATLAB 5.0 MAT-file") && &bytes[124..128] == b"\x00\x01IM");
    let again = at("-o plant.mat");
    assert!(again.code == Some(2) && again.stderr.contains("already exists"), "{}", again.stderr);
    assert_eq!(at("-o plant.mat --overwrite -q").code, Some(0));
    assert_eq!(at("-o plant.npz").code, Some(0));
    let odd = at("-o plant.csv");
    assert!(odd.code == Some(2) && odd.stderr.contains(".mat or .npz"), "{}", odd.stderr);
    assert_eq!(crate::support::names(folder.path()), ["model.toml", "plant.mat", "plant.npz"]);
}

/// An appendage on two gimbals.
const GIMBALS: &str = "[[hinged]]\nname = \"dish\"\nmass = 2\ncenter_of_mass = [1.2, 0.1, 0]\ninertia = [0.1, 0.4, 0.3]\n\
                       hinge = [0.5, 0, 0]\naxes = [[0, 0, 1], [0, 1, 0]]\nstiffness = [14, 22]\ndamping = [0.6, 0.4]\n";

#[test]
fn hinges_have_torques_angles_and_rates_by_axis() {
    let model = format!("{MODEL}{GIMBALS}");
    let options = "--at rest --inputs hinge.dish.2.torque --outputs hinge.dish.2.rate,hinge.dish.2.angle,hinge.dish.1.rate,momentum.y";
    let found = linear(&model, options);
    let (B, C) = (numbers(&found, "B"), numbers(&found, "C"));
    let rate = |output: usize| -> f64 { (0..B.len()).map(|state| C[output][state] * B[state][0]).sum() };
    assert!(rate(0) > 0.0 && rate(1) == 0.0 && rate(3).abs() < 1e-12, "{} {} {}", rate(0), rate(1), rate(3));
    assert_eq!(found["inputs"][0]["unit"], "N m");
    assert_eq!(found["outputs"][1]["unit"], "rad");
    for (name, said) in [
        ("hinge.dish.torque", "dish.1 to dish.2"),
        ("hinge.dish.3.torque", "dish.1 to dish.2"),
        ("hinge.arm.torque", "dish.1 to dish.2"),
    ] {
        let refused = ran_with(&model, &format!("linear model.toml --inputs {name}"));
        assert!(crate::support::one_line(refused.refusal()).contains(said), "{name}: {}", refused.stderr);
    }
    let refused = ran_with(MODEL, "linear model.toml --inputs acceleration.x");
    assert!(
        crate::support::one_line(refused.refusal()).contains("give force.x, or a [support]"),
        "{}",
        refused.stderr
    );
    let held = format!("{MODEL}[support]\nkind = \"fixed-point\"\npoint = [0, 0, 0]\n");
    let found = linear(&held, "--at rest --inputs acceleration.x --outputs rate.z");
    assert_eq!(found["inputs"][0]["unit"], "m/s^2");
}

#[test]
fn a_truncated_model_says_its_bound_first() {
    let options = "linear model.toml --at rest --inputs torque.z --outputs rate.z --truncate balanced --keep";
    let ran = ran_with(MODEL, &format!("{options} 10"));
    let first = crate::support::one_line(ran.stdout.lines().nth(2).unwrap());
    assert!(
        ran.code == Some(0) && first.starts_with("The response is within "),
        "{:?} {first} {}",
        ran.code,
        ran.stderr
    );
    let coarse = ran_with(MODEL, &format!("{options} 6"));
    let first = crate::support::one_line(coarse.stdout.lines().nth(2).unwrap());
    assert!(coarse.code == Some(1) && first.starts_with("DOES NOT HOLD: the response is within "), "{first}");
    let coarse = ran_with(MODEL, "linear model.toml --json --at rest --truncate modal --keep 10");
    assert_eq!(coarse.code, Some(1), "{}", coarse.stderr);
    let found: Value = serde_json::from_str(&coarse.stdout).unwrap();
    assert_eq!(
        (names(&found, "states")[9].as_str(), &found["truncation"]["whole"]),
        ("truncated.10", &serde_json::json!(12))
    );
    for (options, said) in [
        ("--truncate balanced --keep 3", "6 states do not decay"),
        ("--truncate balanced --keep 12", "has 12 states; keep fewer"),
        ("--truncate modal --keep 3", "keep 6 or more"),
        ("--truncate balanced", "--keep"),
        ("--truncate best --keep 8", "balanced, modal"),
    ] {
        let refused = ran_with(MODEL, &format!("linear model.toml --at rest {options}"));
        let told = crate::support::one_line(&refused.stderr);
        assert!(refused.code == Some(2) && told.contains(said), "{options}: {told}");
    }
}

/// A box of water, whose response is known to the slow flow alone.
#[test]
fn a_liquid_that_is_not_known_is_said_first() {
    let water = "[[cavity]]\nname = \"tank\"\nshape = \"box\"\nsides = [0.6, 0.5, 0.4]\ncenter = [0, 0, 0]\n\
                 density = 1000\nkinematic_viscosity = \"1 cSt\"\n";
    let tank = format!("{MODEL}{water}");
    for (at, code, said) in [
        (
            "0,0,1",
            1,
            "DOES NOT HOLD: The equations of motion describe liquids by slow flow and a few relaxations",
        ),
        ("rest", 0, "how far that is from the response of tank is not known"),
    ] {
        let ran = ran_with(&tank, &format!("linear model.toml --at {at}"));
        let told = crate::support::one_line(&ran.stdout);
        assert!(ran.code == Some(code) && told.contains(said), "{at}: {:?} {told}", ran.code);
        let at_the_state = told.find("About").unwrap();
        assert!(told.find(said).unwrap() < at_the_state, "{told}");
    }
    assert_eq!(linear(&tank, "--at rest")["not_compared"], serde_json::json!(["tank"]));
}
