//! Ctrl-C, a reader that goes away, and a process that is killed.

use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use quasirigid_io::record::RunRecord;
use tempfile::TempDir;

use crate::support::{Ran, Table, folder_of, names, one_line, program};

/// Time in which the first work of the program has begun.
const BEGUN: Duration = Duration::from_millis(300);
/// Longer than any test may take.
const PATIENCE: Duration = Duration::from_secs(60);

pub fn start(folder: &TempDir, line: &str) -> Child {
    let mut command = program(folder.path());
    command.args(line.split_whitespace()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

pub fn signal(child: &Child, name: &str) {
    let status = Command::new("kill").args([name, &child.id().to_string()]).status();
    assert!(status.unwrap().success());
}

/// Waits until the program listens for Ctrl-C, which is when it propagates.
pub fn wait_until_it_listens(child: &Child) {
    let start = Instant::now();
    while !listens(child) && start.elapsed() < PATIENCE {
        std::thread::sleep(Duration::from_millis(10));
    }
    std::thread::sleep(BEGUN);
}

/// Waits until a run has its folder, which is when it propagates a long history.
pub fn wait_until_it_keeps(child: &Child, kept: &Path) {
    let start = Instant::now();
    while !kept.join("run.identity").exists() {
        assert!(start.elapsed() < PATIENCE, "there is no {}", kept.display());
        std::thread::sleep(Duration::from_millis(10));
    }
    wait_until_it_listens(child);
}

#[cfg(target_os = "linux")]
fn listens(child: &Child) -> bool {
    let status = fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap_or_default();
    let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:"));
    caught.is_some_and(|mask| u64::from_str_radix(mask.trim(), 16).unwrap() & 2 != 0)
}

#[cfg(not(target_os = "linux"))]
fn listens(_: &Child) -> bool {
    std::thread::sleep(Duration::from_secs(3));
    true
}

/// Presses Ctrl-C once the program propagates, and waits for its end, which must come at once.
fn interrupted(folder: &TempDir, line: &str) -> Ran {
    interrupted_when(wait_until_it_listens, folder, line)
}

/// Presses Ctrl-C in a long run, which keeps what it has in work.
fn interrupted_long(folder: &TempDir) -> Ran {
    interrupted_when(|child| wait_until_it_keeps(child, &folder.path().join("spin-unfinished")), folder, LONG)
}

/// Presses Ctrl-C after a wait, and waits for the end.
fn interrupted_when(wait: impl FnOnce(&Child), folder: &TempDir, line: &str) -> Ran {
    let mut child = start(folder, line);
    let (stdout, stderr) = (child.stdout.take().unwrap(), child.stderr.take().unwrap());
    let [stdout, stderr] = [reading(stdout), reading(stderr)];
    wait(&child);
    signal(&child, "-INT");
    let status = ended(&mut child);
    Ran { code: status.code(), stdout: stdout.join().unwrap(), stderr: stderr.join().unwrap() }
}

/// Exit status of a child after a signal; the end must come at once.
pub fn ended(child: &mut Child) -> ExitStatus {
    let pressed = Instant::now();
    loop {
        if let Some(status) = child.try_wait().unwrap() {
            return status;
        }
        if pressed.elapsed() > Duration::from_secs(15) {
            child.kill().unwrap();
            panic!("it goes on after Ctrl-C");
        }
        std::thread::sleep(Duration::from_millis(10));
    }
}

/// Reads a pipe to its end on a thread of its own.
fn reading(mut pipe: impl Read + Send + 'static) -> JoinHandle<String> {
    std::thread::spawn(move || {
        let mut text = String::new();
        pipe.read_to_string(&mut text).unwrap();
        text
    })
}

/// A run that would take minutes.
const LONG: &str = "run model.toml --duration 2000h --samples 2000001 -o spin";

#[test]
fn interrupted_run_leaves_a_valid_record_that_says_so_and_starts_no_second_history() {
    let folder = folder_of("explorer1-stiff");
    let ran = interrupted_long(&folder);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert_eq!(names(&folder), ["model.toml", "spin", "spin-unfinished"]);
    let record = RunRecord::read(&folder.path().join("spin")).unwrap();
    let [history] = &record.histories[..] else { panic!("{} histories", record.histories.len()) };
    assert_eq!((&*history.system, &*history.status), ("reduced", "interrupted"));
    assert!(history.message.starts_with("the run was interrupted at t = "), "{}", history.message);
    let times = &history.columns[0].values;
    assert!(times[0] == 0.0 && times.is_sorted() && times.len() < 2_000_001, "{}", times.len());
    let note = "The run was interrupted, so the history of the rigid body was left out.";
    assert_eq!(record.notes, [note]);
    let page = fs::read_to_string(folder.path().join("spin/report.html")).unwrap();
    assert!(page.contains("Ended early") && page.contains(&history.message) && page.contains(note));
    let words = one_line(&ran.stdout);
    assert!(words.contains("the run was interrupted at t = ") && words.contains(note), "{}", ran.stdout);
    assert!(ran.stdout.lines().all(|line| line.chars().count() <= 80), "{}", ran.stdout);
}

/// Explorer 1 has no reduced history, so that the full one in its place is interrupted.
#[test]
fn a_history_in_the_place_of_another_can_be_interrupted_too() {
    let folder = folder_of("explorer1");
    let ran = interrupted_long(&folder);
    assert_eq!(ran.code, Some(1));
    let record = RunRecord::read(&folder.path().join("spin")).unwrap();
    let states: Vec<_> = record.histories.iter().map(|each| (&*each.system, &*each.status)).collect();
    assert_eq!(states, [("full", "interrupted")]);
    assert!(record.notes.iter().any(|note| note.ends_with("the history of the rigid body was left out.")));
}

#[test]
fn interrupted_table_is_printed_up_to_there() {
    let folder = folder_of("explorer1-stiff");
    let ran = interrupted(&folder, "simulate model.toml --duration 2000h --samples 2000001");
    assert_eq!(ran.code, Some(1));
    let table = Table::of(&ran.stdout);
    let times = table.column("t");
    assert!(times[0] == 0.0 && times.is_sorted() && times.len() < 2_000_001);
    let words = one_line(&ran.stderr);
    assert!(words.starts_with("quasirigid: the run was interrupted at t = "), "{words}");
    assert!(words.ends_with("s; the table is valid up to there"), "{words}");
}

#[test]
fn full_system_ends_on_ctrl_c_with_its_table_valid_up_to_there() {
    let folder = folder_of("explorer1");
    let ran = interrupted(&folder, "simulate model.toml --system full --duration 2000h --samples 2000001");
    assert_eq!(ran.code, Some(1));
    let times = Table::of(&ran.stdout).column("t");
    assert!(times[0] == 0.0 && times.is_sorted() && times.len() < 2_000_001);
    let words = one_line(&ran.stderr);
    assert!(words.starts_with("quasirigid: the run was interrupted at t = "), "{words}");
}

#[test]
fn verification_ends_on_ctrl_c() {
    let folder = folder_of("three-masses");
    let ran = interrupted(&folder, "verify model.toml --revolutions 1e7");
    assert_eq!((ran.code, &*ran.stdout), (Some(1), ""));
    assert_eq!(ran.stderr, "quasirigid: the verification was interrupted; nothing was measured\n");
}

/// The histories are complete, the verification is missing.
#[test]
fn interrupted_proof_is_left_out_of_the_record() {
    let folder = folder_of("three-masses");
    let file = folder.path().join("model.toml");
    let text = fs::read_to_string(&file).unwrap();
    fs::write(&file, text + "verify = { revolutions = 1e7 }\n").unwrap();
    let after_histories = |child: &Child| {
        wait_until_it_listens(child);
        std::thread::sleep(Duration::from_secs(2));
    };
    let ran = interrupted_when(after_histories, &folder, "run model.toml --duration 10 -o spin");
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let record = RunRecord::read(&folder.path().join("spin")).unwrap();
    assert_eq!((record.histories.len(), record.verification), (2, None));
    assert!(
        record
            .notes
            .iter()
            .any(|note| note.contains("the verification against the full system was left out"))
    );
}

#[test]
fn interrupted_table_in_a_file_is_whole_rows() {
    let folder = folder_of("explorer1-stiff");
    let ran =
        interrupted(&folder, "simulate model.toml --duration 2000h --samples 2000001 --out table.csv --json");
    assert_eq!(ran.code, Some(1));
    assert_eq!(ran.json()["status"], "interrupted");
    let text = fs::read_to_string(folder.path().join("table.csv")).unwrap();
    assert!(text.ends_with('\n') && !Table::of(&text).rows.is_empty());
    assert_eq!(names(&folder), ["model.toml", "table.csv", "table.csv.inputs.json"]);
}

#[test]
fn printing_of_a_long_table_ends_on_ctrl_c() {
    let folder = folder_of("axial-mass");
    let mut child = start(&folder, "simulate model.toml --duration 10 --samples 100001");
    let mut out = BufReader::new(child.stdout.take().unwrap());
    let mut text = String::new();
    out.read_line(&mut text).unwrap(); // it prints now, and waits for the pipe to be read
    signal(&child, "-INT");
    std::thread::sleep(Duration::from_millis(500));
    out.read_to_string(&mut text).unwrap();
    let ran: Ran = child.wait_with_output().unwrap().into();
    assert_eq!((ran.code, &*ran.stderr), (Some(1), "quasirigid: interrupted; the table is incomplete\n"));
    assert!(text.lines().count() < 50_000, "{} lines", text.lines().count());
}

#[test]
fn killed_run_leaves_nothing_but_the_run_in_work() {
    let folder = folder_of("explorer1-stiff");
    let mut child = start(&folder, LONG);
    wait_until_it_keeps(&child, &folder.path().join("spin-unfinished"));
    signal(&child, "-KILL");
    child.wait().unwrap();
    assert_eq!(names(&folder), ["model.toml", "spin-unfinished"]);
}

#[test]
fn reader_that_goes_away_ends_the_program_quietly() {
    let folder = folder_of("axial-mass");
    for line in ["simulate model.toml --duration 60 --samples 20001", "derive model.toml --order 12 --json"] {
        let mut child = start(&folder, line);
        let mut first = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut first).unwrap();
        let ran: Ran = child.wait_with_output().unwrap().into();
        assert_eq!((ran.code, &*ran.stderr), (Some(0), ""), "{line}");
        assert!(first.ends_with('\n'));
    }
}

/// Systems end programs by SIGTERM, and by SIGXCPU at the limit of processor time.
#[test]
fn signal_to_end_does_what_ctrl_c_does() {
    for name in ["-TERM", "-XCPU"] {
        let folder = folder_of("explorer1-stiff");
        let mut child = start(&folder, LONG);
        wait_until_it_keeps(&child, &folder.path().join("spin-unfinished"));
        signal(&child, name);
        assert_eq!(ended(&mut child).code(), Some(1), "{name}");
        let record = RunRecord::read(&folder.path().join("spin")).unwrap();
        assert_eq!(record.histories[0].status, "interrupted");
        assert_eq!(names(&folder), ["model.toml", "spin", "spin-unfinished"]);
    }
}

/// Nobody reads the pipe, so the program never asks whether it should end. The rows of its long table are in a temporary file.
#[test]
fn work_that_does_not_see_ctrl_c_ends_all_the_same() {
    let folder = folder_of("axial-mass");
    let [once, twice] = [1, 2].map(|presses| {
        let mut command = program(folder.path());
        command.args(["simulate", "model.toml", "--duration", "10", "--samples", "100001"]);
        command.env("TMPDIR", folder.path()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        let mut out = BufReader::new(child.stdout.take().unwrap());
        out.read_line(&mut String::new()).unwrap(); // it prints now, and waits for the pipe to be read
        std::thread::sleep(Duration::from_millis(300));
        let pressed = Instant::now();
        for _ in 0..presses {
            signal(&child, "-INT");
            std::thread::sleep(Duration::from_millis(200));
        }
        assert_eq!(ended(&mut child).code(), Some(1));
        let taken = pressed.elapsed();
        let mut words = String::new();
        child.stderr.take().unwrap().read_to_string(&mut words).unwrap();
        assert_eq!(words, "quasirigid: interrupted; no file was written or changed\n");
        assert_eq!(names(&folder), ["model.toml"]);
        taken
    });
    assert!(twice < once, "the second one ends it at once: {twice:?}, not {once:?}");
}

/// Each step of a structure under forces takes long, so that steps are no measure of time.
#[test]
fn slow_steps_are_asked_as_often_as_fast_ones() {
    let folder = folder_of("solar-panels");
    let file = folder.path().join("model.toml");
    let text = fs::read_to_string(&file).unwrap();
    fs::write(&file, text + "\n[[force]]\nkind = \"spin-drag\"\ncoefficient = 1e-4\n").unwrap();
    let ran = interrupted(&folder, "simulate model.toml --duration 1h --samples 11");
    assert_eq!(ran.code, Some(1));
    assert!(Table::of(&ran.stdout).column("t")[0] == 0.0, "{ran:?}");
    let words = one_line(&ran.stderr);
    assert!(words.contains("the run was interrupted at t = "), "{words}");
}
