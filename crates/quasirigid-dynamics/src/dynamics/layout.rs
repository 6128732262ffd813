use std::ops::Range;

use crate::model::FlexibleBody;

/// Layout of a full state: slow parts, then energies of the dissipators, then controllers, then coordinates and their momenta.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Layout {
    /// Number of internal coordinates.
    pub n: usize,
    /// Number of dissipators with an energy account of their own, after the slow parts.
    pub accounts: usize,
    /// Length of the block of the controllers, after the accounts.
    pub controls: usize,
}

/// Angular momentum (N·m·s), body axes: about the pole, or about the centre of mass of a free body.
pub(super) const MOMENTUM: usize = 0;
/// Attitude, `R_NB`.
pub(super) const ATTITUDE: usize = 3;
/// Energy taken by the dashpots (J).
pub(super) const DISSIPATED: usize = 7;
/// Work of the external forces (J).
pub(super) const WORK: usize = 8;
/// Angle turned, `∫|ω| dt` (rad).
pub(super) const ANGLE: usize = 9;
/// Impulse of the external moments, `∫M dt` (N·m·s), inertial axes.
pub(super) const IMPULSE: usize = 10;
/// Place (m), inertial axes: of the centre of mass of a free body, of the pole of a constrained one.
pub(super) const PLACE: usize = 13;
/// Velocity of that point (m/s).
pub(super) const VELOCITY: usize = 16;
/// Length of the slow parts, before the energies of the dissipators.
pub(super) const SLOW_LENGTH: usize = 19;

impl Layout {
    /// Layout for a body; a single dissipator needs no account beside the total.
    pub fn of(body: &FlexibleBody) -> Self {
        let dissipators = body.dissipators().len();
        let accounts = if dissipators > 1 { dissipators } else { 0 };
        Self { n: body.coordinates().len(), accounts, controls: 0 }
    }

    /// The layout with a block of controllers of a length.
    pub fn with_controls(self, controls: usize) -> Self {
        Self { controls, ..self }
    }

    /// Length before the coordinates.
    pub fn slow(self) -> usize {
        SLOW_LENGTH + self.accounts + self.controls
    }

    /// Energy taken by each dissipator (J), if there are several.
    pub fn accounts(self) -> Range<usize> {
        SLOW_LENGTH..SLOW_LENGTH + self.accounts
    }

    /// Block of the controllers.
    pub fn controls(self) -> Range<usize> {
        SLOW_LENGTH + self.accounts..self.slow()
    }

    pub fn len(self) -> usize {
        self.slow() + 2 * self.n
    }

    /// Internal coordinates.
    pub fn q(self) -> Range<usize> {
        self.slow()..self.slow() + self.n
    }

    /// Momenta `∂L/∂q̇` of the internal coordinates.
    pub fn p(self) -> Range<usize> {
        self.slow() + self.n..self.len()
    }
}

/// Vector at an index of a state.
pub(super) fn triple(y: &[f64], at: usize) -> [f64; 3] {
    [y[at], y[at + 1], y[at + 2]]
}

/// Attitude of a state.
pub(super) fn attitude(y: &[f64]) -> [f64; 4] {
    [y[ATTITUDE], y[ATTITUDE + 1], y[ATTITUDE + 2], y[ATTITUDE + 3]]
}
