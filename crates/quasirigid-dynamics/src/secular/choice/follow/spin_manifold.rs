use super::super::reason::Reason;
use super::full_system::history_options;
use super::{ChoiceError, ChoiceObserver, Driver, Found, Outcome, Stop};
use crate::secular::{DirectStopReason, follow_on_manifold};

impl Driver<'_> {
    /// The history of the reduced equations about the spin.
    pub(super) fn spin_manifold(&self, observer: &mut dyn ChoiceObserver) -> Result<Found, Stop> {
        let (spins, span) = (self.case.spins, self.case.span);
        let [from, to] = span.ends;
        if from.mode != to.mode {
            return Err(Reason::ManifoldThroughSeparatrix.into());
        }
        let options = history_options(Some(span.energies[1]), span.duration, self.limits);
        let mut watch = |share: f64| observer.observe(share);
        let found = follow_on_manifold(spins.body, from.mode, &span.start, &options, &mut watch);
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
