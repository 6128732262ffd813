use super::rates::Rates;
use super::{Drift, DriftState};
use crate::averaging::evolution::RotationState;
use crate::averaging::power::MeanPower;
use crate::model::Mode;

/// Distance from the separatrix, as `ξ`, where the rotation passes to another region: the time left out is a share `e^{−25}`.
pub(super) const SEPARATRIX: f64 = -25.0;

/// A passage through the separatrix: from one of the four regions of the sphere of angular momentum to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeparatrixPassage {
    /// Time (s).
    pub t: f64,
    /// Mode and side of the circled axis, ±1, before.
    pub from: (Mode, f64),
    /// Mode and side of the circled axis, ±1, after.
    pub to: (Mode, f64),
    /// Probability of that region: the phase of the wobble decides which one is entered.
    pub probability: f64,
}

impl<P: MeanPower> Drift<P> {
    /// State in the most probable region beyond the separatrix, with the passage; none if every region leads back. (A10)
    pub(super) fn onward(&self, at: &DriftState) -> Option<(DriftState, SeparatrixPassage)> {
        let regions = [Mode::ShortAxis, Mode::LongAxis].map(|mode| [(mode, 1.0), (mode, -1.0)]);
        let ways = regions.as_flattened().iter().map(|region| (*region, self.outflow(*region, at)));
        let open: Vec<_> = ways.filter(|(_, flow)| *flow > 0.0).collect();
        let sum: f64 = open.iter().map(|(_, flow)| flow).sum();
        let first = *open.first()?;
        let ((mode, side), flow) =
            open[1..].iter().fold(first, |best, way| if way.1 > best.1 { *way } else { best });
        let state = DriftState { rotation_state: RotationState { mode, xi: SEPARATRIX }, side, ..*at };
        let from = (at.rotation_state.mode, at.side);
        Some((state, SeparatrixPassage { t: at.t, from, to: (mode, side), probability: flow / sum }))
    }

    /// Change of `D` in a period of the polhode, away from the separatrix, next to it in a region. (A10)
    fn outflow(&self, (mode, side): (Mode, f64), at: &DriftState) -> f64 {
        let DriftState { t, angular_momentum, direction, .. } = *at;
        let rates = Rates { drift: self, mode, side, angular_momentum, steady: false };
        let [I1, I2, I3] = self.moments;
        let gap = match mode {
            Mode::ShortAxis => I3 - I2,
            Mode::LongAxis => I2 - I1,
        };
        let period = rates.motion(SEPARATRIX, angular_momentum).polhode_period();
        gap * rates.at(t, SEPARATRIX, angular_momentum, direction)[0] * period
    }
}
