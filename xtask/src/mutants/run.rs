//! Tests, each in a process of its own with limits of time and memory, so that the first failure ends the work on a mutant.

use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use super::outcome::Outcome;
use super::reach::Test;
use super::switch::VARIABLE;

/// Limits of a process: processor time and address space, of the shell, in front of the test.
const LIMITED: &str = "ulimit -t \"$1\"; ulimit -v \"$2\"; exec \"$3\" --exact \"$4\"";
/// Address space of a test (KiB).
const MEMORY: u64 = 12 << 20;
/// Time that every test may have (s), and the multiple of its own time without a mutant.
const TIME: u64 = 20;
const SLOWER: u64 = 5;
/// Wall time for each second of processor time: the machine may be busy, a process may wait for ever.
const BUSY: u32 = 8;
/// Signals of a process beyond its time.
const SIGNALS: [i32; 2] = [9, 24];

/// End of a test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    Passed,
    Failed,
    TimedOut,
}

/// Runs the tests that reach a mutant, the shortest first, until one fails.
pub fn mutant<'t>(tests: impl Iterator<Item = &'t Test>, package: &Path, switch: &str) -> Outcome {
    let mut passed = 0;
    for it in tests {
        let limit = Duration::from_secs(TIME + SLOWER * it.time.as_secs());
        match test(it, package, switch, limit) {
            End::Passed => passed += 1,
            End::Failed => return Outcome::Caught(it.name.clone()),
            End::TimedOut => return Outcome::TimedOut(it.name.clone()),
        }
    }
    Outcome::Survived(passed)
}

/// Runs a test with a value of the variable that throws the switch.
pub fn test(it: &Test, package: &Path, switch: &str, limit: Duration) -> End {
    let seconds = limit.as_secs().to_string();
    let started = Command::new("sh")
        .args(["-c", LIMITED, "sh", &seconds, &MEMORY.to_string()])
        .arg(&it.program)
        .arg(&it.name)
        .current_dir(package)
        .env(VARIABLE, switch)
        .env("CARGO_MANIFEST_DIR", package)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn();
    let Ok(mut process) = started else { return End::Failed };
    let start = Instant::now();
    let mut pause = Duration::from_millis(1);
    loop {
        match process.try_wait() {
            Ok(Some(status)) if status.success() => return End::Passed,
            Ok(Some(status)) if status.signal().is_some_and(|signal| SIGNALS.contains(&signal)) => {
                return End::TimedOut;
            }
            Ok(Some(_)) | Err(_) => return End::Failed,
            Ok(None) if start.elapsed() > BUSY * limit => {
                let _ = process.kill();
                let _ = process.wait();
                return End::TimedOut;
            }
            Ok(None) => {
                thread::sleep(pause);
                pause = (pause * 5 / 4).min(Duration::from_millis(50));
            }
        }
    }
}

/// Does each of `count` pieces of work in some threads, and takes the results one at a time as they come.
///
/// # Errors
/// The first of `take`; pieces that are under way are finished.
pub fn each<T: Send>(
    count: usize,
    jobs: usize,
    work: impl Fn(usize) -> T + Sync,
    take: impl FnMut(usize, T) -> Result<(), String> + Send,
) -> Result<(), String> {
    let (next, stopped) = (AtomicUsize::new(0), AtomicBool::new(false));
    let taken = Mutex::new((take, Ok(())));
    let worker = || {
        loop {
            let at = next.fetch_add(1, Ordering::Relaxed);
            if at >= count || stopped.load(Ordering::Relaxed) {
                return;
            }
            let result = work(at);
            let mut taken = taken.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
            if taken.1.is_ok() {
                taken.1 = taken.0(at, result);
                stopped.fetch_or(taken.1.is_err(), Ordering::Relaxed);
            }
        }
    };
    thread::scope(|scope| (0..jobs).for_each(|_| drop(scope.spawn(worker))));
    taken.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner).1
}
