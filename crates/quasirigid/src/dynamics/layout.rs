use std::ops::Range;

use crate::model::FlexibleBody;

/// Where the parts of a full state stand in its list of numbers: slow parts first, then what dissipators take, then the
/// coordinates and their momenta.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Layout {
    /// Number of internal coordinates.
    pub n: usize,
    /// Number of dissipators whose energies are kept apart, after the slow parts.
    pub accounts: usize,
}

/// Momentum (N·m·s), body axes: about the pole, or about the centre of mass of a free body.
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
/// Place (m), inertial axes: of the centre of mass of a free body, of the pole of a held one.
pub(super) const PLACE: usize = 13;
/// Its velocity (m/s).
pub(super) const VELOCITY: usize = 16;
/// Numbers before what dissipators take.
pub(super) const SLOW: usize = 19;

impl Layout {
    /// Of a body; the energy taken by a single dissipator is the whole.
    pub fn of(body: &FlexibleBody) -> Self {
        let dissipators = body.dissipators().len();
        Self { n: body.coordinates().len(), accounts: if dissipators > 1 { dissipators } else { 0 } }
    }

    /// Numbers before the coordinates.
    pub fn slow(self) -> usize {
        SLOW + self.accounts
    }

    /// Energy taken by each dissipator (J), if there are several.
    pub fn accounts(self) -> Range<usize> {
        SLOW..self.slow()
    }

    pub fn len(self) -> usize {
        self.slow() + 2 * self.n
    }

    /// Internal coordinates.
    pub fn q(self) -> Range<usize> {
        self.slow()..self.slow() + self.n
    }

    /// Their momenta `∂L/∂q̇`.
    pub fn p(self) -> Range<usize> {
        self.slow() + self.n..self.len()
    }
}

/// Three numbers of a state.
pub(super) fn triple(y: &[f64], at: usize) -> [f64; 3] {
    [y[at], y[at + 1], y[at + 2]]
}

/// The attitude of a state.
pub(super) fn attitude(y: &[f64]) -> [f64; 4] {
    [y[ATTITUDE], y[ATTITUDE + 1], y[ATTITUDE + 2], y[ATTITUDE + 3]]
}
