//! Loss of power: the calls to the system show that every result is on the disk before it has its name, its name before the program
//! says so, and an older result goes only after that; and that a disk that fails is told.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

use super::super::interrupt::ended;
use super::{LONG, STUDY, can, folder_of_rigid, skip};
use crate::support::{Ran, files, folder_of, folder_of_study, names, ran_in};

const CALLS: &str = "trace=write,fsync,rename,renameat,renameat2,unlink,unlinkat,mkdir";

/// The program under `strace`, which writes what it sees into a file, or lets calls fail or take long.
pub fn tracing(folder: &Path, options: &[&str], line: &str) -> Command {
    let mut command = Command::new("strace");
    command.args(["-f", "-y", "-qq", "-s", "0"]).args(options);
    command.arg(env!("CARGO_BIN_EXE_quasirigid")).args(line.split(' ')).current_dir(folder);
    command
}

fn traced(folder: &Path, options: &[&str], line: &str) -> Ran {
    tracing(folder, options, line).output().unwrap().into()
}

/// What a call did, as far as it matters here.
#[derive(Debug)]
enum Call {
    Wrote(PathBuf),
    Settled(PathBuf),
    Renamed(PathBuf, PathBuf),
    Removed(PathBuf),
    Made(PathBuf),
    Said,
}

/// The calls of a command that succeeded, with full paths.
fn calls(folder: &Path, line: &str) -> Vec<Call> {
    let log = tempfile::NamedTempFile::new().unwrap();
    let path = log.path().to_str().unwrap();
    let ran = traced(folder, &["-o", path, "-e", CALLS], line);
    assert_eq!(ran.code, Some(0), "{line}: {}", ran.stderr);
    let root = folder.canonicalize().unwrap();
    let full = |text: &str| root.join(text).components().collect::<PathBuf>();
    let text = fs::read_to_string(log.path()).unwrap();
    text.lines().filter_map(|line| call(line, &full)).collect()
}

fn call(line: &str, full: &dyn Fn(&str) -> PathBuf) -> Option<Call> {
    let (_, line) = line.trim_start().split_once(char::is_whitespace)?;
    let (name, rest) = line.trim_start().split_once('(')?;
    if rest.contains(" = -1 ") {
        return None;
    }
    let descriptor = || Some(full(rest.split_once('<')?.1.split_once('>')?.0));
    let quoted: Vec<&str> = rest.split('"').skip(1).step_by(2).collect();
    Some(match name {
        "write" if rest.starts_with("1<") => Call::Said,
        "write" => Call::Wrote(descriptor()?),
        "fsync" => Call::Settled(descriptor()?),
        "rename" | "renameat" | "renameat2" => Call::Renamed(full(quoted.first()?), full(quoted.get(1)?)),
        "mkdir" => Call::Made(full(quoted.first()?)),
        "unlink" => Call::Removed(full(quoted.first()?)),
        // relative to the folder of a descriptor
        "unlinkat" if !rest.starts_with("AT_FDCWD") => Call::Removed(descriptor()?.join(quoted.first()?)),
        "unlinkat" => Call::Removed(full(quoted.first()?)),
        _ => return None,
    })
}

fn is_checkpoint(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending == "checkpoint")
}

/// Asserts the order of the calls of a writer: a checkpoint gets its name after its folder and the rows that
/// it continues.
fn assert_ordered(line: &str, calls: &[Call]) {
    let ours = |path: &Path| !path.starts_with("/dev") && !path.starts_with("/proc") && path.is_absolute();
    let mut unsettled: HashMap<PathBuf, &str> = HashMap::new();
    let mut results = 0;
    for call in calls {
        match call {
            Call::Wrote(path) if ours(path) && !path.to_string_lossy().contains(":[") => {
                unsettled.insert(path.clone(), "bytes");
            }
            Call::Settled(path) => {
                // what is in a folder has its name settled with it, the folder itself has not
                unsettled.retain(|place, what| match *what {
                    "bytes" => place != path,
                    _ => place.parent() != Some(path),
                });
            }
            Call::Renamed(from, to) if to.file_name().is_some_and(|name| name != "lock") => {
                let torn = unsettled.iter().find(|(path, what)| match **what {
                    "bytes" => {
                        path.starts_with(from)
                            || is_checkpoint(to) && path.with_extension("") == to.with_extension("")
                    }
                    _ => is_checkpoint(to) && Some(path.as_path()) == to.parent(),
                });
                assert!(
                    torn.is_none(),
                    "{line}: {torn:?} is not on the disk when {} gets its name",
                    to.display()
                );
                unsettled.insert(to.clone(), "name");
                results += 1;
            }
            Call::Removed(path) => {
                let name = unsettled.iter().find(|(_, what)| **what == "name");
                assert!(name.is_none(), "{line}: {} goes before {name:?} is on the disk", path.display());
                unsettled.remove(path);
            }
            Call::Made(path) if !path.to_string_lossy().contains(".quasirigid-") => {
                unsettled.insert(path.clone(), "name");
            }
            Call::Said => {
                assert!(unsettled.values().all(|what| *what != "name"), "{line}: said before {unsettled:?}")
            }
            _ => {}
        }
    }
    assert!(results > 0, "{line}: nothing was put in its place");
    let names: Vec<_> = unsettled.iter().filter(|(_, what)| **what == "name").collect();
    assert!(names.is_empty(), "{line}: {names:?} may be lost");
}

pub fn can_trace() -> bool {
    can("strace", &["-f", "-y", "-qq", "-o", "/dev/null", "true"])
}

#[test]
fn results_are_on_the_disk_before_anything_is_said() {
    if !can_trace() {
        return skip("strace is missing, or may not trace");
    }
    let folder = folder_of_study(STUDY);
    fs::copy(folder_of_rigid().path().join("model.toml"), folder.path().join("rigid.toml")).unwrap();
    for line in [
        "run model.toml --duration 5 -o out",
        "run model.toml --duration 6 --tables csv,npz,parquet -o out --overwrite",
        "run rigid.toml --duration 60 --samples 100101 --tables parquet -o long",
        "simulate model.toml --duration 5 --out t.csv --json",
        "simulate model.toml --duration 5 --out t.csv --json --overwrite",
        "evolve model.toml --out e.csv",
        "report out",
        "report out --gltf body.glb",
        "plot out --figure spin",
        "sweep study.toml -o study",
    ] {
        assert_ordered(line, &calls(folder.path(), line));
    }
}

#[test]
fn rows_are_on_the_disk_before_the_checkpoint_that_continues_them() {
    if !can_trace() {
        return skip("strace is missing, or may not trace");
    }
    let folder = folder_of("boom-satellite");
    let calls = calls(folder.path(), LONG);
    assert_ordered(LONG, &calls);
    assert!(calls.iter().any(|call| matches!(call, Call::Renamed(_, to) if is_checkpoint(to))), "{calls:?}");
}

/// What a loss of power takes of a study is the answers of the last second.
#[test]
fn answers_of_a_study_in_work_come_to_the_disk() {
    if !can_trace() {
        return skip("strace is missing, or may not trace");
    }
    let folder = folder_of_study(
        &STUDY.replace("samples = 12", "samples = 900000").replace("part = 4", "part = 900000"),
    );
    let log = tempfile::NamedTempFile::new().unwrap();
    let options = ["-o", log.path().to_str().unwrap(), "-e", "trace=fsync"];
    let mut child = tracing(folder.path(), &options, "sweep study.toml -o out -q").spawn().unwrap();
    let start = Instant::now();
    let (settled, process) = loop {
        let seen = fs::read_to_string(log.path()).unwrap();
        let settled = seen.lines().any(|line| line.contains("part-00000.journal>"));
        if settled || start.elapsed() > Duration::from_secs(30) {
            break (settled, seen.split_whitespace().next().unwrap_or_default().to_owned());
        }
        std::thread::sleep(Duration::from_millis(20));
    };
    assert!(can("kill", &["-INT", &process])); // strace itself lets no signal through
    assert_eq!((settled, ended(&mut child).code()), (true, Some(1)));
}

#[test]
fn disk_that_fails_is_told_and_the_older_result_stays() {
    if !can_trace() {
        return skip("strace is missing, or may not trace");
    }
    let folder = folder_of_study(STUDY);
    assert_eq!(ran_in(folder.path(), "run model.toml --duration 5 -q -o out").code, Some(0));
    fs::write(folder.path().join("t.csv"), "older").unwrap();
    let before = files(folder.path());
    for (name, call) in [("fsync", "fsync"), ("rename", "rename,renameat,renameat2")] {
        for line in [
            "run model.toml --duration 6 -q -o out --overwrite",
            "simulate model.toml --duration 5 -q --out t.csv --overwrite",
            "run model.toml --duration 5 -q -o new",
        ] {
            let inject = format!("inject={call}:error=EIO");
            let ran = traced(folder.path(), &["-o", "/dev/null", "-e", &inject], line);
            assert_eq!(ran.code, Some(2), "{call}, {line}: {}", ran.stderr);
            assert!(ran.stderr.contains("cannot write"), "{call}, {line}: {}", ran.stderr);
            assert!(files(folder.path()) == before, "{call}, {line}: {:?}", names(&folder));
        }
        let line = format!("sweep study.toml -q -o study-{name}");
        let ran =
            traced(folder.path(), &["-o", "/dev/null", "-e", &format!("inject={call}:error=EIO")], &line);
        assert_eq!(ran.code, Some(2), "{call}: {}", ran.stderr);
        assert!(ran.stderr.contains(&format!("study-{name}")), "{}", ran.stderr);
        fs::remove_dir_all(folder.path().join(format!("study-{name}"))).unwrap();
    }
}

/// The last step, when all files of the record are on the disk; and file systems that know neither exchange nor exclusive names.
#[test]
fn record_that_cannot_take_its_place_leaves_the_older_one() {
    if !can_trace() {
        return skip("strace is missing, or may not trace");
    }
    let folder = folder_of_study(STUDY);
    assert_eq!(ran_in(folder.path(), "run model.toml --duration 5 -q -o out").code, Some(0));
    let [out, kept] = ["out", "out-unfinished"].map(|name| folder.path().join(name));
    let before = files(&out);
    let lines =
        ["run model.toml --duration 6 -q -o out --overwrite", "run model.toml --duration 5 -q -o new"];
    for line in lines {
        let ran = traced(folder.path(), &["-o", "/dev/null", "-e", "inject=renameat2:error=EIO"], line);
        assert_eq!(ran.code, Some(2), "{line}: {}", ran.stderr);
        assert!(ran.stderr.contains("cannot write"), "{line}: {}", ran.stderr);
        let _ = fs::remove_dir_all(&kept); // of a slow machine
        assert!(files(&out) == before, "{line}");
        assert_eq!(names(&folder), ["model.toml", "out", "study.toml"], "{line}");
    }
    for line in lines {
        let ran = traced(folder.path(), &["-o", "/dev/null", "-e", "inject=renameat2:error=EINVAL"], line);
        assert_eq!((ran.code, &*ran.stderr), (Some(0), ""), "{line}");
    }
    assert_eq!(names(&folder), ["model.toml", "new", "out", "study.toml"]);
    assert!(files(&out)["record.json"] != before["record.json"]);
}

/// The older record is looked at once more when it is out of its place.
#[test]
fn what_is_put_into_an_older_record_at_the_last_moment_stays() {
    if !can_trace() {
        return skip("strace is missing, or may not trace");
    }
    let folder = folder_of_study(STUDY);
    assert_eq!(ran_in(folder.path(), "run model.toml --duration 5 -q -o out").code, Some(0));
    let log = tempfile::NamedTempFile::new().unwrap();
    let path = log.path().to_str().unwrap();
    let slow = ["-o", path, "-e", "trace=fsync,renameat2", "-e", "inject=renameat2:delay_enter=2000000"];
    let line = "run model.toml --duration 6 -q -o out --overwrite";
    let mut child = tracing(folder.path(), &slow, line).spawn().unwrap();
    while !fs::read_to_string(log.path()).unwrap().contains("/new>") {
        assert!(child.try_wait().unwrap().is_none(), "the run ended before");
        std::thread::sleep(Duration::from_millis(5));
    }
    std::thread::sleep(Duration::from_millis(500)); // the record is on the disk, and waits for the exchange
    fs::write(folder.path().join("out/thesis.txt"), "precious").unwrap();
    assert_eq!(ended(&mut child).code(), Some(1));
    assert_eq!(fs::read_to_string(folder.path().join("out/thesis.txt")).unwrap(), "precious");
    assert_eq!(names(&folder), ["model.toml", "out", "out-2", "study.toml"]);
}

/// The name of the new record may not be on the disk, so the older one comes back.
#[test]
fn older_record_stays_where_the_name_of_the_new_one_is_not_settled() {
    if !can_trace() {
        return skip("strace is missing, or may not trace");
    }
    let folder = folder_of_study(STUDY);
    assert_eq!(ran_in(folder.path(), "run model.toml --duration 5 -q -o out").code, Some(0));
    let before = files(folder.path());
    let line = "run model.toml --duration 6 -q -o out --overwrite";
    let settled = before.len() - 2; // the files of the record; then comes its folder, then the folder above
    let inject = format!("inject=fsync:error=EIO:when={}", settled + 2);
    let ran = traced(folder.path(), &["-o", "/dev/null", "-e", &inject], line);
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    assert!(files(folder.path()) == before, "{:?}", names(&folder));
    let inject = format!("inject=fsync:error=EIO:when={}", settled + 3);
    let ran = traced(folder.path(), &["-o", "/dev/null", "-e", &inject], line);
    assert_eq!(ran.code, Some(2));
    assert!(ran.stderr.contains("out is written, but the system does not say"), "{}", ran.stderr);
}
