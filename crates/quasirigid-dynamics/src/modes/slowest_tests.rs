use super::*;
use crate::elements::{Assembly, Coefficient, Rotor, RotorKind, SpringLaw};
use crate::model::Principal;
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
        assert!(
            gap(&own) < tolerance * lambda(mode).norm(),
            "{} {} {}",
            mode.name,
            lambda(mode),
            lambda(own)
        );
        let decays = (own.decay_rate - mode.decay_rate).abs();
        assert!(
            decays <= 1e-8 * mode.decay_rate.abs() + 1e-15 * lambda(mode).norm(),
            "{} {decays:e}",
            mode.name
        );
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

/// A flywheel with friction decays by itself, and its angle has an eigenvalue of zero that is no motion.
#[test]
fn rotors_are_blocks_of_their_own() {
    let axis = [0.3, -0.2, 1.0];
    let kind = RotorKind::Flywheel { axis };
    let rotor = Rotor { name: "damper".into(), kind, inertia: 3.0, friction: 0.4, speed: None };
    let body = Assembly { rotors: vec![rotor], ..hub_of_points(15, 300.0) }.body().unwrap();
    let spin = spun(&body, 2, 0.5);
    assert_same(&body, &spin, 1e-9);
    let found = slow(&by_blocks(&body, &spin));
    assert_eq!((found.missing, found.positive_energy), (Some(0), true));
}

/// Points that are alike have equal eigenvalues, which one Krylov space does not tell apart: those found and those told to be missing are all.
#[test]
fn nothing_is_missing_unsaid() {
    let mut assembly = hub_of_points(30, 900.0);
    for (k, spring) in assembly.springs.iter_mut().enumerate() {
        let k = 40.0 + (k / 10) as f64;
        spring.law = SpringLaw::Spatial {
            stiffness: Coefficient::Isotropic(1e3 * k),
            damping: Coefficient::Isotropic(k),
        };
    }
    assembly.points.iter_mut().for_each(|point| point.mass = 30.0);
    let body = assembly.body().unwrap();
    let spin = spun(&body, 2, 0.2);
    let (few, all) = (by_blocks(&body, &spin), SpinModes::all_about(&body, spin.clone()).unwrap());
    let SlowModes { rate, missing, .. } = slow(&few);
    let eigenvalues = |modes: &SpinModes| -> usize {
        let below = modes.modes.iter().filter(|mode| lambda(mode).norm() < rate);
        below.map(|mode| if mode.frequency > 0.0 { 2 } else { 1 }).sum()
    };
    let missing = missing.expect("points are small blocks");
    assert!(missing > 0, "thirty equal points have more equal eigenvalues than Krylov spaces");
    assert_eq!(eigenvalues(&few) + missing, eigenvalues(&all), "{rate}");
}

/// About the axis of least inertia the energy is not least, and the nutation grows; about that of greatest inertia it is, and a body
/// on a chain has too large a block for a count, not for this.
#[test]
fn stability_is_shown_by_the_energy_alone() {
    let body = hub_of_points(60, 50.0).body().unwrap();
    let [least, greatest] = [0, 2].map(|axis| SpinModes::about(&body, spun(&body, axis, 0.5)).unwrap());
    assert!(least.unstable() && !least.stable() && !slow(&least).positive_energy);
    assert!(greatest.stable() && !greatest.unstable() && slow(&greatest).positive_energy);
    assert!(greatest.modes.len() > WANTED && slow(&greatest).missing == Some(0));
    let ring = ring_of_points(60).body().unwrap();
    let ring = SpinModes::about(&ring, spun(&ring, 2, 0.3)).unwrap();
    assert!(ring.stable() && slow(&ring).missing.is_none());
    let unshown = SpinModes {
        range: ModeRange::Slowest(SlowModes { positive_energy: false, ..slow(&greatest) }),
        ..greatest
    };
    assert!(!unshown.stable() && !unshown.unstable());
}
