//! Evolution of a body with momentum wheels of constant speed: its energy falls at constant `|K|` to that of a steady spin, whose axis need
//! not be a principal one.
//! Equations (Q15) and (Q16), docs/theory/16-methods.md.

mod answer;
mod attracting_spin;
mod full_system;
mod methods;
mod record;

use quasirigid::dynamics::Start;
use quasirigid_io::model::Target;
use quasirigid_math::vec3::norm;

use super::outlook::Outlook;
use super::reason::Reason;
use super::{Evolved, approximated, slow_torque};
use crate::error::StudyError;
use crate::materials::flowing_at;
use crate::motion::Motion;
use crate::settings::EvolveSettings;
use crate::study::Study;
use crate::watch::Watch;
use answer::Answer;
use attracting_spin::AttractingSpin;

/// Follows a body with momentum wheels from a start.
pub fn follow(
    study: &Study,
    start: Start,
    asked: &EvolveSettings,
    observer: &mut dyn Watch,
) -> Result<Evolved, StudyError> {
    check(study, asked)?;
    let full = Motion::new(study, start).full()?;
    let G = norm(full.angular_momentum(&study.body));
    let refused = |reason: &Reason, rate| Evolved {
        record: record::refused(reason, rate, G, study.model.kind),
        notes: Vec::new(),
    };
    let changing = study.body.wheels().driven.iter().any(|wheel| wheel.speed.uses(0));
    let no_solid = || flowing_at(study, start.omega).map(Reason::NoSolid);
    if let Some(reason) = changing.then_some(Reason::ChangingWheel).or_else(no_solid) {
        return Ok(refused(&reason, None));
    }
    let mut outlook = Outlook::new(observer, asked.method.is_some());
    let spin = match AttractingSpin::of(study, &full) {
        Ok(spin) => spin,
        Err(stop) => return Ok(refused(&Reason::of(stop)?, None)),
    };
    let answer = match methods::chosen(&spin, &full, asked, &mut outlook) {
        Ok(answer) => answer,
        Err(stop) => return Ok(refused(&outlook.reason(stop)?, spin.rate())),
    };
    let verdict = answer.verdict.clone().with_shape_error(approximated(study));
    Ok(Evolved { record: record::answered(Answer { verdict, ..answer }, asked), notes: Vec::new() })
}

/// Refuses what has no meaning for a body with momentum wheels.
fn check(study: &Study, asked: &EvolveSettings) -> Result<(), StudyError> {
    let what = if !slow_torque(study)?.is_zero() {
        "it is followed without a torque"
    } else if asked.start.is_some() {
        "it starts from the initial state of the model"
    } else if matches!(asked.until, Some(Target::Ratio(_))) {
        "it goes to an angle, as \"5 deg\", from the steady spin that attracts: D/I3 says nothing of a body with stored angular momentum"
    } else {
        return Ok(());
    };
    Err(StudyError::Wheels { what })
}
