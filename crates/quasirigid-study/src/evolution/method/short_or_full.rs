use std::cell::OnceCell;
use std::ops::ControlFlow;

use quasirigid::model::FlexibleBody;
use quasirigid::secular::{AverageCriteria, Probes};

use super::outlook::Outlook;
use super::start_and_end::Way;
use super::steady_spins::Ground;
use super::verdict::ChosenMethod;
use crate::evolution::reason::{Reason, Stop};
use crate::evolution::secular::SecularEvolution;

/// Revolutions up to which a history of the full system is chosen at once, and up to which it is tried where nothing else holds.
const FEW: f64 = 3_000.0;
pub const MANY: f64 = 200_000.0;
/// Decay in a period of the polhode up to which the power has a mean.
const DECAY: f64 = 0.05;

/// A choice between the methods.
pub struct Choice<'a> {
    pub body: &'a FlexibleBody,
    pub ground: &'a Ground<'a>,
    pub way: &'a Way,
    /// Longest time (s).
    pub duration: Option<f64>,
    /// What is known of the work ahead.
    pub outlook: &'a Outlook,
    /// Short runs of the full system, once made; none where they are not wanted.
    pub probes: OnceCell<Option<Probes>>,
}

impl<'a> Choice<'a> {
    pub fn new(ground: &'a Ground<'a>, way: &'a Way, duration: Option<f64>, outlook: &'a Outlook) -> Self {
        Self { body: ground.body, ground, way, duration, outlook, probes: OnceCell::new() }
    }

    pub fn criteria(&self, secular: &SecularEvolution) -> AverageCriteria {
        self.ground.criteria(secular.power(), self.way.ends)
    }

    /// The average that was asked for, marked where its criteria fail.
    pub fn forced_average(&self, secular: &SecularEvolution) -> ChosenMethod {
        let criteria = self.criteria(secular);
        if criteria.hold() { self.averaged(criteria) } else { ChosenMethod::Unfounded { criteria } }
    }

    /// The method that holds where the average does not.
    pub fn other(
        &self,
        secular: &mut SecularEvolution,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<ChosenMethod, Stop> {
        if !self.ground.complete(self.way.ends) {
            return Ok(self.calibrated(secular)?);
        }
        if let Some(road) = self.on_manifold(watch)? {
            return Ok(road);
        }
        let revolutions = self.ground.revolutions(self.way.ends);
        let fast = self.ground.haste(self.way.ends) > DECAY;
        if fast || self.whirls() || revolutions.is_some_and(|revolutions| revolutions <= FEW) {
            return self.announced_history(revolutions, watch);
        }
        if revolutions.is_none() {
            return Err(Reason::UnknownRevolutions.into());
        }
        self.announce_short_runs(watch)?;
        match self.measured(watch).map_err(Stop::from) {
            Err(Stop::Refused(_)) if revolutions.is_some_and(|revolutions| revolutions <= MANY) => {
                self.announced_history(revolutions, watch)
            }
            found => found,
        }
    }

    /// The history of the full system, if it takes no longer than is worked without being asked.
    fn announced_history(
        &self,
        revolutions: Option<f64>,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<ChosenMethod, Stop> {
        self.announce_history(revolutions, watch)?;
        self.short_history(watch)
    }

    /// Whether a motion beside the nutation grows at a pole of the way.
    pub fn whirls(&self) -> bool {
        self.way.ends.iter().any(|stage| {
            let pole = self.ground.poles.of_mode(stage.mode);
            pole.is_some_and(|pole| pole.modes.internal.iter().any(|[decay, _]| pole.grows(*decay)))
        })
    }
}
