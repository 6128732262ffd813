//! Order of the reduced equations about a spin in the amplitude of the nutation, measured against the full system. (W3)

use std::ops::ControlFlow;

use quasirigid::dynamics::{Forced, Options, Sample, propagate_full};
use quasirigid::elements::Assembly;
use quasirigid::reduction::frequencies;
use quasirigid::submanifold::{
    ManifoldStart, Masters, SpinManifold, SpinManifoldPlan, Style, propagate_on_manifold,
};
use quasirigid::verification::{
    DegreeRow, Difference, SpinVerificationPlan, VerificationError, verify_about_spin,
};
use quasirigid_math::rotation::angle_between;
use quasirigid_math::vec3::{add, norm, scale};

use super::{bodies, body_of, derived, plan};

/// Largest differences in angular velocity, relative to the spin, and in attitude, between the reduced and the full motion over a time, for
/// an amplitude.
fn difference(manifold: &SpinManifold, amplitude: f64, duration: f64) -> [f64; 2] {
    let mut z = vec![[0.0; 2]; manifold.expansion().free()];
    let rest = 0.3 * amplitude;
    z.fill([rest, 0.2 * rest]);
    z[0] = [amplitude * 0.4_f64.cos(), amplitude * 0.4_f64.sin()];
    for (z, lead) in z.iter_mut().zip(manifold.masters.iter()) {
        if lead.frequency == 0.0 {
            z[1] = 0.0;
        }
    }
    let attitude = quasirigid_math::rotation::turned([1.0, 0.0, 0.0, 0.0], [0.3, -0.2, 0.4]);
    let state = manifold.full_state(&z, attitude);
    let start = ManifoldStart { z, attitude, place: [0.0; 3], velocity: [0.0; 3], left_out: 0.0 };
    let options = Options { tolerance: 1e-13, ..Options::default() };
    let times: Vec<f64> = (0..=8).map(|i| duration * f64::from(i) / 8.0).collect();
    let (mut full, mut reduced): (Vec<Sample>, Vec<Sample>) = Default::default();
    propagate_full(Forced::not(manifold.body), &state, &times, &options, &mut full).unwrap();
    propagate_on_manifold(manifold, &start, &times, &options, &mut reduced).unwrap();
    let gaps = full.iter().zip(&reduced).map(|(full, reduced)| {
        let gap = norm(add(full.omega, scale(-1.0, reduced.omega))) / manifold.rate();
        [gap, angle_between(full.attitude, reduced.attitude)]
    });
    gaps.fold([0.0; 2], |largest, gap| [gap[0].max(largest[0]), gap[1].max(largest[1])])
}

/// Slopes in the amplitude of both differences over two halvings, for degrees 1 to 4.
fn slopes(assembly: &Assembly, spin: f64, masters: &Masters, style: Style) -> Vec<[f64; 2]> {
    let body = body_of(assembly);
    let slope = |degree| {
        let plan = SpinManifoldPlan { masters: masters.clone(), style, ..plan(&body, spin, degree) };
        let manifold = derived(&body, &plan);
        let duration = 6.0 / manifold.masters[0].frequency;
        let gaps = [0.08, 0.04, 0.02].map(|amplitude| difference(&manifold, amplitude, duration));
        println!("spin {spin} degree {degree}: {gaps:?}");
        std::array::from_fn(|i| (gaps[1][i] / gaps[2][i]).log2())
    };
    (1..=4).map(slope).collect()
}

/// Shortfall of a measured slope.
const SHORT: f64 = 0.35;

fn falls(slopes: &[[f64; 2]]) {
    for (i, [omega, attitude]) in slopes.iter().enumerate() {
        let expected = (i + 2) as f64;
        assert!(*omega > expected - SHORT && *attitude > expected - SHORT, "degree {}: {slopes:?}", i + 1);
    }
}

/// Ratios of slow, resonant and fast spins to the lowest frequency.
const ANY: [f64; 3] = [0.1, 1.0, 10.0];
/// Angular momentum (N·m·s) of a wheel.
const WHEEL: f64 = 5.0;

/// Lowest frequency (rad/s) of a body with its attitude fixed; one radian a second of a body without elastic parts.
fn lowest(assembly: &Assembly) -> f64 {
    let vibrations = frequencies(&body_of(assembly)).unwrap();
    vibrations.first().copied().unwrap_or(1.0)
}

/// Body at some ratios of its spin to its lowest frequency from an amplitude (rad) on, measured as `verify` does; wheels turn as fast as
/// the body. (W14)
fn verified(amplitude: f64, ratios: &[f64], at: &dyn Fn(f64) -> Assembly) {
    for &ratio in ratios {
        let assembly = at(ratio);
        let body = body_of(&assembly);
        let plan = SpinVerificationPlan {
            about: plan(&body, ratio * lowest(&assembly), 1),
            degrees: vec![1, 2, 3, 4],
            amplitude,
            halvings: 2,
            periods: 1.0,
            samples: 8,
        };
        let mut shares = Vec::new();
        let watch = &mut |share: f64| {
            shares.push(share);
            ControlFlow::Continue(())
        };
        let found = verify_about_spin(&body, &plan, watch).unwrap();
        assert!(shares.iter().all(|share| (0.0..1.0).contains(share)), "{shares:?}");
        for row in &found.rows {
            let gaps: Vec<f64> = row.differences.iter().map(|difference| difference.omega).collect();
            println!("ratio {ratio}, degree {}: {:?} {gaps:?}", row.degree, row.order);
        }
        assert!(found.reached(), "ratio {ratio}");
    }
}

/// A row whose differences fall with an order less than its own has not reached it, nor has one whose differences are no numbers.
#[test]
fn differences_that_do_not_fall_are_told() {
    let difference = |omega: f64| Difference { omega, attitude: 0.0, dissipated: 0.0, dissipation: 1.0 };
    let row =
        |order: Option<f64>, omega: f64| DegreeRow { degree: 3, differences: vec![difference(omega)], order };
    assert!(row(Some(4.0), 1e-6).reached() && row(None, 1e-14).reached());
    assert!(!row(Some(3.0), 1e-6).reached() && !row(None, f64::NAN).reached());
}

#[test]
fn a_verification_at_rest_or_without_an_end_is_refused() {
    let body = body_of(&bodies::two_masses());
    let good = SpinVerificationPlan {
        about: plan(&body, 1.0, 1),
        degrees: vec![1],
        amplitude: 0.08,
        halvings: 1,
        periods: 0.1,
        samples: 2,
    };
    let refused = |plan: SpinVerificationPlan| {
        let found = verify_about_spin(&body, &plan, &mut |_| ControlFlow::Continue(()));
        matches!(found, Err(VerificationError::Plan { .. } | VerificationError::Amplitude { .. }))
    };
    assert!(!refused(good.clone()));
    for amplitude in [0.0, -0.08, f64::NAN, f64::INFINITY] {
        assert!(refused(SpinVerificationPlan { amplitude, ..good.clone() }), "{amplitude}");
    }
    for periods in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(refused(SpinVerificationPlan { periods, ..good.clone() }), "{periods}");
    }
}

#[test]
fn springs_at_any_spin() {
    verified(0.08, &ANY, &|_| bodies::two_masses());
}

#[test]
fn hinges_at_any_spin() {
    verified(0.08, &ANY, &|_| bodies::hinged());
}

#[test]
fn beams_at_any_spin() {
    verified(0.04, &ANY, &|_| bodies::beam());
}

#[test]
fn rotors_and_a_wheel_at_any_spin() {
    verified(0.08, &ANY, &|ratio| bodies::rotors(WHEEL * ratio));
}

#[test]
fn a_liquid_at_any_spin() {
    verified(0.08, &ANY, &|_| bodies::liquid());
}

#[test]
fn everything_together() {
    verified(0.04, &[1.0], &|ratio| bodies::everything(WHEEL * ratio));
}

#[test]
#[ignore = "a minute; run at night"]
fn everything_together_at_any_spin() {
    verified(0.04, &ANY, &|ratio| bodies::everything(WHEEL * ratio));
}

#[test]
fn in_graph_style() {
    falls(&slopes(&bodies::two_masses(), 5.0, &Masters::Nutation, Style::Graph));
}

#[test]
fn with_a_second_pair() {
    falls(&slopes(&bodies::two_masses(), 2.0, &Masters::With(vec![5.0]), Style::NormalForm));
}

#[test]
fn along_curved_paths_with_the_attitude() {
    falls(&slopes(&bodies::hinged(), 5.0, &Masters::Nutation, Style::NormalForm));
}

#[test]
#[ignore = "half a minute; run at night"]
fn everything_with_the_attitude() {
    falls(&slopes(&bodies::everything(WHEEL), 3.0, &Masters::Nutation, Style::NormalForm));
}
