//! Coils in a magnetic field from the command line: `m = −k Ḃ` beside eddy currents, whose law it is, and its linear models. (Y8), (Y9)

use serde_json::Value;

use crate::support::{MODEL, Table, difference, one_line, ran_with};

const B_DOT: &str = "[[controller]]\nname = \"coils\"\nkind = \"b-dot\"\ngain = 4e8\n";
/// A conductor with the tensor that is the gain.
const CURRENTS: &str = "[[force]]\nkind = \"eddy-current\"\ntensor = 4e8\n";
const DIPOLE: &str = "[magnetic_field]\ndipole = [1.0e15, 0.8e15, -7.6e15]\ndipole_rate = 7.2921159e-5\n\
                      orbit = { body = \"Earth\", semi_major_axis = \"6878 km\", inclination = \"97 deg\" }\n";
const UNIFORM: &str = "[magnetic_field]\nfield = [10e-6, -20e-6, 35e-6]\n";

/// The model of the tests, whose mass is on a stiff spring, with lines.
fn stiff(lines: &str) -> String {
    let body =
        MODEL.replace("stiffness = 600.0", "stiffness = 4e5").replace("damping = 30.0", "damping = 2e3");
    body.replace("[initial]", &format!("{lines}[initial]"))
}

/// The rigid carrier of the tests, at rest or in a rotation.
fn rigid(lines: &str, omega: [f64; 3], attitude: [f64; 4]) -> String {
    let carrier = MODEL.split("[[point]]").next().unwrap();
    format!("{carrier}{lines}[initial]\nangular_velocity = {omega:?}\nattitude = {attitude:?}\n")
}

/// The unsaturated law is that of eddy currents with the gain in place of the tensor, (F15): the full system under either, the reduced
/// equations under the currents, and the rigid body all move as one, where the springs are stiff.
#[test]
fn coils_are_eddy_currents() {
    for field in [DIPOLE, UNIFORM] {
        let follow = |lines: &str, system: &str| {
            let line = format!("simulate model.toml --system {system} --times 0,30,60 --tolerance 1e-12");
            let ran = ran_with(&stiff(&format!("{field}{lines}")), &line);
            assert_eq!(ran.code, Some(0), "{}", ran.stderr);
            let table = Table::of(&ran.stdout);
            let work = table.column("work")[2];
            [1, 2].map(|row| (table.vector(["wx", "wy", "wz"], row), work))
        };
        let known = follow(CURRENTS, "full");
        assert!(known[1].1 < -0.1 * 0.5 * 9.0 * 0.12 * 0.12, "{known:?}");
        // displacements start as forces alone hold them, and the rigid body has none
        for (lines, system, close) in [
            (B_DOT, "full", 1e-7),
            (B_DOT, "rigid", 1e-6),
            (CURRENTS, "reduced", 1e-9),
            (CURRENTS, "rigid", 1e-6),
        ] {
            let found = follow(lines, system);
            for ((found, work), (known, known_work)) in found.into_iter().zip(known) {
                assert!(difference(found, known) < close, "{system} {lines}: {found:?} {known:?}");
                assert!(
                    (work / known_work - 1.0).abs() < 10.0 * close,
                    "{system} {lines}: {work} {known_work}"
                );
            }
        }
    }
}

fn linear(model: &str, options: &str) -> Value {
    let ran = ran_with(model, &format!("linear model.toml --json {options}"));
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    ran.json()
}

fn matrix(found: &Value, name: &str) -> Vec<Vec<f64>> {
    serde_json::from_value(found[name].clone()).unwrap()
}

/// The closed loop is the linear model under eddy currents, whose slopes come from the law of that force: about rest in an attitude of its
/// own, and about a spin along the field.
#[test]
fn the_closed_loop_is_the_linear_model_under_eddy_currents() {
    let aslant = [0.5, 0.1, -0.7, 0.5];
    // the field in body axes is z where this attitude turns z to it
    let [x, y, z] = [10.0, -20.0, 35.0_f64];
    let size = (x * x + y * y + z * z).sqrt();
    let half = (0.5 * (1.0 + z / size)).sqrt();
    let along = [half, -y / size / (2.0 * half), x / size / (2.0 * half), 0.0];
    // about the spin the axis of the body comes to the field, too
    for (omega, attitude, at, decaying) in
        [([0.0; 3], aslant, "rest", 2), ([0.0, 0.0, 0.02], along, "spin", 4)]
    {
        let options = format!("--at {at} --outputs rate.x,rate.y,rate.z,attitude.x,attitude.y,attitude.z");
        let model = |lines: &str| rigid(&format!("{UNIFORM}{lines}"), omega, attitude);
        let (found, known) = (linear(&model(B_DOT), &options), linear(&model(CURRENTS), &options));
        assert_eq!(found["states"], known["states"]);
        let (A, expected) = (matrix(&found, "A"), matrix(&known, "A"));
        let size = expected.iter().flatten().fold(0.0_f64, |size, entry| size.max(entry.abs()));
        for (row, expected) in A.iter().zip(&expected) {
            for (entry, expected) in row.iter().zip(expected) {
                assert!((entry - expected).abs() < 1e-9 * size, "{at}: {A:?} {expected:?}");
            }
        }
        for name in ["B", "C", "D"] {
            assert_eq!(matrix(&found, name), matrix(&known, name), "{at} {name}");
        }
        let poles = matrix(&found, "poles");
        assert_eq!(poles.iter().filter(|pole| pole[0] < -1e-3).count(), decaying, "{poles:?}");
    }
}

/// `J ω̇ = −k B² ω` across a field along z, and nothing along it.
#[test]
fn poles_about_rest_are_the_rates_of_decay() {
    let field = "[magnetic_field]\nfield = [0, 0, 35e-6]\n";
    let found = linear(&rigid(&format!("{field}{B_DOT}"), [0.0; 3], [1.0, 0.0, 0.0, 0.0]), "--at rest");
    let poles = matrix(&found, "poles");
    for J in [9.0, 13.0] {
        let known: f64 = -4e8 * 35e-6 * 35e-6 / J;
        let close = |pole: &&Vec<f64>| (pole[0] / known - 1.0).abs() < 1e-9 && pole[1] == 0.0;
        assert_eq!(poles.iter().filter(close).count(), 1, "{known} {poles:?}");
    }
    assert_eq!(poles.iter().filter(|pole| pole[0].hypot(pole[1]) < 1e-12).count(), 4, "{poles:?}");
}

#[test]
fn loops_that_vary_in_time_are_refused() {
    let refused = |lines: &str, omega, at: &str| {
        let model = rigid(lines, omega, [1.0, 0.0, 0.0, 0.0]);
        one_line(ran_with(&model, &format!("linear model.toml --at {at}")).refusal())
    };
    let orbit = refused(&format!("{DIPOLE}{B_DOT}"), [0.0; 3], "rest");
    assert!(
        orbit.contains("changes along the orbit") && orbit.contains("give [magnetic_field] a uniform"),
        "{orbit}"
    );
    let across = refused(&format!("{UNIFORM}{B_DOT}"), [0.0, 0.0, 0.02], "spin");
    assert!(across.contains("turns in the body") && across.contains("about rest"), "{across}");
    let constant = "[[controller]]\nname = \"coil\"\nkind = \"formula\"\nmoment = [\"1\", \"0\", \"0\"]\n";
    let steady = refused(&format!("{UNIFORM}{constant}"), [0.0; 3], "rest");
    assert!(steady.contains("the state is not steady"), "{steady}");
}

/// A law on the field and its rate that stops no motion in particular: the history of small rotations is that of the linear model.
#[test]
fn a_loop_on_the_field_follows_its_history() {
    let law = "[[controller]]\nname = \"compass\"\nkind = \"formula\"\ninputs = { bx = \"field.x\", by = \"field.y\", rx = \"field_rate.x\" }\n\
               moment = [\"3e6*(by + 20e-6) - 9e7*rx\", \"-2e6*(bx - 10e-6)\", \"4e6*(bx - 10e-6)\"]\n";
    let model = rigid(&format!("{UNIFORM}{law}"), [1e-7, -2e-7, 3e-7], [1.0, 0.0, 0.0, 0.0]);
    let found = linear(&model, "--at rest");
    let (A, C) = (matrix(&found, "A"), matrix(&found, "C"));
    let states: Vec<&str> =
        found["states"].as_array().unwrap().iter().map(|state| state["name"].as_str().unwrap()).collect();
    let mut state = vec![0.0; states.len()];
    for (name, rate) in [("rate.x", 1e-7), ("rate.y", -2e-7), ("rate.z", 3e-7)] {
        state[states.iter().position(|state| *state == name).unwrap()] = rate;
    }
    let times = [20.0, 60.0, 100.0];
    let ran = ran_with(&model, "simulate model.toml --system rigid --times 20,60,100 --tolerance 1e-12");
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let table = Table::of(&ran.stdout);
    for (row, t) in times.into_iter().enumerate() {
        let state = super::controllers::after(&A, &state, t);
        let known: [f64; 3] =
            std::array::from_fn(|axis| C[axis].iter().zip(&state).map(|(c, state)| c * state).sum());
        let found = table.vector(["wx", "wy", "wz"], row);
        // the squares of the angles, some hundred thousandths
        assert!(difference(found, known) < 3e-4, "{t}: {found:?} {known:?}");
    }
}

#[test]
fn a_model_without_a_field_says_what_to_add() {
    let told = one_line(ran_with(&stiff(B_DOT), "simulate model.toml --system full").refusal());
    assert!(told.contains("it needs a magnetic field") && told.contains("[magnetic_field]"), "{told}");
}

const ROD: &str = "[[rod]]\nname = \"rod x\"\naxis = [1, 0, 0]\nlength = 0.3\ndiameter = 0.02\nsaturation = 0.74\nremanence = 0.35\ncoercivity = 1.59\n";

/// Full and rigid body are braked by a rod in the same way, where the spring is stiff; what follows no past refuses it.
#[test]
fn rods_act_in_histories_and_are_refused_elsewhere() {
    let model = stiff(&format!("{DIPOLE}{ROD}"));
    let follow = |system: &str| {
        let ran = ran_with(&model, &format!("simulate model.toml --system {system} --times 0,300,600"));
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        assert!(
            one_line(&ran.stderr).contains("Controllers and hysteresis rods (rod x) act"),
            "{}",
            ran.stderr
        );
        let table = Table::of(&ran.stdout);
        (table.vector(["wx", "wy", "wz"], 2), table.column("work")[2])
    };
    let ((full, work), (rigid, _)) = (follow("full"), follow("rigid"));
    assert!(difference(rigid, full) < 1e-4, "{rigid:?} {full:?}");
    assert!(work.abs() > 1e-9, "{work}");
    for line in [
        "run model.toml -o out",
        "simulate model.toml --system reduced",
        "simulate model.toml --system spin-manifold",
        "evolve model.toml",
        "verify model.toml",
        "modes model.toml",
        "linear model.toml",
        "derive model.toml --about spin",
        "export model.toml --to c -o out.c",
    ] {
        let ran = ran_with(&model, line);
        let told = one_line(ran.refusal());
        assert!(told.contains("leaves out the hysteresis rods of the model (rod x)"), "{line}: {told}");
    }
}
