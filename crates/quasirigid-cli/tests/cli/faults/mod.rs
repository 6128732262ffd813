//! Faults of the machine and of other processes: full disks, folders that go, losses of power, closed streams. Nothing is lost that was
//! said to be written, nothing of others is destroyed, and every refusal says where and what.

mod damaged;
mod full_disk;
mod gone;
#[cfg(target_os = "linux")]
mod power;
mod read_only;
mod streams;
mod together;

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::LazyLock;
use std::time::Duration;

use tempfile::TempDir;

use crate::support::{MODEL, Ran, copy, folder_of, folder_with, program};

/// A study of three parts.
pub const STUDY: &str = "\
model = \"model.toml\"
seed = 7
samples = 12
part = 4
[vary]
\"carrier.mass\" = { log-normal = { median = 40.0, decades = 0.2 } }
[answer]
quantities = [\"check.valid\", \"check.T1\", \"check.verdict\"]
";

/// A run of seconds, whose rows go to the disk from the start.
pub const LONG: &str = "run model.toml --samples 100101 --duration 150h --tables parquet -q -o out";

/// A folder with a model of which only the rigid body is followed, so that many rows take little time.
pub fn folder_of_rigid() -> TempDir {
    folder_with(&format!("{MODEL}systems = [\"rigid\"]\n"))
}

/// The answer to a command line of the program after others of the shell, such as limits.
pub fn after(folder: &Path, first: &str, line: &str) -> Ran {
    let line = format!("{first}; exec {} {line}", env!("CARGO_BIN_EXE_quasirigid"));
    Command::new("sh").args(["-c", &line]).current_dir(folder).output().unwrap().into()
}

/// Says that a test does nothing on this machine.
#[allow(clippy::print_stderr)] // a test that was skipped must not look like one that passed
pub fn skip(reason: &str) {
    eprintln!("skipped: {reason}");
}

/// Whether a command of the system can be run here.
pub fn can(command: &str, arguments: &[&str]) -> bool {
    let tried = Command::new(command).args(arguments).stdout(Stdio::null()).stderr(Stdio::null()).status();
    tried.is_ok_and(|status| status.success())
}

/// A folder on which something is mounted as long as this lives.
pub struct Mounted(TempDir);

impl Mounted {
    /// Mounts with these options of `mount`; none where that is not allowed.
    pub fn on(folder: TempDir, options: &[&str]) -> Option<Self> {
        let path = folder.path().to_str().unwrap().to_owned();
        can("mount", &[options, &[path.as_str()]].concat()).then_some(Self(folder))
    }

    pub fn path(&self) -> &Path {
        self.0.path()
    }
}

impl Drop for Mounted {
    fn drop(&mut self) {
        can("umount", &[self.path().to_str().unwrap()]);
    }
}

/// Starts a long run and waits for its first checkpoint.
pub fn in_work(folder: &Path) -> Child {
    let checkpoint = folder.join("out-unfinished/history-reduced.checkpoint");
    let before = fs::read(&checkpoint).unwrap_or_default();
    let line = if before.is_empty() { LONG.to_owned() } else { format!("{LONG} --resume") };
    let mut command = program(folder);
    command.args(line.split(' ')).stdout(Stdio::null()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    while fs::read(&checkpoint).unwrap_or_default() == before {
        assert!(child.try_wait().unwrap().is_none(), "the run ended before a checkpoint");
        std::thread::sleep(Duration::from_millis(5));
    }
    child
}

/// A folder with a run that was killed after a checkpoint.
pub fn killed_run() -> TempDir {
    static KILLED: LazyLock<TempDir> = LazyLock::new(|| {
        let folder = folder_of("boom-satellite");
        let mut child = in_work(folder.path());
        child.kill().unwrap();
        child.wait().unwrap();
        folder
    });
    let folder = TempDir::new().unwrap();
    copy(KILLED.path(), folder.path());
    folder
}
