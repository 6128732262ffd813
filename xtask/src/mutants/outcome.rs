//! What the tests made of each mutant.

use std::collections::BTreeMap;
use std::fmt;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::Path;

/// What the tests made of a mutant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The named test failed.
    Caught(String),
    /// The named test needed more time than it may.
    TimedOut(String),
    /// No test failed, of the number that reach the mutant.
    Survived(usize),
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Caught(test) => write!(f, "caught\t{test}"),
            Self::TimedOut(test) => write!(f, "timed out\t{test}"),
            Self::Survived(tests) => write!(f, "SURVIVED\t{tests} tests reach it"),
        }
    }
}

/// Outcomes by the names of the mutants, kept in a file: a run that was cut short goes on with the others.
#[derive(Debug)]
pub struct Outcomes {
    file: File,
    known: BTreeMap<String, String>,
}

impl Outcomes {
    /// Reads the file, if there is one.
    pub fn open(path: &Path) -> Result<Self, String> {
        let text = std::fs::read_to_string(path).unwrap_or_default();
        let rows = text.lines().filter_map(|row| row.split_once('\t'));
        let known = rows.map(|(name, outcome)| (name.to_owned(), outcome.to_owned())).collect();
        let file = OpenOptions::new().create(true).append(true).open(path);
        Ok(Self { file: file.map_err(|error| format!("cannot write {}: {error}", path.display()))?, known })
    }

    /// Whether a test caught the mutant.
    pub fn caught(&self, name: &str) -> bool {
        self.known.get(name).is_some_and(|outcome| !outcome.starts_with("SURVIVED"))
    }

    /// Adds an outcome, in place of an older one.
    pub fn add(&mut self, name: &str, outcome: &Outcome) -> Result<(), String> {
        self.known.insert(name.to_owned(), outcome.to_string());
        writeln!(self.file, "{name}\t{outcome}").map_err(|error| format!("cannot write the outcome: {error}"))
    }

    /// Prints the survivors and the numbers; the number of survivors.
    pub fn summary<'n>(&self, names: impl Iterator<Item = &'n str>) -> usize {
        let (mut all, mut late, mut survivors) = (0, 0, 0);
        for name in names {
            let outcome = self.known.get(name).map_or("", String::as_str);
            all += 1;
            late += usize::from(outcome.starts_with("timed out"));
            if !self.caught(name) {
                survivors += 1;
                println!("{name}\t{outcome}");
            }
        }
        let share = 100.0 * (all - survivors) as f64 / all as f64;
        println!(
            "xtask mutants: {all} mutants, {} caught ({late} by the limit of time), {survivors} survivors: {share:.1} % caught",
            all - survivors
        );
        survivors
    }
}

#[cfg(test)]
mod tests {
    use super::{Outcome, Outcomes};

    #[test]
    fn outcomes_outlive_the_run_and_the_last_one_counts() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("outcomes.tsv");
        let mut outcomes = Outcomes::open(&path).expect("a new file");
        for (name, outcome) in [
            ("a.rs:1:1: replace + with -", Outcome::Survived(3)),
            ("a.rs:2:1: delete !", Outcome::TimedOut("laws::b".into())),
            ("a.rs:1:1: replace + with -", Outcome::Caught("laws::a".into())),
            ("a.rs:3:1: delete -", Outcome::Survived(0)),
        ] {
            outcomes.add(name, &outcome).expect("a row");
        }
        let read = Outcomes::open(&path).expect("the file just written");
        assert!(read.caught("a.rs:1:1: replace + with -") && read.caught("a.rs:2:1: delete !"));
        assert!(!read.caught("a.rs:3:1: delete -") && !read.caught("a.rs:4:1: delete -"));
        assert_eq!(read.summary(["a.rs:1:1: replace + with -", "a.rs:3:1: delete -"].into_iter()), 1);
    }
}
