use std::fs;

use insta::assert_snapshot;

use super::support::{MODEL, folder_with, names, ran_in, ran_with};

/// How `check` refuses the model with one part replaced.
fn refusal(part: &str, by: &str) -> String {
    assert!(MODEL.contains(part), "{part}");
    ran_with(&MODEL.replacen(part, by, 1), "check model.toml").refusal().to_owned()
}

#[test]
fn unknown_key_is_answered_with_the_nearest() {
    assert_snapshot!(refusal("stiffness = 600.0", "stifness = 600.0"), @"");
}

#[test]
fn wrong_unit_is_answered_with_a_right_one() {
    assert_snapshot!(refusal("mass = 1.0", "mass = \"3 rpm\""), @"");
}

#[test]
fn negative_mass_is_refused() {
    assert_snapshot!(refusal("mass = 1.0", "mass = -1.0"), @"");
}

#[test]
fn impossible_inertia_is_refused() {
    assert_snapshot!(refusal("[9.0, 13.0, 16.0]", "[1.0, 2.0, 16.0]"), @"");
}

#[test]
fn mechanism_is_refused() {
    let spring = MODEL.find("[[spring]]").unwrap()..MODEL.find("[initial]").unwrap();
    assert_snapshot!(refusal(&MODEL[spring], ""), @"");
}

#[test]
fn duplicate_name_is_refused() {
    let point = "[[point]]\nname = \"tip\"\nmass = 2.0\nposition = [1, 0, 0]\n";
    assert_snapshot!(refusal("[[spring]]", &format!("{point}[[spring]]")), @"");
}

#[test]
fn missing_carrier_is_refused() {
    let carrier = ..MODEL.find("[[point]]").unwrap();
    assert_snapshot!(refusal(&MODEL[carrier], ""), @"");
}

#[test]
fn text_that_is_no_toml_is_refused() {
    assert_snapshot!(refusal("mass = 40.0", "mass = 40 kg"), @"");
}

#[test]
fn empty_file_is_refused() {
    assert_snapshot!(ran_with("", "check model.toml").refusal(), @"");
}

#[test]
fn missing_file_and_folder_are_refused() {
    let folder = folder_with("");
    assert_snapshot!(ran_in(folder.path(), "check nodel.toml").refusal(), @"quasirigid: nodel.toml: there is no such file");
    assert_snapshot!(ran_in(folder.path(), "check .").refusal(), @"quasirigid: .: this is a folder; give the model file inside it");
}

#[test]
fn bytes_that_are_no_text_are_located() {
    let folder = folder_with("");
    let (before, after) = MODEL.split_once("40.0").unwrap();
    let bytes = [before.as_bytes(), b"\"40 \xff\"", after.as_bytes()].concat();
    fs::write(folder.path().join("model.toml"), bytes).unwrap();
    assert_snapshot!(ran_in(folder.path(), "check model.toml").refusal(), @"");
}

#[test]
fn mistakes_are_all_shown_in_the_order_of_the_file() {
    let model = MODEL.replace("mass = 40.0", "mas = 40.0").replace("600.0", "\"600 N\"").replace("60\n", "-60\n");
    let message = ran_with(&model, "check model.toml").refusal().to_owned();
    let places: Vec<_> = message.lines().filter(|line| line.contains("model.toml:")).collect();
    assert!(places.len() >= 3 && places.is_sorted_by_key(|place| line_of(place)), "{message}");
    for shown in ["\"mas\"", "\"600 N\"", "-60"] {
        assert!(message.contains(shown), "{shown}: {message}");
    }
    assert!(message.ends_with("problems; nothing was computed\n"), "{message}");
}

fn line_of(place: &str) -> usize {
    place.split("model.toml:").nth(1).unwrap().split(':').next().unwrap().trim().parse().unwrap_or(usize::MAX)
}

#[test]
fn every_command_refuses_alike_and_writes_nothing() {
    let folder = folder_with(&MODEL.replace("mass = 40.0", "mass = 0"));
    let message = ran_in(folder.path(), "check model.toml").refusal().to_owned();
    for line in ["run model.toml", "run model.toml --json -q", "derive model.toml", "simulate model.toml --out table.csv"] {
        assert_eq!(ran_in(folder.path(), line).refusal(), message, "{line}");
        assert_eq!(names(&folder), ["model.toml"], "{line}");
    }
}

#[test]
fn messages_have_no_colours_off_a_terminal() {
    assert!(!refusal("mass = 40.0", "mass = 0").contains('\u{1b}'));
}

/// `script` gives the program a terminal; where there is none of it, nothing is learnt.
#[cfg(target_os = "linux")]
#[test]
fn messages_have_colours_on_a_terminal_that_wants_them() {
    let folder = folder_with(&MODEL.replace("mass = 40.0", "mass = 0"));
    let shown = |colours: Option<&str>| {
        let mut script = std::process::Command::new("script");
        let line = format!("{} check model.toml", env!("CARGO_BIN_EXE_quasirigid"));
        script.args(["-q", "-e", "-c", &line, "/dev/null"]).current_dir(folder.path()).env_remove("NO_COLOR");
        if let Some(value) = colours {
            script.env("NO_COLOR", value);
        }
        script.output().ok().map(|output| String::from_utf8_lossy(&output.stdout).into_owned())
    };
    if let (Some(colourful), Some(plain)) = (shown(None), shown(Some("1"))) {
        assert!(colourful.contains("\u{1b}[31m") || colourful.contains("\u{1b}["), "{colourful:?}");
        assert!(!plain.contains("\u{1b}["), "{plain:?}");
    }
}
