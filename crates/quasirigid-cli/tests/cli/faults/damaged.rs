//! Files that a run or a study goes on from, cut short, filled with zeros or changed: told and refused, or answered again; never taken
//! for results.

use std::fs;
use std::path::Path;

use super::{LONG, STUDY, killed_run};
use crate::support::{copy, files, folder_of_study, names, one_line, ran_in};

/// Forms of damage to a file.
fn damages(whole: &[u8]) -> Vec<(String, Vec<u8>)> {
    let length = whole.len();
    let cuts = [0, 1, 8, length / 3, length - 8, length - 1];
    let mut all: Vec<_> = cuts.iter().map(|cut| (format!("cut at {cut}"), whole[..*cut].to_vec())).collect();
    all.push(("zeros".into(), vec![0; length]));
    all.push(("a tail of zeros".into(), [&whole[..length / 2], &vec![0; length - length / 2]].concat()));
    all.push(("more bytes".into(), [whole, b"more"].concat()));
    for at in [0, 9, length / 2, length - 1] {
        let mut changed = whole.to_vec();
        changed[at] ^= 1;
        all.push((format!("byte {at}"), changed));
    }
    all
}

#[test]
fn damaged_checkpoint_is_refused_and_stays() {
    let folder = killed_run();
    let path = folder.path().join("out-unfinished/history-reduced.checkpoint");
    for (damage, bytes) in damages(&fs::read(&path).unwrap()) {
        fs::write(&path, &bytes).unwrap();
        let refused = ran_in(folder.path(), &format!("{LONG} --resume"));
        let words = "out-unfinished: its checkpoint is damaged; remove the folder and start anew";
        assert!(one_line(refused.refusal()).ends_with(words), "{damage}: {}", refused.stderr);
        assert_eq!(fs::read(&path).unwrap(), bytes, "{damage}");
    }
}

/// The rows up to the checkpoint go into the results as they stand.
#[test]
fn damaged_rows_are_refused_and_stay() {
    let folder = killed_run();
    for name in ["history-reduced.rows", "history-reduced.frames"] {
        let path = folder.path().join("out-unfinished").join(name);
        let whole = fs::read(&path).unwrap();
        let changed = |at: usize| {
            let mut bytes = whole.clone();
            bytes[at] ^= 1;
            bytes
        };
        let zeros = vec![0; whole.len()];
        for bytes in [changed(0), changed(1000), changed(8200), zeros, Vec::new(), whole[..1000].to_vec()] {
            fs::write(&path, &bytes).unwrap();
            let refused = ran_in(folder.path(), &format!("{LONG} --resume"));
            let said = one_line(refused.refusal());
            assert!(
                said.contains("its rows are damaged") || said.contains("its rows are cut short"),
                "{said}"
            );
            assert_eq!(fs::read(&path).unwrap(), bytes, "{name}");
        }
        fs::write(&path, whole).unwrap();
    }
}

#[test]
fn run_without_identity_is_refused() {
    let folder = killed_run();
    let path = folder.path().join("out-unfinished/run.identity");
    for bytes in [&b""[..], b"0000"] {
        fs::write(&path, bytes).unwrap();
        ran_in(folder.path(), &format!("{LONG} --resume")).refusal();
    }
    fs::remove_file(&path).unwrap();
    let refused = ran_in(folder.path(), &format!("{LONG} --resume"));
    assert!(refused.refusal().contains("there is no run here to continue"), "{}", refused.stderr);
    assert!(names(folder.path().join("out-unfinished")).contains(&"history-reduced.rows".to_owned()));
}

/// A part is refused by name; once it is removed its rows are answered again, and the bytes are those of a study without damage.
#[test]
fn damaged_part_of_a_study_is_refused_and_answered_again() {
    let folder = folder_of_study(STUDY);
    let resume = "sweep study.toml -o out -q --resume";
    assert_eq!(ran_in(folder.path(), "sweep study.toml -o out -q").code, Some(0));
    let whole = files(&folder.path().join("out"));
    let part = folder.path().join("out/parts/part-00001.parquet");
    let bytes = fs::read(&part).unwrap();
    let assert_refused = |damage: &str| {
        let refused = ran_in(folder.path(), resume);
        let said = one_line(refused.refusal());
        let named = said.contains("out/parts/part-00001.parquet: ") && said.contains("with --resume");
        assert!(named, "{damage}: {said}");
    };
    let changed = (4..bytes.len()).step_by(151).map(|at| {
        let mut changed = bytes.clone();
        changed[at] ^= 0x10;
        (format!("byte {at}"), changed)
    });
    for (damage, damaged) in damages(&bytes).into_iter().chain(changed) {
        fs::write(&part, &damaged).unwrap();
        assert_refused(&damage);
    }
    fs::copy(folder.path().join("out/parts/part-00000.parquet"), &part).unwrap();
    assert_refused("another part");
    fs::remove_file(&part).unwrap();
    assert_eq!(ran_in(folder.path(), resume).code, Some(0));
    assert_eq!(files(&folder.path().join("out")), whole);
}

/// Lines of a journal that a loss of power tore are answered again, and no other.
#[test]
fn torn_journal_of_a_study_is_answered_again() {
    let folder = folder_of_study(STUDY);
    assert_eq!(ran_in(folder.path(), "sweep study.toml -o whole -q").code, Some(0));
    let whole = files(&folder.path().join("whole"));
    let other = folder_of_study(STUDY);
    copy(&folder.path().join("whole"), &other.path().join("out"));
    let journal = other.path().join("out/parts/part-00002.journal");
    let readable = b"00000000 [8,\"answered\",\"\",\"\",[true,[0],\"holds\"]]\n"; // an answer, but for its checksum
    for torn in [
        &b"deadbeef [8,\"answered\""[..],
        b"\0\0\0\0\0\0\0\0\n",
        b"\xff\xfe\n\n\n",
        b"00000000 []\n",
        readable,
    ] {
        fs::remove_file(other.path().join("out/parts/part-00002.parquet")).unwrap();
        fs::write(&journal, torn).unwrap();
        let ran = ran_in(other.path(), "sweep study.toml -o out -q --resume");
        assert_eq!((ran.code, &*ran.stderr), (Some(0), ""));
        assert_eq!(files(&other.path().join("out")), whole);
    }
    assert!(!Path::exists(&journal));
}
