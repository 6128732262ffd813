//! Long runs of the fuzz targets, on the stable compiler.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use clap::Parser;
use quasirigid_fuzz::campaign::Campaign;
use quasirigid_fuzz::corpus::HOME;
use quasirigid_fuzz::heap::Counted;
use quasirigid_fuzz::targets::{TARGETS, Target};
use quasirigid_fuzz::worker::{Work, work};

#[global_allocator]
static HEAP: Counted = Counted;

/// Fuzzes the readers and the laws of quasirigid.
#[derive(Debug, Parser)]
struct Arguments {
    /// Target, or `all`; an unknown one lists them
    #[arg(long, default_value = "all")]
    target: String,
    /// Seconds for each target
    #[arg(long, default_value_t = 60.0)]
    seconds: f64,
    /// Most mutated inputs of a process
    #[arg(long, default_value_t = u64::MAX)]
    executions: u64,
    /// Seed of the mutations
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Processes side by side
    #[arg(long, default_value_t = 1)]
    jobs: usize,
    /// Folder of failing inputs; the regressions of the crate by default
    #[arg(long)]
    findings: Option<PathBuf>,
    /// Only mutated inputs, without the corpus and the regressions first
    #[arg(long)]
    no_replay: bool,
    /// Executes in this process, with this file for the input in work
    #[arg(long, hide = true)]
    worker: Option<PathBuf>,
}

fn main() -> ExitCode {
    match run(Arguments::parse()) {
        Ok(code) => code,
        Err(error) => {
            let _ = writeln!(io::stderr(), "quasirigid-fuzz: {error}");
            ExitCode::from(2)
        }
    }
}

fn run(arguments: Arguments) -> io::Result<ExitCode> {
    let Arguments { target, seconds, executions, seed, jobs, findings, no_replay, worker } = arguments;
    let time = Duration::try_from_secs_f64(seconds).map_err(io::Error::other)?;
    let findings = findings.unwrap_or_else(|| PathBuf::from(HOME).join("regressions"));
    let targets: Vec<&'static Target> =
        TARGETS.iter().filter(|known| target == "all" || known.name == target).collect();
    if targets.is_empty() {
        let names: Vec<&str> = TARGETS.iter().map(|target| target.name).collect();
        return Err(io::Error::other(format!(
            "there is no target {target:?}; they are {}",
            names.join(", ")
        )));
    }
    if let Some(scratch) = worker {
        let failures = work(&Work {
            target: targets[0],
            seed,
            time,
            executions,
            replay: !no_replay,
            scratch,
            findings,
        })?;
        return Ok(ExitCode::from(u8::from(failures > 0)));
    }
    let program = std::env::current_exe()?;
    let campaign = Campaign { program, time, executions, seed, jobs, findings };
    let (mut all, mut failed) = (0, 0);
    let mut out = io::stdout().lock();
    for target in targets {
        let count = campaign.run(target)?;
        let rate = count.executions as f64 / count.seconds;
        let (name, executions) = (target.name, count.executions);
        let failures = if count.failed > 0 { ", FAILED" } else { "" };
        writeln!(out, "{name:<18} {executions:>10} executions {rate:>8.0}/s{failures}")?;
        all += executions;
        failed += count.failed;
    }
    writeln!(out, "{:<18} {all:>10} executions", "all")?;
    Ok(ExitCode::from(u8::from(failed > 0)))
}
