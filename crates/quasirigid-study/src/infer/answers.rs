//! Answers of changed copies of a model against measured ones.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use quasirigid_io::model::{Source, System};
use quasirigid_io::study_file::Answer;

use super::data::MeasuredAnswer;
use crate::asked;

/// The measured quantities of a changed text of a model, or the reason why one has no value.
pub(super) fn values(
    source: &Source,
    text: &str,
    measured: &[MeasuredAnswer],
    system: System,
    cancelled: &Arc<AtomicBool>,
) -> Result<Vec<f64>, String> {
    let quantities = measured.iter().map(|each| each.quantity.clone()).collect();
    let asked = Answer { quantities, times: Vec::new(), system, percentiles: Vec::new() };
    let found = asked::answers(source, text, &asked, cancelled).ok_or_else(|| "interrupted".to_owned())?;
    let value = |each: &MeasuredAnswer| {
        found.number(&each.quantity).map_err(|(_, reason)| {
            let name = format!("`{}`", each.quantity.name);
            if reason.starts_with(&name) { reason } else { format!("{name}: {reason}") }
        })
    };
    measured.iter().map(value).collect()
}
