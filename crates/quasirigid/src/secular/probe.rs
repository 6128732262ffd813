use std::ops::ControlFlow;

use super::energy_range::EnergyRange;
use super::measure::{MeasureError, Measurement};
use super::poles::Poles;
use super::site::{MeasureOptions, Site, span};
use crate::averaging::{FreeRotation, MeanPower, Stage};
use crate::dynamics::FullState;
use crate::model::{FlexibleBody, Mode};

/// Nearest place to the separatrix that is probed, as `ξ`.
const NEAREST: f64 = -2.0;
/// Ways shorter than this, as `ξ`, are probed at one place, others at so many.
const SHORT: f64 = 0.3;
const PLACES: usize = 3;

/// Mean power of the full system at a few places of a way, from the widest wobble on: what an average is compared with. (Q9)
#[derive(Clone, Debug)]
pub struct Probes {
    momentum: f64,
    measurements: Vec<Measurement>,
    /// Relative change of a mean that did not settle, infinite where a run ended early; zero if all settled.
    unsettled: f64,
}

impl Probes {
    /// Measures between two stages; nothing where the wobble is so small that the modes give the power.
    ///
    /// # Errors
    /// [`MeasureError`] if a run cannot start, the steps allowed are used up, or somebody asks for an end.
    pub fn between(
        body: &FlexibleBody,
        range: &EnergyRange,
        poles: &Poles,
        ends: [Stage; 2],
        options: &MeasureOptions,
        watch: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Self, MeasureError> {
        let site = Site { body, range, poles, options: *options };
        let mut probes = Self { momentum: range.momentum(), measurements: Vec::new(), unsettled: 0.0 };
        for stage in places(range, ends) {
            match site.measure(stage, watch) {
                Ok(found) => probes.measurements.push(found),
                Err(MeasureError::Unsettled { change }) => {
                    probes.unsettled = change;
                    break;
                }
                Err(MeasureError::Ended { .. } | MeasureError::LeftMode) => {
                    probes.unsettled = f64::INFINITY;
                    break;
                }
                Err(failed) => return Err(failed),
            }
        }
        Ok(probes)
    }

    /// Measures from a state on the slow manifold.
    ///
    /// # Errors
    /// [`MeasureError`] if there is no mean.
    pub fn from(
        body: &FlexibleBody,
        range: &EnergyRange,
        poles: &Poles,
        start: FullState,
        options: &MeasureOptions,
        watch: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Self, MeasureError> {
        let found = Site { body, range, poles, options: *options }.measure_from(start, watch)?;
        Ok(Self { momentum: range.momentum(), measurements: vec![found], unsettled: 0.0 })
    }

    /// Steps that the runs took.
    #[must_use]
    pub fn steps(&self) -> u64 {
        self.measurements.iter().map(|found| found.steps).sum()
    }

    /// Largest relative difference of a power from what was measured; at least the change of a mean that did not settle.
    #[must_use]
    pub fn error(&self, power: &dyn MeanPower) -> f64 {
        let off = self.measurements.iter().map(|found| {
            let Stage { mode, xi } = found.stage;
            let motion = FreeRotation::at_logit(power.moments(), self.momentum, mode, xi);
            (power.mean_power(&motion) / found.power - 1.0).abs()
        });
        off.fold(self.unsettled, f64::max)
    }
}

/// Places of a way at which the wobble is wide.
fn places(range: &EnergyRange, ends: [Stage; 2]) -> Vec<Stage> {
    let in_mode = |mode: Mode| {
        let [low, high] = span(range, mode, ends, NEAREST).unwrap_or([0.0; 2]);
        let count = match high - low {
            way if way <= 0.0 => 0,
            way if way < SHORT => 1,
            _ => PLACES,
        };
        (0..count).map(move |i| Stage { mode, xi: low + (high - low) * i as f64 / PLACES as f64 })
    };
    [Mode::LongAxis, Mode::ShortAxis].into_iter().flat_map(in_mode).collect()
}
