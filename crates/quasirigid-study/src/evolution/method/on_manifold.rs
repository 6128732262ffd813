//! History of the reduced equations about a spin, where they hold from start to end.

use std::ops::ControlFlow;

use quasirigid::secular::{DirectStopReason, follow_on_manifold};

use super::full::options;
use super::short_or_full::Choice;
use super::verdict::ChosenMethod;
use crate::error::StudyError;
use crate::words::significant;

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
        Ok(self.along_manifold(watch)?.ok())
    }

    /// The history of the reduced equations about the spin, or why there is none.
    pub fn along_manifold(
        &self,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Result<ChosenMethod, String>, StudyError> {
        let [from, to] = self.way.ends;
        if from.mode != to.mode {
            return Ok(Err(
                "the reduced equations about a spin do not reach from one pole to the other".into()
            ));
        }
        let options = options(Some(self.way.energies[1]), self.duration);
        let found = follow_on_manifold(self.body, from.mode, &self.way.start, &options, watch);
        let nutation = self.ground.motion(from).nutation()[1].to_degrees();
        Ok(match found {
            Err(error) => Err(error.to_string()),
            Ok(None) => Err(format!(
                "the reduced equations about the spin do not hold at the nutation of the start, {} degrees, or the start is too far \
                 off them",
                significant(nutation, 3)
            )),
            Ok(Some(history)) if history.run.ending == DirectStopReason::Interrupted => {
                return Err(StudyError::Interrupted);
            }
            Ok(Some(history)) => Ok(ChosenMethod::Manifold(Box::new(history))),
        })
    }
}
