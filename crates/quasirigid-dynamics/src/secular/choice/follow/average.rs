//! Averages along the frozen polhode: their criteria, short runs beside them, and the response in the spinning frame.

use std::ops::ControlFlow;
use std::sync::Arc;

use super::super::average_powers::AveragePowers;
use super::super::limits::Limits;
use super::super::reason::Reason;
use super::super::reference_spins::ReferenceSpins;
use super::{AverageBasis, ChoiceError, ChoiceObserver, Driver, Followed, Found, Outcome, Stop};
use crate::averaging::{Evolution, InterpolatedPower, MeanPower, PowerSource, RotationState};
use crate::math::stopwatch::Stopwatch;
use crate::secular::criteria::{deformed, uneven};
use crate::secular::{AverageCriteria, MeasureError, MeasureOptions, SpotChecks};

/// Steps of each short run beside an average at most, and the time (s) after which an average that nobody asked for goes without them.
const PROBE_STEPS: u64 = 3_000_000;
const PROBE_TIME: f64 = 40.0;
/// Coordinates from which a periodic motion takes less time than a short run.
const MANY_COORDINATES: usize = 13;

impl Driver<'_> {
    /// An average, where its criteria hold and short runs confirm it; one that was asked for, with a mark where its criteria fail.
    pub(super) fn average(
        &self,
        source: PowerSource,
        observer: &mut dyn ChoiceObserver,
    ) -> Result<Found, Stop> {
        let power = self.case.powers.of(source);
        let criteria = self.case.spins.average_criteria(&power, self.case.span.ends);
        let (basis, error) = match self.asked {
            true if !self.accepts(&criteria) => (AverageBasis::Fails(criteria), self.power_error(&criteria)),
            true => (AverageBasis::Criteria, self.time_error(&power, &criteria)),
            false => {
                let criteria = self.confirmed(criteria, &power, observer)?;
                if let Some(found) = self.in_few_periods(&power, observer)? {
                    return Ok(found);
                }
                (AverageBasis::Criteria, self.time_error(&power, &criteria))
            }
        };
        let outcome = Outcome::Average { power, basis };
        Ok(Found { outcome, error: Some(error), source: Some(source) })
    }

    /// The average of the response in the spinning frame, whose reaction on the polhode counts among the criteria. (H6)
    pub(super) fn spinning_frame(&self, observer: &mut dyn ChoiceObserver) -> Result<Found, Stop> {
        let (spins, span) = (self.case.spins, self.case.span);
        let Some(hill) = &self.case.spinning_frame else { return Err(Reason::NotPrepared.into()) };
        let evolution = Evolution::new(hill, spins.range.angular_momentum());
        let share = |state: RotationState| hill.share(&evolution.motion(state)).unwrap_or(f64::INFINITY);
        let share = span.ends.map(share).into_iter().fold(0.0, f64::max);
        let criteria = spins.average_criteria(hill, span.ends);
        let criteria = AverageCriteria { poles: criteria.poles.max(share), ..criteria };
        let criteria = self.confirmed(criteria, hill, observer)?;
        if let Some(found) = self.in_few_periods(hill, observer)? {
            return Ok(found);
        }
        let power = Arc::new(InterpolatedPower::new(hill.clone(), spins.range.angular_momentum()));
        let error = Some(self.time_error(&power, &criteria));
        Ok(Found { outcome: Outcome::SpinningFrame(power), error, source: None })
    }

    /// Criteria of an average that hold, with its difference from short runs of the full system.
    fn confirmed(
        &self,
        criteria: AverageCriteria,
        power: &dyn MeanPower,
        observer: &mut dyn ChoiceObserver,
    ) -> Result<AverageCriteria, Stop> {
        if !self.accepts(&criteria) {
            return Err(Reason::AverageFails(criteria).into());
        }
        let probed = self.probes(observer)?.map_or(0.0, |probes| probes.error(power));
        let criteria = AverageCriteria { probed, ..criteria };
        if self.accepts(&criteria) { Ok(criteria) } else { Err(Reason::AverageFails(criteria).into()) }
    }

    /// The history of the full system in place of an average over few periods of the wobble, where it has every loss and does not take too long.
    fn in_few_periods(
        &self,
        power: &dyn MeanPower,
        observer: &mut dyn ChoiceObserver,
    ) -> Result<Option<Found>, Stop> {
        let criteria = &self.case.criteria;
        let followed = criteria.left_out <= self.limits.losses_left_out
            && criteria.revolutions.is_some_and(|revolutions| revolutions <= self.limits.many_revolutions);
        if !followed || uneven(self.case.spins.periods(power, self.case.span.ends)) <= self.limits.uneven {
            return Ok(None);
        }
        match self.full_system(observer) {
            Ok(found) => Ok(Some(found)),
            Err(Stop::Refused { .. }) => Ok(None),
            Err(failed) => Err(failed),
        }
    }

    fn accepts(&self, criteria: &AverageCriteria) -> bool {
        criteria.error() <= self.limits.average_error
    }

    /// Bound of the error of an averaged power: where no short runs stand beside it, with the elasticity that no pole shows. (Q17)
    fn power_error(&self, criteria: &AverageCriteria) -> f64 {
        let unseen = if criteria.probed > 0.0 { None } else { self.case.criteria.spin_ratio };
        criteria.error().max(unseen.map_or(0.0, deformed))
    }

    /// Bound of the error of the time of an average.
    fn time_error(&self, power: &dyn MeanPower, criteria: &AverageCriteria) -> f64 {
        self.power_error(criteria) + uneven(self.case.spins.periods(power, self.case.span.ends))
    }

    /// Short runs of the full system on the span; none where they are not wanted, take too long, or do not lead to a power.
    fn probes(&self, observer: &mut dyn ChoiceObserver) -> Result<Option<&SpotChecks>, ChoiceError> {
        if let Some(probes) = self.probes.get() {
            return Ok(probes.as_ref());
        }
        let mut found = None;
        if self.case.criteria.wants_probes(self.limits) {
            let ReferenceSpins { body, range, poles, .. } = self.case.spins;
            let options = MeasureOptions { most_steps: PROBE_STEPS, ..MeasureOptions::default() };
            let (begun, mut long) = (Stopwatch::start(), false);
            let mut watch = || {
                long |= begun.seconds() > PROBE_TIME;
                if long { ControlFlow::Break(()) } else { observer.observe(0.0) }
            };
            let coordinates = body.coordinates().len();
            let periodic =
                (MANY_COORDINATES..=self.limits.coordinates_of_periodic_motions).contains(&coordinates);
            let ends = self.case.span.ends;
            let probes = SpotChecks::between(body, range, poles, ends, (&options, periodic), &mut watch);
            match probes {
                Ok(probes) => found = Some(probes),
                Err(MeasureError::Interrupted) if !long => return Err(ChoiceError::Interrupted),
                Err(_) => {}
            }
        }
        Ok(self.probes.get_or_init(|| found).as_ref())
    }
}

/// Average of a body under a slow torque at a rotation state, which no other method follows; `asked` gives it although it does not hold.
///
/// # Errors
/// [`Reason`] why it does not hold.
pub fn average_under_torque(
    spins: &ReferenceSpins,
    powers: &AveragePowers,
    state: RotationState,
    asked: bool,
    limits: &Limits,
) -> Result<Followed, Reason> {
    let unknown = spins.unknown_liquid_response(state.mode);
    if !unknown.is_empty() {
        return Err(Reason::UnknownLiquidResponse(unknown.to_vec()));
    }
    let judged = |source: PowerSource| {
        let power = powers.of(source);
        let criteria = spins.average_criteria(&power, [state; 2]);
        (power, source, criteria)
    };
    let (mut power, mut source, mut criteria) = judged(powers.first);
    if criteria.error() > limits.error_under_torque && powers.may_take_harmonics() {
        (power, source, criteria) = judged(PowerSource::Harmonics);
    }
    let basis = if criteria.error() <= limits.error_under_torque {
        AverageBasis::UnderTorque
    } else if asked {
        AverageBasis::Fails(criteria)
    } else {
        return Err(Reason::AverageUnderTorque(criteria));
    };
    Ok(Followed::average(power, source, basis, Some(criteria.error())))
}
