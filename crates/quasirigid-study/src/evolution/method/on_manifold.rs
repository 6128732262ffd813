//! History of the reduced equations about a spin, where they hold from start to end.

use std::ops::ControlFlow;

use quasirigid::secular::{DirectStopReason, follow_on_manifold};

use super::full::options;
use super::short_or_full::Choice;
use super::verdict::ChosenMethod;
use crate::error::StudyError;
use crate::evolution::reason::{Reason, Stop};

/// Number of coordinates up to which the reduced equations about a spin are tried unasked.
pub const FEW: usize = 150;

impl Choice<'_> {
    /// The history of the reduced equations about the spin, tried without having been asked for; none where they do not hold.
    pub fn on_manifold(
        &self,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Option<ChosenMethod>, StudyError> {
        let [from, to] = self.way.ends;
        if from.mode != to.mode || self.body.coordinates().len() > FEW {
            return Ok(None);
        }
        match self.along_manifold(watch) {
            Ok(road) => Ok(Some(road)),
            Err(Stop::Refused(_)) => Ok(None),
            Err(Stop::Failed(error)) => Err(error),
        }
    }

    /// The history of the reduced equations about the spin, or why there is none.
    pub fn along_manifold(
        &self,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<ChosenMethod, Stop> {
        let [from, to] = self.way.ends;
        if from.mode != to.mode {
            return Err(Reason::ManifoldBetweenAxes.into());
        }
        let options = options(Some(self.way.energies[1]), self.duration);
        let found = follow_on_manifold(self.body, from.mode, &self.way.start, &options, watch);
        match found.map_err(Reason::Submanifold)? {
            None => Err(Reason::BeyondManifold { wobble: self.ground.motion(from).nutation()[1] }.into()),
            Some(history) if history.run.ending == DirectStopReason::Interrupted => {
                Err(StudyError::Interrupted.into())
            }
            Some(history) => Ok(ChosenMethod::Manifold(Box::new(history))),
        }
    }
}
