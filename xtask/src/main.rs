//! Automation of the workspace, all of it in Rust: `cargo xtask check`, `cargo xtask test`.
#![allow(clippy::print_stdout, clippy::print_stderr)]

mod book;
mod cases;
mod docs;
mod finding;
mod json;
mod labels;
mod lanes;
mod layers;
mod markdown;
mod paths;
mod release;
mod test;
mod tree;

use std::path::PathBuf;
use std::process::ExitCode;

use finding::{Finding, Weight};
use test::Wishes;
use tree::Tree;

type Check = fn(&Tree) -> Vec<Finding>;

const CHECKS: [(&str, Check); 8] = [
    ("layers", layers::check),
    ("labels", labels::check),
    ("paths", paths::check),
    ("docs", docs::check),
    ("book", book::check),
    ("versions", release::check),
    ("json", json::check),
    ("cases", cases::check),
];

const HELP: &str = "\
usage: cargo xtask test [--require-python] [--wheel]
       cargo xtask release [--plan]
       cargo xtask <check>
       cargo xtask json --write

  test     every test, of Rust and of Python; what Python lacks is told, and fails only with --require-python;
           --wheel tests the package as users install it, which takes four minutes more
  release  archive of the program, wheel, lists of materials and checksums in dist/; --plan names the steps alone

  check    all of the following
  layers   who imports whom inside a crate, and no foreign type in a public signature
  labels   equation labels and reference keys of the code exist in docs/
  paths    ARCHITECTURE.md and CONTRIBUTING.md name what exists
  docs     TOML and commands in README.md and docs/guide are sound
  book     docs/SUMMARY.md names every chapter, links lead somewhere; then mdBook, where it is installed, builds the site
  versions workspace, crates, Python package, citation, recipe and changelog agree on the version
  cases    tests named in the table of readers' cases exist
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
        ["release"] => return release(false),
        ["release", "--plan"] => return release(true),
        ["preprocess"] => return told("preprocess", book::preprocess().map_err(|error| error.to_string())),
        // mdBook asks whether the preprocessor suits a form of output: it suits each.
        ["preprocess", "supports", _] => return ExitCode::SUCCESS,
        ["json", "--write"] => {
            let root = workspace_root().map_err(|error| error.to_string());
            return told("json", root.and_then(|root| json::write(&root)));
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
    match workspace_root().and_then(|root| Ok((Tree::load(&root)?, root))) {
        Ok((tree, root)) => {
            let sound = report(name, chosen.iter().flat_map(|check| check(&tree)).collect());
            match name {
                _ if !sound => ExitCode::FAILURE,
                "check" | "book" => told("book", book::build(&root)),
                _ => ExitCode::SUCCESS,
            }
        }
        Err(error) => refuse(&format!("xtask: cannot read the workspace: {error}")),
    }
}

/// Runs every test.
fn test(wishes: Wishes) -> ExitCode {
    let root = workspace_root().map_err(|error| format!("cannot read the workspace: {error}"));
    told("test", root.and_then(|root| test::run(&root, wishes)))
}

/// Builds a release.
fn release(only_plan: bool) -> ExitCode {
    let root = workspace_root().and_then(|root| Ok((Tree::load(&root)?, root)));
    let root = root.map_err(|error| format!("cannot read the workspace: {error}"));
    told("release", root.and_then(|(tree, root)| release::run(&root, &tree, only_plan)))
}

/// Says what failed.
fn told(name: &str, done: Result<(), String>) -> ExitCode {
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("\nxtask {name}: {message}");
            ExitCode::FAILURE
        }
    }
}

fn refuse(message: &str) -> ExitCode {
    eprintln!("{message}");
    ExitCode::from(2)
}

/// Prints what was found; whether nothing fails the check.
fn report(name: &str, mut findings: Vec<Finding>) -> bool {
    findings.sort();
    findings.dedup();
    for finding in &findings {
        println!("{finding}");
    }
    let warnings = findings.iter().filter(|finding| finding.weight == Weight::Warning).count();
    let errors = findings.len() - warnings;
    println!("xtask {name}: {errors} to mend, {warnings} to note");
    errors == 0
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
