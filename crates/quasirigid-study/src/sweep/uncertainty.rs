//! Uncertainty of one evolution: the model's own uncertain keys are drawn, and the evolution of each draw is followed.
//! The draws form a Latin hypercube with a fixed seed, so that the same model gives the same intervals.

use std::fmt::Write;

use quasirigid_io::model::System;
use quasirigid_io::record::{IntervalRecord, QuantityRecord, UncertaintyRecord};
use quasirigid_io::study_file::{Answer, Command, Quantity, Sampling, StudyFile};
use quasirigid_io::table_file::CellColumn;

use super::{Sweep, SweepError, folder, summary};
use crate::layout::paragraph;
use crate::settings::{Setting, uncertainty_samples};
use crate::study::Study;
use crate::watch::Watch;
use crate::words::{significant, time};

/// Percentiles of the intervals of 68 and 95 %, about the median.
const PERCENTILES: [f64; 5] = [2.5, 16.0, 50.0, 84.0, 97.5];
const SEED: u64 = 0;

impl Study {
    /// Follows the evolution of the model for draws of its uncertain keys; none if the watch ended the work.
    ///
    /// # Errors
    /// [`SweepError::Setting`] for a number of draws out of range, [`SweepError::Certain`] for a model without `[uncertainty]`, and those of opening a study.
    pub fn uncertainty(
        &self,
        samples: usize,
        watch: &mut dyn Watch,
    ) -> Result<Option<UncertaintyRecord>, SweepError> {
        uncertainty_samples(Some(samples))?;
        let model = &self.model;
        if model.uncertainty.is_empty() {
            return Err(SweepError::Certain { file: model.source.file.clone() });
        }
        let quantity = |name: &str| Quantity {
            name: name.to_owned(),
            command: Command::Evolve,
            path: vec![name.to_owned()],
            span: 0..0,
        };
        let answer = Answer {
            quantities: ["time", "turns"].map(quantity).into(),
            times: Vec::new(),
            system: System::Reduced,
            percentiles: PERCENTILES.to_vec(),
        };
        let study = StudyFile {
            source: model.source.clone(),
            model: model.source.file.clone(),
            seed: SEED,
            samples,
            sampling: Sampling::LatinHypercube,
            part: samples,
            vary: model.uncertainty.clone(),
            table: None,
            columns: None,
            answer,
            former_names: Vec::new(),
        };
        let sweep = Sweep::new(study, model.source.clone(), watch)?;
        let Some(rows) = sweep.in_memory(watch)? else { return Ok(None) };
        let columns = folder::columns(&sweep, &rows);
        let wanted = |names: &[&str]| -> Result<Vec<CellColumn>, SweepError> {
            Ok(columns.iter().filter(|column| names.contains(&column.name.as_str())).cloned().collect())
        };
        let record = summary::summary(&sweep, &wanted)?;
        Ok(Some(UncertaintyRecord {
            samples: samples as u64,
            answered: record.status.get("answered").copied().unwrap_or(0),
            intervals: record.quantities.iter().filter_map(intervals).collect(),
            correlations: record.correlations.into_iter().filter(|each| each.quantity == "time").collect(),
            reasons: record.reasons,
        }))
    }

    /// A sentence for an answer from the stated values of uncertain keys, with the name that an interface has for the setting; none for
    /// a model without such keys.
    #[must_use]
    pub fn undrawn(&self, name: &dyn Fn(Setting) -> &'static str) -> Option<String> {
        let which = match self.model.uncertainty.len() {
            0 => return None,
            1 => "the key in [uncertainty] has its stated value".to_owned(),
            keys => format!("the {keys} keys in [uncertainty] have their stated values"),
        };
        Some(format!("{which}; {}, as 200, draws and gives intervals", name(Setting::UncertaintySamples)))
    }
}

fn intervals(quantity: &QuantityRecord) -> Option<IntervalRecord> {
    let values: Vec<f64> = quantity.percentiles.iter().map(|each| each.value).collect();
    let [least, lower, median, upper, greatest] = *<&[f64; 5]>::try_from(values.as_slice()).ok()?;
    Some(IntervalRecord {
        name: quantity.name.clone(),
        unit: quantity.unit.clone(),
        median,
        interval_68: [lower, upper],
        interval_95: [least, greatest],
    })
}

/// Intervals and deciding inputs, for a terminal of 80 columns.
#[must_use]
pub fn text(record: &UncertaintyRecord) -> String {
    let UncertaintyRecord { samples, answered, intervals, correlations, reasons } = record;
    let mut text = String::new();
    let mut line = |line: &str, first: &str| {
        let _ = writeln!(text, "{}", paragraph(line, first, "    ")); // a string takes any text
    };
    line(&format!("Uncertainty, from {samples} draws, {answered} of them answered:"), "  ");
    for interval in intervals {
        let shown = |value: f64| match interval.name.as_str() {
            _ if value.is_infinite() => "never".to_owned(),
            "time" => time(value),
            _ => significant(value, 3),
        };
        let range = |[least, greatest]: [f64; 2]| format!("{} to {}", shown(least), shown(greatest));
        let name = if interval.name == "turns" { "revolutions" } else { &interval.name };
        line(
            &format!(
                "{name}: 68 % within {}, 95 % within {}, median {}",
                range(interval.interval_68),
                range(interval.interval_95),
                shown(interval.median)
            ),
            "  ",
        );
    }
    let decides: Vec<String> =
        correlations.iter().filter_map(|each| Some(format!("{} {:+.2}", each.input, each.rho?))).collect();
    if !decides.is_empty() {
        line(&format!("rank correlation with the time: {}", decides.join(", ")), "  ");
    }
    for reason in reasons {
        line(&format!("{} without an answer: {}", reason.count, reason.example), "  ");
    }
    text
}
