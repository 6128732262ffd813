//! Mutation testing of the physics crate: mutants of cargo-mutants' list, built into one program.
//! cargo-mutants builds the crate and its tests once for every mutant, which takes minutes each. Here a copy of the crate has every
//! mutant of a sample behind a switch that an environment variable throws, and is built once. A test that does not reach the place
//! of a mutant cannot tell it from the original, so only those that do are run.

mod build;
mod outcome;
mod reach;
mod run;
mod sample;
mod schema;
mod source;
mod switch;
mod viable;

use std::fs;
use std::path::{Path, PathBuf};

use build::Copy;
use outcome::Outcomes;
use reach::Test;
use source::Edits;
use viable::Viable;

/// Candidates for each mutant that is asked for: some do not compile.
const SPARE: f64 = 1.4;

/// Wishes of the caller.
#[derive(Clone, Copy, Debug)]
pub struct Wishes {
    /// Number of mutants that compile.
    pub count: usize,
    /// Seed of the sample.
    pub seed: u64,
    /// Processes at a time.
    pub jobs: usize,
}

impl Default for Wishes {
    fn default() -> Self {
        Self { count: 300, seed: 22, jobs: 2 }
    }
}

impl Wishes {
    /// Reads `--count N --seed S --jobs J`, in any order.
    pub fn read(words: &[&str]) -> Option<Self> {
        let mut wishes = Self::default();
        for pair in words.chunks(2) {
            match *pair {
                ["--count", number] => wishes.count = number.parse().ok().filter(|count| *count > 0)?,
                ["--seed", number] => wishes.seed = number.parse().ok()?,
                ["--jobs", number] => wishes.jobs = number.parse().ok().filter(|jobs| *jobs > 0)?,
                _ => return None,
            }
        }
        Some(wishes)
    }
}

/// Runs the tests of the crate against a sample of its mutants; the number of those that no test caught.
///
/// # Errors
/// A sentence on what could not be read, built or run.
pub fn run(root: &Path, wishes: Wishes) -> Result<usize, String> {
    let folder = root.join("target/mutants");
    fs::create_dir_all(&folder).map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
    let listed = sample::list(root)?;
    let asked = (wishes.count as f64 * SPARE).ceil() as usize;
    println!("{} mutants listed by cargo-mutants; seed {}", listed.len(), wishes.seed);
    let candidates = sample::sample(listed, asked, wishes.seed);

    let scratch = Copy::of(root, &folder, "scratch", &Edits::default())?;
    let viable = Viable::of(root, &scratch, &folder.join("compiles.tsv"), &candidates)?;
    let chosen: Vec<usize> = (0..candidates.len()).filter(|n| viable.has(*n)).take(wishes.count).collect();
    let unviable = chosen.last().map_or(0, |last| last + 1 - chosen.len());
    let without = chosen.iter().filter(|n| viable.alone.contains(n)).count();
    println!(
        "{} mutants, {without} of them without a switch; {unviable} that do not compile were passed over",
        chosen.len()
    );

    let mut outcomes = Outcomes::open(&folder.join("outcomes.tsv"))?;
    let copy = Copy::of(root, &folder, "switched", &viable.edits)?;
    let tests = reach::measure(&folder, &copy.package(), &copy.programs()?, wishes.jobs)?;
    let name = |n: usize| candidates[n].name.as_str();
    let pending = chosen.iter().copied().filter(|n| !outcomes.caught(name(*n)));
    let (switched, plain): (Vec<_>, Vec<_>) = pending.partition(|n| viable.edits.has(*n));
    let one = |at: usize| {
        let reaching = tests.iter().filter(|test| test.reached.contains(&switched[at]));
        run::mutant(reaching, &copy.package(), &switched[at].to_string())
    };
    run::each(switched.len(), wishes.jobs, one, |at, outcome| outcomes.add(name(switched[at]), &outcome))?;
    for n in plain {
        let programs = scratch.plain(root, &candidates[n])?;
        let outcome = run::mutant(of(&tests, &programs).iter(), &scratch.package(), "");
        outcomes.add(name(n), &outcome)?;
    }
    Ok(outcomes.summary(chosen.iter().map(|n| name(*n))))
}

/// The same tests in programs with a mutant that has no switch.
fn of(tests: &[Test], programs: &[PathBuf]) -> Vec<Test> {
    let kind = |program: &Path| {
        program.file_name().and_then(|name| Some(name.to_str()?.split('-').next()?.to_owned()))
    };
    let moved = |test: &Test| {
        let program = programs.iter().find(|program| kind(program) == kind(&test.program))?;
        Some(Test { program: program.clone(), ..test.clone() })
    };
    tests.iter().filter_map(moved).collect()
}

fn read(path: &Path) -> Result<String, String> {
    fs::read_to_string(path).map_err(|error| format!("cannot read {}: {error}", path.display()))
}

fn write(path: &Path, text: &str) -> Result<(), String> {
    fs::write(path, text).map_err(|error| format!("cannot write {}: {error}", path.display()))
}
