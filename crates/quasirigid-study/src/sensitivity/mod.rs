//! Sensitivity of an answer to the numbers of a model: derivatives of one quantity with respect to keys of the file.
//! Every value is a whole answer on a changed copy of the model, so that any quantity of any command has derivatives; the differences are
//! extrapolated to a step of zero with an error estimate, and a quantity that has none is told as such. Equation (O1),
//! docs/theory/23-sensitivity.md.

mod changed;
mod text;

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use quasirigid_io::model::{KeyPath, WrittenNumber};
use quasirigid_io::study_file::Quantity;
use quasirigid_math::derivative::{Derivative, derivative};
use rayon::prelude::*;
use serde::Serialize;
use serde_json::{Value, json};

use crate::asked::{Status, unit};
use crate::error::StudyError;
use crate::study::Study;
use crate::watch::{Flagging, Watch, watched, whole_pool};
use changed::{Changed, Missing};

/// First step, relative to the key; halved until the error is small.
const FIRST: f64 = 1.0 / 64.0;
/// Error, relative to the quantity, at which no better is looked for.
const ENOUGH: f64 = 1e-11;
/// Errors and changes of slope above which there is no derivative: relative to it, and to the quantity.
const TRUSTED: f64 = 1e-3;
const NEGLIGIBLE: f64 = 1e-6;
/// Table of the file whose numbers are settings of the computation, varied only where a user names them.
const SETTINGS: &str = "run";

/// Sensitivity of a quantity; the first paragraph of a field is the reference of `--json` in the guide.
#[derive(Clone, Debug, Serialize)]
pub struct Sensitivity {
    /// Title of the model.
    pub name: String,
    /// The quantity.
    pub quantity: String,
    /// Its value.
    pub value: f64,
    /// Its unit; empty of a pure number.
    pub unit: String,
    /// What matters most, in words.
    pub sentence: String,
    /// Derivatives, the largest effect first.
    pub derivatives: Vec<KeyDerivative>,
    /// Keys without a derivative.
    pub not_known: Vec<NoDerivative>,
}

/// Derivative with respect to a key.
#[derive(Clone, Debug, Serialize)]
pub struct KeyDerivative {
    /// Path of the key.
    pub key: String,
    /// Value of the key, in its unit.
    pub value: f64,
    /// Unit of the key as the file writes it; empty of a plain number, which is in SI units.
    pub unit: String,
    /// Derivative of the quantity with respect to the key.
    pub derivative: f64,
    /// Derivative of the logarithm of the quantity with respect to that of the key; `null` if the quantity is zero.
    pub relative: Option<f64>,
    /// Estimate of the error of the derivative.
    pub error: f64,
    /// Size of the key that its effect is measured by: its own, of a zero that of the largest number beside it.
    #[serde(skip)]
    pub(crate) scale: f64,
}

/// Key with respect to which there is no derivative.
#[derive(Clone, Debug, Serialize)]
pub struct NoDerivative {
    /// Path of the key.
    pub key: String,
    /// The reason, in words.
    pub reason: String,
}

/// Outcome for a key.
enum Outcome {
    Known(KeyDerivative),
    NotKnown(NoDerivative),
    /// No value beside that of the file makes a model: a count, or a number that a law fixes.
    Fixed(NoDerivative),
}

impl Study {
    /// Derivatives of a quantity with respect to keys of the model: to all its numbers outside `[run]` if none are named.
    ///
    /// # Errors
    /// [`StudyError::Change`] for keys that do not exist, [`StudyError::NoNumber`] for those that are no numbers, [`StudyError::NoQuantity`] if
    /// the model does not answer.
    pub fn sensitivity(
        &self,
        quantity: &Quantity,
        keys: &[KeyPath],
        watch: &mut dyn Watch,
    ) -> Result<Sensitivity, StudyError> {
        let cancelled = Arc::default();
        let done = AtomicUsize::new(0);
        let order = self.order_given.then_some(self.order);
        let changed = Changed::new(&self.model.source, order, quantity, &cancelled)?;
        let numbers = chosen(&changed, keys)?;
        let started = Instant::now();
        let mut observer =
            Flagging { watch, cancelled: &cancelled, stage: "answering the file", share: &|| 0.0 };
        let at_file =
            watched(&mut observer, || changed.value(&[]).map_err(|missing| unanswered(quantity, missing)))?;
        if let Some(said) = text::outlook(numbers.len(), started.elapsed().as_secs_f64()) {
            watch.plan(&said);
        }
        let share = || done.load(Ordering::Relaxed) as f64 / numbers.len().max(1) as f64;
        let mut observer =
            Flagging { watch, cancelled: &cancelled, stage: "varying the keys", share: &share };
        let outcomes =
            watched(
                &mut observer,
                || Ok(whole_pool()?.install(|| each(&changed, at_file, &numbers, &done))),
            )?;
        let outcomes: Option<Vec<Outcome>> = outcomes.into_iter().collect();
        let outcomes = outcomes.ok_or(StudyError::Interrupted)?;
        let mut found = Sensitivity {
            name: self.model.name.clone(),
            quantity: quantity.name.clone(),
            value: at_file,
            unit: unit(quantity).to_owned(),
            sentence: String::new(),
            derivatives: Vec::new(),
            not_known: Vec::new(),
        };
        for outcome in outcomes {
            match outcome {
                Outcome::Known(derivative) => found.derivatives.push(derivative),
                Outcome::NotKnown(none) => found.not_known.push(none),
                Outcome::Fixed(none) if !keys.is_empty() => found.not_known.push(none),
                Outcome::Fixed(_) => (),
            }
        }
        let effect = |each: &KeyDerivative| (each.derivative * each.scale).abs();
        found.derivatives.sort_by(|a, b| effect(b).total_cmp(&effect(a)));
        found.sentence = found.told();
        Ok(found)
    }
}

/// The numbers of the keys, or all of the model.
fn chosen(changed: &Changed<'_>, keys: &[KeyPath]) -> Result<Vec<WrittenNumber>, StudyError> {
    if keys.is_empty() {
        let all = changed.template().numbers();
        return Ok(all.into_iter().filter(|each| each.path.names().next() != Some(SETTINGS)).collect());
    }
    let find = |key: &KeyPath| {
        let found = changed.template().number(key)?;
        found.ok_or_else(|| StudyError::NoNumber { key: key.to_string() })
    };
    keys.iter().map(find).collect()
}

fn unanswered(quantity: &Quantity, missing: Missing) -> StudyError {
    match missing {
        Missing::Cancelled => StudyError::Interrupted,
        Missing::No(_, reason) => StudyError::NoQuantity { name: quantity.name.clone(), reason },
    }
}

fn each(
    changed: &Changed<'_>,
    at_file: f64,
    numbers: &[WrittenNumber],
    done: &AtomicUsize,
) -> Vec<Option<Outcome>> {
    let one = |number: &WrittenNumber| {
        let outcome = of_key(changed, at_file, number);
        done.fetch_add(1, Ordering::Relaxed);
        outcome
    };
    numbers.par_iter().map(one).collect()
}

/// Outcome for a key; none if the work was cancelled.
fn of_key(changed: &Changed<'_>, at_file: f64, number: &WrittenNumber) -> Option<Outcome> {
    let key = number.path.to_string();
    let none = |reason: String| NoDerivative { key: key.clone(), reason };
    if number.scale == 0.0 {
        return Some(Outcome::NotKnown(none("it is zero, and nothing beside it gives its scale".to_owned())));
    }
    let (mut valid, mut reason, mut cancelled) = (false, String::new(), false);
    let found = derivative(at_file, FIRST, ENOUGH * at_file.abs(), |step| {
        if cancelled {
            return None;
        }
        let given = number.with(number.number + step * number.scale);
        match changed.value(&[(number.path.clone(), given)]) {
            Ok(value) => {
                valid = true;
                Some(value)
            }
            Err(Missing::Cancelled) => {
                cancelled = true;
                None
            }
            Err(Missing::No(status, why)) => {
                valid |= status != Status::Invalid;
                reason = why;
                None
            }
        }
    });
    if cancelled {
        return None;
    }
    Some(match found {
        None if valid => Outcome::NotKnown(none(format!("beside the file's value: {reason}"))),
        None => Outcome::Fixed(none(format!("no other value makes a model: {reason}"))),
        Some(found) => judged(found, at_file, number)
            .map_or_else(|reason| Outcome::NotKnown(none(reason)), Outcome::Known),
    })
}

/// The derivative with respect to a key from that with respect to the relative step, or why it is none.
fn judged(found: Derivative, at_file: f64, number: &WrittenNumber) -> Result<KeyDerivative, String> {
    let Derivative { value, error, corner, step } = found;
    let tolerated = (TRUSTED * value.abs()).max(NEGLIGIBLE * at_file.abs());
    if corner > tolerated {
        return Err(text::corner(value, corner, number.scale));
    }
    if error > tolerated {
        return Err(text::rough(step));
    }
    Ok(KeyDerivative {
        key: number.path.to_string(),
        value: number.number,
        unit: number.unit.clone().unwrap_or_default(),
        derivative: value / number.scale,
        relative: (at_file != 0.0).then(|| value / number.scale * number.number / at_file),
        error: error / number.scale,
        scale: number.scale,
    })
}

impl Sensitivity {
    /// For machines.
    #[must_use]
    pub fn json(&self) -> Value {
        json!(self)
    }
}
