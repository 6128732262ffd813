//! Mistakes in a model file as the terminal shows them: place, source line, marker and advice.
//! Snapshots fix the drawings; every command has to refuse alike and to write nothing.

use std::fs;

use insta::assert_snapshot;

use crate::support::{MODEL, folder_with, names, ran_in, ran_with};

/// Refusal by `check` of the model with one part replaced.
fn refusal(part: &str, by: &str) -> String {
    assert!(MODEL.contains(part), "{part}");
    ran_with(&MODEL.replacen(part, by, 1), "check model.toml").refusal().to_owned()
}

#[test]
fn unknown_key_is_answered_with_the_nearest() {
    assert_snapshot!(refusal("stiffness = 600.0", "stifness = 600.0"), @r#"
    Error: unknown key "stifness" in [[spring]]
        ╭─[ model.toml:12:1 ]
        │
     12 │ stifness = 600.0
        │ ────┬───  
        │     ╰───── unknown key
        │ 
        │ Help: did you mean `stiffness`? the keys are name, from, to,
        │       stiffness, damping, rheology, axial, anchor, tension,
        │       natural_length
    ────╯

    quasirigid: model.toml: 1 problem; nothing was computed
    "#);
}

#[test]
fn wrong_unit_is_answered_with_a_right_one() {
    assert_snapshot!(refusal("mass = 1.0", "mass = \"3 rpm\""), @r#"
    Error: `mass`: "3 rpm" is an angular velocity, but a mass is needed
       ╭─[ model.toml:7:8 ]
       │
     7 │ mass = "3 rpm"
       │        ───┬───  
       │           ╰───── a mass is needed
       │ 
       │ Help: write for example "12 lb", or a plain number in kg
    ───╯

    quasirigid: model.toml: 1 problem; nothing was computed
    "#);
}

#[test]
fn negative_mass_is_refused() {
    assert_snapshot!(refusal("mass = 1.0", "mass = -1.0"), @r#"
    Error: `mass` is -1 kg, but must be positive
       ╭─[ model.toml:7:8 ]
       │
     7 │ mass = -1.0
       │        ──┬─  
       │          ╰─── must be positive
       │ 
       │ Help: write a number in kg, or a text with its unit such as "12 lb"
    ───╯

    quasirigid: model.toml: 1 problem; nothing was computed
    "#);
}

#[test]
fn impossible_inertia_is_refused() {
    assert_snapshot!(refusal("[9.0, 13.0, 16.0]", "[1.0, 2.0, 16.0]"), @r"
    Error: `inertia` of the carrier: no body has the principal moments of inertia
    [1.0, 2.0, 16.0] kg m^2: none may be negative, or exceed the sum of the other
    two
       ╭─[ model.toml:4:11 ]
       │
     4 │ inertia = [1.0, 2.0, 16.0]
       │           ────────┬───────  
       │                   ╰───────── no body has this inertia
       │ 
       │ Help: check the units and the signs of the products of inertia; the
       │       tensor is about the element's own centre of mass
    ───╯

    quasirigid: model.toml: 1 problem; nothing was computed
    ");
}

#[test]
fn mechanism_is_refused() {
    let spring = MODEL.find("[[spring]]").unwrap()..MODEL.find("[initial]").unwrap();
    assert_snapshot!(refusal(&MODEL[spring], ""), @r#"
    Error: a mechanism: no spring resists some motion of "tip" x, "tip" y, "tip" z
       ╭─[ model.toml:5:1 ]
       │
     5 │ [[point]]
       │ ────┬────  
       │     ╰────── held by no spring
       │ 
       │ Help: add a spring that resists it, or leave the point less freedom:
       │       motion = { line = [x, y, z] }
    ───╯

    quasirigid: model.toml: 1 problem; nothing was computed
    "#);
}

#[test]
fn duplicate_name_is_refused() {
    let point = "[[point]]\nname = \"tip\"\nmass = 2.0\nposition = [1, 0, 0]\n";
    assert_snapshot!(refusal("[[spring]]", &format!("{point}[[spring]]")), @r#"
    Error: the name "tip" is used twice; it stands first in line 6
        ╭─[ model.toml:10:8 ]
        │
     10 │ name = "tip"
        │        ──┬──  
        │          ╰──── used before
        │ 
        │ Help: give each element its own name
    ────╯

    quasirigid: model.toml: 1 problem; nothing was computed
    "#);
}

#[test]
fn missing_carrier_is_refused() {
    let carrier = ..MODEL.find("[[point]]").unwrap();
    assert_snapshot!(refusal(&MODEL[carrier], ""), @"
    Error: the file has no [carrier] and no part that is elastic throughout
       ╭─[ model.toml:1:1 ]
       │
     1 │ [[point]]
       │ │ 
       │ ╰─ no body in this file
       │ 
       │ Help: add [carrier] with mass, center_of_mass and inertia: the rigid
       │       body that carries everything else; or a body that is elastic
       │       throughout: [[ellipsoid]], [[surface]], [[beam]], [[panel]],
       │       [[solid]]
    ───╯

    quasirigid: model.toml: 1 problem; nothing was computed
    ");
}

#[test]
fn text_that_is_no_toml_is_refused() {
    assert_snapshot!(refusal("mass = 40.0", "mass = 40 kg"), @r#"
    Error: not valid TOML: string values must be quoted, expected literal string
       ╭─[ model.toml:2:8 ]
       │
     2 │ mass = 40 kg
       │        ──┬──  
       │          ╰──── here
       │ 
       │ Help: a number with its unit stands in quotes: "40 kg"
    ───╯

    quasirigid: model.toml: 1 problem; nothing was computed
    "#);
}

#[test]
fn empty_file_is_refused() {
    assert_snapshot!(ran_with("", "check model.toml").refusal(), @r"
    Error: the file is empty
       ╭─[ model.toml:1:1 ]
       │
     1 │ 
       │ │ 
       │ ╰─ nothing to read
       │ 
       │ Help: a model has at least a [carrier] with mass, center_of_mass and
       │       inertia, or an [[ellipsoid]] with semi_axes and material
    ───╯

    quasirigid: model.toml: 1 problem; nothing was computed
    ");
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
    assert_snapshot!(ran_in(folder.path(), "check model.toml").refusal(), @r#"
    Error: the file is not UTF-8 text: the byte 0xFF is not allowed here
       ╭─[ model.toml:2:12 ]
       │
     2 │ mass = "40 �"
       │            ┬  
       │            ╰── not UTF-8
       │ 
       │ Help: a model file is a TOML text; save it with the encoding UTF-8
    ───╯

    quasirigid: model.toml: 1 problem; nothing was computed
    "#);
}

#[test]
fn mistakes_are_all_shown_in_the_order_of_the_file() {
    let model =
        MODEL.replace("mass = 40.0", "mas = 40.0").replace("600.0", "\"600 N\"").replace("60\n", "-60\n");
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
    for line in [
        "run model.toml",
        "run model.toml --json -q",
        "derive model.toml",
        "simulate model.toml --out table.csv",
    ] {
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
