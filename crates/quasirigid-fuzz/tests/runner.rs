//! Every target keeps its promises on its corpus, on its regressions, and on some thousands of mutated inputs.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use quasirigid_fuzz::campaign::Campaign;
use quasirigid_fuzz::corpus::{self, HOME};
use quasirigid_fuzz::targets::TARGETS;

/// Time for the mutated inputs of one target, after its files.
const TIME: Duration = Duration::from_millis(600);
/// Most mutated inputs of one target.
const EXECUTIONS: u64 = 4000;

/// Every target in a process of its own, two at a time.
#[test]
fn no_input_breaks_a_promise() {
    let findings = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("findings");
    let campaign = |seed: u64| Campaign {
        program: PathBuf::from(env!("CARGO_BIN_EXE_quasirigid-fuzz")),
        time: TIME,
        executions: EXECUTIONS,
        seed,
        jobs: 1,
        findings: findings.clone(),
    };
    let start = Instant::now();
    let (first, second) = TARGETS.split_at(TARGETS.len() / 2);
    let run = |targets: &[quasirigid_fuzz::targets::Target]| -> Vec<&'static str> {
        let failed =
            |target: &&quasirigid_fuzz::targets::Target| campaign(22).run(target).unwrap().failed > 0;
        targets.iter().filter(failed).map(|target| target.name).collect()
    };
    let failed = std::thread::scope(|scope| {
        let other = scope.spawn(|| run(second));
        [run(first), other.join().unwrap()].concat()
    });
    assert!(failed.is_empty(), "{failed:?} failed; their inputs are in {}", findings.display());
    assert!(start.elapsed() < Duration::from_secs(600), "a run of the tests has no room for so many inputs");
}

#[test]
fn every_target_has_a_corpus_and_every_folder_a_target() {
    for target in &TARGETS {
        assert!(!corpus::files(target).is_empty(), "{} has no corpus", target.name);
    }
    for kind in ["corpus", "regressions"] {
        for entry in std::fs::read_dir(PathBuf::from(HOME).join(kind)).unwrap() {
            let name = entry.unwrap().file_name().into_string().unwrap();
            assert!(TARGETS.iter().any(|target| target.name == name), "{kind}/{name} belongs to no target");
        }
    }
}
