//! Which mutants compile, and which of them behind a switch.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use super::build::Copy;
use super::sample::Mutant;
use super::source::Edits;
use super::write;

const SWITCHED: &str = "switched";
const ALONE: &str = "alone";
const NEVER: &str = "never";

/// Mutants that compile.
pub struct Viable {
    /// Those behind a switch.
    pub edits: Edits,
    /// Those that are built one at a time: constants, and functions that return `impl Trait`.
    pub alone: BTreeSet<usize>,
}

impl Viable {
    /// Asks the compiler, unless a file has its answers for all of the mutants.
    pub fn of(root: &Path, scratch: &Copy, file: &Path, mutants: &[Mutant]) -> Result<Self, String> {
        let mut edits = Edits::of(root, mutants)?;
        let text = fs::read_to_string(file).unwrap_or_default();
        let known: BTreeMap<&str, &str> = text.lines().filter_map(|row| row.split_once('\t')).collect();
        let answers: Option<Vec<&str>> =
            mutants.iter().map(|mutant| known.get(mutant.name.as_str()).copied()).collect();
        if let Some(answers) = answers {
            let those = |wanted: &str| (0..mutants.len()).filter(|n| answers[*n] == wanted).collect();
            let switched: BTreeSet<usize> = those(SWITCHED);
            (0..mutants.len()).filter(|n| !switched.contains(n)).for_each(|n| edits.remove(n));
            return Ok(Self { edits, alone: those(ALONE) });
        }
        scratch.weed(root, &mut edits)?;
        let alone = scratch.alone(root, mutants, &edits)?;
        let answer = |n: usize| {
            if edits.has(n) {
                SWITCHED
            } else if alone.contains(&n) {
                ALONE
            } else {
                NEVER
            }
        };
        let rows: Vec<String> =
            (0..).zip(mutants).map(|(n, mutant)| format!("{}\t{}\n", mutant.name, answer(n))).collect();
        write(file, &rows.concat())?;
        Ok(Self { edits, alone })
    }

    /// Whether a mutant compiles.
    pub fn has(&self, mutant: usize) -> bool {
        self.edits.has(mutant) || self.alone.contains(&mutant)
    }
}
