//! A campaign: processes that execute targets side by side, restarted where an input ends one, with the counts of all.

use std::io;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus};
use std::time::{Duration, Instant};

use crate::corpus::keep;
use crate::scratch::Remains;
use crate::targets::Target;
use crate::worker::HANG;

/// Settings of a campaign.
#[derive(Clone, Debug)]
pub struct Campaign {
    /// Program that has the targets.
    pub program: PathBuf,
    /// Time for each target.
    pub time: Duration,
    /// Most mutated inputs of a process.
    pub executions: u64,
    /// Seed of the first process of each target.
    pub seed: u64,
    /// Processes side by side.
    pub jobs: usize,
    /// Folder of failing inputs.
    pub findings: PathBuf,
}

/// Count of one target.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Count {
    /// Executions.
    pub executions: u64,
    /// Time of all processes (s).
    pub seconds: f64,
    /// Processes that found a failure or were ended by one.
    pub failed: u64,
}

impl Campaign {
    /// Runs one target.
    ///
    /// # Errors
    /// What the system says of processes and files.
    pub fn run(&self, target: &Target) -> io::Result<Count> {
        let folder = tempfile::tempdir()?;
        let jobs: Vec<io::Result<Count>> = std::thread::scope(|scope| {
            let job = |job: usize| self.job(target, job as u64, folder.path());
            let threads: Vec<_> = (0..self.jobs).map(|number| scope.spawn(move || job(number))).collect();
            threads
                .into_iter()
                .map(|thread| thread.join().unwrap_or_else(|_| Err(io::ErrorKind::Other.into())))
                .collect()
        });
        let mut sum = Count::default();
        for count in jobs {
            let count = count?;
            sum.executions += count.executions;
            sum.seconds += count.seconds;
            sum.failed += count.failed;
        }
        Ok(sum)
    }

    fn job(&self, target: &Target, job: u64, folder: &Path) -> io::Result<Count> {
        let clock = Instant::now();
        let scratch = folder.join(format!("scratch-{job}"));
        let mut count = Count::default();
        for process in 0.. {
            let left = self.time.saturating_sub(clock.elapsed());
            if process > 0 && left.is_zero() {
                break;
            }
            let seed = self.seed.wrapping_add(job << 32).wrapping_add(process);
            let status = self.start(target, seed, left, job == 0 && process == 0, &scratch)?.wait()?;
            let remains = Remains::of(&scratch);
            count.executions += remains.executions;
            if status.success() {
                break;
            }
            count.failed += 1;
            if status.code() == Some(1) {
                break; // failures that the process kept itself, all through its time
            }
            let (name, shown) = target.shown(&remains.input);
            keep(&self.findings, name, &cause(status, &remains.input), &shown)?;
        }
        count.seconds = clock.elapsed().as_secs_f64();
        Ok(count)
    }

    fn start(
        &self,
        target: &Target,
        seed: u64,
        time: Duration,
        replay: bool,
        scratch: &Path,
    ) -> io::Result<Child> {
        let mut command = Command::new(&self.program);
        command.arg("--worker").arg(scratch).args(["--target", target.name]);
        command.args(["--seed", &seed.to_string(), "--seconds", &time.as_secs_f64().to_string()]);
        command.args(["--executions", &self.executions.to_string()]).arg("--findings").arg(&self.findings);
        if !replay {
            command.arg("--no-replay");
        }
        command.spawn()
    }
}

/// Name of a failure that ended the process; inputs of different length are kept apart.
fn cause(status: ExitStatus, input: &[u8]) -> String {
    let kind = if status.code() == Some(HANG) { "hang".to_owned() } else { status.to_string() };
    format!("{kind}-{}", input.len())
}
