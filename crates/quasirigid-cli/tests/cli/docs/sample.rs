//! The checks of the pages, tried on pages of which the truth is known.

use std::fs;
use std::path::Path;

use tempfile::TempDir;

use super::problems;
use crate::support::{MODEL, names};

/// A repository with one example, one chapter and a README.
fn found(readme: &str) -> Vec<String> {
    let root = TempDir::new().unwrap();
    let write = |path: &str, text: &str| {
        let path = root.path().join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    };
    write("examples/boom/model.toml", MODEL);
    write("docs/guide/1.md", "```console\n$ quasirigid check examples/bom/model.toml\n```\n");
    write("docs/guide/notes.txt", "```console\n$ quasirigid nonsense\n```\n");
    write("README.md", readme);
    let found = problems(root.path());
    assert_eq!(names(root.path().join("examples/boom")), ["model.toml"], "nothing is left behind");
    let (guide, readme): (Vec<_>, Vec<_>) =
        found.into_iter().partition(|problem| problem.starts_with("docs/guide/"));
    assert_eq!(guide.len(), 1, "{guide:?}");
    assert!(
        guide[0].starts_with(
            "docs/guide/1.md:2: `quasirigid check examples/bom/model.toml` fails:\nquasirigid: "
        )
    );
    readme
}

fn console(lines: &str) -> Vec<String> {
    found(&format!("# Title\n\n```console\n{lines}```\n"))
}

#[test]
fn true_pages_have_no_problems() {
    let lines = "$ quasirigid check examples/boom/model.toml\nmodel: The reduced equations hold at this spin.\n...\n\
                 $ cargo run -- run examples/boom/model.toml -o examples/boom/out --quiet\n\
                 $ quasirigid simulate examples/boom/model.toml --duration \"1 s\" --samples 2 | head -1\n\
                 t,wx,wy,wz,qw,qx,qy,qz,energy,momentum,dissipated,work,energy_drift,momentum_drift,\
                 x,y,z,vx,vy,vz,R0x,R0y,R0z\n\
                 $ cargo test\n$ false\n";
    assert_eq!(console(lines), [""; 0]);
}

#[test]
fn output_that_differs_is_found_with_what_is_printed() {
    let found = console("$ quasirigid check examples/boom/model.toml\nmodel: It holds.\n...\n");
    assert_eq!(found.len(), 1);
    let start =
        "README.md:4: `quasirigid check examples/boom/model.toml` prints otherwise:\nmodel: The reduced";
    assert!(found[0].starts_with(start), "{found:?}");
}

#[test]
fn refusal_may_be_shown() {
    let lines = "$ quasirigid check none.toml\nquasirigid: none.toml: there is no such file\n";
    assert_eq!(console(lines), [""; 0]);
}

#[test]
fn commands_of_a_page_share_a_folder() {
    let again = "$ quasirigid run examples/boom/model.toml -o spin --quiet\n";
    let found = console(&format!("{again}{again}"));
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].starts_with("README.md:5:") && found[0].contains("spin already exists"), "{found:?}");
}

#[test]
fn complete_models_are_models_and_parts_are_not_asked_to_be() {
    let toml = |text: &str| found(&format!("```toml\n{text}```\n"));
    assert_eq!(toml(&format!("# complete\n{MODEL}")), [""; 0]);
    assert_eq!(toml("[run]\norder = 30\n"), [""; 0]);
    let parsed = toml(&format!("# complete\n{MODEL}mode = 3\n"));
    assert!(
        parsed[0].starts_with("README.md:2: not a complete model:\nmodel.toml:19:1: unknown key"),
        "{parsed:?}"
    );
    let checked = toml(&format!("# complete\n{}", MODEL.replace("600.0", "0.0")));
    assert!(checked[0].starts_with("README.md:2: not a complete model:\n"), "{checked:?}");
}

#[test]
fn commands_know_a_model_by_its_name() {
    let lines =
        "```console\n$ quasirigid check hub.toml\nhub: The reduced equations hold at this spin.\n...\n```\n";
    let named = format!("```toml\n# complete: hub.toml\n{MODEL}```\n{lines}");
    assert_eq!(found(&named), [""; 0]);
    let other = found(&named.replacen("hub.toml", "bus.toml", 1));
    assert_eq!(other.len(), 1, "{other:?}");
    assert!(other[0].contains("there is no such file"), "{other:?}");
}

#[test]
fn repository_without_pages_has_no_problems() {
    let root = TempDir::new().unwrap();
    assert_eq!(problems(root.path()), [""; 0]);
    assert_eq!(problems(Path::new("/nowhere/at/all")), [""; 0]);
}
