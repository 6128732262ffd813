//! Choice of the average: its criteria, probes of the full system, and the response in the spinning frame.

use std::ops::ControlFlow;
use std::sync::Arc;

use quasirigid::averaging::{Evolution, HillResponse, MeanPower, RotationState};
use quasirigid::reduction::frequencies;
use quasirigid::secular::{AverageCriteria, CalibratedPower, MeasureError, MeasureOptions, Probes};
use quasirigid_math::vec3::norm;

use super::full::REFUSED;
use super::short_or_full::Choice;
use super::steady_spins::Ground;
use super::verdict::ChosenMethod;
use crate::error::StudyError;
use crate::evolution::reason::Reason;
use crate::evolution::secular::SecularEvolution;
use crate::words::{significant, time};

/// Places of the way at which parametric resonance is looked for.
const LOOKS: usize = 4;
/// Ratio of the spin to the slowest elastic frequency from which an average is compared with short runs of the full system, and the
/// steps of each run at most.
const PROBED: f64 = 0.1;
const PROBE_STEPS: u64 = 3_000_000;
/// Coordinates up to which the response in the spinning frame is tried.
const FEW_COORDINATES: usize = 120;
/// Wobble (rad) at which the rates of the modes are no better than the average.
const WIDE: f64 = 0.6;
/// Least error that is claimed for the rates of the modes.
const LEAST: f64 = 1e-3;
/// Least error for liquids whose boundary layer is that of a liquid at rest in a turned frame.
const OF_LIQUIDS: f64 = 0.02;

impl Choice<'_> {
    /// The average if it holds: from the reduced equations, from the harmonics, or from those of the spinning frame.
    pub fn average(
        &self,
        secular: &mut SecularEvolution,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Option<ChosenMethod>, StudyError> {
        let hill = self.spinning_frame();
        secular.verdict.parametric = hill.as_ref().and_then(|hill| self.parametric(hill));
        if secular.verdict.parametric.is_some() {
            return Ok(None);
        }
        if let Some(road) = self.accepted(self.criteria(secular), secular.power(), watch)? {
            return Ok(Some(road));
        }
        if secular.by_polynomial && !secular.power_was_asked {
            secular.take_harmonics();
            if let Some(road) = self.accepted(self.criteria(secular), secular.power(), watch)? {
                return Ok(Some(road));
            }
        }
        let Some(hill) = hill.filter(|_| !secular.power_was_asked) else { return Ok(None) };
        let evolution = Evolution::new(&hill, self.ground.range.angular_momentum());
        let share = |stage: RotationState| hill.share(&evolution.motion(stage)).unwrap_or(f64::INFINITY);
        let share = self.way.ends.map(share).into_iter().fold(0.0, f64::max);
        let criteria = self.ground.criteria(&hill, self.way.ends);
        let criteria = AverageCriteria { poles: criteria.poles.max(share), ..criteria };
        let road = self.accepted(criteria, &hill, watch)?;
        if road.is_some() {
            secular.take_hill(hill);
        }
        Ok(road)
    }

    /// An average whose criteria hold and that short runs of the full system confirm.
    pub fn accepted(
        &self,
        criteria: AverageCriteria,
        power: &dyn MeanPower,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Option<ChosenMethod>, StudyError> {
        if !criteria.hold() {
            return Ok(None);
        }
        let probed = self.probes(watch)?.map_or(0.0, |probes| probes.error(power));
        let criteria = AverageCriteria { probed, ..criteria };
        Ok(criteria.hold().then(|| self.averaged(criteria)))
    }

    /// Short runs of the full system on the way; none of a body that is stiff, or whose losses have no equations of motion.
    pub fn probes(
        &self,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Option<&Probes>, StudyError> {
        if let Some(probes) = self.probes.get() {
            return Ok(probes.as_ref());
        }
        let slowest = frequencies(self.body)?.first().copied().unwrap_or(f64::INFINITY);
        let stiff = self.body.cyclic().is_empty() && norm(self.way.start.omega) < PROBED * slowest;
        let mut found = None;
        if !stiff && self.ground.complete(self.way.ends) {
            let Ground { body, range, poles, .. } = self.ground;
            let options = MeasureOptions { most_steps: PROBE_STEPS, ..MeasureOptions::default() };
            let probes = Probes::between(body, range, poles, self.way.ends, &options, &mut || watch(0.0));
            match probes {
                Ok(probes) => found = Some(probes),
                Err(MeasureError::Interrupted) => return Err(StudyError::Interrupted),
                Err(_) => {}
            }
        }
        Ok(self.probes.get_or_init(|| found).as_ref())
    }

    /// The average, with the error of its time.
    pub fn averaged(&self, criteria: AverageCriteria) -> ChosenMethod {
        let periods = self.ground.periods(self.way.ends).unwrap_or(f64::INFINITY);
        ChosenMethod::Average { error: criteria.time_error(periods) }
    }

    /// The response in the spinning frame; none of a body of many coordinates.
    pub fn spinning_frame(&self) -> Option<HillResponse> {
        let few = self.body.coordinates().len() <= FEW_COORDINATES;
        if few { HillResponse::compute(self.body).ok() } else { None }
    }

    /// A vibration that grows from nothing on the way, in words; none if none does.
    pub fn parametric(&self, hill: &HillResponse) -> Option<String> {
        let evolution = Evolution::new(hill, self.ground.range.angular_momentum());
        let [from, to] = self.way.ends;
        evolution.stages(from, to, LOOKS).find_map(|stage| {
            let motion = evolution.motion(stage);
            let resonance = hill.floquet(&motion).ok()?.resonance?;
            Some(format!(
                "Parametric resonance: at a wobble of {} degrees a vibration of {} at {} rad/s grows from nothing, e-fold in {}.",
                significant(motion.nutation()[1].to_degrees(), 3),
                resonance.coordinate,
                significant(resonance.frequency, 4),
                time(resonance.rate.recip())
            ))
        })
    }

    /// The average at the rates of the modes, for small wobbles.
    pub fn calibrated(&self, secular: &mut SecularEvolution) -> Result<ChosenMethod, Reason> {
        if !secular.viscoelastic {
            secular.take_harmonics();
        }
        let Ground { range, poles, .. } = self.ground;
        let power = CalibratedPower::new(secular.shared(), range.angular_momentum(), |mode| poles.rate(mode));
        if self.way.ends.iter().any(|stage| poles.rate(stage.mode).is_none_or(|rate| rate <= 0.0)) {
            return Err(Reason::NoRateOfModes);
        }
        let off = self.way.ends.map(|stage| (power.factor(stage.mode) - 1.0).abs());
        let off = off[0].max(off[1]);
        let wobble = self.way.ends.map(|stage| self.ground.motion(stage).nutation()[1]);
        let widest = wobble[0].max(wobble[1]);
        let error = off * (widest / WIDE).powi(2).min(1.0);
        if let Some(unstable) = self.ground.unstable() {
            return Err(Reason::Unstable(unstable));
        }
        if error > REFUSED {
            return Err(Reason::TooWideForModes { error: off, wobble: widest });
        }
        let liquids = self.ground.liquids(self.way.ends);
        if liquids > REFUSED {
            return Err(Reason::TooWideForLiquids { wobble: widest });
        }
        let least = if self.body.memories().is_empty() { LEAST } else { OF_LIQUIDS };
        Ok(ChosenMethod::Calibrated { power: Arc::new(power), error: error.max(least).max(liquids) })
    }
}
