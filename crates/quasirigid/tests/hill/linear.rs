//! The harmonics against the integrated linear equations.

use proptest::prelude::*;
use quasirigid::averaging::{HillResponse, MeanPower};
use quasirigid::elements::Assembly;
use quasirigid::model::{FlexibleBody, Mode};

use super::bodies::motion;
use super::oracle::{Linear, periodic};
use crate::support::rotors::{ball, flywheel};
use crate::support::{assemblies, cases};

/// Power, states and multipliers of a body along a polhode, by both methods.
fn compare(body: &FlexibleBody, spin: f64, mode: Mode, xi: f64) -> Result<(), TestCaseError> {
    let motion = motion(body, spin, mode, xi);
    let hill = HillResponse::compute(body).unwrap();
    let linear = Linear::new(body, [1e-3, 1e-2]);
    let fastest = linear.fastest();
    let count = 60 * (1 + (motion.polhode_period() * fastest / 60.0) as usize);
    let truth = periodic(&linear, &motion, count);
    let response = hill.periodic(&motion).unwrap();
    prop_assert!(response.residual() < 1e-10, "{:e}", response.residual());
    prop_assert!(response.truncation() < 1e-9, "{:e}", response.truncation());
    let power = hill.mean_power(&motion);
    prop_assert!((power / truth.power - 1.0).abs() < 1e-6, "power {power:e}, truth {:e}", truth.power);
    let elastic = body.elastic();
    let size = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    for i in [0, count / 7, count / 2 - 3, 5 * count / 6] {
        let t = motion.polhode_period() * i as f64 / count as f64;
        let (q, rate) = hill.state(&motion, t).unwrap();
        let gap: Vec<f64> = (0..elastic).map(|j| q[j] - truth.states[i][j]).collect();
        prop_assert!(size(&gap) < 1e-6 * size(&q[..elastic]).max(1e-12), "{q:?} {}", truth.states[i]);
        let gap: Vec<f64> = rate.iter().zip(truth.rates[i].iter()).map(|(a, b)| a - b).collect();
        prop_assert!(size(&gap) < 1e-6 * size(&rate), "{rate:?} {}", truth.rates[i]);
    }
    let floquet = hill.floquet(&motion).unwrap();
    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
    let expected = largest(&mut truth.monodromy.complex_eigenvalues().iter().map(|value| value.norm()));
    let found = largest(&mut floquet.multipliers.iter().map(|[re, im]| re.hypot(*im)));
    prop_assert!((found - expected).abs() < 1e-6 * expected.max(1.0), "multipliers {found} {expected}");
    Ok(())
}

fn lowest(body: &FlexibleBody) -> f64 {
    quasirigid::averaging::Response::compute(body).unwrap().frequencies().next().unwrap().0
}

proptest! {
    #![proptest_config(cases(4))]

    /// Points on lines, in planes and in space, hinges on curved paths, free or fixed at a point.
    #[test]
    fn harmonics_are_the_periodic_motion(
        assembly in assemblies(), share in 0.05..0.6, xi in -1.0..5.0, long in any::<bool>()
    ) {
        let body = assembly.body().unwrap();
        let mode = if long { Mode::LongAxis } else { Mode::ShortAxis };
        compare(&body, share * lowest(&body), mode, xi)?;
    }

    /// Harmonics and integration agree with a flywheel and a ball on friction, whose mean rates count.
    #[test]
    fn rotors_turn_along(assembly in assemblies(), share in 0.05..0.6, xi in -1.0..5.0, long in any::<bool>()) {
        let plain = assembly.body().unwrap();
        let inertia = quasirigid::model::Principal::compute(plain.invariants().J).moments[0];
        let rotors = vec![flywheel([0.3, -0.5, 0.8], 0.1 * inertia, 0.3 * inertia), ball(0.05 * inertia, 0.4 * inertia)];
        let body = Assembly { rotors, ..assembly }.body().unwrap();
        let mode = if long { Mode::LongAxis } else { Mode::ShortAxis };
        compare(&body, share * lowest(&plain), mode, xi)?;
    }
}
