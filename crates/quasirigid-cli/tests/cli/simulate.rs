//! `simulate`: columns, times, units, systems and forms of the printed table, and the JSON of the last state.

use std::path::Path;

use crate::support::{ROOT, Table, difference, folder_of, folder_with, numbers, ran, ran_in, ran_with};

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
        let line = format!("simulate examples/three-masses/model.toml --duration 20 --samples 50{option}");
        let [one, other] = [(); 2].map(|()| ran_in(Path::new(ROOT), &line));
        assert!(one.code == Some(0) && one.stdout == other.stdout, "{line}");
    }
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
