//! The common problem of other programs: `data/published/common_problem`, trajectories of the full system.

use std::path::Path;

use quasirigid::dynamics::{Forced, FullState, Options, Outcome, propagate_full};
use quasirigid::problems::CommonProblem;
use quasirigid_math::rotation::{ALIGNED, angle_between};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/published/common_problem");

/// Rows of a table: t, ω, attitude, q, v, E, |H|.
fn rows(table: &str) -> Vec<Vec<f64>> {
    let text = std::fs::read_to_string(Path::new(FOLDER).join(format!("{table}.csv"))).unwrap();
    let row = |line: &str| line.split(',').map(|field| field.parse().unwrap()).collect();
    text.lines().skip(1).map(row).collect()
}

/// Largest differences from the table: of the spin, the attitude, and the energy.
fn differences(table: &str, tolerance: f64) -> [f64; 3] {
    let rows = rows(table);
    let case = CommonProblem::named(table.trim_end_matches("_s")).unwrap();
    let body = case.assembly().body().unwrap();
    let start = FullState {
        q: rows[0][8..11].to_vec(),
        rate: rows[0][11..14].to_vec(),
        ..FullState::at_rest(&body, CommonProblem::SPIN, ALIGNED)
    };
    let times: Vec<f64> = rows.iter().map(|row| row[0]).collect();
    let options = Options { tolerance, ..Options::default() };
    let mut samples = Vec::new();
    let run = propagate_full(Forced::not(&body), &start, &times, &options, &mut samples).unwrap();
    assert_eq!(run.outcome, Outcome::Finished);
    assert!(run.last.momentum_drift.abs() < 1e-10, "|K| drifts by {:e}", run.last.momentum_drift);
    let mut worst = [0.0_f64; 3];
    for (row, sample) in rows.iter().zip(&samples) {
        for axis in 0..3 {
            worst[0] = worst[0].max((sample.omega[axis] - row[1 + axis]).abs());
        }
        worst[1] = worst[1].max(angle_between(sample.attitude, [row[4], row[5], row[6], row[7]]));
        worst[2] = worst[2].max((sample.energy / row[14] - 1.0).abs());
    }
    println!("{table:7} {:9.1e} {:9.1e} {:9.1e} {:?}", worst[0], worst[1], worst[2], run.work);
    worst
}

/// Every row, from rest and from the slow manifold, underdamped and overdamped: 1e-8 in the spin.
#[test]
fn full_system_follows_the_reference_trajectories() {
    for table in ["A", "A_s", "B", "B_s", "over", "over_s", "soft"] {
        let [spin, attitude, energy] = differences(table, 1e-11);
        assert!(spin < 1e-8 && attitude < 1e-7 && energy < 1e-9, "{table}: {spin:e} {attitude:e} {energy:e}");
    }
}

/// 4900 revolutions: the table itself is good to 1e-12 (SOURCE.md).
#[test]
fn full_system_follows_the_reference_for_thousands_of_turns() {
    let [spin, attitude, energy] = differences("long", 1e-13);
    assert!(spin < 1e-8 && attitude < 1e-6 && energy < 1e-9, "{spin:e} {attitude:e} {energy:e}");
}

/// The vibrations decay, and then the steps no longer depend on the stiffness of the springs.
#[test]
fn work_does_not_grow_with_the_stiffness() {
    let steps = |case: CommonProblem| {
        let body = case.assembly().body().unwrap();
        let start = FullState::at_rest(&body, CommonProblem::SPIN, ALIGNED);
        let options = Options { tolerance: 1e-9, ..Options::default() };
        let run = propagate_full(Forced::not(&body), &start, &[200.0], &options, &mut Vec::new()).unwrap();
        run.work.steps
    };
    let (soft, stiff) = (steps(CommonProblem::A), steps(CommonProblem::C));
    assert!(stiff < soft + soft / 4, "{soft} steps at 1e4 N/m, {stiff} at 1e8 N/m");
}
