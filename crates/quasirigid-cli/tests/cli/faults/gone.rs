//! Folders that are removed, moved or replaced while the work goes on, and places behind links that lead nowhere.

use std::fs;
use std::io::Read;
use std::os::unix::fs::symlink;
use std::time::Duration;

use super::super::interrupt::{ended, signal, start, wait_until_it_keeps, wait_until_it_listens};
use super::{STUDY, folder_of_rigid, in_work};
use crate::support::{Ran, files, folder_of, folder_of_study, names, one_line, ran_in};

#[test]
fn run_in_work_that_is_moved_is_told_and_goes_on_when_it_is_back() {
    let folder = folder_of("boom-satellite");
    let child = in_work(folder.path());
    let [kept, moved] = ["out-unfinished", "moved"].map(|name| folder.path().join(name));
    fs::rename(&kept, &moved).unwrap();
    let ran: Ran = child.wait_with_output().unwrap().into();
    assert_eq!(ran.code, Some(2));
    let said = one_line(&ran.stderr);
    assert!(said.contains("out-unfinished: the folder of the run was removed, moved or replaced"), "{said}");
    assert_eq!(names(&folder), ["model.toml", "moved"]);
    fs::rename(&moved, &kept).unwrap();
    let mut child = in_work(folder.path()); // it has another checkpoint now
    child.kill().unwrap();
    child.wait().unwrap();
}

/// A link to another record stands where the run has its folder: nothing is written through it, and nothing removed.
#[test]
fn record_in_the_place_of_a_run_in_work_is_left_alone() {
    let folder = folder_of("boom-satellite");
    assert_eq!(ran_in(folder.path(), "run model.toml --duration 60 -q -o thesis").code, Some(0));
    let thesis = files(&folder.path().join("thesis"));
    let child = in_work(folder.path());
    fs::rename(folder.path().join("out-unfinished"), folder.path().join("moved")).unwrap();
    symlink("thesis", folder.path().join("out-unfinished")).unwrap();
    let ran: Ran = child.wait_with_output().unwrap().into();
    assert_eq!(ran.code, Some(2));
    assert!(files(&folder.path().join("thesis")) == thesis);
    assert_eq!(names(&folder), ["model.toml", "moved", "out-unfinished", "thesis"]);
}

/// Files with names like those of a run that somebody put into its folder stay when the run ends.
#[test]
fn files_of_others_in_a_run_in_work_stay() {
    let folder = folder_of_rigid();
    let mut child =
        start(&folder, "run model.toml --samples 100101 --duration 600 --tables parquet -q -o out");
    let kept = folder.path().join("out-unfinished");
    while !kept.join("run.identity").exists() {
        assert!(child.try_wait().unwrap().is_none(), "the run ended before");
        std::thread::sleep(Duration::from_millis(1));
    }
    fs::write(kept.join("history-thesis.txt"), "precious").unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(0));
    assert_eq!(names(&kept), ["history-thesis.txt"]);
}

/// Where a folder with the same names stands in its place, nothing is written into that.
#[test]
fn study_whose_folder_is_removed_or_replaced_is_told() {
    for replaced in [false, true] {
        let folder = folder_of_study(
            &STUDY.replace("samples = 12", "samples = 900000").replace("part = 4", "part = 900000"),
        );
        let mut child = start(&folder, "sweep study.toml -o out -q");
        wait_until_it_listens(&child);
        let out = folder.path().join("out");
        while !out.join("parts/part-00000.journal").exists() {
            std::thread::sleep(Duration::from_millis(5));
        }
        if replaced {
            fs::rename(&out, folder.path().join("moved")).unwrap();
            fs::create_dir_all(out.join("parts")).unwrap();
        } else {
            fs::remove_dir_all(&out).unwrap();
        }
        assert_eq!(ended(&mut child).code(), Some(2));
        let ran: Ran = child.wait_with_output().unwrap().into();
        assert!(ran.refusal().contains("out/parts/part-00000.journal: "), "{}", ran.stderr);
        let left: &[&str] = if replaced {
            &["model.toml", "moved", "out", "study.toml"]
        } else {
            &["model.toml", "study.toml"]
        };
        assert_eq!(names(&folder), left);
        assert!(!replaced || names(out.join("parts")).is_empty());
    }
}

/// What a run has in work moves with the folder above it; nothing appears in the old place, or in another folder there.
#[test]
fn folder_above_that_is_renamed_is_told() {
    for replaced in [false, true] {
        let folder = folder_of("explorer1-stiff");
        fs::create_dir(folder.path().join("above")).unwrap();
        let line = "run model.toml --duration 2000h --samples 2000001 -q -o above/out";
        let mut child = start(&folder, line);
        wait_until_it_keeps(&child, &folder.path().join("above/out-unfinished"));
        fs::rename(folder.path().join("above"), folder.path().join("elsewhere")).unwrap();
        if replaced {
            fs::create_dir(folder.path().join("above")).unwrap();
        }
        signal(&child, "-INT");
        assert_eq!(ended(&mut child).code(), Some(2));
        let mut said = String::new();
        child.stderr.take().unwrap().read_to_string(&mut said).unwrap();
        let words = "above/out-unfinished: the folder of the run was removed, moved or replaced";
        assert!(one_line(&said).contains(words), "{said}");
        assert!(!replaced || names(folder.path().join("above")).is_empty());
        assert_eq!(names(folder.path().join("elsewhere")), ["out-unfinished"]);
    }
}

#[test]
fn link_that_leads_nowhere_is_no_place_for_results() {
    let folder = folder_of_study(STUDY);
    symlink("nowhere", folder.path().join("out")).unwrap();
    for line in [
        "run model.toml --duration 5 -q -o out",
        "run model.toml --duration 5 -q -o out --overwrite",
        "sweep study.toml -q -o out",
        "simulate model.toml --duration 5 -q --out out",
        "evolve model.toml -q --out out",
    ] {
        let refused = ran_in(folder.path(), line);
        assert!(one_line(refused.refusal()).contains("out already exists"), "{line}: {}", refused.stderr);
        assert_eq!(names(&folder), ["model.toml", "out", "study.toml"]);
        assert_eq!(fs::read_link(folder.path().join("out")).unwrap().to_str(), Some("nowhere"));
    }
}
