//! What was measured: columns of a history, and answers of commands.

use quasirigid_io::estimate::{Amount, Estimate};
use quasirigid_io::measured_file::{MeasuredColumn, Measurements};
use quasirigid_io::model::System;
use quasirigid_io::study_file::Quantity;
use quasirigid_io::units::number_in;

use super::keys::Key;
use super::loss::Loss;
use super::{InferSettings, motions};
use crate::asked::unit;
use crate::error::StudyError;
use crate::study::Study;

/// Scatter of a column over its largest value below which it is exact: what is left is the error of the history.
const EXACT: f64 = 1e-6;

/// Measured answer of a command.
#[derive(Clone)]
pub(super) struct MeasuredAnswer {
    pub quantity: Quantity,
    pub value: f64,
    pub sigma: f64,
    pub unit: &'static str,
}

/// What was measured.
pub(super) struct Data {
    pub history: Option<Measurements>,
    /// Units of the columns of the history.
    pub units: Vec<String>,
    pub answers: Vec<MeasuredAnswer>,
}

impl Data {
    /// The measurements in the units of the model's own answers.
    pub fn new(
        study: &Study,
        history: Option<&Measurements>,
        asked: &InferSettings,
    ) -> Result<Self, StudyError> {
        let mut answers: Vec<MeasuredAnswer> = Vec::new();
        for estimate in &asked.measured {
            let one = answer(estimate)?;
            if answers.iter().any(|other| other.quantity.name == one.quantity.name) {
                return refuse(format!("{} is measured twice", estimate.name));
            }
            answers.push(one);
        }
        let (history, units) = match history {
            Some(history) => in_units(study, history.clone(), asked.system).map(|(a, b)| (Some(a), b))?,
            None => (None, Vec::new()),
        };
        Ok(Self { history, units, answers })
    }

    /// Number of measured values.
    pub fn count(&self) -> usize {
        self.history.as_ref().map_or(0, Measurements::count) + self.answers.len()
    }

    /// Whether a history misses its columns by no more than its own error, so that their scatter is no noise.
    pub fn is_exact(&self, residuals: &[f64]) -> bool {
        let Some(history) = self.history.as_ref().filter(|_| !self.has_deviations()) else { return false };
        let columns = history.columns.iter().zip(residuals.chunks_exact(history.t.len()));
        columns.fold(true, |all, (column, residuals)| all && is_exact(column, residuals))
    }

    /// Whether standard deviations are given.
    pub fn has_deviations(&self) -> bool {
        self.history.as_ref().is_none_or(Measurements::has_deviations)
    }

    /// Refuses data that are fewer than the keys, and what needs deviations where there are none.
    pub fn check(&self, keys: &[Key], asked: &InferSettings) -> Result<(), StudyError> {
        if self.count() == 0 {
            return refuse("nothing is measured: give a history or a measured answer".to_owned());
        }
        if !self.has_deviations() {
            let what = [
                (!self.answers.is_empty(), "measured answers"),
                (!asked.priors.is_empty(), "priors"),
                (asked.loss.kind != Loss::Squares, "a robust loss, whose scale is in deviations,"),
            ];
            if let Some((_, what)) = what.iter().find(|(is_there, _)| *is_there) {
                return refuse(format!(
                    "{what} beside a history without deviations: add sigma_ columns to it, or --sigma"
                ));
            }
        }
        if !(asked.loss.scale > 0.0) {
            return refuse(format!("the scale of a loss is {}, but must be positive", asked.loss.scale));
        }
        let priors = keys.iter().filter(|key| key.prior.is_some()).count();
        let (known, needed) = (self.count() + priors, keys.len() + usize::from(!self.has_deviations()));
        if keys.is_empty() || known < needed {
            return refuse(format!(
                "{} measured values for {} keys; give {needed} values or priors at least",
                self.count(),
                keys.len()
            ));
        }
        Ok(())
    }
}

/// Whether a history misses a column by no more than its own error.
pub(super) fn is_exact(column: &MeasuredColumn, residuals: &[f64]) -> bool {
    let missed = residuals.iter().enumerate().map(|(row, r)| (r * column.deviation(row)).powi(2));
    let largest = column.values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    (missed.sum::<f64>() / residuals.len() as f64).sqrt() <= EXACT * largest
}

fn refuse<T>(problem: String) -> Result<T, StudyError> {
    Err(StudyError::Infer { problem })
}

/// A measured answer in the unit in which its command prints it.
fn answer(estimate: &Estimate) -> Result<MeasuredAnswer, StudyError> {
    let quantity: Quantity = estimate
        .name
        .parse()
        .map_err(|error| StudyError::Infer { problem: format!("{}: {error}", estimate.name) })?;
    let own = unit(&quantity);
    let number = |amount: &Amount| {
        amount.in_unit(own).ok_or_else(|| StudyError::Infer {
            problem: if own.is_empty() {
                format!(
                    "{} is printed without a unit: give a plain number in place of {amount}",
                    estimate.name
                )
            } else {
                format!("{} is in {own}, and {amount} is something else", estimate.name)
            },
        })
    };
    let (value, sigma) = (number(&estimate.value)?, number(&estimate.sigma)?);
    Ok(MeasuredAnswer { value, sigma, unit: own, quantity })
}

/// A history in the units of the columns of the model's own, and these units.
fn in_units(
    study: &Study,
    mut data: Measurements,
    system: System,
) -> Result<(Measurements, Vec<String>), StudyError> {
    let known = motions::units(study, system)?;
    let mut units = Vec::new();
    for column in &mut data.columns {
        let own = known.iter().find(|(name, _)| *name == column.name).map(|(_, unit)| unit.as_str());
        units.push(own.unwrap_or_default().to_owned());
        let (Some(unit), Some(own)) = (column.unit.take(), own) else { continue };
        let factor = number_in(&format!("1 {unit}"), own).ok_or_else(|| StudyError::Infer {
            problem: format!("the data have {} in {unit}, and the history has it in {own}", column.name),
        })?;
        column.scale(factor);
    }
    Ok((data, units))
}
