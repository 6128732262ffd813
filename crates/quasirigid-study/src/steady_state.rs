//! The steady state of a body under moments with the modes about it: search, record and text.

use quasirigid::model::Marker;
use quasirigid::model::force::Force;
use quasirigid::modes::{SteadyModes, SteadyState, SteadyStateGuess, acts};
use quasirigid_io::model::{BodyKind, Rotation};
use quasirigid_io::record::SteadySpinRecord;
use quasirigid_math::vec3::norm;
use serde::Serialize;

use crate::error::StudyError;
use crate::liquids::unanswered;
use crate::motion::placed;
use crate::start::initial;
use crate::steady::{fate, fate_of, missing, recorded};
use crate::study::Study;
use crate::tanks;
use crate::words::{significant, tidied};

/// Entry for the axis in the record of a steady state under moments.
pub const UNDER_FORCES: &str = "under forces";
/// The same of a body at rest on which nothing acts.
pub const AT_REST: &str = "at rest";
/// Distance of a state from the place of the search from which the distance is mentioned (rad, share of the rate).
const AWAY: f64 = 0.1;

/// Record of a steady state under moments, or of its absence.
pub struct Told {
    pub record: SteadySpinRecord,
    /// Results beside those of every steady spin.
    pub state: Option<SteadyStateObject>,
}

/// Forces of a model, and the names of those that act in time alone and not at the start: about the start they change nothing.
pub fn at_start(study: &Study) -> (Vec<Force<Marker>>, Vec<String>) {
    let (asleep, acting): (Vec<_>, Vec<_>) =
        study.forces.iter().cloned().partition(|force| force.law.sleeps());
    (acting, asleep.into_iter().map(|force| force.name).collect())
}

/// Sentence on forces that do not act at the start; none without any.
pub fn asleep(names: &[String]) -> Option<String> {
    let list = names.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ");
    let (noun, verb) = if names.len() == 1 { ("The force", "does") } else { ("The forces", "do") };
    (!names.is_empty())
        .then(|| format!("{noun} {list} {verb} not act at the start: this is the body without."))
}

/// Place of the search: the angular velocity asked for, or the start of the file, at rest if the file has no rotation.
pub fn near(study: &Study, asked: Option<[f64; 3]>) -> Result<SteadyStateGuess, StudyError> {
    let Study { model, .. } = study;
    let omega = match (asked, model.initial.rotation) {
        (Some(omega), _) | (None, Some(Rotation::Spin(omega))) => omega,
        (None, Some(_)) => initial(study)?.omega,
        (None, None) => [0.0; 3],
    };
    let (place, velocity) = placed(study);
    Ok(SteadyStateGuess { omega, attitude: model.initial.attitude, place, velocity, asked: asked.is_some() })
}

/// The steady state next to a start with the modes about it, or the reason for its absence.
pub fn told(study: &Study, forces: &[Force<Marker>], near: SteadyStateGuess) -> Told {
    let found = SteadyState::near(&study.body, forces, near)
        .and_then(|state| SteadyModes::about(&study.body, forces, state));
    let refused = |why: String| Told {
        record: missing(UNDER_FORCES, format!("Under the forces: {why}.")),
        state: None,
    };
    match found {
        Ok(modes) => match silent(study, &modes) {
            Some(message) => refused(format!("no answer, since {message}")),
            None => Told { record: record(study, forces, &modes, near), state: Some(described(&modes)) },
        },
        Err(error) => refused(error.to_string()),
    }
}

/// Liquids of unknown response to the slowest oscillating mode, in words.
fn silent(study: &Study, modes: &SteadyModes) -> Option<String> {
    let swinging = modes.modes.iter().map(|mode| mode.frequency).filter(|frequency| *frequency > 0.0);
    unanswered(study, modes.state.omega, swinging.fold(f64::INFINITY, f64::min))
}

fn record(
    study: &Study,
    forces: &[Force<Marker>],
    modes: &SteadyModes,
    near: SteadyStateGuess,
) -> SteadySpinRecord {
    let state = &modes.state;
    let coordinates = study.body.coordinates().iter().zip(&state.q).take(study.body.elastic());
    SteadySpinRecord {
        sentence: tanks::warning(study, state.omega)
            .into_iter()
            .chain([sentence(modes, near, (study.model.kind, &subject(study, forces)))])
            .collect::<Vec<_>>()
            .join(" "),
        axis: if acts(&study.body, forces) { UNDER_FORCES } else { AT_REST }.into(),
        spin: Some(tidied(state.omega)),
        angular_momentum: Some(state.angular_momentum),
        energy: Some(state.energy),
        displacements: coordinates.map(|(coordinate, q)| (coordinate.name.clone(), *q)).collect(),
        stable: modes.stable(),
        modes: modes.modes.iter().map(|mode| recorded(mode, modes.seen_from_outside(mode))).collect(),
        slowest: None,
    }
}

/// Steady state under forces, for machines; the first paragraph of a field is the reference of `--json` in the guide.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct SteadyStateObject {
    /// Of the rotation (rad/s).
    pub rate: f64,
    /// Inertial; `null` at rest.
    pub axis: Option<[f64; 3]>,
    /// Quaternion.
    pub attitude: [f64; 4],
    /// Of the pole (m/s), inertial axes.
    pub velocity: [f64; 3],
    /// Angle from the start (rad).
    pub away: f64,
    /// Unusual motions that stay or drift.
    pub neutral: usize,
}

fn described(modes: &SteadyModes) -> SteadyStateObject {
    let state = &modes.state;
    SteadyStateObject {
        rate: norm(state.omega),
        axis: state.axis,
        attitude: state.attitude,
        velocity: state.velocity,
        away: state.away,
        neutral: modes.neutral,
    }
}

/// The steady state in words, without the forces that do not act at the start.
fn subject(study: &Study, forces: &[Force<Marker>]) -> String {
    let mut subject = "steady state under the forces".to_owned();
    if !acts(&study.body, forces) {
        subject = "state of rest".to_owned();
    }
    let asleep: Vec<String> = study
        .forces
        .iter()
        .filter(|force| force.law.sleeps())
        .map(|force| format!("{:?}", force.name))
        .collect();
    if !asleep.is_empty() {
        subject.push_str(&format!(" without {}, which does not act at the start,", asleep.join(", ")));
    }
    subject
}

/// Result of the steady state in words, instability first.
fn sentence(modes: &SteadyModes, near: SteadyStateGuess, (kind, subject): (BodyKind, &str)) -> String {
    let fastest = modes.modes.iter().min_by(|a, b| a.decay_rate.total_cmp(&b.decay_rate));
    let mut sentence = match fastest {
        Some(mode) if mode.grows() => {
            format!(
                "The {subject} is UNSTABLE: a motion of {} {}.",
                kind.mode_name(&mode.name),
                fate(mode.decay_rate)
            )
        }
        Some(mode) => format!(
            "No small motion about the {subject} {}: that of {} {}{}.",
            if mode.rate_bound > 0.0 { "is seen to grow" } else { "grows" },
            kind.mode_name(&mode.name),
            fate_of(mode),
            if mode.decay_rate > 0.0 { ", the slowest" } else { "" },
        ),
        None => format!("The {subject} has no modes."),
    };
    sentence.push_str(&rate(modes));
    if modes.neutral > 0 {
        let (motions, stay) = if modes.neutral == 1 { ("motion", "stays") } else { ("motions", "stay") };
        sentence.push_str(&format!(
            " Beside these {} {motions} {stay} or drift{}: such states form a family.",
            modes.neutral,
            if modes.neutral == 1 { "s" } else { "" },
        ));
    }
    let (rate, sought) = (norm(modes.state.omega), norm(near.omega));
    if (rate - sought).abs() > AWAY * rate.max(sought) {
        sentence.push_str(&format!(" It was looked for at {} rad/s.", significant(sought, 6)));
    }
    if modes.state.away > AWAY {
        let angle = significant(modes.state.away.to_degrees(), 3);
        sentence.push_str(&format!(" It is {angle} degrees from where it was looked for."));
    }
    sentence
}

/// Rotation of the body, in words.
fn rate(modes: &SteadyModes) -> String {
    let Some(axis) = modes.state.axis else { return " The body rests.".into() };
    let axis = tidied(axis).map(|component| significant(component, 4)).join(", ");
    format!(
        " The body turns at {} rad/s about ({axis}), inertial axes.",
        significant(norm(modes.state.omega), 6)
    )
}
