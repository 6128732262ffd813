//! Mean power and energy along a slow manifold about a spin, as functions of the amplitude of the nutation.

use std::f64::consts::TAU;

use crate::math::bisection::bisected;

use super::spin_manifold::SpinManifold;

/// Means over a turn of the phase at an amplitude of the nutation, the other masters at rest. (W12)
#[derive(Clone, Debug, PartialEq)]
pub struct ManifoldPower {
    /// Mean energy (J), without that of wheels.
    pub energy: f64,
    /// Mean power (W) of each dissipator, in the order of [`FlexibleBody::dissipators`](crate::model::FlexibleBody::dissipators).
    pub budget: Vec<f64>,
    /// Mean power (W) of all dissipators.
    pub power: f64,
}

/// Phases of the means: a periodic function, so that the error falls exponentially.
const PHASES: usize = 32;

impl SpinManifold<'_> {
    /// Mean energy and power at an amplitude of the nutation (rad), from the state without truncation. (W12)
    #[must_use]
    pub fn power_at(&self, amplitude: f64) -> ManifoldPower {
        let mut sum =
            ManifoldPower { energy: 0.0, budget: vec![0.0; self.body.dissipators().len()], power: 0.0 };
        for i in 0..PHASES {
            let phase = TAU * i as f64 / PHASES as f64;
            let mut z = vec![[0.0; 2]; self.manifold.free()];
            z[0] = [amplitude * phase.cos(), amplitude * phase.sin()];
            let state = self.full_state(&z, crate::math::rotation::ALIGNED);
            sum.energy += state.energy(self.body) / PHASES as f64;
            for (sum, dissipator) in sum.budget.iter_mut().zip(self.body.dissipators()) {
                *sum += dissipator.power(&state.rate) / PHASES as f64;
            }
        }
        sum.power = sum.budget.iter().sum();
        sum
    }

    /// Amplitude (rad) up to `widest` at which the mean energy is this one (J); none if it is not met.
    #[must_use]
    pub fn amplitude_at(&self, energy: f64, widest: f64) -> Option<f64> {
        let at = |amplitude: f64| self.power_at(amplitude).energy;
        let (least, most) = (self.steady_energy(), at(widest));
        let within = (energy - least) * (energy - most) <= 0.0;
        within.then(|| bisected([0.0, widest], at, energy, most > least))
    }
}
