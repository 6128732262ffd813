//! Verdict on the method of an evolution: its name, the source of its power, its reason and the error of the time in one sentence.
//! The sentence is closed only when all errors are known, so that it has one number: that of the method and of approximated shapes.
//! Criteria: (Q3), (Q7) and (Q9), docs/theory/16-methods.md.

use quasirigid::averaging::PowerSource;
use quasirigid::model::Mode;
use quasirigid::secular::choice::{AverageBasis, Followed, Method, Outcome};
use quasirigid::secular::{ManifoldBoundary, ManifoldHistory, MeasuredBy, MeasuredPower, Places};
use quasirigid_io::model::BodyKind;

use super::refusals::unfounded;
use crate::resolution::{NOTHING, known};
use crate::words::significant;

/// Reason for a history of the full system.
pub fn followed_fully(kind: BodyKind) -> String {
    format!("The full system was followed from start to end; the {} is its envelope.", kind.nutation())
}

/// Least relative error of a time that is stated.
const LEAST: f64 = 1e-6;

/// Verdict on a method.
#[derive(Clone, Debug, Default)]
pub struct Verdict {
    /// Reason for the method and limits of its validity.
    pub sentence: String,
    /// Source of the error of the time, in words that may be empty, until all errors are known and the sentence is closed with them; none where
    /// the sentence is complete without the error.
    pub error_source: Option<&'static str>,
    /// Estimate of the relative error of the time.
    pub error: Option<f64>,
    /// Whether the answer does not hold although it was asked for.
    pub fails: bool,
}

impl Verdict {
    /// Verdict on what was followed of a body of a kind.
    pub fn of(Followed { outcome, error, .. }: &Followed, kind: BodyKind) -> Self {
        let nutation = kind.nutation();
        let (sentence, error_source) = match outcome {
            Outcome::Average { basis: AverageBasis::Stiff | AverageBasis::UnderTorque, .. } => {
                (String::new(), None)
            }
            Outcome::Average { basis: AverageBasis::Fails(criteria), .. } => {
                (format!("THE AVERAGE DOES NOT HOLD: {}.", unfounded(*criteria, kind)), None)
            }
            Outcome::Average { basis: AverageBasis::Criteria, .. } | Outcome::SpinningFrame(_) => {
                ("Averaged along the polhode".into(), Some("the modes about the steady spins"))
            }
            Outcome::ModalRates(_) => (
                format!(
                    "Averaged at the rates that the modes about the steady spins have; the {nutation} is small enough for them"
                ),
                Some(""),
            ),
            Outcome::LevelCurves(_) => {
                let end = if error.is_some() { "" } else { "." };
                let sentence = format!(
                    "Two moments of inertia are equal, or elasticity changes their difference by more than 1 %: averaged along the level curves \
                     of the slow energy{end}"
                );
                (sentence, error.map(|_| "the modes about the steady spins"))
            }
            Outcome::SpinManifold(history) => (reduced(history, kind), Some("")),
            Outcome::Measured { power, .. } => (measured(power), Some("")),
            Outcome::FullSystem(_) => (followed_fully(kind), None),
        };
        let fails = matches!(outcome, Outcome::Average { basis: AverageBasis::Fails(_), .. });
        Self { sentence, error_source, error: *error, fails }
    }

    /// Closes the sentence with the error of the time: one number for the method and for the approximated shape or flow, since a time is as
    /// wrong as its power.
    pub fn with_shape_error(mut self, approximated: Option<(&str, f64)>) -> Self {
        let (what, shape) = (approximated.map(|(what, _)| what), approximated.map(|(_, error)| error));
        self.error = shape.map_or(self.error, |shape| Some(self.error.unwrap_or(0.0) + shape));
        let (source, error) = (self.error_source.take(), self.error.unwrap_or(0.0));
        let words = match (source, shape) {
            (None, None) => String::new(),
            (_, Some(_)) if !error.is_finite() => {
                format!("{} is approximated: {}.", what.unwrap_or_default(), known(error))
            }
            _ => {
                let approximation = what.map(|what| format!("the approximation of {what}"));
                let sources = approximation.into_iter().chain(source.map(str::to_owned));
                let sources: Vec<String> = sources.filter(|words| !words.is_empty()).collect();
                let by =
                    if sources.is_empty() { String::new() } else { format!("by {} ", sources.join(" and ")) };
                if error > 1.0 {
                    format!("{by}the time is not known: the change is within the error of the method.")
                } else {
                    format!("{by}the time is good to {} %.", significant(100.0 * error.max(LEAST), 2))
                }
            }
        };
        self.sentence = match source {
            Some(_) => format!("{}; {words}", self.sentence),
            None => format!("{} {}", self.sentence, capital(&words)).trim().into(),
        };
        if shape.is_some_and(|shape| shape > NOTHING) {
            self.fails = true;
            self.sentence = format!("THE SHAPE IS NOT RESOLVED. {}", self.sentence);
        }
        self
    }

    /// Closes the sentence of an evolution in which nothing is dissipated: there is no time that could be good to anything.
    pub fn without_time(self) -> Self {
        let end = if self.error_source.is_some() { "." } else { "" };
        Self { sentence: self.sentence + end, error_source: None, error: None, ..self }
    }

    /// Says first that the liquid of a tank does not stay where it has settled. (U9)
    pub fn of_other_spin(self, why: &str) -> Self {
        let sentence = format!("DOES NOT HOLD: {why} {}", self.sentence).trim().into();
        Self { sentence, fails: true, ..self }
    }

    /// Says first that a material is no solid, for which nothing here holds. (G16)
    pub fn of_no_solid(self, why: &str) -> Self {
        let sentence = format!("NO SOLID: {why}. {}", self.sentence).trim().into();
        Self { sentence, fails: true, ..self }
    }
}

/// Name of a method in records.
pub fn road(method: Method) -> &'static str {
    match method {
        Method::Average(_) | Method::SpinningFrame => "average",
        Method::ModalRates => "modes",
        Method::LevelCurves => "levels",
        Method::SpinManifold => "manifold",
        Method::PeriodicMotions => "periodic-motions",
        Method::MicroRuns => "micro-runs",
        Method::FullSystem => "direct",
    }
}

/// Source of the power of a method that follows it from start to end, in words; none of an average.
pub fn followed_power(method: Method, kind: BodyKind) -> Option<String> {
    let envelope = |followed: &str| {
        let nutation = kind.nutation();
        format!(
            "{followed} from start to end; the {nutation} is the envelope, that of a rigid body with the same energy"
        )
    };
    match method {
        Method::PeriodicMotions => Some("that of periodic motions of the full system along the way".into()),
        Method::MicroRuns => Some("measured by short runs of the full system along the way".into()),
        Method::LevelCurves => {
            Some("mean of the power of the reduced equations along level curves of the slow energy".into())
        }
        Method::SpinManifold => Some(envelope("the reduced equations about the spin")),
        Method::FullSystem => Some(envelope("the full system")),
        Method::Average(_) | Method::SpinningFrame | Method::ModalRates => None,
    }
}

/// Source of the power in words; of averages that of the power averaged, from reduced equations of an order.
pub fn source_of_power(method: Method, source: PowerSource, order: usize, kind: BodyKind) -> String {
    if let Some(words) = followed_power(method, kind) {
        return words;
    }
    match source {
        _ if method == Method::SpinningFrame => {
            "harmonics of the polhode in the spinning frame, coupled by its Coriolis and centrifugal forces"
                .into()
        }
        PowerSource::Polynomial => {
            format!("mean of the power of the reduced equations of order {order} along the polhode")
        }
        PowerSource::Harmonics => {
            "sum over the harmonics of the polhode, with every elastic mode, dashpot and material".into()
        }
    }
}

/// Reduced equations about a spin that were followed, and their range, in words.
fn reduced(ManifoldHistory { beside, range, .. }: &ManifoldHistory, kind: BodyKind) -> String {
    let beside = if beside.is_empty() {
        String::new()
    } else {
        format!(", with the motion of {}", beside.join(" and "))
    };
    format!(
        "The reduced equations about the spin were followed{beside}; they hold to a {} of {} degrees",
        kind.nutation(),
        significant(range.to_degrees(), 3)
    )
}

/// Sources of a measured power, in words.
fn measured(power: &MeasuredPower) -> String {
    let places = power.measurements.iter().filter(|each| each.by != MeasuredBy::SpinManifold).count();
    let edges: Vec<String> = power.boundaries.iter().map(handed).collect();
    if places == 0 {
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
    let source = match power.places {
        Places::PeriodicMotions => format!("that of {places} periodic motions"),
        Places::ShortRuns => format!("measured in {places} short runs"),
    };
    format!(
        "The internal parts are too massive or too compliant for averaging: the mean power was {within}{source} of the full system"
    )
}

/// Range within which the power is that of reduced equations about a spin, in words.
fn handed(boundary: &ManifoldBoundary) -> String {
    let ManifoldBoundary { mode, nutation, mismatch } = *boundary;
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
