use std::ops::ControlFlow;

use super::super::reason::Reason;
use super::full_system::history_options;
use super::{ChoiceError, ChoiceObserver, Driver, Found, Outcome, Stop};
use crate::math::stopwatch::Stopwatch;
use crate::secular::{DirectStopReason, follow_on_manifold};

/// Time of work (s) after which another method is taken, unless this one was asked for.
const MOST_TIME: f64 = 40.0;

impl Driver<'_> {
    /// The history of the reduced equations about the spin; for a limited time of work where it was not asked for.
    pub(super) fn spin_manifold(&self, observer: &mut dyn ChoiceObserver) -> Result<Found, Stop> {
        let (spins, span) = (self.case.spins, self.case.span);
        let [from, to] = span.ends;
        if from.mode != to.mode {
            return Err(Reason::ManifoldThroughSeparatrix.into());
        }
        let options = history_options(Some(span.energies[1]), span.duration, self.limits);
        let (begun, mut long) = (Stopwatch::start(), false);
        let mut watch = |share: f64| {
            long |= !self.asked && begun.seconds() > MOST_TIME;
            if long { ControlFlow::Break(()) } else { observer.observe(share) }
        };
        let found = follow_on_manifold(spins.body, from.mode, &span.start, &options, &mut watch);
        if long {
            return Err(Reason::LongManifold { seconds: MOST_TIME }.into());
        }
        match found? {
            None => Err(Reason::BeyondManifold { wobble: spins.motion(from).nutation()[1] }.into()),
            Some(history) if history.run.ending == DirectStopReason::Interrupted => {
                Err(ChoiceError::Interrupted.into())
            }
            Some(history) => {
                let error = Some(history.error);
                Ok(Found { outcome: Outcome::SpinManifold(Box::new(history)), error, source: None })
            }
        }
    }
}
