//! Two processes at one place, at the same time or one after the death of the other; and clocks that jump.

use std::fs::{self, File};
use std::io::Read;
use std::time::{Duration, SystemTime};

use super::super::interrupt::{ended, signal, start, wait_until_it_keeps};
use super::{LONG, STUDY, folder_of_rigid, in_work};
use crate::support::{files, folder_of, folder_of_study, names, one_line, ran_in};

#[test]
fn two_studies_in_one_folder_end_with_the_same_bytes() {
    let folder = folder_of_study(STUDY);
    assert_eq!(ran_in(folder.path(), "sweep study.toml -o whole -q").code, Some(0));
    let mut both = [(); 2].map(|()| start(&folder, "sweep study.toml -o out -q --resume --threads 1"));
    for child in &mut both {
        assert_eq!(child.wait().unwrap().code(), Some(0));
    }
    assert!(files(&folder.path().join("out")) == files(&folder.path().join("whole")));
}

/// The first has a temporary file for as long as its disk takes, and the second ends before it.
#[cfg(target_os = "linux")]
#[test]
fn study_beside_one_on_a_slow_disk_ends_with_the_same_bytes() {
    use super::power::{can_trace, tracing};
    if !can_trace() {
        return super::skip("strace is missing, or may not trace");
    }
    let folder = folder_of_study(STUDY);
    let line = "sweep study.toml -o out -q --resume";
    assert_eq!(ran_in(folder.path(), "sweep study.toml -o whole -q").code, Some(0));
    let slow = ["-o", "/dev/null", "-e", "trace=fsync", "-e", "inject=fsync:delay_enter=500000"];
    let mut first = tracing(folder.path(), &slow, line).spawn().unwrap();
    let out = folder.path().join("out");
    while !(out.is_dir() && names(&out).iter().any(|name| name.ends_with(".tmp"))) {
        assert!(first.try_wait().unwrap().is_none(), "the first study ended before");
        std::thread::sleep(Duration::from_millis(5));
    }
    assert_eq!(ran_in(folder.path(), line).code, Some(0));
    assert_eq!(first.wait().unwrap().code(), Some(0));
    assert!(files(&out) == files(&folder.path().join("whole")));
}

/// A lock dies with its process.
#[test]
fn study_goes_on_where_a_killed_process_held_the_lock() {
    let folder = folder_of_study(STUDY);
    assert_eq!(ran_in(folder.path(), "sweep study.toml -o whole -q").code, Some(0));
    fs::create_dir_all(folder.path().join("out/parts")).unwrap();
    for name in ["study.toml", "model.toml", "sweep.json"] {
        fs::copy(folder.path().join("whole").join(name), folder.path().join("out").join(name)).unwrap();
    }
    let journal = File::create(folder.path().join("out/parts/part-00001.journal")).unwrap();
    journal.lock().unwrap();
    let beside = ran_in(folder.path(), "sweep study.toml -o out --resume");
    assert_eq!(beside.code, Some(0));
    assert_eq!(beside.stdout, "2 of 3 parts are in out; another process is working on 1 more.\n");
    drop(journal);
    assert_eq!(ran_in(folder.path(), "sweep study.toml -o out -q --resume").code, Some(0));
    assert!(files(&folder.path().join("out")) == files(&folder.path().join("whole")));
}

#[test]
fn run_in_work_has_one_process() {
    let folder = folder_of("boom-satellite");
    let mut child = in_work(folder.path());
    let refused = ran_in(folder.path(), &format!("{LONG} --resume"));
    let said = one_line(refused.refusal());
    assert_eq!(said, "quasirigid: out-unfinished: another process is working on this run");
    child.kill().unwrap();
    child.wait().unwrap();
    let mut child = in_work(folder.path()); // the lock died with its process
    child.kill().unwrap();
    child.wait().unwrap();
}

/// The second of two runs has its folder beside that of the first, where `--resume` does not look.
#[test]
fn second_run_says_how_it_goes_on() {
    let folder = folder_of("explorer1-stiff");
    let line = "run model.toml --duration 2000h --samples 2000001 -q -o out";
    let mut both = Vec::new();
    for kept in ["out-unfinished", "out-unfinished-2"] {
        let child = start(&folder, line);
        wait_until_it_keeps(&child, &folder.path().join(kept));
        both.push(child);
    }
    for (child, words) in both
        .iter_mut()
        .rev()
        .zip(["out-unfinished-2 is kept; rename it out-unfinished, and", "out-unfinished is kept; the same"])
    {
        signal(child, "-INT");
        assert_eq!(ended(child).code(), Some(1));
        let mut said = String::new();
        child.stderr.take().unwrap().read_to_string(&mut said).unwrap();
        assert!(one_line(&said).contains(words), "{said}");
    }
    assert_eq!(names(&folder), ["model.toml", "out", "out-2", "out-unfinished", "out-unfinished-2"]);
}

/// The folder of a run has no identity until that is on the disk, which can take long; a second run that starts meanwhile was told to
/// remove it.
#[test]
fn run_beside_one_that_makes_its_folder_has_another() {
    let folder = folder_of_rigid();
    let making = folder.path().join("out-unfinished");
    fs::create_dir(&making).unwrap();
    fs::write(making.join(".quasirigid-1-0.tmp"), "").unwrap();
    let line = "run model.toml --samples 100101 --duration 60 --tables parquet -q -o out";
    let ran = ran_in(folder.path(), line);
    assert_eq!((ran.code, &*ran.stderr), (Some(0), ""));
    assert_eq!(names(&folder), ["model.toml", "out", "out-unfinished"]);
    assert_eq!(names(&making), [".quasirigid-1-0.tmp"]);
}

/// What is left of a dead process is told by its lock; the clock of a file server may be years off.
#[test]
fn temporary_files_are_told_from_leftovers_whatever_their_time() {
    let folder = folder_of_study(STUDY);
    assert_eq!(ran_in(folder.path(), "sweep study.toml -o out -q").code, Some(0));
    let day = Duration::from_secs(86_400);
    for (number, time) in
        [SystemTime::UNIX_EPOCH - 20_000 * day, SystemTime::UNIX_EPOCH, SystemTime::now() + 40_000 * day]
            .into_iter()
            .enumerate()
    {
        let [living, dead] = ["living", "dead"].map(|state| {
            let path = folder.path().join(format!("out/parts/.quasirigid-{state}-{number}.tmp"));
            let file = File::create(&path).unwrap();
            file.set_modified(time).unwrap();
            (path, file)
        });
        living.1.lock().unwrap();
        drop(dead.1);
        assert_eq!(ran_in(folder.path(), "sweep study.toml -o out -q --resume").code, Some(0));
        assert!(living.0.exists() && !dead.0.exists(), "{time:?}");
    }
}

/// Times of files decide nothing: models and records from before 1970 and after 2038 are like others.
#[test]
fn files_of_any_year_are_read_and_replaced() {
    let folder = folder_of_study(STUDY);
    let run = "run model.toml --duration 5 -q -o out";
    assert_eq!(ran_in(folder.path(), run).code, Some(0));
    let day = Duration::from_secs(86_400);
    for time in [SystemTime::UNIX_EPOCH - 20_000 * day, SystemTime::UNIX_EPOCH + 60_000 * day] {
        for name in ["model.toml", "out/record.json", "out/report.html"] {
            File::options().write(true).open(folder.path().join(name)).unwrap().set_modified(time).unwrap();
        }
        File::create(folder.path().join(".quasirigid-left")).unwrap().set_modified(time).unwrap();
        for line in [&format!("{run} --overwrite"), "report out -q", "plot out --figure spin -q --overwrite"]
        {
            let ran = ran_in(folder.path(), line);
            assert_eq!((ran.code, &*ran.stderr), (Some(0), ""), "{line}");
        }
    }
}
