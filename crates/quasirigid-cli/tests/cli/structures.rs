//! Examples of structures and networks: their commands print what their pages show.
//! Apart from the other examples because each takes seconds; the radar shape of Apophis is skipped where its file is missing.

use std::fs;
use std::path::{Path, PathBuf};
#[cfg(unix)]
use std::process::Command;

use crate::support::{ROOT, Table, folder_of, ran, ran_in};

/// Output of a command in the README of an example, up to its first line of dots.
fn shown(example: &str, command: &str) -> String {
    let page = fs::read_to_string(Path::new(ROOT).join("examples").join(example).join("README.md")).unwrap();
    let (_, rest) = page.split_once(&format!("$ quasirigid {command}\n")).expect(command);
    let block = rest.split("```").next().unwrap().split("$ ").next().unwrap();
    block.split("...\n").next().unwrap().to_owned()
}

fn assert_answers_as_shown(example: &str, command: &str) {
    let line = format!("{command} examples/{example}/model.toml");
    let answer = ran(&line);
    let shown = shown(example, &line);
    assert!(shown.len() > 20, "{line}");
    assert!(answer.stdout.starts_with(&shown), "{line}:\n{}{}", answer.stdout, answer.stderr);
}

#[test]
fn solar_panels_answer_as_their_page_shows() {
    assert_answers_as_shown("solar-panels", "check");
    assert_answers_as_shown("solar-panels", "evolve");
}

#[test]
fn what_turns_inside_answers_as_its_pages_show() {
    for example in ["friction-wheel", "mercury-ring", "spherical-tank"] {
        assert_answers_as_shown(example, "evolve");
    }
}

#[test]
fn a_network_answers_as_its_page_shows() {
    assert_answers_as_shown("quillen-network", "evolve");
}

/// The script of the example, on the first runs of its table.
#[cfg(unix)]
#[test]
fn networks_of_the_runs_lose_what_the_page_tables() {
    let program = Path::new(env!("CARGO_BIN_EXE_quasirigid")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap_or_default());
    let script = Path::new(ROOT).join("examples/quillen-network/runs.sh");
    let printed = Command::new("sh").arg(script).arg("5").env("PATH", path).output().unwrap();
    let printed = String::from_utf8(printed.stdout).unwrap();
    let page = fs::read_to_string(Path::new(ROOT).join("examples/quillen-network/README.md")).unwrap();
    assert_eq!(printed.lines().count(), 2 + 5, "{printed}");
    assert!(page.contains(&printed), "{printed}");
    assert_eq!(page.matches(" | (").count(), 42);
}

#[test]
fn a_spun_up_beam_answers_as_its_page_shows() {
    assert_answers_as_shown("spin-up-beam", "check");
}

/// The lag that the page of the example names, next to -0.574 m in the publication; the body starts at rest, parts included.
#[test]
fn the_tip_of_a_spun_up_beam_lags_as_published() {
    let line =
        "simulate examples/spin-up-beam/model.toml --system full --displacements --times 0,6.76 --quiet";
    let answer = ran(line);
    assert_eq!(answer.code, Some(0), "{}", answer.stderr);
    let lag = Table::of(&answer.stdout).column("beam tip along y");
    assert_eq!(lag[0], 0.0);
    assert!((lag[1] / -0.574 - 1.0).abs() < 1e-2, "{lag:?}");
    let page = fs::read_to_string(Path::new(ROOT).join("examples/spin-up-beam/README.md")).unwrap();
    assert!(page.contains(&format!("{:.3} m", lag[1]).replace('-', "−")), "{lag:?}");
}

/// File of the radar shape, if there is one beside the model or beside the repository.
fn radar_shape() -> Option<PathBuf> {
    let root = Path::new(ROOT);
    let beside = root.join("examples/apophis-shape/apophis-radar-shape.obj");
    [beside, root.join("../shared/reference/apophis-radar-shape.obj")].into_iter().find(|file| file.is_file())
}

#[test]
fn the_radar_shape_of_apophis_answers_as_its_page_shows() {
    let Some(shape) = radar_shape() else {
        println!("skipped: the radar shape is not here; see examples/apophis-shape/get-shape.sh");
        return;
    };
    let folder = folder_of("apophis-shape");
    fs::copy(shape, folder.path().join("apophis-radar-shape.obj")).unwrap();
    let answer = ran_in(folder.path(), "evolve model.toml");
    let shown = shown("apophis-shape", "evolve examples/apophis-shape/model.toml");
    assert!(shown.len() > 20);
    assert!(answer.stdout.starts_with(&shown), "{}{}", answer.stdout, answer.stderr);
}
