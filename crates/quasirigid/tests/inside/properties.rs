//! Internal rotors and liquids depend neither on the axes of the file nor on its units.

use quasirigid::dynamics::FullState;
use quasirigid::elements::Assembly;
use quasirigid::model::FlexibleBody;
use quasirigid::reduction::{Relaxation, Validity, reduce};
use quasirigid_math::rotation::ALIGNED;
use quasirigid_math::vec3::norm;

use super::bodies::everything;
use super::description::{Description, SAME};
use crate::submanifold::bodies::beam;
use crate::support::rotors::flywheel;

/// Order kept, and the order that the liquids are prepared for.
const ORDER: usize = 4;
const OMEGA: [f64; 3] = [0.3, -0.2, 0.4];
/// Rounding of some hundred operations, grown by the condition of the chains of liquids.
const ROUNDING: f64 = 1e-12;
/// Damped eigenvalues near critical damping are as sensitive as a square root.
const DAMPED: f64 = 1e-7;

fn body() -> Assembly {
    let mut assembly = everything();
    assembly.reduction.order = ORDER;
    assembly
}

fn assert_the_same(description: Description) {
    let (before, after) = (body().build().unwrap(), description.of(&body()).build().unwrap());
    let (old, new) = (reduce(&before.body, ORDER).unwrap(), reduce(&after.body, ORDER).unwrap());
    let mut gaps = description.gaps(&new, &old);
    let liquids = after.liquids.iter().zip(&before.liquids);
    gaps.extend(liquids.map(|(found, before)| ("P", description.liquid_gap(found, before))));
    let times = |body| Relaxation::compute(body).unwrap().times;
    // Eigenvalues, right to the rounding of the largest.
    let (found, known) = (times(&after.body), times(&before.body));
    let longest = description.time * known[0];
    let relaxed = found.into_iter().zip(known);
    gaps.extend(relaxed.map(|(found, known)| ("tau", (found - description.time * known).abs() / longest)));
    println!("{description:?}: {gaps:?}");
    assert_eq!(after.body.cyclic(), before.body.cyclic());
    assert!(gaps.iter().all(|(_, gap)| *gap < ROUNDING), "{gaps:?}");
}

/// Criteria are ratios. That of the series is evaluated in fixed directions and may change a little with the axes.
fn assert_the_same_criteria(description: Description) {
    let criteria = |assembly: Assembly, omega| {
        Validity::assess(&assembly.body().unwrap(), ORDER - 1, omega).unwrap().criteria
    };
    let found = criteria(description.of(&body()), description.vector(OMEGA, [0, 0, -1]));
    for (found, expected) in found.iter().zip(criteria(body(), OMEGA)) {
        assert_eq!(found.comparison, expected.comparison);
        let gap = (found.value - expected.value).abs() / expected.value;
        println!("{:?} {gap:e}", found.comparison);
        assert!(gap < DAMPED || expected.value == 0.0, "{found:?} {expected:?}");
    }
}

#[test]
fn rotating_the_axes_of_the_file_rotates_every_result() {
    for turn in [[0.4, -1.3, 0.8], [-2.1, 0.5, 1.9], [0.0, 0.0, 0.3]] {
        assert_the_same(Description { turn, ..SAME });
    }
}

#[test]
fn changing_the_units_scales_every_result() {
    for [length, mass, time] in [[39.37, 2.2046, 16.7], [1234.5, 7.31e-4, 913.0], [3.1e-7, 4.7e8, 8.9e-6]] {
        let description = Description { length, mass, time, ..SAME };
        assert_the_same(description);
        assert_the_same_criteria(description);
    }
}

/// A beam keeps its curved paths where a rotor beside it is locked: energy and angular momentum are those of the rotor at rest.
#[test]
fn a_locked_rotor_leaves_the_paths_of_a_beam() {
    let rotors = vec![flywheel([0.3, 1.0, -0.5], 0.4, 0.6)];
    let body = Assembly { rotors, ..beam() }.body().unwrap();
    let locked = body.locked_inside();
    let elastic = locked.coordinates().len();
    assert_eq!(elastic + 1, body.coordinates().len());
    let moved = |body: &FlexibleBody| {
        let mut state = FullState::at_rest(body, OMEGA, ALIGNED);
        for j in 0..elastic {
            state.q[j] = 0.1 / (1.0 + j as f64);
            state.rate[j] = 0.3 - 0.2 * j as f64;
        }
        (state.energy(body), state.angular_momentum(body))
    };
    let ((energy, momentum), (expected, whole)) = (moved(&locked), moved(&body));
    assert!((energy / expected - 1.0).abs() < 1e-12, "{energy} {expected}");
    assert!((0..3).all(|i| (momentum[i] - whole[i]).abs() < 1e-12 * norm(whole)), "{momentum:?} {whole:?}");
}

#[test]
fn turned_axes_and_other_units_go_together() {
    assert_the_same(Description { turn: [1.1, 0.7, -0.9], length: 0.0173, mass: 61.0, time: 0.29 });
}
