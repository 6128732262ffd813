//! Verdict on the method of an evolution: its name, its reason, and the error of the time, in numbers and in one sentence.
//! The sentence is closed only when all errors are known, so that it has one number: that of the method and of approximated shapes.
//! Criteria: (Q3), (Q7) and (Q9), docs/theory/16-methods.md.

use std::sync::Arc;

use quasirigid::averaging::{LevelPassage, MeanPower};
use quasirigid::model::Mode;
use quasirigid::secular::{AverageCriteria, DirectRow, DirectRun, HandOver, ManifoldHistory, MeasuredPower};

use super::History;
use super::start_and_end::{Levels, Way};
use super::steady_spins::Ground;
use crate::evolution::refusals::unfounded;
use crate::evolution::secular::SecularEvolution;
use crate::resolution::{NOTHING, known};
use crate::words::significant;

/// Reason for a history of the full system.
pub const FOLLOWED: &str = "The full system was followed from start to end; the wobble is its envelope.";

/// Least relative error of a time that is stated.
const LEAST: f64 = 1e-6;

/// The method taken, with its reason, its error, and its results beside the power.
#[derive(Clone, Debug, Default)]
pub struct Verdict {
    /// `average`, `levels`, `modes`, `manifold`, `micro-runs`, `direct`, or `none`.
    pub road: &'static str,
    /// Reason for the method and limits of its validity.
    pub sentence: String,
    /// Source of the error of the time, in words that may be empty, until all errors are known and the sentence is closed with them.
    pub judge: Option<&'static str>,
    /// Estimate of the relative error of the time.
    pub error: Option<f64>,
    /// Rates (1/s) of the modes: growth about the axis of least inertia, decay about that of greatest.
    pub rates: Option<[Option<f64>; 2]>,
    /// Power or energy that each dissipator takes, where the method measures them.
    pub budget: Option<Vec<(String, f64)>>,
    /// A vibration that grows from nothing on the way, in words.
    pub parametric: Option<String>,
    /// Whether the answer does not hold although it was asked for.
    pub fails: bool,
}

impl Verdict {
    /// The average, with an estimate of its error.
    pub fn average(error: Option<f64>) -> Self {
        Self { road: "average", error, ..Self::default() }
    }

    /// Rates of the modes and the vibration that grows on the way, in a verdict otherwise blank.
    fn kept(&mut self) -> Self {
        Self { rates: self.rates, parametric: self.parametric.take(), ..Self::default() }
    }

    /// Marks an average that was asked for although its criteria fail.
    pub fn does_not_hold(&mut self, criteria: AverageCriteria) {
        self.sentence = format!("THE AVERAGE DOES NOT HOLD: {}.", unfounded(criteria));
        self.error = Some(criteria.error());
        self.fails = true;
    }

    /// Time (s) in which a small wobble about the axis of a mode changes by e, from the modes; none if the modes were not computed, not a
    /// number where their rates are not known.
    pub fn folding(&self, mode: Mode) -> Option<f64> {
        let rates = self.rates?;
        let rate = rates[usize::from(mode == Mode::ShortAxis)]?;
        Some(if rate > 0.0 || rate.is_nan() { rate.recip() } else { f64::INFINITY })
    }

    /// Closes the sentence with the error of the time: one number for the method and for the approximated shape or flow, since a time is as
    /// wrong as its power.
    pub fn close(&mut self, approximated: Option<(&str, f64)>) {
        let (what, shape) = (approximated.map(|(what, _)| what), approximated.map(|(_, error)| error));
        self.error = shape.map_or(self.error, |shape| Some(self.error.unwrap_or(0.0) + shape));
        let (judge, error) = (self.judge.take(), self.error.unwrap_or(0.0));
        let words = match (judge, shape) {
            (None, None) => String::new(),
            (_, Some(_)) if !error.is_finite() => {
                format!("{} is approximated: {}.", what.unwrap_or_default(), known(error))
            }
            _ => {
                let approximation = what.map(|what| format!("the approximation of {what}"));
                let judges = approximation.into_iter().chain(judge.map(str::to_owned));
                let judges: Vec<String> = judges.filter(|words| !words.is_empty()).collect();
                let by =
                    if judges.is_empty() { String::new() } else { format!("by {} ", judges.join(" and ")) };
                format!("{by}the time is good to {} %.", significant(100.0 * error.max(LEAST), 2))
            }
        };
        self.sentence = match judge {
            Some(_) => format!("{}; {words}", self.sentence),
            None => format!("{} {}", self.sentence, capital(&words)).trim().into(),
        };
        if shape.is_some_and(|shape| shape > NOTHING) {
            self.fails = true;
            self.sentence = format!("THE SHAPE IS NOT RESOLVED. {}", self.sentence);
        }
    }

    /// Says first that a material is no solid, for which nothing here holds. (G16)
    pub fn is_of_no_solid(&mut self, why: &str) {
        self.fails = true;
        self.sentence = format!("NO SOLID: {why}. {}", self.sentence).trim().into();
    }

    /// Source of the power, in words; none of an average.
    pub fn method(&self) -> Option<String> {
        match self.road {
            "micro-runs" => Some("measured by short runs of the full system along the way".into()),
            "levels" => Some("mean of the power of the reduced equations along level curves of the slow energy".into()),
            "manifold" => Some("the reduced equations about the spin from start to end; the wobble is the envelope, that of a rigid body with the same energy".into()),
            "direct" => Some("the full system from start to end; the wobble is the envelope, that of a rigid body with the same energy".into()),
            _ => None,
        }
    }
}

/// A method that leads to an answer.
pub enum ChosenMethod {
    /// The average, with the estimate of its error.
    Average { error: f64 },
    /// The average that was asked for, although it does not hold.
    Unfounded { criteria: AverageCriteria },
    /// The average at the rates of the modes.
    Calibrated { power: Arc<dyn MeanPower>, error: f64 },
    /// The power measured by short runs, after the full system has forgotten its start.
    Measured(Box<MeasuredPower>, Option<DirectRow>),
    /// The history of the reduced equations about the spin.
    Manifold(Box<ManifoldHistory>),
    /// The history of the full system.
    Direct(Box<DirectRun>),
    /// The average along levels of the slow energy.
    Levels(Box<LevelPassage>),
}

/// Takes a method: the power that is followed, or the history.
pub fn take(road: ChosenMethod, ground: &Ground, way: &Way, secular: &mut SecularEvolution) -> History {
    let named = |budget: &[f64]| Some(way.dissipators.iter().cloned().zip(budget.iter().copied()).collect());
    match road {
        ChosenMethod::Average { error } => {
            secular.begin(way.settled);
            secular.verdict = Verdict {
                road: "average",
                sentence: "Averaged along the polhode".into(),
                judge: Some("the modes about the steady spins"),
                error: Some(error),
                ..secular.verdict.kept()
            };
            History::None
        }
        ChosenMethod::Unfounded { criteria } => {
            secular.begin(way.settled);
            secular.verdict.does_not_hold(criteria);
            History::None
        }
        ChosenMethod::Calibrated { power, error } => {
            secular.begin(way.settled);
            secular.source = power;
            secular.verdict = Verdict {
                road: "modes",
                sentence: "Averaged at the rates that the modes about the steady spins have; the wobble is small enough for them"
                    .into(),
                judge: Some(""),
                error: Some(error),
                ..secular.verdict.kept()
            };
            History::None
        }
        ChosenMethod::Measured(power, settled) => {
            secular.verdict = Verdict {
                road: "micro-runs",
                sentence: measured(&power),
                judge: Some(""),
                error: Some(power.time_error(ground.periods(way.ends).unwrap_or(f64::INFINITY))),
                budget: power.measurements.first().and_then(|first| named(&first.budget)),
                ..secular.verdict.kept()
            };
            secular.take(Arc::new(*power), &ground.range, way.energies[0]);
            settled.map_or(History::None, |row| History::Settled(row, ground.range.clone()))
        }
        ChosenMethod::Manifold(history) => {
            secular.verdict = Verdict {
                road: "manifold",
                sentence: reduced(&history),
                judge: Some(""),
                error: Some(history.error),
                budget: named(&history.run.budget),
                ..secular.verdict.kept()
            };
            secular.take(Arc::new(Levels(ground.range.moments())), &ground.range, way.energies[0]);
            History::Full(Box::new(history.run), ground.range.clone())
        }
        ChosenMethod::Direct(run) => {
            secular.verdict = Verdict {
                road: "direct",
                sentence: FOLLOWED.into(),
                error: Some(run.energy_drift.abs() / (way.energies[0] - way.energies[1]).abs()),
                budget: named(&run.budget),
                ..secular.verdict.kept()
            };
            secular.take(Arc::new(Levels(ground.range.moments())), &ground.range, way.energies[0]);
            History::Full(run, ground.range.clone())
        }
        ChosenMethod::Levels(passage) => {
            secular.verdict = Verdict {
                road: "levels",
                sentence: "Elasticity changes a difference of the moments of inertia by more than 1 %: averaged along the level curves of the slow energy.".into(),
                parametric: None,
                ..secular.verdict.kept()
            };
            History::Levels(passage)
        }
    }
}

/// Reduced equations about a spin that were followed, and their range, in words.
fn reduced(ManifoldHistory { beside, range, .. }: &ManifoldHistory) -> String {
    let beside = if beside.is_empty() {
        String::new()
    } else {
        format!(", with the motion of {}", beside.join(" and "))
    };
    format!(
        "The reduced equations about the spin were followed{beside}; they hold to a nutation of {} degrees",
        significant(range.to_degrees(), 3)
    )
}

/// Sources of a measured power, in words.
fn measured(power: &MeasuredPower) -> String {
    let runs = power.measurements.iter().filter(|each| !each.reduced).count();
    let edges: Vec<String> = power.hand_overs.iter().map(handed).collect();
    if runs == 0 {
        return format!(
            "The internal parts are too massive or too compliant for averaging: the mean power was taken from the reduced equations about the \
             spin, which hold {}",
            edges.join(", ")
        );
    }
    let within = if edges.is_empty() {
        String::new()
    } else {
        format!("taken from the reduced equations about the spin {}, and elsewhere ", edges.join(", "))
    };
    format!(
        "The internal parts are too massive or too compliant for averaging: the mean power was {within}measured in {runs} short runs of the \
         full system"
    )
}

/// Range within which the power is that of reduced equations about a spin, in words.
fn handed(hand_over: &HandOver) -> String {
    let HandOver { mode, nutation, mismatch } = *hand_over;
    let axis = if mode == Mode::ShortAxis { "greatest" } else { "least" };
    let differs = if mismatch == 0.0 {
        String::new()
    } else {
        format!(", where both differ by {} %", significant(100.0 * mismatch, 2))
    };
    format!("to {} degrees about the axis of {axis} inertia{differs}", significant(nutation.to_degrees(), 3))
}

fn capital(words: &str) -> String {
    let mut letters = words.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
