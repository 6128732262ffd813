//! Which tests reach the place of which mutant, and how long each takes.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

use super::run::{self, End};
use super::switch::REACH;

/// Longest time of a test of the original.
const LONGEST: Duration = Duration::from_secs(600);

/// A test of a program.
#[derive(Clone, Debug)]
pub struct Test {
    /// Program that has it.
    pub program: PathBuf,
    /// Its name in the program.
    pub name: String,
    /// Time that it took on the original.
    pub time: Duration,
    /// Mutants whose place it reaches.
    pub reached: BTreeSet<usize>,
}

/// Runs each test of the programs on the original; the shortest come first.
pub fn measure(
    folder: &Path,
    package: &Path,
    programs: &[PathBuf],
    jobs: usize,
) -> Result<Vec<Test>, String> {
    let mut names = Vec::new();
    for program in programs {
        let told = Command::new(program).args(["--list", "--format", "terse"]).current_dir(package).output();
        let told = told.map_err(|error| format!("{} does not run ({error})", program.display()))?;
        let list = String::from_utf8_lossy(&told.stdout).into_owned();
        let of_program = list.lines().filter_map(|line| line.strip_suffix(": test"));
        names.extend(of_program.map(|name| (program.clone(), name.to_owned())));
    }
    let mut tests = Vec::new();
    let one = |at: usize| {
        let (program, name) = names[at].clone();
        let list = folder.join(format!("reached-{at}"));
        let _ = fs::remove_file(&list);
        let start = Instant::now();
        let mut test = Test { program, name, time: LONGEST, reached: BTreeSet::new() };
        let end = run::test(&test, package, &format!("{REACH}{}", list.display()), LONGEST);
        test.time = start.elapsed();
        let text = fs::read_to_string(&list).unwrap_or_default();
        test.reached = text.lines().filter_map(|line| line.parse().ok()).collect();
        let _ = fs::remove_file(&list);
        (test, end)
    };
    run::each(names.len(), jobs, one, |_, (test, end)| {
        if end != End::Passed {
            return Err(format!("{} fails without a mutant", test.name));
        }
        tests.push(test);
        Ok(())
    })?;
    tests.sort_by_key(|test| test.time);
    Ok(tests)
}
