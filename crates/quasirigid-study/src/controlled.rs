//! Bodies under controllers and with hysteresis rods: the systems that carry them, and the answers that do not.
//! Equations (Y1) to (Y4) and (Y11), docs/theory/20-control.md.

use std::convert::Infallible;

use quasirigid::dynamics::{Forced, FullState, Observer, Options, Run, Start, propagate_controlled};
use quasirigid::model::Marker;
use quasirigid::model::control::Controls;
use quasirigid::model::force::Force;
use quasirigid_io::model::System;

use crate::error::StudyError;
use crate::motion::Motion;
use crate::study::Study;

impl Study {
    /// Refuses an answer that controllers take no part in.
    pub(crate) fn uncontrolled(&self, what: &'static str) -> Result<(), StudyError> {
        self.without_rods(what)?;
        if self.controls.is_empty() {
            return Ok(());
        }
        let names = self.controls.controllers.iter().map(|controller| controller.name.clone()).collect();
        Err(StudyError::Controlled { names, what })
    }

    /// Refuses an answer that hysteresis rods take no part in.
    pub(crate) fn without_rods(&self, what: &'static str) -> Result<(), StudyError> {
        if self.controls.rods.is_empty() {
            return Ok(());
        }
        let names = self.controls.rods.iter().map(|rod| rod.name.clone()).collect();
        Err(StudyError::Remembering { names, what })
    }
}

/// Accepts a system that carries the controllers of a study.
pub fn carries(study: &Study, system: System) -> Result<(), StudyError> {
    match system {
        System::Full | System::Rigid => Ok(()),
        System::Reduced => study.uncontrolled("the reduced system"),
        System::SpinManifold => study.uncontrolled("the system about a spin"),
    }
}

/// Note on the answers that are those of the body alone.
pub fn note(controls: &Controls) -> Option<String> {
    let names: Vec<&str> = controls.controllers.iter().map(|controller| &*controller.name).collect();
    let rods: Vec<&str> = controls.rods.iter().map(|rod| &*rod.name).collect();
    if !rods.is_empty() {
        let all = [names, rods].concat().join(", ");
        return Some(format!(
            "Controllers and hysteresis rods ({all}) act in histories of the full and the rigid system; checks, reduced equations and effective masses are those of the body without them."
        ));
    }
    (!names.is_empty()).then(|| {
        format!(
            "The controllers ({}) act in histories of the full and the rigid system and in linear models; checks, reduced equations and effective masses are those of the body without them.",
            names.join(", ")
        )
    })
}

/// Follows a body under its controllers, the rigid one as the full system of the body frozen at equilibrium.
pub fn follow(
    motion: &Motion,
    system: System,
    times: &[f64],
    options: &Options,
    observer: &mut dyn Observer,
) -> Result<Run, StudyError> {
    carries(motion.study(), system)?;
    let controls = &motion.study().controls;
    if system == System::Full {
        let start = motion.full()?;
        let run = propagate_controlled(motion.system(), controls, &start, times, options, observer);
        return run.map_err(|error| motion.study().told_of(error));
    }
    let body = motion.body.frozen();
    let forces: Vec<Force<Marker>> = motion.forces.iter().map(frozen).collect();
    let Start { omega, attitude, place, velocity } = motion.start;
    let start = FullState { place, velocity, ..FullState::at_rest(&body, omega, attitude) };
    let rigid = Forced { body: &body, forces: &forces };
    Ok(propagate_controlled(rigid, controls, &start, times, options, observer)?)
}

/// Force on the body frozen at equilibrium.
fn frozen(force: &Force<Marker>) -> Force<Marker> {
    match force.try_map(|place| Ok::<_, Infallible>(place.frozen())) {
        Ok(force) => force,
        Err(never) => match never {},
    }
}
