//! Steady spin in the full equations: the relative equilibrium at a given angular momentum, curved paths included.

use crate::math::eigen::Dense;
use crate::math::lu::Lu;
use crate::math::submanifold::LinearPart;
use crate::math::vec3::{norm, scale};
use crate::model::{ExpandedMotion, FlexibleBody};
use crate::modes::{RelativeEquilibrium, SpinMagnitude};

use super::error::SubmanifoldError;

/// Steady spin of the full equations at an angular momentum. (M1), (W9)
#[derive(Clone, Debug)]
pub struct SteadySpin {
    /// Angular velocity (rad/s), body axes.
    pub omega: [f64; 3],
    /// Displacements of the internal coordinates; zero of cyclic ones.
    pub q: Vec<f64>,
    /// Angular momentum (N·m·s), that of wheels included, body axes.
    pub angular_momentum: [f64; 3],
    /// Linear part of the full equations there.
    pub(super) linear: LinearPart,
}

/// Limit of Newton steps, and the residual relative to `|K||ω|` at which they end; one accepted where rounding ends the progress.
const NEWTON_STEPS: usize = 30;
const CONVERGED_RESIDUAL: f64 = 1e-15;
const ACCEPTED_RESIDUAL: f64 = 1e-11;

impl SteadySpin {
    /// Steady spin that continues one about an axis of the frozen body, at an angular momentum (N·m·s).
    ///
    /// # Errors
    /// [`SubmanifoldError`] if there is none.
    pub fn near(
        body: &FlexibleBody,
        axis: [f64; 3],
        angular_momentum: f64,
    ) -> Result<Self, SubmanifoldError> {
        let near = RelativeEquilibrium::near(body, axis, SpinMagnitude::AngularMomentum(angular_momentum))?;
        Self::polished(body, &near, angular_momentum)
    }

    /// Steady spin of the full equations next to one of the linear balance.
    pub(super) fn polished(
        body: &FlexibleBody,
        near: &RelativeEquilibrium,
        angular_momentum: f64,
    ) -> Result<Self, SubmanifoldError> {
        let system = ExpandedMotion::of(body);
        let (n, elastic) = (body.coordinates().len(), body.elastic());
        let mut state = near.omega.to_vec();
        state.resize(3 + n, 0.0);
        state.extend(&near.q[..elastic]);
        let rate = norm(near.omega);
        let lost = || SubmanifoldError::NoBalance { axis: scale(rate.recip(), near.omega) };
        let mut best = f64::INFINITY;
        for _ in 0..NEWTON_STEPS {
            let linear = LinearPart::at(&system, &state);
            let newton = Newton { linear: &linear, n, elastic, angular_momentum, rate };
            let residual = newton.residual();
            let size = newton.size(&residual);
            if !size.is_finite() {
                return Err(lost());
            }
            if size <= CONVERGED_RESIDUAL || (size >= 0.5 * best && best <= ACCEPTED_RESIDUAL) {
                return Ok(Self::of(linear, n, elastic));
            }
            best = best.min(size);
            let step = newton.step(&residual).ok_or_else(lost)?;
            (0..3).for_each(|axis| state[axis] += step[axis]);
            (0..elastic).for_each(|j| state[3 + n + j] += step[3 + j]);
        }
        Err(lost())
    }

    fn of(linear: LinearPart, n: usize, elastic: usize) -> Self {
        let triple = |list: &[f64]| [list[0], list[1], list[2]];
        let mut q = linear.state[3 + n..3 + n + elastic].to_vec();
        q.resize(n, 0.0);
        Self { omega: triple(&linear.state), angular_momentum: triple(&linear.momenta), q, linear }
    }
}

/// Newton step for the angular velocity and the displacements of a steady spin.
///
/// The moment `K × ω` has no component along `K`; the condition on `|K|` takes its place.
struct Newton<'a> {
    linear: &'a LinearPart,
    n: usize,
    elastic: usize,
    angular_momentum: f64,
    rate: f64,
}

impl Newton<'_> {
    fn momentum(&self) -> [f64; 3] {
        std::array::from_fn(|axis| self.linear.momenta[axis])
    }

    /// Moment with the excess of `|K|` along `K`, then the forces on the elastic coordinates.
    fn residual(&self) -> Vec<f64> {
        let K = self.momentum();
        let G = self.angular_momentum;
        let excess = 0.5 * self.rate * ((norm(K) / G).powi(2) - 1.0);
        let moment = (0..3).map(|axis| self.linear.forces[axis] + excess * K[axis]);
        let forces = &self.linear.forces[3..3 + self.elastic];
        moment.chain(forces.iter().copied()).collect()
    }

    /// Residual relative to `|K||ω|`, forces by the displacements that they cause.
    fn size(&self, residual: &[f64]) -> f64 {
        let whole = self.angular_momentum * self.rate;
        let scales = &self.linear.scales[3 + self.n..];
        let forces = residual[3..].iter().zip(scales).map(|(force, scale)| force * scale / whole.sqrt());
        let moments = residual[..3].iter().map(|moment| moment / whole);
        moments.chain(forces).fold(0.0, |sum: f64, part| sum.hypot(part))
    }

    fn step(&self, residual: &[f64]) -> Option<Vec<f64>> {
        let size = 3 + self.elastic;
        let column = |k: usize| if k < 3 { k } else { self.n + k };
        let K = self.momentum();
        let gradient = self.linear.conserved.as_ref()?;
        let along = self.rate / (self.angular_momentum * self.angular_momentum);
        let mut matrix = Dense::zero(size);
        for k in 0..size {
            for row in 0..size {
                matrix.add(row, k, self.linear.slope.at(row, column(k)));
            }
            (0..3).for_each(|axis| matrix.add(axis, k, along * K[axis] * gradient[column(k)]));
        }
        let step = Lu::new(&matrix)?.solve(residual, 1)?;
        Some(step.into_iter().map(|entry| -entry).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problems::ring_of_points;

    /// A balance at another angular momentum is a start as good as any: the spin that is found has the one that is asked for.
    #[test]
    fn a_spin_is_found_from_a_balance_at_another_angular_momentum() {
        let body = ring_of_points(2).body().unwrap();
        let axis = crate::model::Principal::compute(body.invariants().J).axes[2];
        let G = 20.0;
        let exact = SteadySpin::near(&body, axis, G).unwrap();
        for share in [0.9, 1.2] {
            let off =
                RelativeEquilibrium::near(&body, axis, SpinMagnitude::AngularMomentum(share * G)).unwrap();
            let found = SteadySpin::polished(&body, &off, G).unwrap();
            assert!((norm(found.angular_momentum) / G - 1.0).abs() < 1e-13, "{:?}", found.angular_momentum);
            let gap = (0..3).map(|i| (found.omega[i] - exact.omega[i]).abs()).fold(0.0, f64::max);
            assert!(gap < 1e-12 * norm(exact.omega), "{share}: {gap:e}");
        }
    }
}
