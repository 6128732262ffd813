//! Residuals of changed copies of a model: of the history, of the measured answers, and of what is known beforehand.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use quasirigid_io::model::{System, Template};
use rayon::prelude::*;

use super::data::Data;
use super::keys::Key;
use super::loss::{Loss, RobustLoss};
use super::{answers, motions};
use crate::error::StudyError;
use crate::study::Study;

/// What is made least, by the numbers of the keys over their scales.
pub(super) struct Problem<'a> {
    pub study: &'a Study,
    pub template: &'a Template,
    pub keys: &'a [Key],
    pub data: &'a Data,
    pub system: System,
    pub loss: RobustLoss,
    pub cancelled: &'a Arc<AtomicBool>,
    /// Number of models that were followed.
    pub models: AtomicUsize,
}

impl Problem<'_> {
    pub fn start(&self) -> Vec<f64> {
        self.keys.iter().map(Key::start).collect()
    }

    pub fn bounds(&self) -> Vec<[f64; 2]> {
        self.keys.iter().map(Key::bounds).collect()
    }

    /// Notes on the history of the file itself, whose errors are told, as are those of its answers.
    pub fn checked(&self) -> Result<Vec<String>, StudyError> {
        let text = self.text(&self.start())?;
        let notes = match &self.data.history {
            Some(data) => motions::checked(self.study, &text, data, self.system)?,
            None => Vec::new(),
        };
        if let (false, Err(reason)) = (self.data.answers.is_empty(), self.answers(&text)) {
            return Err(if self.cancelled.load(Ordering::Relaxed) {
                StudyError::Interrupted
            } else {
                StudyError::Infer { problem: format!("the model does not answer what is measured: {reason}") }
            });
        }
        Ok(notes)
    }

    /// Residuals over their deviations: columns of the history, answers, priors; none where the model or an answer does not exist.
    pub fn residuals(&self, point: &[f64]) -> Option<Vec<f64>> {
        if self.cancelled.load(Ordering::Relaxed) {
            return None;
        }
        self.models.fetch_add(1, Ordering::Relaxed);
        let text = self.text(point).ok()?;
        let mut residuals = match &self.data.history {
            Some(data) => {
                let work = || motions::residuals(self.study, &text, data, self.system);
                catch_unwind(AssertUnwindSafe(work)).ok()??
            }
            None => Vec::new(),
        };
        if !self.data.answers.is_empty() {
            let found = self.answers(&text).ok()?;
            let answers = self.data.answers.iter().zip(found);
            residuals.extend(answers.map(|(measured, found)| (found - measured.value) / measured.sigma));
        }
        residuals.extend(self.keys.iter().zip(point).filter_map(|(key, x)| key.prior(*x)));
        residuals.iter().all(|residual| residual.is_finite()).then_some(residuals)
    }

    /// Residuals whose squares are the losses; what is known beforehand counts as it is. (O19)
    pub fn losses(&self, point: &[f64]) -> Option<Vec<f64>> {
        let mut residuals = self.residuals(point)?;
        if self.loss.kind != Loss::Squares {
            let measured = self.data.count();
            residuals[..measured].iter_mut().for_each(|r| *r = self.loss.root(*r));
        }
        Some(residuals)
    }

    /// The losses at many points at once.
    pub fn all(&self, points: &[Vec<f64>]) -> Vec<Option<Vec<f64>>> {
        points.par_iter().map(|point| self.losses(point)).collect()
    }

    fn text(&self, point: &[f64]) -> Result<String, StudyError> {
        let changes = self.keys.iter().zip(point).map(|(key, x)| {
            let number = &key.number;
            (number.path.clone(), number.with(x * number.scale))
        });
        Ok(self.template.changed(&changes.collect::<Vec<_>>())?)
    }

    fn answers(&self, text: &str) -> Result<Vec<f64>, String> {
        let source = &self.study.model.source;
        answers::values(source, text, &self.data.answers, self.system, self.cancelled)
    }
}
