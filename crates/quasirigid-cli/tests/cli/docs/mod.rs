//! The README, the guide and the predictions: their commands run and print what the pages show, their complete models are models.
//!
//! In a `console` block a line `$ quasirigid ...` or `$ cargo run -- ...` is run where the pages expect it,
//! the root of the repository, or rather a copy that holds the examples and the measured cases, which the commands of one page share. What
//! follows up to the next `$` is what it prints; a line `...` stands for any lines. A `toml` block whose first line
//! is `# complete` is a model; `# complete: NAME.toml` is one that the commands after it know by this name. Files that
//! models name stand in the folder `data` beside the page.

mod page;
#[cfg(unix)]
mod sample;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use quasirigid_io::model::Model;
use tempfile::TempDir;

use crate::support::{ROOT, copy, names};
use page::{Block, Shown, blocks, commands, matches};

/// Folder of the files that models of a page name, beside the page.
const DATA: &str = "data";
/// Folder of the models beside measured numbers.
const MEASURED: &str = "data/published/measured";

/// Problems of the pages of a repository.
fn problems(root: &Path) -> Vec<String> {
    pages(root).iter().flat_map(|page| problems_of(root, page)).collect()
}

/// The README, the chapters of the guide and the predictions, as far as they exist.
fn pages(root: &Path) -> Vec<PathBuf> {
    let pages_in = |folder: &'static str| {
        let within = root.join(folder);
        let all = if within.is_dir() { names(&within) } else { Vec::new() };
        all.into_iter().filter(|name| name.ends_with(".md")).map(|name| Path::new(folder).join(name))
    };
    let chapters = ["docs/guide", "predictions"].into_iter().flat_map(pages_in);
    std::iter::once("README.md".into()).chain(chapters).filter(|page| root.join(page).is_file()).collect()
}

fn problems_of(root: &Path, page: &Path) -> Vec<String> {
    let folder = TempDir::new().unwrap();
    copy(&root.join("examples"), &folder.path().join("examples"));
    if root.join(MEASURED).is_dir() {
        copy(&root.join(MEASURED), &folder.path().join(MEASURED));
    }
    let file = root.join(page);
    let (text, beside) = (fs::read_to_string(&file).unwrap(), file.parent().unwrap());
    if beside.join(DATA).is_dir() {
        copy(&beside.join(DATA), &folder.path().join(DATA));
    }
    let found = blocks(&text).into_iter().flat_map(|block| match block.language.as_str() {
        "console" => {
            commands(&block).into_iter().filter_map(|shown| wrong_output(&shown, folder.path())).collect()
        }
        "toml" => {
            put_down(&block, folder.path());
            wrong_model(&block, beside).into_iter().collect()
        }
        _ => Vec::new(),
    });
    found.map(|(line, problem)| format!("{}:{line}: {problem}", page.display())).collect()
}

/// Difference between the output of a command and that on its page.
fn wrong_output(shown: &Shown, folder: &Path) -> Option<(usize, String)> {
    let program = Path::new(env!("CARGO_BIN_EXE_quasirigid")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap_or_default());
    let ran = Command::new("sh")
        .args(["-c", &format!("exec 2>&1; {}", shown.command)])
        .current_dir(folder)
        .env("PATH", path)
        .env_remove("COLUMNS")
        .output()
        .unwrap();
    let printed = String::from_utf8_lossy(&ran.stdout);
    let printed: Vec<_> = printed.trim_end().lines().map(str::trim_end).collect();
    let command = &shown.command;
    if shown.output.is_empty() {
        let failed = !matches!(ran.status.code(), Some(0 | 1));
        return failed.then(|| (shown.line, format!("`{command}` fails:\n{}", printed.join("\n"))));
    }
    let expected: Vec<_> = shown.output.iter().map(String::as_str).collect();
    (!matches(&expected, &printed))
        .then(|| (shown.line, format!("`{command}` prints otherwise:\n{}", printed.join("\n"))))
}

/// Text after `# complete` in the first line of a model.
fn heading(block: &Block) -> Option<&str> {
    let rest = block.text.lines().next()?.trim().strip_prefix("# complete")?;
    if rest.is_empty() { Some(rest) } else { rest.strip_prefix(": ") }
}

/// Writes a model with a name where commands run.
fn put_down(block: &Block, folder: &Path) {
    if let Some(name) = heading(block).filter(|name| !name.is_empty()) {
        fs::write(folder.join(name), &block.text).unwrap();
    }
}

/// Problem of a complete model; the files that it names are looked for from the folder of its page.
fn wrong_model(block: &Block, beside: &Path) -> Option<(usize, String)> {
    heading(block)?;
    let refused = match Model::parse(&beside.join("model.toml"), &block.text) {
        Err(error) => error.to_string(),
        Ok(model) => match model.assembly.body() {
            Err(error) => model.diagnose(&error).to_string(),
            Ok(_) => return None,
        },
    };
    let refused = refused.replace(&format!("{}/", beside.display()), "");
    Some((block.line, format!("not a complete model:\n{refused}")))
}

#[cfg(unix)]
#[test]
fn readme_and_guide_tell_the_truth() {
    let problems = problems(Path::new(ROOT));
    assert!(problems.is_empty(), "{}", problems.join("\n\n"));
}
