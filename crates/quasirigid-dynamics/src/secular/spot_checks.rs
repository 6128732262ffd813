//! Spot checks: mean power of the full system at a few rotation states, to check an average before its use.
//! The poles say nothing of a resonance at a large wobble; a mean that does not settle, or a run that ends early, counts as an error of the
//! average.
//! Equations (Q9) and (Q19), docs/theory/16-methods.md.

use std::ops::ControlFlow;

use super::energy_range::EnergyRange;
use super::measure::{MeasureError, Measurement};
use super::measurement_point::{MeasureOptions, MeasurementPoint, small, span};
use super::periodic_place::PeriodicPlaces;
use super::poles::Poles;
use crate::averaging::{FreeRotation, MeanPower, RotationState};
use crate::dynamics::FullState;
use crate::model::{FlexibleBody, Mode};

/// Nearest place to the separatrix that is probed, as `ξ`.
const NEAREST_SEPARATRIX: f64 = -2.0;
/// Length in `ξ` below which one place is probed, and the number of places otherwise.
const SINGLE_PLACE_LENGTH: f64 = 0.3;
const PLACES: usize = 3;

/// Mean power of the full system at a few rotation states of an evolution, from the widest wobble on, for comparison with an average.
/// (Q9)
#[derive(Clone, Debug)]
pub struct SpotChecks {
    angular_momentum: f64,
    measurements: Vec<Measurement>,
    /// Relative change of a mean that did not settle, infinite where a run ended early; zero if all settled.
    unsettled: f64,
}

impl SpotChecks {
    /// Measures between two rotation states, by periodic motions where `periodic` and they are found, else by short runs; no measurement where the
    /// wobble is so small that the modes give the power.
    ///
    /// # Errors
    /// [`MeasureError`] if a run cannot start, the steps allowed are used up, or the caller asks for an end.
    pub fn between(
        body: &FlexibleBody,
        range: &EnergyRange,
        poles: &Poles,
        ends: [RotationState; 2],
        (options, periodic): (&MeasureOptions, bool),
        watch: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Self, MeasureError> {
        let point = MeasurementPoint { body, range, poles, options: *options };
        let mut motions = periodic.then(PeriodicPlaces::default);
        let mut spot_checks =
            Self { angular_momentum: range.angular_momentum(), measurements: Vec::new(), unsettled: 0.0 };
        for rotation_state in places(range, ends) {
            let closed = motions
                .as_mut()
                .map(|motions| motions.measure(body, range, (rotation_state, options.error), watch));
            let found = match closed {
                Some(found @ (Ok(_) | Err(MeasureError::Interrupted))) => found,
                _ => point.measure(rotation_state, watch),
            };
            match found {
                Ok(found) => spot_checks.measurements.push(found),
                Err(MeasureError::Unsettled { change }) => {
                    spot_checks.unsettled = change;
                    break;
                }
                Err(MeasureError::Ended { .. } | MeasureError::LeftMode) => {
                    spot_checks.unsettled = f64::INFINITY;
                    break;
                }
                Err(failed) => return Err(failed),
            }
        }
        Ok(spot_checks)
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
        let found = MeasurementPoint { body, range, poles, options: *options }.measure_from(start, watch)?;
        Ok(Self { angular_momentum: range.angular_momentum(), measurements: vec![found], unsettled: 0.0 })
    }

    /// Steps of the runs.
    #[must_use]
    pub fn steps(&self) -> u64 {
        self.measurements.iter().map(|found| found.steps).sum()
    }

    /// Largest relative difference of a power from the measured one; at least the change of a mean that did not settle.
    #[must_use]
    pub fn error(&self, power: &dyn MeanPower) -> f64 {
        let off = self.measurements.iter().map(|found| {
            let RotationState { mode, xi } = found.rotation_state;
            let motion = FreeRotation::at_logit(power.moments(), self.angular_momentum, mode, xi);
            (power.mean_power(&motion) / found.power - 1.0).abs()
        });
        off.fold(self.unsettled, f64::max)
    }
}

/// Rotation states of an evolution with a wide wobble.
fn places(range: &EnergyRange, ends: [RotationState; 2]) -> Vec<RotationState> {
    let in_mode = |mode: Mode| {
        let [low, high] =
            span(range, mode, ends, [NEAREST_SEPARATRIX, small(range, mode)]).unwrap_or([0.0; 2]);
        let count = match high - low {
            way if way <= 0.0 => 0,
            way if way < SINGLE_PLACE_LENGTH => 1,
            _ => PLACES,
        };
        (0..count).map(move |i| RotationState { mode, xi: low + (high - low) * i as f64 / PLACES as f64 })
    };
    [Mode::LongAxis, Mode::ShortAxis].into_iter().flat_map(in_mode).collect()
}
