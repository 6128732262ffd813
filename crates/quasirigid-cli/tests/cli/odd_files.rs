//! Files with characters that steer terminals, files that never end, and models too large for the machine.

use std::fs;
use std::process::Command;

use crate::support::{MODEL, Ran, folder_with, one_line, program, ran_in, ran_with};

fn steers(text: &str) -> bool {
    text.chars().any(|letter| letter.is_control() && letter != '\n')
}

#[test]
fn nothing_from_a_file_steers_the_terminal() {
    let name = "[body]\nname = \"a\\u001b]0;PWNED\\u0007\\u001b[2J\\u009b1m\\u202e\"\n";
    for line in [
        "check model.toml",
        "derive model.toml",
        "evolve model.toml",
        "modes model.toml",
        "check model.toml --json",
    ] {
        let ran = ran_with(&format!("{name}{MODEL}"), line);
        assert!(!steers(&ran.stdout) && !steers(&ran.stderr), "{line}: {ran:?}");
        assert!(
            ran.stdout.contains("a\\u001b]0;PWNED\\u0007\\u001b[2J\\u009b1m\\u202e"),
            "{line}: {}",
            ran.stdout
        );
    }
    let point = MODEL.replace("\"tip\"", "\"ti\\u001b[2Jp\"");
    let table = ran_with(&point, "simulate model.toml --system full --samples 2 --coordinates");
    assert!(!steers(&table.stdout) && table.stdout.lines().count() == 3, "{}", table.stdout);
}

#[test]
fn lines_that_are_quoted_do_not_steer_it_either() {
    let comment = MODEL.replace("mass = 40.0", "mass = -40.0 # \u{1b}[2J\u{9b}1m é");
    let refused = ran_with(&comment, "check model.toml");
    assert!(!steers(refused.refusal()), "{}", refused.stderr);
    assert!(refused.stderr.contains("mass = -40.0 # ?[2J??1m é"), "{}", refused.stderr);
    let folder = folder_with(MODEL);
    let file = folder.path().join("m\u{1b}[2J.toml");
    fs::write(&file, comment).unwrap();
    for name in ["m\u{1b}[2J.toml", "none\u{1b}[2J.toml"] {
        let ran: Ran = program(folder.path()).args(["check", name]).output().unwrap().into();
        assert!(!steers(ran.refusal()), "{}", ran.stderr);
    }
}

/// A line of a million characters, in a model that is none, is quoted by its beginning and cut.
#[test]
fn a_huge_line_is_cut_in_what_is_quoted() {
    for line in [format!("a = [{}]", "[],".repeat(300_000)), format!("a = \"{}\"", "é".repeat(300_000))] {
        let refused = ran_with(&line, "check model.toml");
        assert!(
            refused.refusal().contains("a = ") && refused.stderr.len() < 3_000,
            "{}",
            refused.stderr.len()
        );
    }
}

/// A name of a file is any bytes; the folder of a run had others than its model.
#[cfg(unix)]
#[test]
fn folder_of_a_run_has_the_bytes_of_its_model() {
    use std::os::unix::ffi::OsStrExt;

    let folder = folder_with(MODEL);
    let name = std::ffi::OsStr::from_bytes(b"m\xff.toml");
    fs::rename(folder.path().join("model.toml"), folder.path().join(name)).unwrap();
    let ran = program(folder.path()).arg("run").arg(name).args(["--duration", "10", "-q"]).output().unwrap();
    assert_eq!(ran.status.code(), Some(0), "{ran:?}");
    assert!(folder.path().join(std::ffi::OsStr::from_bytes(b"m\xff-run/record.json")).is_file());
}

#[test]
fn pipe_in_the_place_of_a_mesh_is_refused() {
    let folder = folder_with(
        "[material.al]\ndensity = 2700\nyoung = \"70 GPa\"\npoisson = 0.33\n[[solid]]\nfile = \"pipe\"\nmaterial = \"al\"\n",
    );
    assert!(Command::new("mkfifo").arg(folder.path().join("pipe")).status().unwrap().success());
    let refused = ran_in(folder.path(), "check model.toml");
    assert!(
        refused.refusal().contains("this is not a regular file but a pipe or a device"),
        "{}",
        refused.stderr
    );
}

/// A model may name any file that its user can read, and its messages may be read by others.
#[test]
fn nothing_of_a_foreign_file_is_quoted() {
    let secret = "root:$6$hG7rQx9w$Zk0PvUuYt1:19000:0:99999:7:::\ndaemon:*:19000:0:99999:7:::\n";
    let al = "[material.al]\ndensity = 2700\nyoung = \"70 GPa\"\npoisson = 0.33\n";
    let matrices = "[[matrices]]\nmass = \"secret\"\nstiffness = \"secret\"\nnodes = \"secret\"\n";
    let modes = "[[modes]]\nnodes = \"secret\"\nmass = \"secret\"\nshapes = \"secret\"\nfrequencies = { file = \"secret\" }\n";
    for model in [
        format!("{al}[[solid]]\nfile = \"secret\"\nmaterial = \"al\"\n"),
        format!("{al}[[surface]]\nfile = \"secret\"\nmaterial = \"al\"\n"),
        format!("{MODEL}{matrices}"),
        format!("{MODEL}{modes}"),
    ] {
        let folder = folder_with(&model);
        fs::write(folder.path().join("secret"), secret).unwrap();
        let refused = ran_in(folder.path(), "check model.toml");
        assert!(!refused.refusal().contains("root"), "{}", refused.stderr);
        assert!(!refused.stderr.contains("$6$") && refused.stderr.contains("secret"), "{}", refused.stderr);
    }
    let folder = folder_with(MODEL);
    fs::write(folder.path().join("secret"), secret).unwrap();
    for asked in ["columns = { m = \"carrier.mass\" }\n", ""] {
        let study = format!(
            "model = \"model.toml\"\n[table]\nfile = \"secret\"\n{asked}[answer]\nquantities = [\"check.valid\"]\n"
        );
        fs::write(folder.path().join("study.toml"), study).unwrap();
        let refused = ran_in(folder.path(), "sweep study.toml");
        assert!(!refused.refusal().contains("root"), "{}", refused.stderr);
    }
}

/// The limit of the shell stands for a small machine.
fn on_a_small_machine(folder: &std::path::Path, kibi: usize, line: &str) -> Ran {
    let line = format!("ulimit -v {kibi}; exec {} {line}", env!("CARGO_BIN_EXE_quasirigid"));
    Command::new("sh").args(["-c", &line]).current_dir(folder).output().unwrap().into()
}

#[test]
fn panel_too_fine_for_the_memory_is_refused_with_an_estimate() {
    let text =
        fs::read_to_string(format!("{}/examples/solar-panels/model.toml", crate::support::ROOT)).unwrap();
    let at = text.find("cells = [").unwrap();
    let end = at + text[at..].find(']').unwrap();
    for (cells, words) in [
        (1000, "`cells` makes 1000000 elements: it would take about"),
        (200, "unknowns are too many here: it would take about"),
    ] {
        let folder = folder_with(&format!("{}cells = [{cells}, {cells}{}", &text[..at], &text[end..]));
        let refused = on_a_small_machine(folder.path(), 1_000_000, "check model.toml");
        let said = refused.refusal().replace(['│', '\n'], " ");
        let said = one_line(&said);
        assert!(said.contains(words), "{said}");
    }
}

/// The rows of a long table go to the disk as they come: these took 400 MB.
#[test]
fn long_table_needs_little_memory() {
    let folder = folder_with(MODEL);
    let line = "simulate model.toml --samples 1000000 --duration 2h --format parquet --out t.parquet -q";
    let ran = on_a_small_machine(folder.path(), 300_000, line);
    assert_eq!(ran.code, Some(0), "{ran:?}");
}

/// The rows of `run` go to the disk as they come: these would take 300 MB.
#[test]
fn long_run_needs_little_memory() {
    let folder = folder_with(MODEL);
    let ran = on_a_small_machine(
        folder.path(),
        300_000,
        "run model.toml --samples 1000000 --duration 2h -o spin -q",
    );
    assert_eq!(ran.code, Some(0), "{ran:?}");
}

/// The answers of an uncertainty are kept in memory until the last.
#[test]
fn answers_without_room_are_refused_before_the_first() {
    let uncertain = "[uncertainty]\n\"carrier.mass\" = { normal = { mean = 40, deviation = 1 } }\n";
    let folder = folder_with(&format!("{MODEL}{uncertain}"));
    let line = "evolve model.toml --uncertainty-samples 10000000 -q";
    let refused = on_a_small_machine(folder.path(), 1_000_000, line);
    let said = one_line(refused.refusal());
    assert!(said.contains("10000000 rows are too many here: it would take about"), "{said}");
}
