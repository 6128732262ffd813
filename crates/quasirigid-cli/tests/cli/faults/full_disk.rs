//! Disks that are full, and files larger than the system allows: at the first byte, in the middle, at the last; what stood there stays.

use std::fs;
use std::path::Path;
use std::process::Command;

use tempfile::TempDir;

use super::{Mounted, STUDY, after, skip};
use crate::support::{files, folder_of_study, names, ran_in};

/// Commands that write one result, and the result. A small one is in the buffer of its file until that is closed.
const WRITERS: [(&str, &str); 10] = [
    ("run model.toml --duration 20 --samples 200 --tables csv,parquet,npz -q -o out --overwrite", "out"),
    ("simulate model.toml --duration 20 --samples 200 -q --overwrite --out t.csv", "t.csv"),
    (
        "simulate model.toml --duration 20 --samples 200 -q --overwrite --format parquet --out t.parquet",
        "t.parquet",
    ),
    ("simulate model.toml --duration 20 --samples 200 -q --overwrite --format npz --out t.npz", "t.npz"),
    (
        "simulate model.toml --duration 20 --samples 3 -q --overwrite --format npz --out small.npz",
        "small.npz",
    ),
    ("evolve model.toml --samples 300 -q --overwrite --out e.csv", "e.csv"),
    ("report record --out page.html -q --overwrite", "page.html"),
    ("report record --gltf body.glb -q --overwrite", "body.glb"),
    ("plot record --figure spin --out spin.svg -q --overwrite", "spin.svg"),
    ("plot record --figure spin --out spin.svg -q --overwrite", "spin.svg"),
];

/// A folder in which every result is there from an earlier time, made otherwise.
fn with_older_results() -> TempDir {
    let folder = folder_of_study(STUDY);
    assert_eq!(ran_in(folder.path(), "run model.toml --duration 5 -q -o record").code, Some(0));
    assert_eq!(ran_in(folder.path(), "run model.toml --duration 7 -q -o out").code, Some(0));
    for (_, result) in &WRITERS[1..] {
        fs::write(folder.path().join(result), "older").unwrap();
    }
    folder
}

/// The bytes of a result, a file or a folder.
fn bytes(path: &Path) -> Vec<(String, Vec<u8>)> {
    if path.is_dir() {
        files(path).into_iter().collect()
    } else {
        vec![(String::new(), fs::read(path).unwrap())]
    }
}

/// The limit, in the 512 bytes that `ulimit` counts, which only the last bytes of a file are beyond: those that are written as it closes.
fn last_block(size: usize) -> usize {
    (size - 1) / 512
}

/// Each file is as large as the limit at another place, so that every stage of the writing meets it.
#[test]
fn result_beyond_a_limit_of_size_leaves_the_older_one() {
    let folder = with_older_results();
    let before = names(&folder);
    for (line, result) in WRITERS {
        let path = folder.path().join(result);
        let older = bytes(&path);
        let last = if older.len() == 1 {
            assert!(ran_in(folder.path(), line).code.is_some_and(|code| code < 2), "{line}");
            let size = fs::metadata(&path).unwrap().len() as usize;
            fs::write(&path, "older").unwrap();
            last_block(size)
        } else {
            0
        };
        for blocks in [0, 3, 20, last] {
            let ran = after(folder.path(), &format!("ulimit -f {blocks}"), line);
            let large = older.len() > 1 || blocks == 0 || blocks == last || ran.code == Some(2);
            if large {
                assert!(
                    ran.refusal().contains("File too large") || ran.stderr.contains("file too large"),
                    "{line}: {ran:?}"
                );
                assert!(
                    ran.stderr.contains(result) && !ran.stderr.contains(".quasirigid-"),
                    "{line}: {}",
                    ran.stderr
                );
                assert_eq!(ran.stderr.matches("too large").count(), 1, "{}", ran.stderr);
                assert!(bytes(&path) == older, "{line}: the older result is gone");
            } else {
                assert!(ran.code.is_some_and(|code| code < 2) && bytes(&path) != older, "{line}: {ran:?}");
                fs::write(&path, "older").unwrap();
            }
            let mut left = names(&folder);
            left.retain(|name| !name.ends_with(".inputs.json"));
            assert_eq!(left, before, "{line}");
        }
    }
}

/// Files of a record, in the order in which they are written.
const WRITTEN: [&str; 7] = [
    "history-reduced.csv",
    "history-rigid.csv",
    "scene.json",
    "record.json",
    "reduced.json",
    "report.html",
    "sphere.svg",
];

/// The first file that is too large is named, even if the last bytes of it alone are.
#[test]
fn record_beyond_a_limit_of_size_at_the_last_byte_of_a_file_leaves_the_older_one() {
    let folder = with_older_results();
    let run = "run model.toml --duration 5 --samples 6 -q -o";
    assert_eq!(ran_in(folder.path(), &format!("{run} whole")).code, Some(0));
    let before = files(folder.path());
    let sizes = WRITTEN.map(|name| before[&format!("whole/{name}")].len());
    assert_eq!(names(folder.path().join("whole")).len(), WRITTEN.len());
    for last in sizes.map(last_block) {
        let ran = after(folder.path(), &format!("ulimit -f {last}"), &format!("{run} out --overwrite"));
        let first = sizes.iter().position(|size| *size > 512 * last).unwrap();
        let words = format!("cannot write out/{}: file too large", WRITTEN[first]);
        assert!(ran.refusal().to_lowercase().contains(&words), "{last}, {words}: {}", ran.stderr);
        assert!(files(folder.path()) == before, "{last}: the older record is gone");
    }
}

#[test]
fn study_beyond_a_limit_of_size_goes_on_to_the_same_bytes() {
    let folder = folder_of_study(STUDY);
    assert_eq!(ran_in(folder.path(), "sweep study.toml -o whole -q").code, Some(0));
    let mut refused = 0;
    for blocks in [0, 1, 3, 7, 14] {
        let ran = after(folder.path(), &format!("ulimit -f {blocks}"), "sweep study.toml -o out -q --resume");
        assert!(
            ran.refusal().contains("out/") && ran.stderr.contains("File too large"),
            "{blocks}: {}",
            ran.stderr
        );
        refused += 1;
        assert!(!folder.path().join("out/summary.json").exists());
    }
    assert!(refused == 5 && names(folder.path().join("out")).iter().all(|name| !name.ends_with(".tmp")));
    assert_eq!(ran_in(folder.path(), "sweep study.toml -o out -q --resume").code, Some(0));
    assert!(files(&folder.path().join("out")) == files(&folder.path().join("whole")));
}

/// A table of many rows is written twice, as rows and then in its format, and the last bytes go when the file is closed.
#[test]
fn long_table_beyond_a_limit_of_size_is_refused_at_its_last_byte() {
    let folder = folder_of_study(STUDY);
    let line = "simulate model.toml --duration 20 --samples 100001 --tolerance 1e-6 -q --format npz --overwrite --out t.npz";
    assert_eq!(ran_in(folder.path(), line).code, Some(0));
    let path = folder.path().join("t.npz");
    let size = fs::metadata(&path).unwrap().len();
    for blocks in [100, (size - 1) / 512] {
        fs::write(&path, "older").unwrap();
        let ran = after(folder.path(), &format!("ulimit -f {blocks}"), line);
        assert!(ran.refusal().contains("quasirigid: cannot write t.npz: "), "{}", ran.stderr);
        assert_eq!((fs::read_to_string(&path).unwrap(), names(&folder).len()), ("older".into(), 3));
    }
}

/// A small file system in memory.
struct Disk(Mounted);

impl Disk {
    fn of(kibi: u64) -> Option<Self> {
        let size = format!("size={kibi}k");
        Some(Self(Mounted::on(TempDir::new().unwrap(), &["-t", "tmpfs", "-o", &size, "tmpfs"])?))
    }

    /// Leaves so many KiB free.
    fn fill(&self, free: u64) {
        let filler = self.0.path().join("filler");
        let _ = fs::remove_file(&filler);
        let sizes = Command::new("df").args(["--output=avail", "-k"]).arg(self.0.path()).output().unwrap();
        let available: u64 =
            String::from_utf8(sizes.stdout).unwrap().lines().nth(1).unwrap().trim().parse().unwrap();
        fs::write(filler, vec![0; 1024 * available.saturating_sub(free) as usize]).unwrap();
    }
}

#[cfg(target_os = "linux")]
#[test]
fn full_disk_leaves_what_stands_there_and_the_work_goes_on_once_there_is_room() {
    let Some(disk) = Disk::of(8192) else { return skip("only root may mount a small file system") };
    let folder = disk.0.path();
    let source = folder_of_study(STUDY);
    for name in ["model.toml", "study.toml"] {
        fs::copy(source.path().join(name), folder.join(name)).unwrap();
    }
    assert_eq!(ran_in(folder, "sweep study.toml -o whole -q").code, Some(0));
    assert_eq!(ran_in(folder, "run model.toml --duration 7 -q -o out").code, Some(0));
    let older = files(&folder.join("out"));
    for free in [0, 4, 40, 400] {
        disk.fill(free);
        let ran = ran_in(folder, "run model.toml --duration 20 --samples 500 -q -o out --overwrite");
        assert!(ran.refusal().contains("cannot write out"), "{free}: {}", ran.stderr);
        assert!(files(&folder.join("out")) == older, "{free}");
        assert_eq!(names(folder), ["filler", "model.toml", "out", "study.toml", "whole"], "{free}");
    }
    for free in [0, 4, 8, 12] {
        disk.fill(free);
        let ran = ran_in(folder, "sweep study.toml -o study -q --resume");
        assert!(
            ran.refusal().contains("No space left on device") && ran.stderr.contains("study"),
            "{free}: {}",
            ran.stderr
        );
        assert!(!folder.join("study/summary.json").exists(), "{free}");
    }
    fs::remove_file(folder.join("filler")).unwrap();
    assert_eq!(ran_in(folder, "sweep study.toml -o study -q --resume").code, Some(0));
    assert!(files(&folder.join("study")) == files(&folder.join("whole")));
}

/// The disk becomes full while a run is in work: its last checkpoint stays, and the message says how to go on.
#[cfg(target_os = "linux")]
#[test]
fn run_in_work_on_a_full_disk_can_go_on() {
    let Some(disk) = Disk::of(9000) else { return skip("only root may mount a small file system") };
    let model = crate::support::folder_of("boom-satellite");
    fs::copy(model.path().join("model.toml"), disk.0.path().join("model.toml")).unwrap();
    let child = super::in_work(disk.0.path());
    let ran: crate::support::Ran = child.wait_with_output().unwrap().into();
    let said = crate::support::one_line(&ran.stderr);
    assert_eq!(ran.code, Some(2), "{said}");
    let kept = "out-unfinished is kept; once files can be written, the same command with --resume continues";
    assert!(said.contains(kept) && said.contains("cannot write out-unfinished"), "{said}");
    assert!(disk.0.path().join("out-unfinished/history-reduced.checkpoint").exists());
    assert_eq!(names(disk.0.path()), ["model.toml", "out-unfinished"]);
}
