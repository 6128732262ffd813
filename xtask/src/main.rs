//! Automation of the workspace, all of it in Rust: `cargo xtask check`, `cargo xtask test`.
#![allow(clippy::print_stdout, clippy::print_stderr)]

mod contents;
mod docs;
mod finding;
mod json;
mod labels;
mod layers;
mod markdown;
mod paths;
mod test;
mod tree;

use std::path::PathBuf;
use std::process::ExitCode;

use finding::{Finding, Weight};
use test::Wishes;
use tree::Tree;

type Check = fn(&Tree) -> Vec<Finding>;

const CHECKS: [(&str, Check); 6] = [
    ("layers", layers::check),
    ("labels", labels::check),
    ("paths", paths::check),
    ("contents", contents::check),
    ("docs", docs::check),
    ("json", json::check),
];

const HELP: &str = "\
usage: cargo xtask test [--require-python] [--wheel]
       cargo xtask <check>
       cargo xtask json --write

  test     every test, of Rust and of Python; what Python lacks is told, and fails only with --require-python;
           --wheel tests the package as users install it, which takes four minutes more

  check    all of the following
  layers   who imports whom inside a crate, and no foreign type in a public signature
  labels   equation labels and reference keys of the code exist in docs/
  paths    ARCHITECTURE.md names what exists
  contents theory and guide list each of their chapters under its number
  docs     TOML and commands in README.md and docs/guide are sound
  json     keys of the JSON output in the guide are those of the doc comments; --write writes them

exit code: 0 nothing found, 1 something found, 2 could not run";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let name = match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["test", ref wishes @ ..] => {
            return match wishes.iter().try_fold(Wishes::default(), |known, wish| match *wish {
                "--require-python" => Ok(Wishes { python: true, ..known }),
                "--wheel" => Ok(Wishes { python: true, wheel: true }),
                _ => Err(()),
            }) {
                Ok(wishes) => test(wishes),
                Err(()) => refuse(HELP),
            };
        }
        ["json", "--write"] => {
            return match workspace_root()
                .map_err(|error| error.to_string())
                .and_then(|root| json::write(&root))
            {
                Ok(()) => ExitCode::SUCCESS,
                Err(message) => refuse(&format!("xtask json: {message}")),
            };
        }
        [name] => name,
        _ => return refuse(HELP),
    };
    if ["help", "--help", "-h"].contains(&name) {
        println!("{HELP}");
        return ExitCode::SUCCESS;
    }
    let chosen: Vec<Check> = CHECKS
        .iter()
        .filter(|(check, _)| name == "check" || name == *check)
        .map(|&(_, check)| check)
        .collect();
    if chosen.is_empty() {
        return refuse(&format!("xtask: there is no check \"{name}\"\n\n{HELP}"));
    }
    match workspace_root().and_then(|root| Tree::load(&root)) {
        Ok(tree) => report(name, chosen.iter().flat_map(|check| check(&tree)).collect()),
        Err(error) => refuse(&format!("xtask: cannot read the workspace: {error}")),
    }
}

/// Runs every test.
fn test(wishes: Wishes) -> ExitCode {
    let done = workspace_root()
        .map_err(|error| format!("cannot read the workspace: {error}"))
        .and_then(|root| test::run(&root, wishes));
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("\nxtask test: {message}");
            ExitCode::FAILURE
        }
    }
}

fn refuse(message: &str) -> ExitCode {
    eprintln!("{message}");
    ExitCode::from(2)
}

fn report(name: &str, mut findings: Vec<Finding>) -> ExitCode {
    findings.sort();
    findings.dedup();
    for finding in &findings {
        println!("{finding}");
    }
    let warnings = findings.iter().filter(|finding| finding.weight == Weight::Warning).count();
    let errors = findings.len() - warnings;
    println!("xtask {name}: {errors} to mend, {warnings} to note");
    if errors == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// The nearest folder above the current one whose `Cargo.toml` declares a workspace.
fn workspace_root() -> std::io::Result<PathBuf> {
    let here = std::env::current_dir()?;
    here.ancestors()
        .find(|folder| {
            std::fs::read_to_string(folder.join("Cargo.toml"))
                .is_ok_and(|manifest| manifest.contains("[workspace]"))
        })
        .map(PathBuf::from)
        .ok_or_else(|| std::io::Error::other("no Cargo workspace here or above"))
}
