//! The full system, forces, events and `verify`.

use quasirigid_io::record::RunRecord;

use crate::support::{MODEL, Table, folder_with, numbers, one_line, ran, ran_in, ran_with};

/// The model with further lines before `[initial]`, in it, and in `[run]`.
fn model(before: &str, initial: &str, run: &str) -> String {
    MODEL.replace("[initial]", &format!("{before}\n[initial]\n{initial}")) + run
}

#[test]
fn full_and_reduced_histories_of_a_soft_start_agree_once_the_vibrations_are_gone() {
    let rest = model("", "displacements = \"rest\"", "");
    let spin = |system: &str| {
        let ran = ran_with(&rest, &format!("simulate model.toml --system {system} --json --quiet"));
        assert_eq!((ran.code, &*ran.stderr), (Some(0), ""));
        let omega = ran.json()["omega"].clone();
        [0, 1, 2].map(|i| omega[i].as_f64().unwrap())
    };
    let (full, reduced) = (spin("full"), spin("reduced"));
    for axis in 0..3 {
        assert!((full[axis] - reduced[axis]).abs() < 1e-6, "{full:?} {reduced:?}");
    }
}

#[test]
fn record_says_which_methods_took_turns() {
    let stiff =
        MODEL.replace("stiffness = 600.0", "stiffness = 6e6").replace("damping = 30.0", "damping = 6e3");
    let all = stiff + "systems = [\"full\", \"reduced\", \"rigid\"]\n";
    let ran = ran_with(&all, "run model.toml --json");
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let record = ran.json();
    let names: Vec<_> =
        (0..3).map(|i| record["histories"][i]["system"].as_str().unwrap().to_owned()).collect();
    assert_eq!(names, ["full", "reduced", "rigid"]);
    let method = record["histories"][0]["method"].as_str().unwrap();
    assert!(method.contains("explicit (DOP853)") && method.contains("implicit (Radau IIA"), "{method}");
}

#[test]
fn verify_prints_orders_and_fails_where_one_is_not_reached() {
    let ran = ran("verify examples/three-masses/model.toml --orders 1,3,5 --json");
    assert_eq!((ran.code, &*ran.stderr), (Some(0), ""));
    let json = ran.json();
    for (row, p) in [1.0, 3.0, 5.0].into_iter().enumerate() {
        let order = json["orders"][row]["order"].as_f64().unwrap();
        assert!((order - (p + 1.0)).abs() < 0.15, "p = {p}: {order}");
        assert_eq!(json["orders"][row]["errors"].as_array().unwrap().len(), 5);
    }
    let soft = MODEL.replace("angular_velocity = [0.12, 0.035, 0.02]", "angular_velocity = [9, 4, 3]");
    let ran = ran_with(&soft, "verify model.toml --orders 1 --halvings 1 --revolutions 60");
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    assert!(ran.stdout.contains("NOT REACHED"), "{}", ran.stdout);
}

/// A boom of 6 m on a stage that spins and wobbles.
const BOOM: &str = "\
[carrier]
mass = 900.0
center_of_mass = [0.0, 0.0, 0.0]
inertia = [1100.0, 1150.0, 300.0]
[material.cfrp]
density = 1600
young = \"90 GPa\"
poisson = 0.3
[section.tube]
shape = \"tube\"
radius = \"15 mm\"
thickness = \"1 mm\"
[[beam]]
name = \"boom\"
nodes = { root = [0, 0, 1.5], tip = [0, 0, 7.5] }
lines = [[\"root\", \"tip\"]]
section = \"tube\"
material = \"cfrp\"
masses = [{ node = \"tip\", mass = 3.0 }]
rayleigh = { stiffness = \"1 ms\" }
attach = \"root\"
[initial]
angular_velocity = [0.0, 0.05, \"10 rpm\"]
displacements = \"rest\"
";

/// Panels on soft hinges, thrown far by the spin: their paths hold no further, and an angle of 12 degrees is told as such.
#[test]
fn panels_thrown_far_end_the_full_system_in_words() {
    let path = format!("{}/examples/solar-panels/model.toml", crate::support::ROOT);
    let panels = std::fs::read_to_string(path).unwrap();
    let soft = panels
        .replace("stiffness = 900.0", "stiffness = 5.0")
        .replace("angle = \"5 deg\", rate = \"4 rpm\"", "angle = \"40 deg\", rate = \"12 rpm\"");
    let ran = ran_with(&soft, "simulate model.toml --system full --duration 1s --samples 2 --json");
    let said = one_line(&ran.stderr);
    assert_eq!((ran.code, &ran.json()["status"]), (Some(1), &"left-validity".into()), "{said}");
    assert!(said.contains("beyond the 20.0 % to which its paths hold"), "{said}");
    assert!(said.contains("\"north\" node") || said.contains("\"south\" node"), "{said}");
}

/// Free vibrations alone in the stiff part allow implicit steps of a third of a millisecond on curved paths: 15 000 of these.
#[test]
fn implicit_steps_on_a_beam_are_as_long_as_its_motion_allows() {
    let line = |integrator: &str| {
        format!(
            "simulate model.toml --system full --duration 0.5s --samples 2 --tolerance 1e-10 --json --integrator {integrator}"
        )
    };
    let [implicit, explicit] = ["implicit", "explicit"].map(|name| ran_with(BOOM, &line(name)).json());
    assert!(implicit["steps"].as_u64().unwrap() < 400, "{}", implicit["steps"]);
    let [a, b] = [&implicit, &explicit].map(|object| numbers(&object["omega"]));
    assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-9), "{a:?} {b:?}");
}

const SWINGING: &str = "\
[carrier]
mass = 40.0
center_of_mass = [0.0, 0.1, 0.0]
inertia = [9.0, 13.0, 16.0]
[[hinged]]
name = \"boom\"
mass = 0.5
center_of_mass = [1.2, 0.1, 0.3]
inertia = [0.01, 0.08, 0.08]
hinge = [0.8, 0.1, 0.3]
axes = [[0.0, 1.0, 0.0]]
stiffness = 0.01
damping = 0.001
places = { tip = [1.6, 0.1, 0.3] }
[initial]
angular_velocity = [0.5, 0.0, 0.6]
[initial.displacements]
boom = [\"10 deg\"]
";

/// Hinges turn to any angle in the full system: a boom that swings far is followed, and nothing drifts.
#[test]
fn a_hinge_that_turns_far_is_followed() {
    let ran = ran_with(SWINGING, "simulate model.toml --system full --duration 100s --samples 50 --json");
    assert_eq!((ran.code, &ran.json()["status"]), (Some(0), &"finished".into()), "{}", ran.stderr);
}

/// A spring at a place on a boom sees its displacement to first order: a boom that swings far is followed no further, at exit code 1.
#[test]
fn a_hinge_with_a_spring_that_turns_far_ends_the_full_system_in_words() {
    let spring =
        "[[spring]]\nfrom = \"carrier\"\nto = { part = \"boom\", node = \"tip\" }\nstiffness = 1e-4\n";
    let boom = format!("{SWINGING}{spring}");
    let ran = ran_with(&boom, "simulate model.toml --system full --duration 100s --samples 50 --json");
    let said = one_line(&ran.stderr);
    assert_eq!((ran.code, &ran.json()["status"]), (Some(1), &"left-validity".into()), "{said}");
    assert!(said.contains("\"boom\" turned on its hinge by"), "{said}");
    assert!(said.contains("beyond the 17.2 degrees to which the springs at places on it hold"), "{said}");
}

/// The whips of this example are stiff and damped beside the step of the explicit method, whose outputs between steps once broke the order.
#[test]
fn outputs_between_stiff_steps_are_as_good_as_the_steps() {
    let ran = ran("verify examples/explorer1-stiff/model.toml --orders 3");
    assert!(ran.code == Some(0) && ran.stdout.contains("Every order is reached."), "{ran:?}");
}

/// The mean power of the average comes closer to that of the full system as ε²; without an average the reason is printed.
#[test]
fn verify_proves_the_average() {
    let json = ran("verify examples/axial-mass/model.toml --orders 3 --halvings 3 --json").json();
    let average = &json["average"];
    let order = average["order"].as_f64().unwrap();
    assert!((order - 2.0).abs() < 5e-3 && average["reached"] == true, "{average}");
    assert_eq!(average["errors"].as_array().unwrap().len(), 4);
    let held = ran("verify examples/heavy-top/model.toml --orders 1 --halvings 1 --revolutions 1");
    assert!(
        held.stdout.contains("The average is left out: the average is of a free body"),
        "{}",
        held.stdout
    );
}

#[test]
fn verify_refuses_what_means_nothing() {
    for (options, message) in [
        ("--orders 11", "choose orders from 0 to 10"),
        ("--revolutions 0", "more than 0 rotations"),
        ("--halvings 0", "1 to 12 halvings"),
    ] {
        let ran = ran(&format!("verify examples/three-masses/model.toml {options}"));
        assert!(ran.refusal().contains(message), "{}", ran.stderr);
    }
}

#[test]
fn a_formula_that_fails_ends_the_run_where_it_fails() {
    let force =
        "[[force]]\nkind = \"expression\"\non = \"tip\"\nforce = [\"1e-30*sqrt(20 - t)\", \"0\", \"0\"]\n";
    for system in ["full", "reduced"] {
        let line = format!("simulate model.toml --system {system} --times 0,10,19,30 --quiet");
        let ran = ran_with(&model(force, "", ""), &line);
        assert_eq!(ran.code, Some(1), "{system}: {}", ran.stderr);
        let message = one_line(&ran.stderr);
        let (_, reached) = message.split_once("not finite numbers beyond t = ").expect(&message);
        let reached: f64 = reached.split(' ').next().unwrap().parse().unwrap();
        assert!((19.99..=20.0).contains(&reached), "{system}: {message}");
        assert_eq!(ran.stdout.lines().count(), 4, "the table is valid up to there");
        assert!(!ran.stdout.contains("NaN"));
    }
}

/// The derivatives of the root grow without bound before it ends: the truncated series runs away, and is stopped.
#[test]
fn a_series_that_runs_away_is_stopped() {
    let force =
        "[[force]]\nkind = \"expression\"\non = \"tip\"\nforce = [\"sqrt(1 - t/20)\", \"0\", \"0\"]\n";
    let ran = ran_with(&model(force, "", ""), "simulate model.toml --times 0,10,30 --json --quiet");
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    assert_eq!(ran.json()["status"], "left-validity");
}

#[test]
fn an_event_ends_the_run_and_is_no_failure() {
    let energy = |time: &str| {
        let ran = ran_with(MODEL, &format!("simulate model.toml --times {time} --json --quiet"));
        ran.json()["energy"].as_f64().unwrap()
    };
    let mark = 0.5 * (energy("0") + energy("10000"));
    let stop = model("", "", &format!("stop = {{ energy = \"{mark} J\" }}\n"));
    let ran = ran_with(&stop, "simulate model.toml --times 10000 --json");
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert!((ran.json()["energy"].as_f64().unwrap() / mark - 1.0).abs() < 1e-13);
    assert_eq!(ran.json()["status"], "event");
}

#[test]
fn forces_move_a_body_that_does_not_turn() {
    let top = model(
        "[support]\nkind = \"fixed-point\"\npoint = [0, 0, 0]\n[[force]]\nkind = \"uniform-gravity\"\nacceleration = [0, 0, -9.81]\n",
        "",
        "",
    );
    let still = top.replace("[0.12, 0.035, 0.02]", "[0, 0, 0]");
    let ran = ran_with(&top, "simulate model.toml --system full --duration 2 --json --quiet");
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let json = ran.json();
    let balance = json["energy_drift"].as_f64().unwrap() / json["work"].as_f64().unwrap();
    assert!(balance.abs() < 1e-9, "what gravity does goes into energy and dashpots: {balance:e}");
    assert!(json["momentum_drift"].as_f64().unwrap() < 1e-9);
    let ends = ["full", "reduced"].map(|system| {
        let ran = ran_with(&still, &format!("simulate model.toml --system {system} --duration 2 --quiet"));
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        let table = Table::of(&ran.stdout);
        assert!(table.rows.iter().flatten().all(|value| value.is_finite()), "{}", ran.stdout);
        *table.column("wx").last().unwrap()
    });
    assert!(ends[0] > 0.5 && (ends[0] - ends[1]).abs() < 1e-3, "{ends:?}");
}

#[test]
fn coordinates_of_the_full_system_are_columns_of_the_table() {
    let line = "simulate model.toml --system full --times 0,1,30 --quiet --coordinates";
    let table = Table::of(&ran_with(&model("", "displacements = { tip = [0.01, 0, 0] }", ""), line).stdout);
    let displacement = table.column("tip x");
    assert_eq!(displacement[0], 0.01);
    assert!(displacement[1].abs() > 1e-6 && displacement[2].abs() < 1e-4, "{displacement:?}");
    assert_eq!(table.column("tip z rate").len(), 3);
    let ran = ran_with(MODEL, "simulate model.toml --coordinates --system rigid");
    let refusal = ran.refusal().replace('\n', " ");
    assert!(refusal.contains("take --system reduced"), "{refusal}");
}

#[test]
fn displacements_of_the_full_system_are_columns_of_the_table() {
    let line = "simulate model.toml --system full --times 0,1,30 --quiet --coordinates --displacements";
    let table = Table::of(&ran_with(&model("", "displacements = { tip = [0.01, 0, 0] }", ""), line).stdout);
    for axis in ["x", "y", "z"] {
        let displacement = table.column(&format!("tip along {axis}"));
        assert_eq!(displacement, table.column(&format!("tip {axis}")));
    }
    assert_eq!(table.column("tip along x")[0], 0.01);
    let ran = ran_with(MODEL, "simulate model.toml --displacements --system rigid");
    assert!(ran.refusal().contains("--displacements: the rigid body has no internal"), "{}", ran.stderr);
}

#[test]
fn a_run_proves_itself_where_the_model_asks() {
    let folder = folder_with(&model("", "", "verify = { revolutions = 2, orders = [1, 3] }\n"));
    let ran = ran_in(folder.path(), "run model.toml -o spin");
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert!(ran.stdout.contains("Every order is reached."), "{}", ran.stdout);
    let record = RunRecord::read(&folder.path().join("spin")).unwrap();
    let verification = record.verification.unwrap();
    let found: Vec<_> = verification.orders.iter().map(|row| (&*row.form, row.p, row.reached)).collect();
    let rows = [("momentum", 1, true), ("momentum", 3, true), ("paper", 1, true), ("paper", 3, true)];
    assert_eq!((verification.reached, &found[..]), (true, &rows[..]));
    let page = std::fs::read_to_string(folder.path().join("spin/report.html")).unwrap();
    assert!(page.contains("Proof against the full system"));
}

#[test]
fn a_run_that_is_not_proved_fails_and_says_so() {
    let fast = model("", "", "verify = { revolutions = 60, orders = [1], halvings = 1 }\n")
        .replace("angular_velocity = [0.12, 0.035, 0.02]", "angular_velocity = [9, 4, 3]");
    let ran = ran_with(&fast, "run model.toml -o spin --duration 1");
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    assert!(ran.stdout.contains("NOT EVERY ORDER IS REACHED"), "{}", ran.stdout);
}

/// Nearly no damping, and a loose tolerance: the loss in the dashpots drowns in the integrator's error.
#[test]
fn an_integrator_that_imitates_the_dashpots_is_called_out() {
    let weak = MODEL.replace("damping = 30.0", "damping = 1e-6");
    let loose = ran_with(&weak, "simulate model.toml --system full --duration 600 --tolerance 1e-4 --json");
    let note = one_line(&loose.stderr);
    assert!(
        note.contains("The integrator changed the energy") && note.contains("smaller tolerance"),
        "{note}"
    );
    let tight = ran_with(MODEL, "simulate model.toml --system full --duration 600 --json");
    assert_eq!((tight.code, &*tight.stderr), (Some(0), ""));
}

#[test]
fn a_tolerance_that_cannot_be_met_is_refused_before_the_work() {
    let ran = ran_with(MODEL, "simulate model.toml --system full --tolerance 1e-17");
    assert!(ran.refusal().contains("choose one from 1e-15 to 1e-2"), "{}", ran.stderr);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_ends_a_full_run_with_a_clear_error() {
    let ran = ran_with(MODEL, "simulate model.toml --system full --out /dev/full");
    assert!(ran.refusal().contains("No space left on device"), "{}", ran.stderr);
}
