use std::sync::Arc;

use super::super::reason::Reason;
use super::super::span::Span;
use super::{Driver, Found, Outcome};
use crate::averaging::{Evolution, MeanPower, PowerSource, RotationState};
use crate::secular::CalibratedPower;

/// Wobble (rad) at which the rates of the modes are no better than the average.
const WIDE: f64 = 0.6;
/// Least error that is claimed for the rates of the modes, and for liquids whose boundary layer is that of a liquid at rest in a turned frame.
const LEAST: f64 = 1e-3;
const LEAST_OF_LIQUIDS: f64 = 0.02;

impl Driver<'_> {
    /// The average at the rates of the modes, for small wobbles. (Q5)
    pub(super) fn modal_rates(&self) -> Result<Found, Reason> {
        let spins = self.case.spins;
        // the polynomial has no loss of a viscoelastic material; it is averaged there only if it was asked for
        let viscoelastic = self.case.criteria.viscoelastic;
        let source = if viscoelastic { self.case.powers.first } else { PowerSource::Harmonics };
        let average = self.case.powers.of(source);
        let rate = |mode| spins.poles.rate(mode);
        let power = CalibratedPower::new(average, spins.range.angular_momentum(), rate);
        let ends = self.ends_within(&power);
        if ends.iter().any(|state| rate(state.mode).is_none_or(|rate| rate <= 0.0)) {
            return Err(Reason::NoModalRate);
        }
        let off = ends.map(|state| (power.factor(state.mode) - 1.0).abs());
        let off = off[0].max(off[1]);
        let wobble = Span::widest(spins, ends);
        let error = off * (wobble / WIDE).powi(2).min(1.0);
        if let Some(unstable) = spins.unstable() {
            return Err(Reason::Unstable(unstable));
        }
        if error > self.limits.measured_error {
            return Err(Reason::TooWideForModes { error: off, wobble });
        }
        let liquids = spins.liquid_error(ends);
        if liquids > self.limits.measured_error {
            return Err(Reason::TooWideForLiquids {
                wobble: (ends[0].mode == ends[1].mode).then_some(wobble),
            });
        }
        let least = if spins.body.memories().is_empty() { LEAST } else { LEAST_OF_LIQUIDS };
        let power: Arc<dyn MeanPower> = Arc::new(power);
        let error = Some(error.max(least).max(liquids));
        Ok(Found { outcome: Outcome::ModalRates(power), error, source: Some(source) })
    }

    /// The span to its last time, at a power, where that is before its end.
    fn ends_within(&self, power: &dyn MeanPower) -> [RotationState; 2] {
        let (spins, span) = (self.case.spins, self.case.span);
        let [from, to] = span.ends;
        let evolution = Evolution::new(power, spins.range.angular_momentum());
        [from, evolution.sooner(from, to, span.duration)]
    }
}
