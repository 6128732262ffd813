use super::*;
use crate::model::{FlexibleBody, Principal};
use crate::modes::{ModeRange, SpinMagnitude, SpinMode, SpinModes};
use crate::problems::{hub_of_points, ring_of_points};

/// Steady spin about a principal axis.
fn spun(body: &FlexibleBody, axis: usize, rate: f64) -> RelativeEquilibrium {
    let axis = Principal::compute(body.invariants().J).axes[axis];
    RelativeEquilibrium::near(body, axis, SpinMagnitude::Rate(rate)).unwrap()
}

/// Slowest modes by the blocks of a body, however small.
fn by_blocks(body: &FlexibleBody, spin: &RelativeEquilibrium) -> SpinModes {
    let coefficients = body.sparse_about_spin(spin.omega, &spin.q).unwrap();
    SpinModes::slowest(body, spin.clone(), &coefficients).unwrap()
}

fn lambda(mode: &SpinMode) -> Complex<f64> {
    Complex::new(-mode.decay_rate, mode.frequency)
}

fn slow(modes: &SpinModes) -> SlowModes {
    match modes.range {
        ModeRange::Slowest(slow) => slow,
        ModeRange::All => panic!("not all modes were asked for"),
    }
}

/// Every mode of the dense matrix below the rate is found, with its digits, name, shares and motion, and no other.
fn assert_same(body: &FlexibleBody, spin: &RelativeEquilibrium, tolerance: f64) {
    let (few, all) = (by_blocks(body, spin), SpinModes::all_about(body, spin.clone()).unwrap());
    let rate = slow(&few).rate;
    let below: Vec<&SpinMode> =
        all.modes.iter().filter(|mode| mode.nutation || lambda(mode).norm() < rate).collect();
    assert_eq!(few.modes.len(), below.len(), "{rate} {:?}", slow(&few));
    for mode in below {
        let gap = |other: &&SpinMode| (lambda(other) - lambda(mode)).norm();
        let own = few.modes.iter().min_by(|a, b| gap(a).total_cmp(&gap(b))).unwrap();
        assert!(gap(&own) < tolerance * lambda(mode).norm(), "{} {} {}", mode.name, lambda(mode), lambda(own));
        let decays = (own.decay_rate - mode.decay_rate).abs();
        assert!(decays <= 1e-8 * mode.decay_rate.abs() + 1e-15 * lambda(mode).norm(), "{} {decays:e}", mode.name);
        assert_eq!(own.nutation, mode.nutation);
        for (part, share) in &mode.moves {
            let other = own.moves.iter().find(|(name, _)| name == part).map_or(0.0, |(_, share)| *share);
            assert!((share - other).abs() < 1e-5, "{} {part} {share} {other}", mode.name);
        }
    }
    assert_eq!(few.nutation().map(|mode| mode.name.clone()), all.nutation().map(|mode| mode.name.clone()));
}

#[test]
fn slowest_modes_are_those_of_the_dense_matrix() {
    for (count, mass) in [(2, 50.0), (20, 50.0), (20, 4000.0)] {
        let body = hub_of_points(count, mass).body().unwrap();
        for (axis, rate) in [(2, 0.5), (0, 0.5), (1, 0.5), (2, 3.0)] {
            let spin = spun(&body, axis, rate);
            assert_same(&body, &spin, 1e-9);
            assert_eq!(slow(&by_blocks(&body, &spin)).missing, Some(0), "{count} {mass} {axis} {rate}");
        }
    }
    let body = ring_of_points(12).body().unwrap();
    assert_same(&body, &spun(&body, 2, 0.3), 1e-9);
}
