//! Dashpots, friction and viscosity take energy and never give it.

use quasirigid::model::{FlexibleBody, ReducedBody};

use super::DIRECTIONS;
use crate::random::Random;

/// Rounding of the sums, relative to the sum of their sizes.
const SUM_ROUNDING: f64 = 1e-10;
/// Rates that are tried.
const TRIES: usize = 8;

/// `q̇ᵀ B q̇ ≥ 0` for rates of every size.
pub fn of_body(body: &FlexibleBody) {
    let size = body.coordinates().len();
    let diagonal = body.damping().diagonal();
    let mut random = Random::new(size as u64);
    for _ in 0..TRIES {
        // in units in which the diagonal is one, so that no coordinate is lost beside another
        let scale = |B: f64| if B > 0.0 { B.sqrt().recip() } else { 1.0 };
        let rate: Vec<f64> =
            diagonal.iter().map(|B| scale(*B) * (random.below(2001) as f64 / 1000.0 - 1.0)).collect();
        let (mut power, mut sizes) = (0.0, 0.0);
        for (row, column, B) in body.damping().iter() {
            let term = rate[row] * B * rate[column];
            power += term;
            sizes += term.abs();
        }
        assert!(
            power >= -SUM_ROUNDING * sizes || !sizes.is_finite(),
            "the damping matrix gives {power} of {sizes} W"
        );
    }
}

/// The power of the reduced equations and of each dissipator.
pub fn of_reduced(body: &ReducedBody) {
    for omega in DIRECTIONS {
        let parts: Vec<f64> =
            (0..=body.power.degree()).map(|degree| body.power.part(degree).value(omega)[0]).collect();
        let sizes: f64 = parts.iter().map(|part| part.abs()).sum();
        let power = body.dissipated_power(omega);
        assert!(power.is_finite(), "the power at {omega:?} rad/s is {power} W");
        assert!(power >= -SUM_ROUNDING * sizes, "the power at {omega:?} rad/s is {power} W of {sizes} W");
    }
}
