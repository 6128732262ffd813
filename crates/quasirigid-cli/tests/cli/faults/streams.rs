//! Standard streams that are full, closed, or whose reader went away, and the end of the terminal.

use std::fs;
use std::process::{Command, Stdio};
use std::time::Duration;

use super::super::interrupt::{ended, signal, wait_until_it_keeps};
use super::{after, folder_of_rigid, skip};
use crate::support::{MODEL, folder_of, folder_with, names, ran_in};

/// More rows than a record keeps in memory, so that there is a folder of the run in work.
const LOGGED: &str = "run model.toml --samples 100101 --duration 60 --tables parquet -o out";

/// A message that nobody can read is no reason to end.
#[cfg(target_os = "linux")]
#[test]
fn full_standard_error_ends_nothing() {
    let folder = folder_with(MODEL);
    assert_eq!(ran_in(folder.path(), "run model.toml --duration 5 -q -o out").code, Some(0));
    for (line, code) in [
        ("report out --out page.html --overwrite", 0),
        ("plot out --figure spin --out spin.svg --overwrite", 0),
        ("check none.toml", 2),
    ] {
        for closing in ["exec 2>/dev/full", "exec 2>&-"] {
            assert_eq!(after(folder.path(), closing, line).code, Some(code), "{line}, {closing}");
        }
    }
    assert!(fs::metadata(folder.path().join("page.html")).unwrap().len() > 100_000);
}

#[cfg(target_os = "linux")]
#[test]
fn help_that_cannot_be_printed_is_told() {
    let folder = folder_with(MODEL);
    for line in ["--help", "run --help", "--version"] {
        let ran = after(folder.path(), "exec >/dev/full", line);
        assert_eq!(
            (ran.code, &*ran.stderr),
            (Some(2), "quasirigid: cannot write standard output: no storage space\n")
        );
        assert_eq!(after(folder.path(), "exec >&-", line).code, Some(0), "closed on purpose");
    }
}

/// The record stands in its place, whatever becomes of the summary.
#[test]
fn run_whose_summary_is_not_read_leaves_no_run_in_work() {
    let folder = folder_of_rigid();
    let line = format!("{} {LOGGED} | true", env!("CARGO_BIN_EXE_quasirigid"));
    assert!(Command::new("sh").args(["-c", &line]).current_dir(folder.path()).status().unwrap().success());
    assert_eq!(names(&folder), ["model.toml", "out"]);
    if cfg!(target_os = "linux") {
        let full = after(folder.path(), "exec >/dev/full", &format!("{LOGGED} --overwrite"));
        assert_eq!(
            (full.code, &*full.stderr),
            (Some(2), "quasirigid: cannot write standard output: no storage space\n")
        );
        assert_eq!(names(&folder), ["model.toml", "out"]);
    }
}

#[test]
fn model_from_a_closed_standard_input_is_empty() {
    let folder = folder_with(MODEL);
    let ran = after(folder.path(), "exec <&-", "check -");
    assert!(ran.refusal().contains("the file is empty"), "{}", ran.stderr);
}

/// Whether this process was started with the signal ignored.
#[cfg(target_os = "linux")]
fn ignores_hang_up() -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:")).unwrap();
    u64::from_str_radix(ignored.trim(), 16).unwrap() & 1 == 1
}

/// `nohup` starts a program with the signal ignored, which then stays so; without it the end of the terminal is one of the run.
#[cfg(target_os = "linux")]
#[test]
fn run_under_nohup_survives_its_terminal() {
    for (first, survives) in [("trap '' HUP", true), ("true", false)] {
        if !survives && ignores_hang_up() {
            return skip("the tests themselves run under nohup, which no child can undo");
        }
        let folder = folder_of("explorer1-stiff");
        let line = format!(
            "{first}; exec {} run model.toml --duration 2000h --samples 2000001 -q -o out",
            env!("CARGO_BIN_EXE_quasirigid")
        );
        let mut command = Command::new("sh");
        command.args(["-c", &line]).current_dir(folder.path()).stderr(Stdio::null());
        let mut child = command.spawn().unwrap();
        wait_until_it_keeps(&child, &folder.path().join("out-unfinished"));
        signal(&child, "-HUP");
        if survives {
            std::thread::sleep(Duration::from_millis(700));
            assert!(child.try_wait().unwrap().is_none(), "it ended with its terminal");
            signal(&child, "-TERM");
        }
        assert_eq!(ended(&mut child).code(), Some(1));
        assert_eq!(names(&folder), ["model.toml", "out", "out-unfinished"]);
    }
}
