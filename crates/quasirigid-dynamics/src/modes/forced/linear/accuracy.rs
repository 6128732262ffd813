//! Error of a linear model by the states that stand for memories, against the exact responses of materials and liquids.
//! Equation (M21), docs/theory/15-modes.md.

use crate::math::eigen::{Dense, NoConvergence, modes};
use crate::math::vec3::norm;
use crate::model::{FlexibleBody, RationalModulus};
use crate::modes::cantilever::held_mass;
use crate::modes::forced::frame_rotation::FrameRotation;
use crate::modes::forced::pencil::Pencil;
use crate::modes::forced::state::SteadyState;
use crate::modes::forced::system::System;

/// Error of the angular velocities that torques on the carrier cause. (M21)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearAccuracy {
    /// Frequencies (rad/s) between which it is told.
    pub band: [f64; 2],
    /// Largest relative error of the response; infinite where a response is not known.
    pub error: f64,
    /// Frequency (rad/s) of that error.
    pub frequency: f64,
}

/// Frequencies at which responses are compared, at least and at most, and the work that they may take (cubes of the size).
const LEAST_SAMPLES: f64 = 24.0;
const MOST_SAMPLES: f64 = 240.0;
const WORK: f64 = 4e9;
/// Ratio of the slowest rate of a body to the beginning of its band, and of the end to the fastest: the same, as the modulus of a material
/// of constant loss is met best in the middle.
const BEYOND: f64 = 10.0;

impl LinearAccuracy {
    /// Compares responses over a band of frequencies (rad/s).
    pub(super) fn compute(
        body: &FlexibleBody,
        state: &SteadyState,
        system: &System,
        (moduli, followed): (&[RationalModulus], bool),
        band: [f64; 2],
    ) -> Self {
        let attitude = state.turning != FrameRotation::Own;
        let pencil = || Pencil::new(body, system, attitude, followed);
        let (exact, model) = (pencil(), pencil().with_states(moduli));
        let size = (3 + body.coordinates().len()) as f64;
        let samples = (WORK / size.powi(3)).clamp(LEAST_SAMPLES, MOST_SAMPLES).floor();
        let [low, high] = band;
        let error = |frequency: f64| {
            let (exact, model) = (exact.response(frequency)?, model.response(frequency)?);
            Some((model - exact).norm() / exact.norm()).filter(|error| error.is_finite())
        };
        let mut worst = Self { band, error: 0.0, frequency: low };
        for k in 0..samples as usize {
            let frequency = low * (high / low).powf(k as f64 / (samples - 1.0));
            let error = error(frequency).unwrap_or(f64::INFINITY);
            if error > worst.error {
                worst = Self { band, error, frequency };
            }
        }
        worst
    }
}

/// Band of frequencies (rad/s) of a body: around its vibrations at rest, its spin and the diffusion in its liquids.
///
/// # Errors
/// [`NoConvergence`] if the vibrations are not found.
pub(super) fn own_rates(body: &FlexibleBody, state: &SteadyState) -> Result<[f64; 2], NoConvergence> {
    let spin = norm(state.omega);
    let mut rates: Vec<f64> = if spin > 0.0 { vec![spin] } else { Vec::new() };
    if body.elastic() > 0 {
        let stiffness = Dense::of(&body.stiffness().block(0..body.elastic()));
        let vibrations = modes(&held_mass(body), &stiffness)?.frequencies;
        rates.extend(vibrations.into_iter().filter(|rate| *rate > 0.0 && rate.is_finite()));
    }
    rates.extend(body.memories().iter().map(|liquid| liquid.time.recip()));
    let slowest = rates.iter().copied().fold(f64::INFINITY, f64::min);
    let fastest = rates.iter().copied().fold(0.0, f64::max);
    Ok([slowest / BEYOND, BEYOND * fastest])
}
