//! Reduced equations about the spin: `derive`, `simulate`, `check`, `verify` and `evolve`, their verdicts first, their refusals in words.

use crate::support::{one_line, ran, ran_with};

/// Satellite with a tuned damper on a spring.
const DAMPER: &str = "examples/nutation-damper/model.toml";
const EXPLORER: &str = "examples/explorer1/model.toml";

/// A boom on a spring so soft that the mass falls outwards: the steady spin is unstable, and no slow motion about it lasts.
const BUCKLED: &str = "\
[carrier]
mass = 100.0
center_of_mass = [0.02, -0.05, 0.1]
inertia = [16.1, 19.2, 18.0]
[[point]]
name = \"soft\"
mass = 0.0162
position = [-0.534, 0.061, -0.371]
motion = { line = [0, 0, 1] }
[[spring]]
from = \"soft\"
to = \"carrier\"
stiffness = 0.00097
damping = 6.28e-5
[initial]
wobble = { angle = \"10 deg\", rate = 1, mode = \"short-axis\" }
";

#[test]
fn explorer_1_as_it_flew_has_equations_about_its_spin() {
    let found = ran(&format!("derive {EXPLORER} --about spin --degree 9 --json"));
    let json = found.json();
    assert_eq!(found.code, Some(0), "{}", json["sentence"]);
    // The rate of a small nutation at this |K|, from an independent linearisation of the satellite, printed to four digits.
    assert!(
        (json["masters"][0]["decay_rate"].as_f64().unwrap() + 0.087_64).abs() < 1e-5,
        "{}",
        json["masters"]
    );
    let range = json["range"]["nutation"].as_f64().unwrap().to_degrees();
    assert!((38.0..42.0).contains(&range), "{range}");
    assert!(json["backbone"].as_array().unwrap().len() > 20);
    let text = ran(&format!("derive {EXPLORER} --about spin --degree 9"));
    assert!(
        one_line(&text.stdout).contains("hold to a nutation of 39.5 degrees within 1.0 %"),
        "{}",
        text.stdout
    );
}

/// At a low degree the start is outside the range: said first, with exit code 1.
#[test]
fn a_start_outside_the_range_is_told_first() {
    let found = ran(&format!("derive {EXPLORER} --about spin --degree 3"));
    assert_eq!(found.code, Some(1));
    let first = one_line(&found.stdout);
    assert!(
        first.starts_with("Explorer 1: The reduced equations about the spin DO NOT HOLD at the start"),
        "{first}"
    );
}

#[test]
fn check_says_which_reduction_holds() {
    for (model, code, reduction) in [
        ("examples/explorer1-stiff/model.toml", 0, "rest"),
        (DAMPER, 1, "spin"),
        ("examples/duende/model.toml", 0, "rest"),
    ] {
        let found = ran(&format!("check {model} --json"));
        assert_eq!((found.code, &found.json()["reduction"]), (Some(code), &reduction.into()), "{model}");
    }
    let text = one_line(&ran(&format!("check {DAMPER}")).stdout);
    assert!(text.contains("+ The reduced equations about the spin hold to a nutation of"), "{text}");
}

#[test]
fn a_history_on_the_manifold_is_that_of_the_full_system() {
    let last = |system: &str| {
        let found = ran(&format!("simulate {DAMPER} --system {system} --duration 40 --samples 2 --json"));
        assert_eq!(found.code, Some(0), "{}", found.stderr);
        found.json()["last"].clone()
    };
    let (full, reduced) = (last("full"), last("manifold"));
    for key in ["wx", "wy", "wz"] {
        let [full, reduced] = [&full, &reduced].map(|row| row[key].as_f64().unwrap());
        assert!((full - reduced).abs() < 1e-4, "{key}: {full} {reduced}");
    }
}

#[test]
fn verify_measures_the_order_in_the_amplitude() {
    let found = ran(&format!("verify {DAMPER} --about spin --orders 1,2,3 --json"));
    let json = found.json();
    assert_eq!((found.code, &json["reached"]), (Some(0), &true.into()), "{json}");
    for row in json["orders"].as_array().unwrap() {
        let (order, expected) = (row["order"].as_f64().unwrap(), row["expected"].as_f64().unwrap());
        assert!((order - expected).abs() < 0.35, "{row}");
    }
    let text = ran(&format!("verify {DAMPER} --about spin --orders 2"));
    assert!(text.stdout.contains("Every order is reached."), "{}", text.stdout);
}

/// What exits with 0 is right: the method of its own is that of the full system, and is refused where the spin is unstable.
#[test]
fn evolve_on_the_manifold_agrees_with_the_full_system_or_refuses() {
    let evolved = |method: &str| ran(&format!("evolve {DAMPER} --method {method} --json")).json();
    let (reduced, full) = (evolved("manifold"), evolved("direct"));
    assert_eq!((&reduced["road"], &full["road"]), (&"manifold".into(), &"direct".into()));
    let [own, truth] = [&reduced, &full].map(|answer| answer["time"].as_f64().unwrap());
    let error = reduced["time_error"].as_f64().unwrap();
    assert!((own / truth - 1.0).abs() <= error && error < 0.01, "{own} {truth} {error}");
    let refused = ran_with(BUCKLED, "evolve model.toml --method manifold --to 0.9990 --json");
    assert_eq!((refused.code, &refused.json()["status"]), (Some(1), &"refused".into()));
    let told = one_line(&ran_with(BUCKLED, "derive model.toml --about spin").stdout);
    assert!(told.contains("DO NOT HOLD: the steady spin is unstable"), "{told}");
}

#[test]
fn what_has_no_such_equations_is_refused_in_words() {
    for (model, words) in [
        ("examples/apophis/model.toml", "no equations of motion of its own"),
        ("examples/gravity-gradient/model.toml", "moment"),
    ] {
        let found = ran(&format!("derive {model} --about spin"));
        assert!(found.code != Some(0) && found.stderr.contains(words), "{model}: {}", found.stderr);
    }
    let found = ran(&format!("derive {EXPLORER} --about spin --degree 12"));
    assert!(found.code == Some(2) && found.stderr.contains("1 to 11"), "{}", found.stderr);
    let found = ran(&format!("derive {EXPLORER} --degree 5"));
    assert!(found.code == Some(2) && found.stderr.contains("--about spin"), "{}", found.stderr);
    let found = ran(&format!("derive {DAMPER} --about spin --masters 77"));
    assert!(found.code == Some(2) && found.stderr.contains("77"), "{}", found.stderr);
}
