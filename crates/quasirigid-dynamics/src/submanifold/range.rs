//! Range of validity of reduced equations about a spin: the amplitude up to which what they leave of the full equations stays below a
//! share of the motion and of the dissipation.
//! The full equations are evaluated without truncation at points of the spin manifold, so that the range needs no integration. (W7), (W11)

use std::f64::consts::TAU;

use crate::math::submanifold::Residual;
use crate::math::vec3::norm;
use crate::model::{ExpandedMotion, FlexibleBody};

use super::spin_manifold::SpinManifold;

/// Defect of the reduced equations at an amplitude: shares of the full equations that they leave. (W11)
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Defect {
    /// Largest acceleration left, over the largest acceleration of the motion.
    pub motion: f64,
    /// Mean power left, over the mean power of all dissipators: the relative error of the decay.
    pub power: f64,
}

/// Range of amplitudes within which reduced equations hold. (W11)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AmplitudeRange {
    /// Amplitude (rad) up to which both defects stay below the share asked for.
    pub amplitude: f64,
    /// Greatest nutation angle at that amplitude (rad).
    pub nutation: f64,
    /// Share asked for.
    pub share: f64,
    /// True if the range was not reached within [`MAX_AMPLITUDE`].
    pub beyond: bool,
}

/// Phases at which a defect is evaluated.
const PHASES: usize = 24;
/// Largest amplitude examined (rad).
pub const MAX_AMPLITUDE: f64 = 1.6;
/// Smallest amplitude examined, and the ratio of one to the next.
const SMALLEST_AMPLITUDE: f64 = 1e-4;
const STEP: f64 = 1.25;
/// Smallest motion, relative to the steady spin, in whose terms a defect is told: a smaller one is rounding.
const LEAST_MOTION: f64 = 1e-9;
/// Rounding of the power left at a point, over the power `E|ω|` of the loads of the steady spin.
const ROUNDED: f64 = 8.0 * f64::EPSILON;
/// Halvings that locate the edge of the range.
const HALVINGS: usize = 12;

impl Defect {
    /// Larger of both defects; infinite where one is no number.
    #[must_use]
    pub fn largest(&self) -> f64 {
        let largest = self.motion.max(self.power);
        if self.motion.is_nan() || self.power.is_nan() { f64::INFINITY } else { largest }
    }
}

impl SpinManifold<'_> {
    /// Defect at an amplitude of the nutation (rad), the other masters at rest. (W11)
    #[must_use]
    pub fn defect(&self, amplitude: f64) -> Defect {
        let rest = vec![[0.0; 2]; self.manifold.free() - 1];
        let point = |phase: f64| {
            let first = [amplitude * phase.cos(), amplitude * phase.sin()];
            std::iter::once(first).chain(rest.iter().copied()).collect()
        };
        self.defect_over((0..PHASES).map(|i| point(TAU * i as f64 / PHASES as f64)))
    }

    /// Defect over a turn of the phases through coordinates. (W11)
    #[must_use]
    pub fn defect_around(&self, z: &[[f64; 2]]) -> Defect {
        let leads = self.manifold.masters.iter().enumerate().filter(|(k, master)| master.partner >= *k);
        let weights: Vec<f64> =
            leads.map(|(_, master)| master.weight.iter().map(|w| f64::from(*w)).sum()).collect();
        let point = |i: usize| {
            let turn = |([x, y], weight): (&[f64; 2], &f64)| {
                let (sine, cosine) = (weight * TAU * i as f64 / PHASES as f64).sin_cos();
                [x * cosine - y * sine, x * sine + y * cosine]
            };
            z.iter().zip(&weights).map(turn).collect()
        };
        self.defect_over((0..PHASES).map(point))
    }

    /// Defect over points of a motion.
    fn defect_over(&self, points: impl Iterator<Item = Vec<[f64; 2]>>) -> Defect {
        let system = ExpandedMotion::of(self.body);
        let (mut left, mut motion, mut excess, mut power) = (0.0_f64, 0.0_f64, 0.0, 0.0);
        for z in points {
            let residual = self.manifold.residual(&system, &z);
            let Some(sizes) = self.sizes(&residual) else {
                return Defect { motion: f64::INFINITY, power: f64::INFINITY };
            };
            left = left.max(sizes[0]);
            motion = motion.max(sizes[1]);
            excess += excess_power(self.body, &residual);
            power += dissipation(self.body, &residual);
        }
        let share = |part: f64, whole: f64| if part == 0.0 { 0.0 } else { part / whole };
        let rounding = ROUNDED * PHASES as f64 * self.steady_energy().abs() * norm(self.spin.omega);
        let told = (f64::abs(excess) - rounding).max(0.0);
        let least = LEAST_MOTION * self.rate() * norm(self.spin.omega) / self.spin.linear.scales[0];
        Defect { motion: left / motion.max(least), power: share(told, power) }
    }

    /// Amplitude up to which the defects stay below a share. (W11)
    #[must_use]
    pub fn range(&self, share: f64) -> AmplitudeRange {
        let holds = |amplitude: f64| self.defect(amplitude).largest() <= share;
        let (mut inside, mut outside) = (0.0, SMALLEST_AMPLITUDE);
        while outside <= MAX_AMPLITUDE && holds(outside) {
            inside = outside;
            outside *= STEP;
        }
        let beyond = outside > MAX_AMPLITUDE;
        if !beyond {
            for _ in 0..HALVINGS {
                let middle = 0.5 * (inside + outside);
                if holds(middle) { inside = middle } else { outside = middle }
            }
        }
        AmplitudeRange { amplitude: inside, nutation: self.nutation(inside), share, beyond }
    }

    /// Greatest tilt of the angular momentum from the axis of the steady spin (rad) at an amplitude of the nutation (rad), the other masters
    /// at rest.
    #[must_use]
    pub fn nutation(&self, amplitude: f64) -> f64 {
        let tilt = |i: usize| {
            let phase = TAU * i as f64 / PHASES as f64;
            let mut z = vec![[0.0; 2]; self.manifold.free()];
            z[0] = [amplitude * phase.cos(), amplitude * phase.sin()];
            self.tilt(&z)
        };
        (0..PHASES).map(tilt).fold(0.0, f64::max)
    }

    /// Sizes of the acceleration left and of the acceleration of the motion; components by their scales.
    fn sizes(&self, residual: &Residual) -> Option<[f64; 2]> {
        let linear = &self.spin.linear;
        let left = linear.accelerations(&residual.defect)?;
        let size = |x: &[f64]| x.iter().zip(&linear.scales).map(|(x, scale)| x / scale).fold(0.0, f64::hypot);
        Some([size(&left), size(&residual.rate)])
    }
}

/// Power that the motion on the spin manifold gains beyond the loss in the dissipators (W): `ω·δ_K + q̇·δ_p + (∂H/∂q)·δ_q`.
fn excess_power(body: &FlexibleBody, residual: &Residual) -> f64 {
    let Residual { state, defect, forces, .. } = residual;
    let n = body.coordinates().len();
    let rates = &state[3..3 + n];
    let kinetic: f64 = state[..3 + n].iter().zip(defect).map(|(rate, defect)| rate * defect).sum();
    let damped = body.damping().times(rates);
    let elastic = defect[3 + n..].iter().enumerate().map(|(j, defect)| -(forces[3 + j] + damped[j]) * defect);
    kinetic + elastic.sum::<f64>()
}

/// Power of all dissipators (W).
fn dissipation(body: &FlexibleBody, residual: &Residual) -> f64 {
    let rates = &residual.state[3..3 + body.coordinates().len()];
    body.damping().quadratic(rates)
}
