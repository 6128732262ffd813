//! Width of the output: every answer, help text and refusal fits a terminal of 80 columns.
//! All examples are run, since long names and many coordinates only show there; quoted lines of the user's file stay as they are.

use std::path::Path;

use tempfile::TempDir;

use crate::support::{
    CONTROLLED, EXAMPLES, MODEL, ROOT, SLIDING, STRUCTURES, STUDIES, SUNLIT, copy, folder_of, names,
    one_line, ran, ran_in, ran_with,
};

/// Examples whose answers take seconds: asked at night.
const SLOW: [&str; 4] = ["gravity-gradient", "heavy-top", "mercury-ring", "spherical-tank"];
/// Columns of a terminal.
const COLUMNS: usize = 80;
/// Examples that are also asked with other settings; those with liquids and forces would take a minute.
const SETTINGS: [&str; 4] = ["boom-satellite", "explorer1", "three-masses", "toutatis"];

fn assert_narrow(line: &str, text: &str) {
    for row in text.lines() {
        assert!(row.chars().count() <= COLUMNS, "{line}: {} columns:\n{row}", row.chars().count());
    }
}

#[test]
fn help_fits_a_terminal() {
    for command in ["", "run ", "check ", "derive ", "simulate "] {
        for option in ["-h", "--help"] {
            let line = format!("{command}{option}");
            let help = ran(&line);
            assert!(help.stdout.lines().count() > 10, "{line}");
            assert_narrow(&line, &help.stdout);
        }
    }
}

#[test]
fn every_example_is_tested() {
    let mut folders = names(Path::new(ROOT).join("examples"));
    folders.retain(|name| {
        Path::new(ROOT).join("examples").join(name).join("model.toml").is_file()
            || STUDIES.contains(&name.as_str())
    });
    let mut tested: Vec<&str> = EXAMPLES
        .into_iter()
        .chain(SLIDING)
        .chain(CONTROLLED)
        .chain(SUNLIT)
        .chain(STRUCTURES)
        .chain(STUDIES)
        .collect();
    tested.sort_unstable();
    assert_eq!(folders.iter().filter(|name| !name.contains('.')).collect::<Vec<_>>(), tested);
}

fn quick() -> impl Iterator<Item = &'static str> {
    EXAMPLES.into_iter().filter(|example| !SLOW.contains(example))
}

#[test]
fn answers_to_examples_fit_a_terminal() {
    answers_fit(quick());
}

/// A liquid that slides: `check` and `modes` answer what they can and say first what they cannot, other answers are refused.
#[test]
fn answers_to_sliding_liquids_fit_a_terminal() {
    for example in SLIDING {
        for (command, code) in
            [("check", 1), ("modes", 0), ("derive", 2), ("evolve", 2), ("verify", 2), ("run", 2)]
        {
            let line = format!("{command} examples/{example}/model.toml");
            let answer = ran(&line);
            assert_eq!(answer.code, Some(code), "{line}: {answer:?}");
            let told = answer.stderr.starts_with("quasirigid: note: MAY NOT HOLD");
            assert!(told || command == "run", "{line}: {answer:?}");
            if code == 2 {
                assert!(one_line(&answer.stderr).contains("with --system full"), "{line}: {answer:?}");
            }
            // a table of modes is as wide as it is for every body
            let table = if command == "modes" { String::new() } else { answer.stdout };
            assert_narrow(&line, &(table + &answer.stderr));
        }
    }
}

/// Controllers: `check` and `derive` answer for the body without them and say so, other answers are refused.
#[test]
fn answers_to_controlled_examples_fit_a_terminal() {
    for example in CONTROLLED {
        for (command, code) in
            [("check", 0), ("derive", 0), ("modes", 2), ("evolve", 2), ("verify", 2), ("run", 2)]
        {
            let line = format!("{command} examples/{example}/model.toml");
            let answer = ran(&line);
            assert_eq!(answer.code, Some(code), "{line}: {answer:?}");
            assert!(one_line(&answer.stderr).contains("controllers"), "{line}: {answer:?}");
            assert_narrow(&line, &(answer.stdout + &answer.stderr));
        }
    }
}

#[test]
#[ignore = "half a minute; run at night"]
fn answers_to_slow_examples_fit_a_terminal() {
    answers_fit(SLOW.into_iter());
}

fn answers_fit(examples: impl Iterator<Item = &'static str>) {
    for example in examples {
        let with_settings = SETTINGS.contains(&example);
        let commands: &[&str] = if with_settings {
            &["check", "check --order 12", "derive", "derive --order 2"]
        } else {
            &["check", "derive"]
        };
        for command in commands {
            let line = format!("{command} examples/{example}/model.toml");
            let answer = ran(&line);
            assert!(answer.stdout.lines().count() > 10, "{line}: {answer:?}");
            assert_narrow(&line, &(answer.stdout + &answer.stderr));
        }
        if example != "gravity-gradient" && example != "heavy-top" {
            let line = format!("evolve examples/{example}/model.toml");
            let answer = ran(&line);
            assert!(answer.stdout.lines().count() > 10, "{line}: {answer:?}");
            assert_narrow(&line, &(answer.stdout + &answer.stderr));
        }
        let folder = folder_of(example);
        let commands = ["run model.toml", "run model.toml --overwrite --order 1 --form angular-velocity"];
        for command in &commands[..1 + usize::from(with_settings)] {
            let answer = ran_in(folder.path(), &format!("{command} --duration 20 --samples 50"));
            assert!(answer.stdout.lines().count() > 6, "{command}: {answer:?}");
            assert_narrow(command, &(answer.stdout + &answer.stderr));
        }
    }
}

#[test]
fn refusals_fit_a_terminal() {
    let folder = TempDir::new().unwrap();
    copy(&Path::new(ROOT).join("examples"), &folder.path().join("examples"));
    for line in [
        "simulate examples/explorer1/model.toml",
        "simulate examples/axial-mass/model.toml --tolerance 1",
        "simulate examples/axial-mass/model.toml --times 2,1",
        "simulate examples/axial-mass/model.toml --duration 3kg",
        "simulate examples/axial-mass/model.toml --out examples",
        "simulate examples/axial-mass/model.toml --out examples/none/of/these/folders/is/there/table.csv",
        "run examples/axial-mass/model.toml -o examples",
        "derive examples/axial-mass/model.toml --order 13",
        "derive examples/axial-mass/mode.toml",
        "check examples",
    ] {
        let refused = ran_in(folder.path(), line);
        assert_ne!(refused.refusal(), "");
        assert_narrow(line, &refused.stderr);
    }
}

/// The lines of the file itself stay as they are.
#[test]
fn mistakes_in_a_model_fit_a_terminal() {
    for (part, by) in [("[9.0, 13.0, 16.0]", "[1.0, 2.0, 16.0]"), ("stiffness", "stifness"), ("600.0", "0.0")]
    {
        let refused = ran_with(&MODEL.replace(part, by), "check model.toml");
        assert_narrow(by, refused.refusal());
    }
}

#[test]
fn quiet_success_prints_nothing_on_standard_error() {
    for example in SETTINGS {
        let folder = folder_of(example);
        for command in ["run --duration 1", "simulate --system rigid --duration 1", "derive", "check"] {
            let line = format!("{command} --quiet model.toml");
            let answer = ran_in(folder.path(), &line);
            assert_ne!(answer.code, Some(2), "{example}: {line}");
            assert_eq!(answer.stderr, "", "{example}: {line}");
            if command.starts_with("run") {
                assert_eq!(answer.stdout, "", "{example}: {line}");
            }
        }
    }
}
