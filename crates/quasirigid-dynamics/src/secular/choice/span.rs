use std::f64::consts::TAU;

use super::reference_spins::ReferenceSpins;
use crate::averaging::{FreeRotation, MeanPower, RotationState, Until};
use crate::dynamics::FullState;
use crate::math::vec3::norm;

/// Effective moments of inertia (kg·m²) without a power: enough to place a rotation state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MomentsOnly(pub [f64; 3]);

impl MeanPower for MomentsOnly {
    fn moments(&self) -> [f64; 3] {
        self.0
    }

    fn mean_power(&self, _: &FreeRotation) -> f64 {
        0.0
    }
}

/// Span of an evolution: its start and its end.
#[derive(Clone, Debug)]
pub struct Span {
    /// State of the full system at the start.
    pub start: FullState,
    /// Whether the start is a rotation state that was asked for, whose vibrations have died out.
    pub placed: bool,
    /// Rotation states at the start and at the end.
    pub ends: [RotationState; 2],
    /// Rotation state of the start when its vibrations have died out.
    pub settled: Option<RotationState>,
    /// Energies (J) of the full system at the start and at the end.
    pub energies: [f64; 2],
    /// Longest time (s).
    pub duration: Option<f64>,
    /// End on level curves; none where it has no meaning there.
    pub level_end: Option<Until>,
    /// Rows of a history on level curves.
    pub samples: usize,
}

/// Rows of a history on level curves, unless another number is given.
const SAMPLES: usize = 201;

impl Span {
    /// Span from a state of the full system, which settles on a rotation state, between two rotation states.
    #[must_use]
    pub fn new(
        spins: &ReferenceSpins,
        (start, settled): (FullState, Option<RotationState>),
        ends: [RotationState; 2],
    ) -> Self {
        Self {
            placed: false,
            ends,
            settled,
            energies: [start.energy(spins.body), spins.motion(ends[1]).energy()],
            start,
            duration: None,
            level_end: None,
            samples: SAMPLES,
        }
    }

    /// Revolutions in the longest time, at the spin of the start; none without one.
    #[must_use]
    pub fn most_revolutions(&self) -> Option<f64> {
        self.duration.map(|duration| duration * norm(self.start.omega) / TAU)
    }

    /// The wider wobble (rad) of two rotation states.
    pub(super) fn widest(spins: &ReferenceSpins, ends: [RotationState; 2]) -> f64 {
        let wobble = ends.map(|state| spins.motion(state).nutation()[1]);
        wobble[0].max(wobble[1])
    }
}
