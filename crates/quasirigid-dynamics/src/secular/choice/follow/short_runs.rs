use super::super::reason::Work;
use super::full_system::history_options;
use super::{ChoiceObserver, Driver, Found, Outcome, Stop};
use crate::averaging::RotationState;
use crate::secular::{
    DirectRow, DirectStopReason, MeasureError, MeasureOptions, MeasuredPower, Places, follow_directly,
    micro_run_periods,
};

/// Relaxation times in which a start is forgotten, and periods of the polhode at most.
const FORGOTTEN: f64 = 8.0;
const LONGEST: f64 = 400.0;

impl Driver<'_> {
    /// The power measured by short runs of the full system, after it has forgotten its start; announced.
    pub(super) fn micro_runs(&self, observer: &mut dyn ChoiceObserver) -> Result<Found, Stop> {
        self.announce_runs(self.time_of_short_runs(), observer)?;
        self.measured(Places::ShortRuns, observer)
    }

    /// The power of periodic motions of the full system, after it has forgotten its start. (Q19)
    pub(super) fn periodic_motions(&self, observer: &mut dyn ChoiceObserver) -> Result<Found, Stop> {
        if let Some(duration) = self.settling() {
            self.announce_runs(duration, observer)?;
        }
        self.measured(Places::PeriodicMotions, observer)
    }

    fn measured(&self, places: Places, observer: &mut dyn ChoiceObserver) -> Result<Found, Stop> {
        let (spins, span) = (self.case.spins, self.case.span);
        let settled = self.settled(observer)?;
        let [from, to] = span.ends;
        let from = settled.as_ref().and_then(|row| spins.range.rotation_state(row.energy)).unwrap_or(from);
        let (range, poles, options) = (&spins.range, &spins.poles, MeasureOptions::default());
        let mut watch = |share: f64| observer.observe(share);
        let power =
            MeasuredPower::along(spins.body, range, poles, ([from, to], places), &options, &mut watch)?;
        if power.error > self.limits.measured_error {
            return Err(MeasureError::Unsettled { change: power.error }.into());
        }
        let error = Some(power.time_error(spins.periods(&power, span.ends)));
        Ok(Found { outcome: Outcome::Measured { power: Box::new(power), settled }, error, source: None })
    }

    /// State at which the full system has forgotten the start; none where the start has settled.
    fn settled(&self, observer: &mut dyn ChoiceObserver) -> Result<Option<DirectRow>, MeasureError> {
        let (spins, span) = (self.case.spins, self.case.span);
        let Some(duration) = self.settling() else { return Ok(None) };
        let options = history_options(Some(span.energies[1]), Some(duration), self.limits);
        let run = follow_directly(spins.body, &span.start, &options, &mut |share| observer.observe(share))?;
        match run.ending {
            DirectStopReason::Finished => Ok(run.rows.last().copied()),
            DirectStopReason::Interrupted => Err(MeasureError::Interrupted),
            _ => Err(MeasureError::LeftMode),
        }
    }

    /// Time (s) in which the full system forgets the start; none where the start has settled.
    fn settling(&self) -> Option<f64> {
        let (spins, span) = (self.case.spins, self.case.span);
        let pole = spins.poles.of_mode(span.ends[0].mode).filter(|_| !span.placed)?;
        let period = spins.motion(span.ends[0]).polhode_period();
        Some((FORGOTTEN / pole.settling_rate()).clamp(period, LONGEST * period))
    }

    /// Whether the evolution ends before the full system has forgotten the start.
    pub(super) fn ends_unsettled(&self) -> bool {
        self.settling().zip(self.case.span.duration).is_some_and(|(settling, duration)| duration <= settling)
    }

    /// Announces runs of the full system over a time (s).
    fn announce_runs(&self, time: f64, observer: &mut dyn ChoiceObserver) -> Result<(), Stop> {
        let Ok(per_period) = self.seconds_per_period(observer) else { return Ok(()) };
        let period = self.case.spins.motion(self.case.span.ends[0]).polhode_period();
        Ok(observer.announce(Work::ShortRuns, per_period / period * time)?)
    }

    /// Time (s) that the short runs take in all.
    fn time_of_short_runs(&self) -> f64 {
        let ends = self.case.span.ends;
        let times = ends.map(|state| self.time_of_runs(state));
        let modes = if ends[0].mode == ends[1].mode { 1.0 } else { 2.0 };
        0.5 * modes * (times[0] + times[1])
    }

    /// Time (s) that the short runs between two states of a mode take in all, if their periods are that of a state.
    fn time_of_runs(&self, state: RotationState) -> f64 {
        let period = self.case.spins.motion(state).polhode_period();
        let pole = self.case.spins.poles.of_mode(state.mode);
        period * micro_run_periods(pole.map_or(0.0, |pole| pole.settling_rate()), period)
    }
}
