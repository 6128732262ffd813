//! Files that appear in place of a result while the work for it goes on, and leftovers of killed runs.

use std::fs::{self, File};
use std::io::Read;
use std::path::Path;
use std::time::{Duration, Instant, SystemTime};

use quasirigid_io::record::RunRecord;
use tempfile::TempDir;

use super::interrupt::{ended, signal, start, wait_until_it_keeps, wait_until_it_listens};
use crate::support::{Ran, folder_of, names, one_line, ran_in};

const LONG: &str = "run model.toml --duration 2000h --samples 2000001 -o out -q";
const SHORT: &str = "run model.toml --duration 5 --samples 6 -q -o out";

/// Does something while a command is at work, which then is interrupted and ends with its partial result.
fn meanwhile(folder: &TempDir, line: &str, done: impl FnOnce(&Path)) -> Ran {
    let mut child = start(folder, line);
    if line.starts_with("run") {
        wait_until_it_keeps(&child, &folder.path().join("out-unfinished"));
    } else {
        wait_until_it_listens(&child);
    }
    done(folder.path());
    signal(&child, "-INT");
    let code = ended(&mut child).code();
    let mut ran = Ran { code, stdout: String::new(), stderr: String::new() };
    child.stderr.take().unwrap().read_to_string(&mut ran.stderr).unwrap();
    ran.stderr = one_line(&ran.stderr);
    ran
}

#[test]
fn folder_that_appears_during_the_run_stays_and_the_record_goes_beside_it() {
    let folder = folder_of("explorer1-stiff");
    let ran = meanwhile(&folder, LONG, |at| {
        fs::create_dir(at.join("out")).unwrap();
        fs::write(at.join("out/thesis.txt"), "precious").unwrap();
    });
    assert_eq!(ran.code, Some(1));
    assert_eq!(names(folder.path().join("out")), ["thesis.txt"]);
    RunRecord::read(&folder.path().join("out-2")).unwrap();
    assert_eq!(names(&folder), ["model.toml", "out", "out-2", "out-unfinished"]);
    let words = "out was created in the meantime, and is left as it is; the result is in out-2";
    assert!(ran.stderr.contains(words), "{}", ran.stderr);
}

#[test]
fn folder_without_contents_and_a_file_stay_too() {
    for file in [false, true] {
        let folder = folder_of("explorer1-stiff");
        let ran = meanwhile(&folder, LONG, |at| {
            let out = at.join("out");
            if file { fs::write(out, "precious").unwrap() } else { fs::create_dir(out).unwrap() }
        });
        assert_eq!(ran.code, Some(1));
        assert_eq!(folder.path().join("out").is_file(), file);
        RunRecord::read(&folder.path().join("out-2")).unwrap();
    }
}

#[test]
fn of_two_runs_into_one_folder_neither_is_lost() {
    let folder = folder_of("explorer1-stiff");
    meanwhile(&folder, LONG, |at| assert_eq!(ran_in(at, SHORT).code, Some(0)));
    let status = |name: &str| RunRecord::read(&folder.path().join(name)).unwrap().histories[0].status.clone();
    assert_eq!([status("out"), status("out-2")], ["finished", "interrupted"]);
}

#[test]
fn what_is_put_into_an_older_record_during_the_run_stays() {
    let folder = folder_of("explorer1-stiff");
    assert_eq!(ran_in(folder.path(), SHORT).code, Some(0));
    let line = format!("{LONG} --overwrite");
    let ran = meanwhile(&folder, &line, |at| fs::write(at.join("out/thesis.txt"), "precious").unwrap());
    assert_eq!(ran.code, Some(1));
    assert_eq!(fs::read_to_string(folder.path().join("out/thesis.txt")).unwrap(), "precious");
    RunRecord::read(&folder.path().join("out-2")).unwrap();
}

#[test]
fn file_that_appears_in_the_place_of_a_table_stays() {
    let folder = folder_of("explorer1-stiff");
    let line = "simulate model.toml --duration 2000h --samples 2000001 --out o.csv -q";
    let ran = meanwhile(&folder, line, |at| fs::write(at.join("o.csv"), "precious").unwrap());
    assert_eq!(ran.code, Some(1));
    assert_eq!(fs::read_to_string(folder.path().join("o.csv")).unwrap(), "precious");
    assert!(fs::read_to_string(folder.path().join("o-2.csv")).unwrap().starts_with("t,wx"));
    assert_eq!(names(&folder), ["model.toml", "o-2.csv", "o-2.csv.inputs.json", "o.csv"]);
}

/// Names alone make no record: a history belongs to a record if the record lists it, and if it is a file.
#[test]
fn files_that_only_look_like_ours_are_never_replaced() {
    let folder = folder_of("axial-mass");
    let out = folder.path().join("out");
    for foreign in ["history-mine.csv", "history-thesis.csv/ch1.txt", "report.html/x"] {
        assert_eq!(ran_in(folder.path(), SHORT).code, Some(0));
        let file = out.join(foreign);
        if foreign.contains('/') {
            let _ = fs::remove_file(file.parent().unwrap());
            fs::create_dir(file.parent().unwrap()).unwrap();
        }
        fs::write(&file, "precious").unwrap();
        let refused = ran_in(folder.path(), &format!("{SHORT} --overwrite"));
        assert!(refused.refusal().contains("is not only a record"), "{foreign}: {}", refused.stderr);
        assert_eq!(fs::read_to_string(&file).unwrap(), "precious");
        fs::remove_dir_all(&out).unwrap();
    }
}

/// A temporary folder as a killed run leaves it, or as a living one holds it.
fn working_folder(folder: &TempDir, name: &str, place: &str) -> File {
    let beside = folder.path().join(name);
    fs::create_dir_all(beside.join("new")).unwrap();
    fs::write(beside.join("new/record.json"), "{").unwrap();
    fs::write(beside.join("place"), place).unwrap();
    let lock = File::create(beside.join("lock")).unwrap();
    lock.lock().unwrap();
    lock
}

#[test]
fn what_killed_runs_left_is_swept_and_what_living_ones_work_in_is_not() {
    let folder = folder_of("axial-mass");
    let living = working_folder(&folder, ".quasirigid-living", "elsewhere");
    drop(working_folder(&folder, ".quasirigid-killed", "elsewhere"));
    fs::create_dir(folder.path().join(".quasirigid-not-ours")).unwrap();
    fs::write(folder.path().join(".quasirigid-fresh"), "").unwrap();
    let old = folder.path().join(".quasirigid-old");
    fs::write(&old, "t,wx").unwrap();
    let hour_ago = SystemTime::now() - Duration::from_secs(3600);
    File::options().write(true).open(&old).unwrap().set_modified(hour_ago).unwrap();
    assert_eq!(ran_in(folder.path(), SHORT).code, Some(0));
    let left = [".quasirigid-fresh", ".quasirigid-living", ".quasirigid-not-ours", "model.toml", "out"];
    assert_eq!(names(&folder), left);
    drop(living);
}

/// Killed between two renames, where the file system cannot exchange: the older record was in no place.
#[test]
fn record_of_a_run_killed_between_two_places_goes_back() {
    let folder = folder_of("axial-mass");
    assert_eq!(ran_in(folder.path(), SHORT).code, Some(0));
    drop(working_folder(&folder, ".quasirigid-killed", "out"));
    let aside = folder.path().join(".quasirigid-killed/new-aside");
    fs::rename(folder.path().join("out"), &aside).unwrap();
    let refused = ran_in(folder.path(), SHORT);
    assert!(refused.refusal().contains("out already exists"), "{}", refused.stderr);
    RunRecord::read(&folder.path().join("out")).unwrap();
    assert_eq!(names(&folder), ["model.toml", "out"]);
}

#[test]
fn name_that_no_file_can_have_is_refused_before_the_work() {
    let folder = folder_of("explorer1-stiff");
    let name = "n".repeat(300);
    for line in [
        format!("run model.toml --duration 2000h --samples 2000001 -o {name}"),
        format!("simulate model.toml --duration 2000h --samples 2000001 --out {name}"),
    ] {
        let start = Instant::now();
        let refused = ran_in(folder.path(), &line);
        assert!(refused.refusal().contains("File name too long"), "{}", refused.stderr);
        assert!(start.elapsed() < Duration::from_secs(10), "{line}");
        assert_eq!(names(&folder), ["model.toml"]);
    }
}
