//! Evolution of a body with momentum wheels of constant speed: its energy falls at constant `|K|` to that of a steady spin, whose axis need
//! not be a principal one.
//! Equations (Q15) and (Q16), docs/theory/16-methods.md.

mod answer;
mod full_system;
mod ground;
mod record;
mod roads;

use quasirigid::averaging::SlowTorque;
use quasirigid::dynamics::Start;
use quasirigid_io::model::Target;
use quasirigid_math::vec3::norm;

use super::method::{Outlook, Refusal};
use super::{Asked, Evolved, approximated};
use crate::error::StudyError;
use crate::materials::flowing_at;
use crate::motion::Motion;
use crate::study::Study;
use crate::watch::Watch;
use ground::Ground;

/// Follows a body with momentum wheels from a start.
pub fn follow(
    study: &Study,
    start: Start,
    asked: &Asked,
    observer: &mut dyn Watch,
) -> Result<Evolved, StudyError> {
    check(study, asked)?;
    let full = Motion::new(study, start).full()?;
    let G = norm(full.angular_momentum(&study.body));
    let refused = |refusal: Refusal| Evolved { record: record::refused(refusal, G), notes: Vec::new() };
    let changing = study.body.wheels().driven.iter().any(|wheel| wheel.speed.uses(0));
    let why = changing.then(|| CHANGING.to_owned()).or_else(|| flowing_at(study, start.omega));
    if let Some(message) = why {
        return Ok(refused(Refusal { message, rates: None }));
    }
    let outlook = Outlook::new(asked.method.is_some());
    let mut watch = |share: f64| outlook.observe(observer, share);
    let ground = match Ground::of(study, &full)? {
        Ok(ground) => ground,
        Err(message) => return Ok(refused(Refusal { message, rates: None })),
    };
    let found = roads::choose(&ground, &full, asked, &outlook, &mut watch);
    let refusal = |message| Refusal { message, rates: Some([None, ground.rate()]) };
    let spent = outlook.over() && matches!(found, Err(StudyError::Interrupted));
    let mut answer = match if spent { Err(Outlook::spent()) } else { found? } {
        Ok(answer) => answer,
        Err(message) => return Ok(refused(refusal(message))),
    };
    answer.verdict.close(approximated(study));
    Ok(Evolved { record: record::answered(answer, asked), notes: Vec::new() })
}

/// Reason why wheels that change their speed have no evolution.
const CHANGING: &str = "a momentum wheel changes its speed: its motor works on the body, whose energy then need not fall, and no steady spin is \
                        reached by itself; `simulate` follows the history";

/// Refuses what has no meaning for a body with momentum wheels.
fn check(study: &Study, asked: &Asked) -> Result<(), StudyError> {
    let what = if !SlowTorque::from_forces(&study.forces)?.is_zero() {
        "it is followed without a torque"
    } else if asked.from.is_some() {
        "it starts from the initial state of the model"
    } else if matches!(asked.until, Some(Target::Ratio(_))) {
        "it goes to a wobble, as \"5 deg\", about the steady spin that attracts: D/I3 says nothing of a body with stored angular momentum"
    } else {
        return Ok(());
    };
    Err(StudyError::Wheels { what })
}
