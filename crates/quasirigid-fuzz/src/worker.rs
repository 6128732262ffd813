//! Process that executes one target: first the files of its corpus and its regressions, then mutated inputs until its time is over.
//!
//! A panic is kept and the process goes on. An input that takes too long, or more memory than the process may have, ends it; the campaign
//! that started it finds that input in the scratch file.

use std::collections::HashSet;
use std::io::{self, Write};
use std::path::PathBuf;
use std::process;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::thread;
use std::time::{Duration, Instant};

use rustix::process::{Resource, Rlimit, setrlimit};
use rustix::time::{ClockId, clock_gettime};

use crate::corpus::{self, keep};
use crate::execution::{catch_panics, execute};
use crate::minimize::minimized;
use crate::mutation::Mutator;
use crate::scratch::Scratch;
use crate::targets::Target;

/// Longest execution, in processor time.
pub const LONGEST_EXECUTION: Duration = Duration::from_secs(10);
/// Exit code of a process that an input held for longer than that.
pub const HANG: i32 = 70;
/// Address space of a process above the memory that its target may use (bytes): code, stacks, caches of the allocator.
const ADDRESS_SPACE: u64 = 640 * 1024 * 1024;
/// Time between two looks at the clock.
const CLOCK_INTERVAL: Duration = Duration::from_millis(200);

/// Work of a process.
#[derive(Clone, Debug)]
pub struct Work {
    /// Target.
    pub target: &'static Target,
    /// Seed of the mutations.
    pub seed: u64,
    /// Time after which no execution is begun.
    pub time: Duration,
    /// Most mutated inputs.
    pub executions: u64,
    /// Whether the files on disk are executed first.
    pub replay: bool,
    /// File for the input in work.
    pub scratch: PathBuf,
    /// Folder of failing inputs.
    pub findings: PathBuf,
}

/// Start of the execution in work, in milliseconds of processor time and one more; zero between executions.
static STARTED: AtomicU64 = AtomicU64::new(0);

/// Executes, and returns the number of failures.
///
/// # Errors
/// What the file system says of the corpus and the findings.
pub fn work(work: &Work) -> io::Result<u64> {
    catch_panics();
    limit_memory(work.target.memory as u64);
    let clock = Instant::now();
    thread::spawn(watch);
    let mut scratch = Scratch::new(&work.scratch)?;
    let (mut failures, mut seen) = (0, HashSet::new());
    let mut once = |input: &[u8]| -> io::Result<()> {
        scratch.note(input)?;
        STARTED.store(processor_time() + 1, Relaxed);
        let result = execute(work.target, input);
        STARTED.store(0, Relaxed);
        let Err(failure) = result else { return Ok(()) };
        failures += 1;
        if !seen.insert(failure.place.clone()) {
            return Ok(());
        }
        let smaller = minimized(work.target, input, &failure.place);
        let (name, shown) = work.target.shown(&smaller);
        let path = keep(&work.findings, name, &failure.place, &shown)?;
        say(&format!("{}: {}: {}\n  {}", work.target.name, failure.place, failure.message, path.display()))
    };
    let corpus = corpus::inputs(work.target)?;
    if work.replay {
        corpus.iter().try_for_each(|input| once(input))?;
    }
    let mut mutator = Mutator::new(work.seed, &corpus, work.target.words);
    for _ in 0..work.executions {
        if clock.elapsed() >= work.time {
            break;
        }
        once(&mutator.input())?;
    }
    Ok(failures)
}

/// Limits the address space, which [`quasirigid_math::memory`] takes as the memory of the machine.
fn limit_memory(memory: u64) {
    let most = Some(memory + ADDRESS_SPACE);
    let _ = setrlimit(Resource::As, Rlimit { current: most, maximum: most });
}

/// Ends the process if an execution takes too long.
#[allow(clippy::exit)] // nothing else ends a thread that does not come back
fn watch() {
    loop {
        thread::sleep(CLOCK_INTERVAL);
        let started = STARTED.load(Relaxed);
        if started > 0 && processor_time().saturating_sub(started) > LONGEST_EXECUTION.as_millis() as u64 {
            process::exit(HANG);
        }
    }
}

/// Processor time of the process (ms), so that other work on the machine makes no execution long.
fn processor_time() -> u64 {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    time.tv_sec as u64 * 1000 + time.tv_nsec as u64 / 1_000_000
}

fn say(text: &str) -> io::Result<()> {
    writeln!(io::stderr().lock(), "{text}")
}
