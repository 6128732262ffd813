//! Displacements in balance with a steady angular velocity.
//! Equations (M1) and (M10), docs/theory/15-modes.md.

use super::{FlexibleBody, Invariants, SpinCoefficients};
use crate::math::eigen::Dense;
use crate::math::lu::Lu;
use crate::math::sym3::{self, times};
use crate::math::vec3::dot;

/// Displacements in balance with a steady angular velocity, and the derivative of the angular momentum.
#[derive(Clone, Debug)]
pub struct BalancedSpin {
    /// Displacements of all coordinates.
    pub q: Vec<f64>,
    /// Angular momentum without that of wheels (N·m·s), body axes.
    pub angular_momentum: [f64; 3],
    /// Derivative of the angular momentum by the angular velocity (kg·m²), rows.
    pub slope: [[f64; 3]; 3],
}

/// Limit of Newton steps for displacements on curved paths, and the change relative to the displacements that is rounding; one accepted
/// where rounding ends the progress.
const STEPS: usize = 30;
const SETTLED: f64 = 1e-14;
const ACCEPTED: f64 = 1e-9;

impl FlexibleBody {
    /// Displacements in balance with a steady angular velocity, `C q = ½ ωᵀ(∂J/∂q)ω`, cyclic coordinates at zero; none where `C − N` is
    /// singular, or the displacements on curved paths are not found. (M1), (M10)
    #[must_use]
    pub fn balanced(&self, omega: [f64; 3]) -> Option<BalancedSpin> {
        BalancedSpin::of(self, omega)
    }
}

impl BalancedSpin {
    fn of(body: &FlexibleBody, omega: [f64; 3]) -> Option<Self> {
        let elastic = body.elastic();
        let mut q = vec![0.0; body.coordinates().len()];
        let Invariants { J, J1, .. } = body.invariants();
        if elastic == 0 {
            return Some(Self { q, angular_momentum: times(*J, omega), slope: sym3::rows(*J) });
        }
        let factor = softened(body, &body.centrifugal_stiffness(omega))?;
        let load: Vec<f64> = J1[..elastic].iter().map(|J1| 0.5 * dot(omega, times(*J1, omega))).collect();
        q[..elastic].copy_from_slice(&factor.solve(&load, 1)?);
        let (coefficients, factor) = settled(body, omega, &mut q, factor)?;
        let mut slope = sym3::rows(coefficients.inertia);
        let answers = factor.solve(coefficients.slopes[..elastic].as_flattened(), 3)?;
        for (left, answer) in coefficients.slopes.iter().zip(answers.as_chunks::<3>().0) {
            for (row, left) in slope.iter_mut().zip(left) {
                row.iter_mut().zip(answer).for_each(|(entry, right)| *entry += left * right);
            }
        }
        Some(Self { q, angular_momentum: times(coefficients.inertia, omega), slope })
    }
}

/// Coefficients and factors of `C − N` in balance, from displacements in balance on straight paths. (M10)
fn settled(
    body: &FlexibleBody,
    omega: [f64; 3],
    q: &mut [f64],
    straight: Lu,
) -> Option<(SpinCoefficients, Lu)> {
    if body.paths().is_none() {
        return Some((body.about_spin(omega, q), straight));
    }
    let elastic = body.elastic();
    let stiffness = body.stiffness().block(0..elastic);
    let size = |x: &[f64]| stiffness.times(x).iter().zip(x).map(|(force, x)| force * x).sum::<f64>().sqrt();
    let mut best = f64::INFINITY;
    for _ in 0..STEPS {
        let coefficients = body.about_spin_on_paths(omega, q);
        let factor = softened(body, &coefficients.centrifugal)?;
        let held = stiffness.times(&q[..elastic]);
        let excess =
            coefficients.slopes.iter().zip(&held).map(|(slope, held)| 0.5 * dot(omega, *slope) - held);
        let step = factor.solve(&excess.collect::<Vec<f64>>(), 1)?;
        let change = size(&step) / size(&q[..elastic]).max(f64::MIN_POSITIVE);
        if change <= SETTLED || (change >= 0.5 * best && best <= ACCEPTED) {
            return Some((coefficients, factor));
        }
        best = best.min(change);
        q.iter_mut().zip(&step).for_each(|(q, step)| *q += step);
    }
    None
}

/// Factors of `C − N` of the elastic coordinates.
fn softened(body: &FlexibleBody, centrifugal: &Dense) -> Option<Lu> {
    let elastic = body.elastic();
    let mut left = Dense::of(&body.stiffness().block(0..elastic));
    for j in 0..elastic {
        for k in 0..elastic {
            left.add(j, k, -centrifugal.at(j, k));
        }
    }
    Lu::new(&left)
}
