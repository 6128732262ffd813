//! Measurement of the mean power at a rotation state: settling time, windows and limits from the modes at the pole.
//! Settling is eight of the slowest internal decays, clamped to 2 to 400 periods of the polhode; the window shrinks where the wobble
//! changes fast.
//! Equations (Q3) and (Q4), docs/theory/16-methods.md.

use std::ops::ControlFlow;

use super::calibrated::wobble;
use super::energy_range::EnergyRange;
use super::measure::{MeasureError, Measurement, Plan, measured};
use super::poles::Poles;
use crate::averaging::{FreeRotation, RotationState, constant_beyond};
use crate::dynamics::FullState;
use crate::model::{FlexibleBody, Mode};

/// Options of a measurement of the power.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasureOptions {
    /// Relative error wanted.
    pub error: f64,
    /// Error allowed per step of the full system, relative.
    pub tolerance: f64,
    /// Limit of steps in all.
    pub most_steps: u64,
}

impl Default for MeasureOptions {
    fn default() -> Self {
        Self { error: 5e-3, tolerance: 1e-9, most_steps: 40_000_000 }
    }
}

/// Relaxation times for the transient of a short run: a residue of `e^{−8}`.
const SETTLING_TIMES: f64 = 8.0;
/// Least and largest time of settling, in periods of the polhode.
const SETTLING: [f64; 2] = [2.0, 400.0];
/// Periods of the polhode in a window: few where the wobble changes fast; in general, and for a run from the slow manifold.
const PERIODS: [f64; 2] = [8.0, 16.0];
const PERIODS_FROM_MANIFOLD: [f64; 2] = [8.0, 24.0];
/// Share of a decay time of the wobble in a window, by the modes at first and then by its power.
const DECAYS: f64 = 0.05;
/// Limits of doublings of a window until the mean settles: in general, and for a run from the slow manifold.
const DOUBLINGS: usize = 6;
const DOUBLINGS_FROM_MANIFOLD: usize = 2;
/// Wobble (rad) below which the modes give the power.
const SMALL_WOBBLE: f64 = 0.02;
/// Wobble (rad) below which the power is not measured where the modes do not give it.
const SMALLEST_WOBBLE: f64 = 1e-3;
/// Distance from the separatrix, as `ξ`, to which the power is measured, between moments of like differences.
pub(super) const NEAREST_SEPARATRIX: f64 = -4.0;

/// Point of measurement of the mean power of a full system. (Q4)
#[derive(Clone, Copy)]
pub(super) struct MeasurementPoint<'a> {
    pub body: &'a FlexibleBody,
    pub range: &'a EnergyRange,
    pub poles: &'a Poles,
    pub options: MeasureOptions,
}

/// Windows of a run: periods of the polhode in the first, how many more are as long, and the limit of those in all.
struct Windows {
    periods: [f64; 2],
    equal: usize,
    doublings: usize,
}

impl MeasurementPoint<'_> {
    /// Measures the mean power near a rotation state.
    pub fn measure(
        self,
        RotationState { mode, xi }: RotationState,
        watch: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Measurement, MeasureError> {
        let Self { body, range, poles, .. } = self;
        let start = range.state(body, RotationState { mode, xi }).ok_or(MeasureError::LeftMode)?;
        let period =
            FreeRotation::at_logit(range.moments(), range.angular_momentum(), mode, xi).polhode_period();
        let pole = poles.of_mode(mode);
        let settling = pole.map_or(0.0, |pole| SETTLING_TIMES / pole.settling_rate().max(f64::MIN_POSITIVE));
        let settling = settling.clamp(SETTLING[0] * period, SETTLING[1] * period);
        self.follow(
            (start, settling),
            (mode, period),
            Windows { periods: PERIODS, equal: 1, doublings: DOUBLINGS },
            watch,
        )
    }

    /// Measures the mean power of a motion from a state on the slow manifold, which has no transient.
    pub fn measure_from(
        self,
        start: FullState,
        watch: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Measurement, MeasureError> {
        let energy = start.energy(self.body);
        let RotationState { mode, .. } = self.range.rotation_state(energy).ok_or(MeasureError::LeftMode)?;
        let period = self.range.polhode(energy).polhode_period();
        let windows =
            Windows { periods: PERIODS_FROM_MANIFOLD, equal: 0, doublings: DOUBLINGS_FROM_MANIFOLD };
        self.follow((start, 0.0), (mode, period), windows, watch)
    }

    fn follow(
        self,
        (start, settling): (FullState, f64),
        (mode, period): (Mode, f64),
        Windows { periods: [fewest, most], equal, doublings }: Windows,
        watch: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<Measurement, MeasureError> {
        let Self { body, range, poles, options } = self;
        let rate = poles.rate(mode).map_or(0.0, f64::abs);
        let plan = Plan {
            settling,
            periods: (DECAYS / (rate * period)).clamp(fewest, most),
            fewest_periods: fewest,
            loss: DECAYS,
            equal,
            change: 0.5 * options.error,
            tolerance: options.tolerance,
            steps: options.most_steps,
            doublings,
        };
        let found = measured(body, range, start, plan, watch)?;
        if found.rotation_state.mode == mode { Ok(found) } else { Err(MeasureError::LeftMode) }
    }
}

/// Periods of the polhode that the short runs between two rotation states of a mode take in all, about: as many runs as the first doubling of
/// the places has, each with its settling at a decay rate (1/s) of what moves inside and two windows. (Q4)
#[must_use]
pub fn micro_run_periods(settling_rate: f64, period: f64) -> f64 {
    let settling = SETTLING_TIMES / (settling_rate.max(f64::MIN_POSITIVE) * period);
    RUNS * (settling.clamp(SETTLING[0], SETTLING[1]) + 2.0 * PERIODS[1])
}

/// Runs in a mode after the first doubling of the places.
const RUNS: f64 = 9.0;

/// Place `ξ` where the wobble is so small that the modes give the power.
pub(super) fn small(range: &EnergyRange, mode: Mode) -> f64 {
    place(range, mode, SMALL_WOBBLE)
}

/// Place `ξ` of a wobble (rad).
fn place(range: &EnergyRange, mode: Mode, angle: f64) -> f64 {
    let wobble_at = |xi: f64| wobble(range.moments(), range.angular_momentum(), RotationState { mode, xi });
    crate::math::bisection::bisected([NEAREST_SEPARATRIX, 40.0], wobble_at, angle, false)
}

/// Place `ξ` beyond which the power is not measured: where the modes give it or, of a wobble that no mode damps, where its energy runs out of digits.
pub(super) fn smallest(range: &EnergyRange, poles: &Poles, mode: Mode) -> f64 {
    let damped = poles.rate(mode).is_none_or(|rate| rate != 0.0);
    place(range, mode, if damped { SMALL_WOBBLE } else { SMALLEST_WOBBLE })
}

/// Places in a mode between which the power is needed, ascending, not nearer to the separatrix than the first bound, between moments of like
/// differences, nor to the axis than the second; none if the evolution does not pass through the mode.
pub(super) fn span(
    range: &EnergyRange,
    mode: Mode,
    [from, to]: [RotationState; 2],
    [nearest, small]: [f64; 2],
) -> Option<[f64; 2]> {
    let nearest = constant_beyond(range.moments(), mode, nearest);
    let at = |rotation_state: RotationState| (rotation_state.mode == mode).then_some(rotation_state.xi);
    let (one, other) = match (at(from), at(to)) {
        (Some(one), Some(other)) => (one, other),
        (Some(one), None) | (None, Some(one)) => (one, nearest),
        (None, None) => return None,
    };
    let within = |xi: f64| xi.clamp(nearest, small);
    (small >= nearest).then(|| [within(one.min(other)), within(one.max(other))])
}
