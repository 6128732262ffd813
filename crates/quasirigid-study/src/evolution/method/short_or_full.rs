use std::cell::OnceCell;
use std::ops::ControlFlow;

use quasirigid::model::FlexibleBody;
use quasirigid::secular::{AverageCriteria, MeasureError, Probes};

use super::start_and_end::Way;
use super::steady_spins::Ground;
use super::verdict::Road;
use crate::error::StudyError;
use crate::evolution::ageing::Ageing;

/// Revolutions of a history of the full system that is chosen at once, and that is tried where nothing else holds.
const FEW: f64 = 3_000.0;
pub const MANY: f64 = 200_000.0;
/// Decay in a period of the polhode up to which the power has a mean.
const DECAY: f64 = 0.05;

/// A choice between the roads.
pub struct Choice<'a> {
    pub body: &'a FlexibleBody,
    pub ground: &'a Ground<'a>,
    pub way: &'a Way,
    /// Longest time (s).
    pub duration: Option<f64>,
    /// Short runs of the full system, once they were made; none where there are to be none.
    pub probes: OnceCell<Option<Probes>>,
}

impl<'a> Choice<'a> {
    pub fn new(ground: &'a Ground<'a>, way: &'a Way, duration: Option<f64>) -> Self {
        Self { body: ground.body, ground, way, duration, probes: OnceCell::new() }
    }

    pub fn criteria(&self, ageing: &Ageing) -> AverageCriteria {
        self.ground.criteria(ageing.power(), self.way.ends)
    }

    /// The average that was asked for.
    pub fn forced_average(&self, ageing: &Ageing) -> Road {
        let criteria = self.criteria(ageing);
        if criteria.hold() { self.averaged(criteria) } else { Road::Unfounded { criteria } }
    }

    /// The road that holds where the average does not.
    pub fn other(
        &self,
        ageing: &mut Ageing,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Result<Road, String>, StudyError> {
        if !self.ground.complete(self.way.ends) {
            return Ok(self.calibrated(ageing));
        }
        let revolutions = self.ground.revolutions(self.way.ends);
        let fast = self.ground.haste(self.way.ends) > DECAY;
        if fast || self.whirls() || revolutions.is_none_or(|turns| turns <= FEW) {
            return self.short_history(watch);
        }
        match self.measured(watch) {
            Ok(road) => Ok(Ok(road)),
            Err(MeasureError::Interrupted) => Err(StudyError::Interrupted),
            Err(_) if revolutions.is_some_and(|turns| turns <= MANY) => self.short_history(watch),
            Err(error) => Ok(Err(error.to_string())),
        }
    }

    /// Whether a motion beside the nutation grows at a pole of the way.
    pub fn whirls(&self) -> bool {
        self.way.ends.iter().any(|stage| {
            let pole = self.ground.poles.of_mode(stage.mode);
            pole.is_some_and(|pole| pole.modes.internal.iter().any(|[decay, _]| *decay < 0.0))
        })
    }
}
