//! `simulate`: columns, times, units, systems and forms of the printed table, and the JSON of the last state.
//! Closed forms and invariants are the references: Euler's precession, constant angular momentum, dissipation equal to the loss.
//! Propagation: (P1) to (P4), docs/theory/05-propagation.md.

use serde_json::Value;

use crate::support::{EXAMPLES, Table, difference, folder_of, folder_with, numbers, ran, ran_in, ran_with};

const HEADER: &str = "t,wx,wy,wz,qw,qx,qy,qz,energy,momentum,dissipated,work,energy_drift,momentum_drift,\
                      x,y,z,vx,vy,vz,R0x,R0y,R0z";
const SPIN: [&str; 3] = ["wx", "wy", "wz"];
const AXIAL: &str = "simulate examples/axial-mass/model.toml";

/// The table of a command that must end with 0 and print nothing else.
#[track_caller]
fn table(line: &str) -> Table {
    let ran = ran(line);
    assert_eq!((ran.code, &*ran.stderr), (Some(0), ""), "{line}");
    Table::of(&ran.stdout)
}

#[test]
fn table_has_the_columns_of_the_contract_and_ends_with_a_line_break() {
    let printed = ran(&format!("{AXIAL} --duration 5 --samples 3")).stdout;
    assert_eq!(printed.lines().next(), Some(HEADER));
    assert!(printed.ends_with('\n') && !printed.contains("\n\n"));
    assert_eq!(printed.lines().count(), 4);
}

#[test]
fn rows_stand_at_the_times_asked_for() {
    assert_eq!(table(&format!("{AXIAL} --times 0,0.5,2,2,7.25")).column("t"), [0.0, 0.5, 2.0, 2.0, 7.25]);
    assert_eq!(table(&format!("{AXIAL} --times 3")).column("t"), [3.0]);
    assert_eq!(table(&format!("{AXIAL} --duration 8 --samples 5")).column("t"), [0.0, 2.0, 4.0, 6.0, 8.0]);
    let times = table(&format!("{AXIAL} --duration 10")).column("t");
    assert_eq!((times.len(), times[0], times[1000]), (1001, 0.0, 10.0));
}

#[test]
fn duration_takes_units_and_the_file_gives_it_otherwise() {
    let end = |option: &str| *table(&format!("{AXIAL} --samples 2{option}")).column("t").last().unwrap();
    assert_eq!(end(" --duration 0.5min"), 30.0);
    assert_eq!(end(" --duration 0.01h"), 36.0);
    assert_eq!(end(" --duration 90"), 90.0);
    assert_eq!(end(""), 7200.0); // "2 h" in the file
    let folder = folder_with(
        "[carrier]\nmass = 1\ncenter_of_mass = [0, 0, 0]\ninertia = [1, 2, 2.5]\n[initial]\nangular_velocity = [0, 3, 4]\n",
    );
    let hundred_turns =
        Table::of(&ran_in(folder.path(), "simulate model.toml --samples 2").stdout).column("t")[1];
    assert!((hundred_turns - 100.0 * std::f64::consts::TAU / 5.0).abs() < 1e-12 * hundred_turns);
}

#[test]
fn samples_of_the_file_hold_unless_the_command_gives_some() {
    let model = crate::support::MODEL.replace("[run]", "[run]\nsamples = 4");
    let rows = |option: &str| {
        Table::of(&ran_with(&model, &format!("simulate model.toml{option}")).stdout).rows.len()
    };
    assert_eq!((rows(""), rows(" --samples 6")), (4, 6));
}

/// The state at time zero is the file's, to rounding: one step of Newton's method ends within an ulp or two.
#[test]
fn first_row_is_the_spin_and_the_attitude_of_the_file() {
    let spins = [
        ("axial-mass", [0.4, 0.0, 1.0]),
        ("explorer1-stiff", [0.75, 0.75, 750.0 * std::f64::consts::TAU / 60.0]),
        ("three-masses", [0.7237041502325885, 1.1638151419359888, 0.5617384730017062]),
    ];
    for (example, spin) in spins {
        for option in ["", " --form angular-velocity", " --system rigid"] {
            let first = table(&format!("simulate examples/{example}/model.toml --times 0,0.01{option}"));
            assert!(difference(first.vector(SPIN, 0), spin) < 1e-15, "{example}{option}");
            assert_eq!(first.rows[0][4..8], [1.0, 0.0, 0.0, 0.0]);
            assert_eq!(first.rows[0][10..14], [0.0; 4], "nothing is dissipated yet");
        }
    }
}

#[test]
fn reduced_body_dissipates_what_it_loses_and_keeps_its_momentum() {
    let history = table("simulate examples/three-masses/model.toml --duration 60 --samples 7");
    let (energy, dissipated) = (history.column("energy"), history.column("dissipated"));
    for row in 1..7 {
        assert!(dissipated[row] > dissipated[row - 1]);
        let loss = energy[0] - energy[row];
        // energy and power are cut at degrees whose neighbours are some thousandths of them
        assert!((loss / dissipated[row] - 1.0).abs() < 0.01, "{loss} {}", dissipated[row]);
        assert!(history.column("energy_drift")[row].abs() < 1e-12 * energy[0]);
    }
    let angular_momentum = history.column("momentum");
    assert!(
        angular_momentum.iter().all(|K| (K / angular_momentum[0] - 1.0).abs() < 1e-14),
        "{angular_momentum:?}"
    );
}

#[test]
fn rigid_body_loses_nothing() {
    for example in EXAMPLES {
        let history =
            table(&format!("simulate examples/{example}/model.toml --system rigid --duration 5 --samples 4"));
        let (energy, work) = (history.column("energy"), history.column("work"));
        let kept = |(E, W): (&f64, &f64)| ((E - W) / energy[0] - 1.0).abs() < 1e-9;
        assert!(energy.iter().zip(&work).all(kept), "{energy:?} {work:?}");
        assert!(history.column("dissipated").iter().all(|lost| *lost == 0.0));
    }
}

/// The closed form of a body of revolution with moments 1, 1, 1.5: the spin across turns at (1.5 − 1) ωz.
#[test]
fn rigid_body_of_revolution_precesses_as_euler_says() {
    let history = table(&format!("{AXIAL} --system rigid --times 0,3"));
    let phase = 0.5 * 3.0_f64;
    let expected = [0.4 * phase.cos(), 0.4 * phase.sin(), 1.0];
    let found = history.vector(SPIN, 1);
    assert!(difference([found[0], found[1].abs(), found[2]], expected) < 1e-11, "{found:?} {expected:?}");
}

/// The truncations of the two forms differ by the first degree left out, 1e-7 of the spin here.
#[test]
fn form_of_the_paper_is_another_integration_of_the_same_motion() {
    let [angular_momentum, paper] = ["angular-momentum", "angular-velocity"]
        .map(|form| table(&format!("{AXIAL} --form {form} --times 0,20")).vector(SPIN, 1));
    let gap = difference(paper, angular_momentum);
    assert!(gap > 1e-14 && gap < 1e-4, "{gap:e}");
    let model = crate::support::MODEL.replace("[run]", "[run]\nform = \"angular-velocity\"");
    let [file, command] = ["", " --form angular-velocity"]
        .map(|option| ran_with(&model, &format!("simulate model.toml --samples 3{option}")).stdout);
    assert_eq!(file, command);
}

#[test]
fn looser_tolerance_takes_fewer_steps() {
    let steps = |tolerance: &str| {
        let ran = ran(&format!("{AXIAL} --duration 200 --json{tolerance}"));
        ran.json()["steps"].as_u64().unwrap()
    };
    assert!(steps(" --tolerance 1e-6") < steps(" --tolerance 1e-9"));
    assert!(steps(" --tolerance 1e-9") < steps(""));
    assert_eq!(steps(" --tolerance 1e-12"), steps(""), "the default is 1e-12");
}

#[test]
fn json_is_the_last_state_and_the_drift_without_a_table() {
    let line = "simulate examples/three-masses/model.toml --times 0,10";
    let last = table(line);
    let ran = ran(&format!("{line} --json"));
    assert_eq!((ran.code, &*ran.stderr), (Some(0), ""));
    let json = ran.json();
    // the row comes from the dense output, which ends within rounding of the last step
    let omega: [f64; 3] = numbers(&json["omega"]).try_into().unwrap();
    assert!(difference(omega, last.vector(SPIN, 1)) < 1e-14, "{omega:?}");
    let attitude: [f64; 4] = numbers(&json["attitude"]).try_into().unwrap();
    assert!(difference(attitude, last.rows[1][4..8].try_into().unwrap()) < 1e-14, "{attitude:?}");
    for name in ["t", "energy", "dissipated"] {
        let (found, row) = (json[name].as_f64().unwrap(), last.column(name)[1]);
        assert!((found / row - 1.0).abs() < 1e-12, "{name}: {found} {row}");
    }
    for (name, size) in [("energy_drift", last.column("energy")[0]), ("momentum_drift", 1.0)] {
        assert!(json[name].as_f64().unwrap().abs() < 1e-12 * size, "{name}: {json}");
    }
    assert_eq!(numbers(&json["momentum"]).len(), 3);
    assert_eq!((&json["status"], &json["system"]), (&"finished".into(), &"reduced".into()));
    assert!(json["turns"].as_f64().unwrap() > 2.0);
}

#[test]
fn same_input_prints_the_same_bytes() {
    for option in ["", " --form angular-velocity", " --system rigid", " --json"] {
        let line = format!("simulate examples/three-masses/model.toml --duration 60 --samples 50{option}");
        assert_eq!(ran(&line).stdout, ran(&line).stdout, "{line}");
    }
}

/// A soft mast whose dissipation holds at the sixth order, not at the default one.
const SOFT_MAST: &str = r#"
[body]
name = "mast"
[carrier]
mass = 100
center_of_mass = [0, 0, 0]
inertia = [30, 36, 10]
[[point]]
name = "tip"
mass = 1
position = [0.1, -0.2, 1.5]
[[spring]]
from = "tip"
to = "carrier"
stiffness = 80
damping = 0.1
[initial]
wobble = { angle = "12 deg", rate = 1, mode = "short-axis" }
"#;

/// Energy that a command finds dissipated, what it says on standard error in one line, and its exit code.
fn dissipated(model: &str, options: &str) -> (f64, String, Option<i32>) {
    let ran = ran_with(model, &format!("simulate model.toml --duration 500 --samples 2 --json{options}"));
    let said = ran.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
    (serde_json::from_str::<Value>(&ran.stdout).unwrap()["dissipated"].as_f64().unwrap(), said, ran.code)
}

/// A motion is followed at the order that holds unless one is asked for; that one says first that its dissipation is doubtful, or is not that
/// of the body.
#[test]
fn order_is_the_one_whose_dissipation_holds() {
    let (full, ..) = dissipated(SOFT_MAST, " --system full");
    let (own, said, code) = dissipated(SOFT_MAST, "");
    assert!((own / full - 1.0).abs() < 2e-3 && code == Some(0), "{own} {full}");
    assert!(said.contains("of order 6: at order 3, the default, dissipation or rates do not hold"), "{said}");
    let (third, said, code) = dissipated(SOFT_MAST, " --order 3");
    assert!((third / full - 1.0).abs() > 0.04 && code == Some(0), "{third} {full}");
    assert!(said.contains("Their dissipation is at the edge of its range at this order."), "{said}");
    let softer = SOFT_MAST.replace("stiffness = 80", "stiffness = 50");
    let (_, said, code) = dissipated(&softer, "");
    assert!(code == Some(1) && said.contains("Their dissipation DOES NOT at this order."), "{said}");
}

#[test]
fn run_takes_the_order_whose_dissipation_holds_and_says_so() {
    let folder = folder_with(SOFT_MAST);
    let ran = ran_in(folder.path(), "run model.toml -o found --json --duration 500");
    let record: Value = serde_json::from_str(&ran.stdout).unwrap();
    assert_eq!((ran.code, &record["reduction"]["order"]), (Some(0), &6.into()));
    assert!(
        record["notes"].to_string().contains("The reduced equations are of order 6"),
        "{}",
        record["notes"]
    );
    let (full, ..) = dissipated(SOFT_MAST, " --system full");
    let taken = record["histories"][0]["dissipated"].as_f64().unwrap();
    assert!((taken / full - 1.0).abs() < 2e-3, "{taken} {full}");
}

#[test]
fn theory_that_does_not_hold_is_said_before_the_refusal() {
    let refused = ran("simulate examples/explorer1/model.toml");
    insta::assert_snapshot!(refused.refusal(), @r"
    quasirigid: The reduced equations DO NOT HOLD at this spin. The check says why.
    quasirigid: the truncated series has no angular momentum for this angular
    velocity; the theory does not hold here: lower the spin, stiffen the springs,
    or use order 1
    ");
}

#[test]
fn theory_at_its_edge_is_said_beside_the_table_unless_quiet() {
    let model = crate::support::MODEL.replace("[0.12, 0.035, 0.02]", "[4.8, 1.4, 0.8]");
    let line = "simulate model.toml --duration 5 --samples 3";
    let [said, quiet] = ["", " --quiet"].map(|option| ran_with(&model, &format!("{line}{option}")));
    assert_eq!(
        said.stderr,
        "quasirigid: The reduced equations are at the edge of their range at this spin.\nThe check says why.\n\
         quasirigid: The reduced equations are of order 4: at order 3, the default,\ndissipation or rates do not hold.\n"
    );
    assert_eq!((quiet.code, &*quiet.stderr), (Some(0), ""));
    assert_eq!(said.stdout, quiet.stdout);
}

/// Shares of the dissipators in the full history, nearly equal to those of the reduced one.
#[test]
fn object_of_a_history_holds_the_shares_of_dissipators() {
    let shares = |system: &str| {
        let object =
            ran(&format!("simulate examples/three-masses/model.toml --system {system} --duration 20 --json"))
                .json();
        object["dissipation"].as_object().unwrap().clone()
    };
    let (full, reduced) = (shares("full"), shares("reduced"));
    assert_eq!(full.len(), 6);
    for (name, share) in &full {
        let (share, other) = (share.as_f64().unwrap(), reduced[name].as_f64().unwrap());
        assert!((share - other).abs() < 0.02, "{name}: {share} {other}");
    }
}

/// Beyond 100 000 rows a table goes to the disk as it comes: the bytes are those of one that memory holds, and nothing else is left.
#[test]
fn long_tables_are_those_of_memory() {
    let folder = folder_of("three-masses");
    let line = |options: &str| format!("simulate model.toml --duration 20 --system rigid --quiet {options}");
    assert_eq!(ran_in(folder.path(), &line("--samples 100002 --out long.csv")).code, Some(0));
    let printed = ran_in(folder.path(), &line("--samples 100002")).stdout;
    let long = std::fs::read_to_string(folder.path().join("long.csv")).unwrap();
    assert!(long == printed && long.lines().count() == 100_003);
    for format in ["parquet", "npz"] {
        let out = format!("long.{format}");
        assert_eq!(
            ran_in(folder.path(), &line(&format!("--samples 100002 --format {format} --out {out}"))).code,
            Some(0)
        );
        assert!(std::fs::metadata(folder.path().join(out)).unwrap().len() > 1_000_000);
    }
    let ends = Table::of(&ran_in(folder.path(), &line("--samples 2")).stdout);
    let last: Vec<f64> =
        long.lines().last().unwrap().split(',').map(|number| number.parse().unwrap()).collect();
    assert_eq!(last[0], ends.rows[1][0]);
    let mut left = crate::support::names(folder.path());
    left.retain(|name| name.starts_with('.'));
    assert!(left.is_empty(), "{left:?}");
}
