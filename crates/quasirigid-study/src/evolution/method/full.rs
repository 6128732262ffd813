//! Methods of the full system: short runs, and the history from start to end.

use std::ops::ControlFlow;

use quasirigid::secular::{
    DirectOptions, DirectRow, DirectStopReason, MeasureError, MeasureOptions, MeasuredPower, follow_directly,
};

use super::short_or_full::{Choice, MANY};
use super::steady_spins::Ground;
use super::verdict::ChosenMethod;
use crate::error::StudyError;
use crate::evolution::reason::{Reason, Stop};

/// Steps of a history.
const STEPS: u64 = 30_000_000;
/// Steps of a history that is followed unasked, times the square of the number of coordinates or, on curved paths, its cube: minutes.
const WORK: f64 = 1e9;
/// Error allowed per step of the full system, relative.
const TOLERANCE: f64 = 1e-10;
/// Revolutions in which no wobble dies out.
const ONE_TURN: f64 = 1.0;
/// Relaxation times in which a start is forgotten, and periods of the polhode at most.
const FORGOTTEN: f64 = 8.0;
const LONGEST: f64 = 400.0;
/// Error from which an answer is refused.
pub const REFUSED: f64 = 0.03;

/// Options of a history of the full system, to an energy (J) or for a time (s).
pub fn options(until: Option<f64>, duration: Option<f64>) -> DirectOptions {
    DirectOptions {
        until,
        duration: duration.unwrap_or(f64::MAX),
        most_revolutions: f64::INFINITY,
        most_steps: STEPS,
        tolerance: TOLERANCE,
    }
}

impl Choice<'_> {
    /// The power measured by short runs.
    pub fn measured(
        &self,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<ChosenMethod, MeasureError> {
        let Ground { range, poles, .. } = self.ground;
        let settled = self.settled(watch)?;
        let [from, to] = self.way.ends;
        let from = settled.as_ref().and_then(|row| range.stage(row.energy)).unwrap_or(from);
        let options = MeasureOptions::default();
        let power = MeasuredPower::along(self.body, range, poles, [from, to], &options, watch)?;
        if power.error > REFUSED {
            return Err(MeasureError::Unsettled { change: power.error });
        }
        Ok(ChosenMethod::Measured(Box::new(power), settled))
    }

    /// State at which the full system has forgotten the start of the file; none where the start is a state that was asked for.
    pub fn settled(
        &self,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Option<DirectRow>, MeasureError> {
        let Some(pole) = self.ground.poles.of_mode(self.way.ends[0].mode).filter(|_| !self.way.placed) else {
            return Ok(None);
        };
        let period = self.ground.motion(self.way.ends[0]).polhode_period();
        let duration = (FORGOTTEN / pole.settling_rate()).clamp(period, LONGEST * period);
        let options = options(Some(self.way.energies[1]), Some(duration));
        let run = follow_directly(self.body, &self.way.start, &options, watch)?;
        match run.ending {
            DirectStopReason::Finished => Ok(run.rows.last().copied()),
            DirectStopReason::Interrupted => Err(MeasureError::Interrupted),
            _ => Err(MeasureError::LeftMode),
        }
    }

    /// The history of the full system, however long.
    pub fn direct(&self, watch: &mut dyn FnMut(f64) -> ControlFlow<()>) -> Result<ChosenMethod, Stop> {
        self.followed([f64::INFINITY, f64::INFINITY], watch)
    }

    /// The history of the full system, if it takes no more than minutes.
    pub fn short_history(&self, watch: &mut dyn FnMut(f64) -> ControlFlow<()>) -> Result<ChosenMethod, Stop> {
        let power = if self.body.paths().is_some() { 3 } else { 2 };
        let per_step = (self.body.coordinates().len().max(1) as f64).powi(power);
        self.followed([MANY, WORK / per_step], watch)
    }

    fn followed(
        &self,
        [most_revolutions, most_steps]: [f64; 2],
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<ChosenMethod, Stop> {
        let options = DirectOptions {
            most_revolutions,
            most_steps: STEPS.min(most_steps as u64),
            ..options(Some(self.way.energies[1]), self.duration)
        };
        let run = follow_directly(self.body, &self.way.start, &options, watch)?;
        let end = run.rows[run.rows.len() - 1];
        match run.ending {
            DirectStopReason::Reached if end.revolutions < ONE_TURN => {
                Err(Reason::WithinRevolution { t: end.t }.into())
            }
            DirectStopReason::Reached | DirectStopReason::Finished => Ok(ChosenMethod::Direct(Box::new(run))),
            DirectStopReason::Interrupted => Err(StudyError::Interrupted.into()),
            ending => {
                let instability = self.ground.unstable().or_else(|| self.ground.whirl());
                Err(Reason::Unfinished { t: end.t, revolutions: end.revolutions, ending, instability }.into())
            }
        }
    }
}
