//! Answers of changed copies of a model against measured ones.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use quasirigid_io::model::{Source, System};
use quasirigid_io::study_file::Answer;
use serde_json::Value;

use super::data::MeasuredAnswer;
use crate::asked::{self, Answered, QuantityValue, Status};

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
        let quantity = &each.quantity;
        let no = |why: &str| Err(format!("`{}` {why}", quantity.name));
        match found.commands.get(&quantity.command) {
            Some(Answered::Objects(objects, Status::Answered, _)) => {
                match asked::find(quantity, objects.last().unwrap_or(&Value::Null)) {
                    QuantityValue::Value(value) => value.as_f64().map_or_else(|| no("is no number"), Ok),
                    QuantityValue::Infinite => no("is infinite"),
                    QuantityValue::Unknown => no("is not known"),
                    QuantityValue::Absent(reason) | QuantityValue::Unclear(reason) => Err(reason),
                }
            }
            Some(Answered::Objects(_, _, reason) | Answered::Nothing(_, reason)) => {
                Err(format!("`{}`: {reason}", quantity.name))
            }
            None => no("is not answered"),
        }
    };
    measured.iter().map(value).collect()
}
