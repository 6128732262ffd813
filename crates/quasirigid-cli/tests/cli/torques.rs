//! `evolve` under torques over ages: every way to an end has its words, and none takes for ever.

use std::time::{Duration, Instant};

use serde_json::Value;

use crate::support::{MODEL, ROOT, Ran, Table, folder_with, one_line, ran_in, ran_with};

/// An ellipsoid like Apophis, with a torque fixed in the body.
fn asteroid(torque: &str) -> String {
    format!(
        "[body]\nname = \"A\"\n[material.rock]\ndensity = \"2 g/cm^3\"\nshear = \"0.5 GPa\"\npoisson = 0.25\n\
         rheology = {{ kind = \"quality-factor\", Q = 1000 }}\n[[ellipsoid]]\n\
         semi_axes = [\"219.1 m\", \"151.2 m\", \"142.7 m\"]\nmaterial = \"rock\"\n[initial]\n\
         periods = {{ rotation = \"263 h\", precession = \"27.38 h\", mode = \"short-axis\" }}\n\
         [[force]]\nkind = \"torque\"\ntorque = [0.0, 0.0, \"{torque}\"]\n"
    )
}

fn boom_with_drag() -> String {
    let text = std::fs::read_to_string(format!("{ROOT}/examples/boom-satellite/model.toml")).unwrap();
    format!("{text}\n[[force]]\nkind = \"spin-drag\"\ncoefficient = 1e-4\n")
}

/// The object, after a look at the exit code, at what else is printed, and at the text for people.
fn told(model: &str, options: &str, status: &str) -> Value {
    let folder = folder_with(model);
    let line = |more: &str| {
        let arguments = format!("evolve model.toml {options} {more}");
        ran_in(folder.path(), arguments.trim_end())
    };
    let start = Instant::now();
    let json: Ran = line("--json");
    assert!(start.elapsed() < Duration::from_secs(60), "{:?}", start.elapsed());
    let object = json.json();
    let message = object["message"].as_str().unwrap().to_owned();
    assert_eq!(object["status"], status, "{object:#}");
    assert!(message.ends_with('.') && message.len() > 20, "{message}");
    let code = if status == "finished" { 0 } else { 1 };
    let text = line("");
    assert_eq!((json.code, text.code), (Some(code), Some(code)), "{json:?}");
    if code == 1 {
        assert!(one_line(&json.stderr).contains(&message), "{}", json.stderr);
        let (_, told) = text.stdout.split_once(": ").unwrap();
        assert!(one_line(told).starts_with(&message), "{told}");
    }
    let rows = Table::of(&line("--format csv").stdout).column("t");
    let time = object["time"].as_f64().unwrap();
    assert!((rows.last().unwrap() / time - 1.0).abs() < 1e-12, "{rows:?} {time}");
    object
}

/// Value of a key; the end is located exactly, whatever the rows.
fn located(model: &str, options: &str, key: &str) -> f64 {
    let [few, many] = [21, 2001].map(|samples| {
        let ran = ran_with(model, &format!("evolve model.toml {options} --json --samples {samples}"));
        ran.json()[key].as_f64().unwrap()
    });
    assert!((few / many - 1.0).abs() < 1e-9 && few > 0.0, "{few} {many}");
    few
}

/// Adversary 02: it never ended, and took no Ctrl-C.
#[test]
fn drag_ends_at_rest() {
    let model = boom_with_drag();
    let object = told(&model, "--duration 10yr", "rest");
    assert!(object["message"].as_str().unwrap().contains("has fallen to 1e-9 of its start"), "{object}");
    located(&model, "--duration 10yr", "time");
}

/// Planetary B2: "held", an undocumented word, at the time of some row.
#[test]
fn a_torque_against_the_spin_turns_the_body_over_and_spins_it_up() {
    let model = asteroid("-1e-3 N m");
    let object = told(&model, "--duration 10Myr", "finished");
    let sentence = object["sentence"].as_str().unwrap();
    assert!(sentence.contains("turns over") && sentence.contains("passes the separatrix"), "{sentence}");
    let crossed = located(&model, "--duration 10Myr", "separatrix_time") / 31_557_600e3;
    assert!(crossed > 200.0 && crossed < 220.0, "{crossed} kyr"); // seen between rows at 200 and 210 kyr
}

#[test]
fn a_torque_along_the_spin_ends_at_the_slowest_elastic_frequency() {
    let model = asteroid("1 N m");
    let object = told(&model, "--duration 1Gyr", "spun-up");
    assert!(object["message"].as_str().unwrap().contains("slowest elastic frequency"), "{object}");
    located(&model, "--duration 1Gyr", "time");
    told(&model, "--duration 1Myr", "finished");
    let target = told(&model, "--duration 1Myr --until 5deg", "finished");
    assert!(target["message"].as_str().unwrap().starts_with("The target was reached after"), "{target}");
    located(&model, "--duration 1Myr --until 5deg", "time");
}

/// A steady spin evolves under a torque; without one it stays, and a body at rest has no axis.
#[test]
fn steady_spins_and_rest_are_told_apart() {
    let steady = MODEL.replace("[0.12, 0.035, 0.02]", "[0.0, 0.0, 0.0]");
    let refusal = ran_with(&steady, "evolve model.toml").refusal().to_owned();
    assert!(one_line(&refusal).contains("the body does not turn"), "{refusal}");
    let fast = MODEL.replace("[0.12, 0.035, 0.02]", "[1e200, 2e200, 0]");
    let refusal = ran_with(&fast, "evolve model.toml").refusal().to_owned();
    assert!(!one_line(&refusal).contains("principal axis"), "{refusal}");
    let tiny = ran_with(MODEL, "evolve model.toml --until 1e-6deg");
    assert_eq!(tiny.code, Some(0), "{tiny:?}");
    assert!(one_line(&tiny.stdout).contains("wobble of 1.00e-6 degrees"), "{}", tiny.stdout);
}

/// Planetary B7: "the body spins about a principal axis".
#[test]
fn a_wobble_needs_its_axis() {
    let model = "[material.rock]\ndensity = \"2 g/cm^3\"\nshear = \"0.5 GPa\"\npoisson = 0.25\n\
                 rheology = { kind = \"quality-factor\", Q = 1000 }\n[[ellipsoid]]\nsemi_axes = [200.0, 150.0, 150.0]\n\
                 material = \"rock\"\n[initial]\n\
                 wobble = { angle = \"20 deg\", rate = \"2 rev/d\", mode = \"short-axis\" }\n";
    let refusal = ran_with(model, "evolve model.toml").refusal().to_owned();
    assert!(one_line(&refusal).contains("no axis of greatest inertia to wobble about"), "{refusal}");
    assert!(one_line(&refusal).contains("mode = \"long-axis\""), "{refusal}");
    let long = ran_with(&model.replace("short-axis", "long-axis"), "evolve model.toml --until 0.9");
    assert_eq!(long.code, Some(0), "{long:?}");
    let to = ran_with(&model.replace("short-axis", "long-axis"), "evolve model.toml --until 5deg");
    assert!(one_line(to.refusal()).contains("two greatest moments are equal"), "{to:?}");
    let loss = ran_with(MODEL, "evolve model.toml --order 2 --power polynomial --method average");
    assert!(one_line(&loss.stdout).contains("though the body loses energy"), "{loss:?}");
}

/// Adversary 08: two bodies on a tether, whose inertia is 1e7 times less about the tether; the quadrature recursed for ever.
#[test]
fn slender_bodies_are_answered() {
    let model = "[carrier]\nmass = 100.0\ncenter_of_mass = [0.0, 0.0, 0.0]\ninertia = [10.0, 12.0, 15.0]\n\
                 [[point]]\nname = \"tip\"\nmass = 20.0\nposition = [0.0, 0.0, 2000]\n[[spring]]\nfrom = \"tip\"\n\
                 to = \"carrier\"\nstiffness = 50.0\ndamping = 5.0\n[initial]\nangular_velocity = [0.01, 0.001, 0.01]\n";
    for (length, options) in [("2000", "--power harmonics"), ("3000", ""), ("3000", "--power harmonics")] {
        let start = Instant::now();
        let ran = ran_with(&model.replace("2000", length), format!("evolve model.toml {options}").trim_end());
        println!("{length} {options}: {:?}\n{}{}", start.elapsed(), ran.stdout, ran.stderr);
        assert!(start.elapsed() < Duration::from_secs(60), "{:?}", start.elapsed());
        assert!(ran.code == Some(0) || !ran.stderr.is_empty());
        if ran.code == Some(1) {
            assert!(ran.stdout.contains("NO ANSWER"), "{}", ran.stdout);
            continue;
        }
        // Both sources of the power agree.
        let square = (length.parse::<f64>().unwrap() / 3000.0).powi(2);
        let object =
            ran_with(&model.replace("2000", length), &format!("evolve model.toml {options} --json")).json();
        assert!((object["time"].as_f64().unwrap() / (square * 7.0562e17) - 1.0).abs() < 1e-3, "{object:#}");
    }
}
