//! Steady spins of bodies with nearly equal moments: all zeros of the equations on a sphere of angular momentum.
//! They are counted by the index theorem and matched with the critical points of the energy, so that none is missed or invented.
//! Equations (N1) and (N2), docs/theory/17-levels.md.

use nalgebra::{Matrix3, Vector3};
use quasirigid::averaging::LevelEvolution;
use quasirigid::dynamics::{all_steady_spins, steady_spins};
use quasirigid::reduction::reduce;
use quasirigid_math::sphere::StationaryKind;
use quasirigid_math::vec3::{cross, norm};

use super::bodies::{SPIN, near_sphere, nearly_equal, with_tensor};

/// Body of moments 2, 2, 1 kg m²: the mass off the axis breaks the symmetry, and leaves four steady spins of the equator. Azimuths found by
/// an independent search for the zeros of `K × Ω(K)`.
#[test]
fn a_mass_off_the_axis_leaves_four_steady_spins_of_the_equator() {
    let body = with_tensor(Matrix3::from_diagonal(&Vector3::new(2.0, 2.0, 1.0))).body().unwrap();
    let reduced = reduce(&body, 3).unwrap();
    let found = all_steady_spins(&reduced, norm(reduced.angular_momentum([0.5, 0.3, 0.4])));
    assert!(found.complete && !found.families, "{found:?}");
    assert_eq!(found.isolated.len(), 6);
    let equator = found
        .isolated
        .iter()
        .filter(|spin| spin.angular_momentum[2].abs() < 0.1 * norm(spin.angular_momentum));
    let mut azimuths: Vec<f64> = equator
        .map(|spin| spin.angular_momentum[1].atan2(spin.angular_momentum[0]).to_degrees().rem_euclid(360.0))
        .collect();
    azimuths.sort_by(f64::total_cmp);
    for (azimuth, expected) in azimuths.iter().zip([18.43, 108.43, 198.43, 288.43]) {
        assert!((azimuth - expected).abs() < 0.01, "{azimuths:?}"); // two decimals given
    }
    assert_eq!(azimuths.len(), 4);
    assert!(steady_spins(&reduced, 1.0)[1].is_none(), "no principal axis of equal moments is one");
}

/// Zeros of the equations, extrema less saddles two, growth only where the energy is greatest or a saddle; and the critical points
/// of the energy alone are the same but for terms beyond the order.
#[test]
fn every_steady_spin_is_one_of_the_equations_and_of_the_energy() {
    for difference in [1e-5, 3e-4, 1e-2] {
        let body = nearly_equal(difference, [0.4, -1.3, 0.8]).body().unwrap();
        let reduced = reduce(&body, 5).unwrap();
        let G = norm(reduced.angular_momentum(SPIN));
        let found = all_steady_spins(&reduced, G);
        assert!(found.complete, "{found:?}");
        let levels = LevelEvolution::new(&reduced, G).unwrap();
        let of_energy: Vec<_> = levels.steady().collect();
        assert_eq!(of_energy.len(), found.isolated.len());
        for spin in &found.isolated {
            let torque = norm(cross(spin.angular_momentum, spin.spin.omega));
            assert!(torque < 1e-13 * G * norm(spin.spin.omega), "{torque}");
            assert_eq!(spin.spin.growth > 0.0, spin.kind != StationaryKind::Minimum, "{spin:?}");
            let apart = |K: [f64; 3]| norm([0, 1, 2].map(|i| K[i] - spin.angular_momentum[i])) / G;
            let (K, kind) = of_energy.iter().min_by(|a, b| apart(a.0).total_cmp(&apart(b.0))).unwrap();
            assert_eq!(*kind, spin.kind);
            assert!(apart(*K) < 2e-3, "{}", apart(*K));
        }
    }
}

/// Where moments are distinct the spins near the axes are all there are.
#[test]
fn distinct_moments_have_the_six_spins_near_their_axes() {
    let body = with_tensor(Matrix3::from_diagonal(&Vector3::new(2.0, 3.0, 4.0))).body().unwrap();
    let reduced = reduce(&body, 3).unwrap();
    let G = norm(reduced.angular_momentum(SPIN));
    let found = all_steady_spins(&reduced, G);
    assert_eq!((found.isolated.len(), found.complete, found.families), (6, true, false));
    for known in steady_spins(&reduced, G).map(Option::unwrap) {
        let same = |spin: &quasirigid::dynamics::IsolatedSpin| {
            norm([0, 1, 2].map(|i| spin.spin.omega[i] - known.omega[i])) < 1e-12 * norm(known.omega)
        };
        let twin = found.isolated.iter().find(|spin| same(spin)).expect("the same spin");
        assert!((twin.spin.growth / known.growth - 1.0).abs() < 1e-6, "{twin:?} {known:?}");
    }
}

#[test]
fn near_sphere_turns_about_none_of_its_principal_axes() {
    let reduced = reduce(&near_sphere().body().unwrap(), 5).unwrap();
    let found = all_steady_spins(&reduced, norm(reduced.angular_momentum(SPIN)));
    let off = |spin: &quasirigid::dynamics::IsolatedSpin| {
        let K = spin.angular_momentum.map(|K| K.abs() / norm(spin.angular_momentum));
        K.iter().copied().fold(0.0, f64::max)
    };
    assert!(found.complete);
    assert!(found.isolated.iter().all(|spin| off(spin) < 0.95), "more than 18° from every axis");
}
