//! Mutants of cargo-mutants' list, and a sample of them by a seed.

use std::path::Path;
use std::process::Command;

use serde_json::Value;
use sha2::{Digest, Sha256};

/// Package whose mutants are taken.
pub const PACKAGE: &str = "quasirigid";

/// A change of the source that a test should notice.
#[derive(Clone, Debug)]
pub struct Mutant {
    /// cargo-mutants' name: place and change.
    pub name: String,
    /// Path relative to the workspace.
    pub file: String,
    /// Kind of the change.
    pub genre: String,
    /// Text in place of the span.
    pub replacement: String,
    /// First place and the place after the last: line and column in characters, from 1.
    pub span: [[usize; 2]; 2],
}

/// Every mutant that cargo-mutants makes of the package.
pub fn list(root: &Path) -> Result<Vec<Mutant>, String> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let asked = Command::new(cargo)
        .args(["mutants", "--list", "--json", "--package", PACKAGE])
        .current_dir(root)
        .output();
    let told = asked.map_err(|error| format!("cargo mutants does not run ({error})"))?;
    if !told.status.success() {
        let cause = String::from_utf8_lossy(&told.stderr);
        return Err(format!("cargo mutants failed; it is installed by cargo install cargo-mutants\n{cause}"));
    }
    let list: Value = serde_json::from_slice(&told.stdout).map_err(|error| error.to_string())?;
    let entries = list.as_array().into_iter().flatten();
    entries.map(|entry| mutant(entry).ok_or_else(|| format!("a mutant of another form: {entry}"))).collect()
}

fn mutant(entry: &Value) -> Option<Mutant> {
    let text = |key: &str| entry[key].as_str().map(str::to_owned);
    let place = |end: &str| {
        let part = |key: &str| entry["span"][end][key].as_u64().map(|number| number as usize);
        Some([part("line")?, part("column")?])
    };
    Some(Mutant {
        name: text("name")?,
        file: text("file")?,
        genre: text("genre")?,
        replacement: text("replacement")?,
        span: [place("start")?, place("end")?],
    })
}

/// The first `count` mutants in the order of the SHA-256 of `<seed> <name>`.
pub fn sample(mut listed: Vec<Mutant>, count: usize, seed: u64) -> Vec<Mutant> {
    listed.sort_by_cached_key(|mutant| Sha256::digest(format!("{seed} {}", mutant.name)));
    listed.truncate(count);
    listed
}

#[cfg(test)]
mod tests {
    use super::{Mutant, sample};

    #[test]
    fn a_sample_is_no_matter_of_the_order_of_the_list() {
        let named = |n: usize| Mutant {
            name: format!("a.rs:{n}:1: replace + with -"),
            file: "a.rs".into(),
            genre: "BinaryOperator".into(),
            replacement: "-".into(),
            span: [[n, 1], [n, 2]],
        };
        let names = |list: Vec<Mutant>, seed| -> Vec<String> {
            sample(list, 5, seed).into_iter().map(|mutant| mutant.name).collect()
        };
        let forwards = names((0..50).map(named).collect(), 1);
        assert_eq!(forwards, names((0..50).rev().map(named).collect(), 1));
        assert_ne!(forwards, names((0..50).map(named).collect(), 2));
    }
}
