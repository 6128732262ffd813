//! Jobs side by side, and the executables of tests as jobs: many tests wait for other programs, and cargo runs one executable at a time.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::{Mutex, PoisonError};
use std::thread;

use serde_json::Value;

use crate::test::{Step, judged, told_at_its_end};

/// Jobs at a time: each test has as many threads as there are processors, and some wait.
const LANES: usize = 2;

/// A job of a lane.
pub type Job<'a> = Box<dyn FnOnce() -> Step + Send + 'a>;

/// Does all jobs, in their order as far as the lanes allow.
///
/// # Errors
/// The sentences of all that failed.
pub fn run(jobs: Vec<Job<'_>>) -> Step {
    let (jobs, failures) = (Mutex::new(jobs.into_iter()), Mutex::new(Vec::new()));
    thread::scope(|scope| {
        for _ in 0..LANES {
            scope.spawn(|| {
                loop {
                    let next = jobs.lock().unwrap_or_else(PoisonError::into_inner).next();
                    let Some(job) = next else { break };
                    if let Err(failure) = job() {
                        failures.lock().unwrap_or_else(PoisonError::into_inner).push(failure);
                    }
                }
            });
        }
    });
    let failures = failures.into_inner().unwrap_or_else(PoisonError::into_inner);
    if failures.is_empty() { Ok(()) } else { Err(failures.join("\nxtask test: ")) }
}

/// Executable of tests.
pub struct Executable {
    /// Package and target.
    name: String,
    file: PathBuf,
    /// Folder of the package, in which its tests run.
    folder: PathBuf,
}

impl Executable {
    /// Builds by some arguments of cargo, and names the executables of tests, the largest first, which take longest.
    ///
    /// # Errors
    /// A sentence if cargo fails, or tells nothing.
    pub fn all<'a>(
        root: &Path,
        cargo: &OsStr,
        arguments: impl Iterator<Item = &'a str>,
    ) -> Result<Vec<Self>, String> {
        let mut command = Command::new(cargo);
        command.args(arguments).current_dir(root).stderr(Stdio::inherit());
        let shown = format!("{command:?}").replace('"', "");
        println!("\nxtask test: {shown}");
        let built = command.arg("--message-format=json-render-diagnostics").output();
        let output = built.map_err(|error| format!("cargo does not run ({error})"))?;
        judged(Ok(output.status), &shown)?;
        let told = String::from_utf8_lossy(&output.stdout);
        let mut found: Vec<Self> =
            told.lines().filter_map(|line| Self::told(&serde_json::from_str(line).ok()?)).collect();
        let size = |own: &Self| std::fs::metadata(&own.file).map_or(0, |file| file.len());
        found.sort_by_key(|own| std::cmp::Reverse(size(own)));
        if found.is_empty() { Err("cargo names no executable of tests".to_owned()) } else { Ok(found) }
    }

    fn told(message: &Value) -> Option<Self> {
        let file = message["executable"].as_str().filter(|_| message["profile"]["test"] == true)?;
        let folder = Path::new(message["manifest_path"].as_str()?).parent()?.to_owned();
        let package = folder.file_name()?.to_string_lossy().into_owned();
        let name = format!("{package} {}", message["target"]["name"].as_str()?);
        Some(Self { name, file: file.into(), folder })
    }

    /// Runs the tests; tells their result alone where all pass.
    ///
    /// # Errors
    /// A sentence if one fails.
    pub fn run(&self, cargo: &OsStr) -> Step {
        let mut command = Command::new(&self.file);
        command.current_dir(&self.folder).env("CARGO_MANIFEST_DIR", &self.folder).env("CARGO", cargo);
        let result = |told: &str| {
            told.lines().filter(|line| line.starts_with("test result")).collect::<Vec<_>>().join("\n")
        };
        told_at_its_end(&mut command, &self.name, result)
    }
}
