//! Controllers from the command line: histories, closed loops, and the answers that refuse them.

use serde_json::Value;

use crate::support::{MODEL, Table, one_line, ran_with};

/// The rigid carrier of [`MODEL`] alone, turned by a radian about its z axis.
fn rigid(controller: &str) -> String {
    let carrier = MODEL.split("[[point]]").next().unwrap();
    let [cos, sin] = [0.5_f64.cos(), 0.5_f64.sin()];
    format!(
        "{carrier}{controller}[initial]\nangular_velocity = [0, 0, 0]\nattitude = [{cos:?}, 0, 0, {sin:?}]\n[run]\nduration = 60\n"
    )
}

const PD: &str = "[[controller]]\nname = \"acs\"\nkind = \"pid\"\nproportional = 0.8\nderivative = 4\n";

#[test]
fn rigid_and_full_histories_are_turned_to_the_target() {
    for system in ["full", "rigid"] {
        let ran = ran_with(&rigid(PD), &format!("simulate model.toml --system {system} --times 0,10,60"));
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        assert!(one_line(&ran.stderr).contains("The controllers (acs) act in histories"), "{}", ran.stderr);
        let table = Table::of(&ran.stdout);
        let J = 16.0;
        let (decay, frequency): (f64, f64) = (2.0 / J, (0.8_f64 / J - 4.0 / J / J).sqrt());
        for (t, rate) in [0.0, 10.0, 60.0_f64].into_iter().zip(table.column("wz")) {
            let known = -0.8 / J / frequency * (-decay * t).exp() * (frequency * t).sin();
            assert!((rate - known).abs() < 1e-9, "{system} {t}: {rate} {known}");
        }
    }
}

/// Nothing leaves a controller out without a word.
#[test]
fn answers_without_controllers_refuse_them() {
    let model = format!("{MODEL}{PD}");
    for line in [
        "run model.toml -o out",
        "simulate model.toml",
        "simulate model.toml --system reduced",
        "simulate model.toml --system spin-manifold",
        "evolve model.toml",
        "verify model.toml",
        "verify model.toml --about spin",
        "modes model.toml",
        "derive model.toml --about spin",
        "export model.toml --to c -o out.c",
    ] {
        let ran = ran_with(&model, line);
        let told = one_line(ran.refusal());
        assert!(told.contains("leaves out the controllers of the model (acs)"), "{line}: {told}");
    }
    for line in ["check model.toml", "derive model.toml", "modes model.toml --effective-masses"] {
        let ran = ran_with(&model, line);
        assert!(one_line(&ran.stderr).contains("those of the body without them"), "{line}: {}", ran.stderr);
    }
    let sampled = format!("{model}period = 0.1\n");
    let told = one_line(ran_with(&sampled, "linear model.toml --at rest").refusal());
    assert!(told.contains("it is sampled, and a linear model is of continuous motion"), "{told}");
    let spinning = one_line(ran_with(&model, "linear model.toml").refusal());
    assert!(spinning.contains("so that the state is not steady"), "{spinning}");
}

fn linear(model: &str, options: &str) -> Value {
    let ran = ran_with(model, &format!("linear model.toml --json --at rest {options}"));
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    ran.json()
}

/// The roots of `J s² + k_D s + k_P` about each axis, through torques and through the motor of a wheel.
#[test]
fn poles_of_a_rigid_body_are_the_roots_of_its_equation() {
    let wheel = "[[wheel]]\nname = \"rw\"\naxis = [0, 0, 1]\nmomentum = 0\n";
    let through = "outputs = [\"torque.x\", \"torque.y\", \"wheel.rw.torque\"]\n";
    for model in [rigid(PD), rigid(&format!("{wheel}{PD}{through}"))] {
        let found = linear(&model, "");
        let poles: Vec<[f64; 2]> = serde_json::from_value(found["poles"].clone()).unwrap();
        for J in [9.0, 13.0, 16.0_f64] {
            let (decay, frequency) = (-2.0 / J, (0.8 / J - 4.0 / J / J).sqrt());
            let close = |pole: &&[f64; 2]| (pole[0] - decay).abs() + (pole[1] - frequency).abs() < 1e-12;
            assert_eq!(poles.iter().filter(close).count(), 1, "{J}: {poles:?}");
        }
        assert_eq!(poles.len(), found["states"].as_array().unwrap().len());
    }
}

/// `exp(A t) x`, by series over short times.
pub fn after(A: &[Vec<f64>], x: &[f64], t: f64) -> Vec<f64> {
    let steps = 2000;
    let step = t / f64::from(steps);
    let times = |x: &[f64]| -> Vec<f64> {
        A.iter().map(|row| row.iter().zip(x).map(|(entry, x)| entry * x).sum()).collect()
    };
    let mut state = x.to_vec();
    for _ in 0..steps {
        let mut term = state.clone();
        for k in 1..=12 {
            term = times(&term).iter().map(|entry| entry * step / f64::from(k)).collect();
            state.iter_mut().zip(&term).for_each(|(sum, term)| *sum += term);
        }
    }
    state
}

/// A pendulum hangs where gravity alone holds it: under a controller that would have it elsewhere no steady state is known. At the target
/// the poles are the roots of its equation.
#[test]
fn a_state_away_from_the_target_has_no_linear_model() {
    let model = |target: &str| {
        format!(
            "[carrier]\nmass = 10\ncenter_of_mass = [0, 0, -0.5]\ninertia = [2, 2, 1]\n[support]\nkind = \"fixed-point\"\n\
             point = [0, 0, 0]\n[[force]]\nkind = \"uniform-gravity\"\nacceleration = [0, 0, -9.81]\n[[controller]]\nkind = \"pid\"\n\
             proportional = 5\nderivative = 1\ntarget = {target}\n[initial]\nangular_velocity = [0, 0, 0]\nattitude = [1, 0, 0, 0]\n"
        )
    };
    for target in ["[0.6, 0.8, 0, 0]", "[0.96, 0, 0, 0.28]"] {
        let ran = ran_with(&model(target), "linear model.toml --at rest");
        let told = crate::support::one_line(&ran.stderr);
        assert!(ran.code == Some(2) && told.contains("the state is not steady"), "{target}: {told}");
    }
    let found = linear(&model("[1, 0, 0, 0]"), "");
    let poles: Vec<[f64; 2]> = serde_json::from_value(found["poles"].clone()).unwrap();
    let (moment, stiffness) = (2.0 + 10.0 * 0.25, 10.0 * 9.81 * 0.5 + 5.0);
    let decay: f64 = 0.5 / moment;
    let frequency = (stiffness / moment - decay * decay).sqrt();
    for known in [[-decay, -frequency], [-decay, frequency]] {
        let gap = |pole: &[f64; 2]| (pole[0] - known[0]).hypot(pole[1] - known[1]);
        assert_eq!(
            poles.iter().filter(|pole| gap(pole) < 1e-10 * frequency).count(),
            2,
            "{poles:?} {known:?}"
        );
    }
}

/// A torque about z from the velocity of the mass on its spring, filtered: sensor and actuator are apart, and the loop is unstable. The
/// history of a small displacement is that of the linear model, and grows by its pole.
#[test]
fn a_noncollocated_loop_grows_by_its_pole() {
    let body = MODEL.split("[initial]").next().unwrap().replace("damping = 30.0", "damping = 1.5");
    let model = format!(
        "{body}[[controller]]\nkind = \"state-space\"\ninputs = [\"velocity.tip.x\", \"rate.y\"]\noutputs = [\"torque.z\", \"torque.x\"]\n\
         A = [[-9, 2], [0, -4]]\nB = [[7, 0], [0.5, 1]]\nC = [[-9, 5], [0.6, -1]]\nD = [[190, 0.3], [0, -0.4]]\n\
         [initial]\nangular_velocity = [0, 0, 0]\ndisplacements = {{ tip = [1e-8, 0, 0] }}\n[run]\nduration = 10\n"
    );
    let found = linear(&model, "");
    let A: Vec<Vec<f64>> = serde_json::from_value(found["A"].clone()).unwrap();
    let C: Vec<Vec<f64>> = serde_json::from_value(found["C"].clone()).unwrap();
    let states: Vec<&str> =
        found["states"].as_array().unwrap().iter().map(|state| state["name"].as_str().unwrap()).collect();
    assert_eq!(states[12..], ["controller.controller 1.1", "controller.controller 1.2"]);
    let displaced = states.iter().position(|name| *name == "coordinate.tip x").unwrap();
    let n = states.len();
    let mut start = vec![0.0; n];
    start[displaced] = 1e-8;
    let ran = ran_with(&model, "simulate model.toml --system full --times 0.5,2,6,10 --tolerance 1e-13");
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let table = Table::of(&ran.stdout);
    for (row, t) in [0.5, 2.0, 6.0, 10.0].into_iter().enumerate() {
        let state = after(&A, &start, t);
        let known: [f64; 3] = std::array::from_fn(|axis| (0..n).map(|j| C[axis][j] * state[j]).sum());
        let found = table.vector(["wx", "wy", "wz"], row);
        let size = known.iter().fold(0.0_f64, |size, rate| size.max(rate.abs()));
        let gap = found.iter().zip(known).fold(0.0_f64, |gap, (a, b)| gap.max((a - b).abs()));
        // the square of the displacement, beside the arms
        assert!(gap < 2e-5 * size, "{t}: {found:?} {known:?}");
    }
    let [growth, frequency]: [f64; 2] = serde_json::from_value(found["poles"][0].clone()).unwrap();
    assert!(growth > 0.3, "{growth} {frequency}");
    let period = std::f64::consts::TAU / frequency.abs();
    let times = format!("{:?},{:?}", 40.0, 40.0 + 4.0 * period);
    let smaller = model.replace("1e-8", "1e-12");
    let late =
        ran_with(&smaller, &format!("simulate model.toml --system full --times {times} --tolerance 1e-13"));
    let rates = Table::of(&late.stdout).column("wz");
    let grown = (rates[1] / rates[0]).ln() / (4.0 * period);
    assert!((grown - growth).abs() < 3e-5 * growth, "{grown} {growth}");
}
