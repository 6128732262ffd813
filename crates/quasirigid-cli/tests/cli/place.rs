//! Position of the body, in tables and objects: paper, (1.15).

use crate::support::{MODEL, Table, difference, folder_with, numbers, ran_in, ran_with};

const PLACE: [&str; 3] = ["x", "y", "z"];
const RATE: [&str; 3] = ["vx", "vy", "vz"];
const POLE: [&str; 3] = ["R0x", "R0y", "R0z"];

/// Body off its axes that starts somewhere, with more tables.
fn model(more: &str) -> String {
    let start =
        "[initial]\nposition = [1, 2, 3]\nvelocity = [0.5, -0.25, 0.125]\nattitude = [0.5, -0.5, 0.5, 0.5]";
    MODEL.replace("[initial]", start).replace("0.12, 0.035, 0.02", "1.2, 0.35, 0.2") + more
}

fn table(model: &str, options: &str) -> Table {
    let ran = ran_with(model, &format!("simulate model.toml --times 0,2,5 --quiet {options}"));
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    Table::of(&ran.stdout)
}

#[test]
fn a_free_body_falls_as_galileo_says() {
    let gravity = "[[force]]\nkind = \"uniform-gravity\"\nacceleration = [0.3, 0, -9.81]\n";
    for (more, g) in [("", [0.0; 3]), (gravity, [0.3, 0.0, -9.81])] {
        let systems = ["full", "reduced", "rigid", "reduced --form angular-velocity"];
        let tables = systems.map(|system| table(&model(more), &format!("--system {system}")));
        for (system, table) in systems.iter().zip(&tables) {
            for (row, t) in [0.0, 2.0, 5.0].into_iter().enumerate() {
                let (start, rate) = ([1.0, 2.0, 3.0], [0.5, -0.25, 0.125]);
                let place = [0, 1, 2].map(|i| start[i] + rate[i] * t + 0.5 * g[i] * t * t);
                let velocity = [0, 1, 2].map(|i| rate[i] + g[i] * t);
                let gaps = [
                    difference(table.vector(PLACE, row), place),
                    difference(table.vector(RATE, row), velocity),
                ];
                // the angular-velocity form integrates the pole: its centre of mass is right to the order
                let allowed = if system.contains("paper") && !more.is_empty() { 1e-5 } else { 1e-11 };
                assert!(gaps.iter().all(|gap| *gap < allowed), "{system}, t = {t}: {gaps:?}");
            }
            let apart = difference(table.vector(POLE, 2), table.vector(PLACE, 2));
            let flexible = *system != "rigid";
            assert!(
                if flexible { (1e-8..1e-2).contains(&apart) } else { apart == 0.0 },
                "{system}: {apart:e}"
            );
        }
        let [full, reduced] = [0, 1].map(|i| {
            let (pole, place) = (tables[i].vector(POLE, 2), tables[i].vector(PLACE, 2));
            [0, 1, 2].map(|axis| pole[axis] - place[axis])
        });
        assert!(difference(reduced, full) < 1e-2, "{reduced:?} {full:?}");
    }
}

#[test]
fn a_driven_pole_is_where_it_is_driven_and_a_fixed_one_has_no_columns() {
    let start = MODEL.replace("[initial]", "[support]\nkind = \"prescribed\"\npoint = [0, 0, 0]\nacceleration = [\"0.3*cos(2*t)\", 0, 0]\nvelocity = [0, 0.5, 0]\nposition = [4, 0, 0]\n[initial]");
    let driven = table(&start, "");
    let t = 5.0_f64;
    let place = [4.0 + 0.075 * (1.0 - (2.0 * t).cos()), 0.5 * t, 0.0];
    assert!(difference(driven.vector(PLACE, 2), place) < 1e-11);
    assert!(!driven.header.iter().any(|name| name == "R0x"), "the pole is the place");
    let fixed = MODEL.replace("[initial]", "[support]\nkind = \"fixed-point\"\npoint = [0, 0, 0]\n[initial]");
    assert_eq!(table(&fixed, "").header.last().unwrap(), "momentum_drift");
}

#[test]
fn objects_and_records_have_it_too() {
    let folder = folder_with(&model(""));
    let row = Table::of(&ran_in(folder.path(), "simulate model.toml --times 7 --quiet").stdout);
    let json = ran_in(folder.path(), "simulate model.toml --times 7 --quiet --json").json();
    for (key, names) in [("position", PLACE), ("velocity", RATE), ("pole", POLE)] {
        let found: [f64; 3] = numbers(&json[key]).try_into().unwrap();
        assert!(difference(found, row.vector(names, 0)) < 1e-12, "{key}: {found:?}");
    }
    let ran = ran_in(folder.path(), "run model.toml -o spin --samples 3 --duration 7");
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let csv = std::fs::read_to_string(folder.path().join("spin/history-reduced.csv")).unwrap();
    let history = Table::of(&csv);
    assert!(difference(history.vector(POLE, 2), row.vector(POLE, 0)) < 1e-12);
}
