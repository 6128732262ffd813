//! Runs that were cut off: what is there reads as a record, and `--resume` ends with the bytes of a run that was not.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Child, Stdio};
use std::sync::LazyLock;
use std::time::Duration;

use insta::assert_snapshot;
use quasirigid_io::record::RunRecord;
use tempfile::TempDir;

use crate::support::{folder_of, names, one_line, program, ran_in};

/// Seconds of work, of more rows than a record keeps in memory.
const RUN: &str = "run model.toml --samples 100101 --duration 40h --tables parquet -q";

/// The bytes of every file of a run that was not cut off.
static WHOLE: LazyLock<Vec<(String, Vec<u8>)>> = LazyLock::new(|| {
    let folder = folder_of("boom-satellite");
    assert_eq!(ran_in(folder.path(), &format!("{RUN} -o spin")).code, Some(0));
    assert_eq!(names(&folder), ["model.toml", "spin"], "nothing is left of the run in work");
    bytes(&folder.path().join("spin"))
});

fn bytes(folder: &Path) -> Vec<(String, Vec<u8>)> {
    names(folder).into_iter().map(|name| (name.clone(), fs::read(folder.join(&name)).unwrap())).collect()
}

fn assert_whole(folder: &TempDir) {
    assert_eq!(names(folder), ["model.toml", "spin"], "nothing is left of the run in work");
    for ((name, found), (_, expected)) in bytes(&folder.path().join("spin")).iter().zip(&*WHOLE) {
        assert!(found == expected, "{name} differs");
    }
}

fn start(folder: &TempDir, options: &str) -> Child {
    let line = format!("{RUN} -o spin {options}");
    program(folder.path()).args(line.split_whitespace()).stderr(Stdio::piped()).spawn().unwrap()
}

/// Starts the run and kills it a while after its first, or next, checkpoint.
fn cut(folder: &TempDir, options: &str, pause: u64) {
    let [checkpoint, rows] = ["checkpoint", "rows"]
        .map(|ending| folder.path().join(format!("spin-unfinished/history-reduced.{ending}")));
    let before = fs::read(&checkpoint).unwrap_or_default();
    let mut child = start(folder, options);
    while fs::read(&checkpoint).unwrap_or_default() == before {
        assert!(before.is_empty() || fs::metadata(&rows).unwrap().len() > 0, "the run began anew");
        assert!(child.try_wait().unwrap().is_none(), "the run ended before a checkpoint");
        std::thread::sleep(Duration::from_millis(5));
    }
    std::thread::sleep(Duration::from_millis(pause));
    child.kill().unwrap();
    child.wait().unwrap();
}

#[test]
fn killed_run_reads_as_a_record_and_goes_on_with_the_same_bits() {
    let folder = folder_of("boom-satellite");
    let unfinished = folder.path().join("spin-unfinished");
    for (options, pause) in [("", 3), ("--resume", 170)] {
        cut(&folder, options, pause);
        let record = RunRecord::read(&unfinished).unwrap();
        let history = record.histories.last().unwrap();
        assert!(history.status == "unfinished" && history.rows() > 1000, "{} rows", history.rows());
        assert!(history.dissipated > 0.0 && history.energy > 0.0);
        let report = ran_in(folder.path(), "report spin-unfinished --out cut.html --overwrite");
        assert_eq!(report.code, Some(0), "{report:?}");
        let page = fs::read_to_string(folder.path().join("cut.html")).unwrap();
        assert!(page.contains("Ended early") && page.contains("quasirigid run with --resume continues it"));
    }
    fs::remove_file(folder.path().join("cut.html")).unwrap();
    for ending in ["rows", "frames"] {
        // a kill leaves rows that no checkpoint knows
        let log = unfinished.join(format!("history-reduced.{ending}"));
        fs::OpenOptions::new().append(true).open(log).unwrap().write_all(&[7; 5000]).unwrap();
    }
    let ended = ran_in(folder.path(), &format!("{RUN} -o spin --resume"));
    assert_eq!((ended.code, &*ended.stderr), (Some(0), ""));
    assert_whole(&folder);
}

#[test]
fn run_that_was_cut_off_is_never_lost_by_another() {
    let folder = folder_of("boom-satellite");
    let nothing = ran_in(folder.path(), &format!("{RUN} -o spin --resume"));
    assert_snapshot!(one_line(nothing.refusal()), @"quasirigid: spin-unfinished: there is no run here to continue");
    cut(&folder, "", 0);
    let before = names(folder.path().join("spin-unfinished"));
    let refusal =
        |options: &str| one_line(ran_in(folder.path(), &format!("{RUN} -o spin {options}")).refusal());
    assert_snapshot!(refusal(""), @"quasirigid: spin-unfinished: an interrupted run is here; continue it with --resume, or remove the folder");
    assert_snapshot!(refusal("--resume --tolerance 1e-10"), @"quasirigid: spin-unfinished: the run here has another model, other settings, or another version of the program");
    let path = folder.path().join("spin-unfinished/history-reduced.checkpoint");
    let mut damaged = fs::read(&path).unwrap();
    damaged[40] ^= 1;
    fs::write(&path, &damaged).unwrap();
    assert_snapshot!(refusal("--resume"), @"quasirigid: spin-unfinished: its checkpoint is damaged; remove the folder and start anew");
    assert_eq!(names(folder.path().join("spin-unfinished")), before);
}

#[test]
fn interrupted_run_leaves_its_record_and_goes_on() {
    let folder = folder_of("boom-satellite");
    let checkpoint = folder.path().join("spin-unfinished/history-reduced.checkpoint");
    let child = start(&folder, "");
    while !checkpoint.exists() {
        std::thread::sleep(Duration::from_millis(5));
    }
    assert!(
        std::process::Command::new("kill")
            .args(["-INT", &child.id().to_string()])
            .status()
            .unwrap()
            .success()
    );
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    let said = one_line(&String::from_utf8_lossy(&output.stderr));
    assert!(
        said.contains("spin-unfinished is kept; the same command with --resume continues the run"),
        "{said}"
    );
    let record = RunRecord::read(&folder.path().join("spin")).unwrap();
    let history = &record.histories[0];
    assert_eq!(history.status, "interrupted");
    assert!(history.is_whole() && history.rows() < 100_101, "every row that was reached is in the table");
    let ended = ran_in(folder.path(), &format!("{RUN} -o spin --resume"));
    assert_eq!(ended.code, Some(0), "{ended:?}");
    assert_whole(&folder);
}
