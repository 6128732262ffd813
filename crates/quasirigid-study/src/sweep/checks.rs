//! Checks of a study before its long work: units of its keys against the model, and quantities against the answers of the first rows.

use std::time::Instant;

use quasirigid_io::model::{KeyPath, KeyValue, Model, ModelError};
use quasirigid_io::study_file::{Command, Quantity, Sampling, Values, Varied};
use quasirigid_io::table_file::CellKind;
use serde_json::Value;

use super::design::MOST_SOBOL_KEYS;
use super::distribution::quantile;
use super::plan::in_unit;
use super::{Output, Sweep, SweepError, is_drawn};
use crate::asked::{Answered, QuantityValue, answers_watched, find, unit};

/// Rows that are tried for a quantity.
const TRIED: u64 = 8;
/// Bodies whose values are tried for a column of a table.
const BODIES: usize = 20;

/// Refuses keys to whose values the model says no by their nature, such as a length for a mass: each alone in the model.
///
/// A model that is no model without the table or the study is not judged here; its rows say what is wrong with each. Returns notes on the
/// former names in the model.
pub(super) fn keys(sweep: &Sweep) -> Result<Vec<String>, SweepError> {
    let drawn = sweep.study.vary.iter().filter(|varied| is_drawn(&varied.values));
    if let (Sampling::Sobol, Some(over)) = (sweep.study.sampling, drawn.into_iter().nth(MOST_SOBOL_KEYS)) {
        let message = format!("a Sobol sequence draws at most {MOST_SOBOL_KEYS} keys");
        let refused = sweep.study.refuse(
            over.span.clone(),
            message,
            "one too many",
            Some("take latin-hypercube".to_owned()),
        );
        return Err(SweepError::File(refused));
    }
    let uncertain = sweep.bodies.as_ref().map_or(0, |bodies| bodies.uncertain() as usize);
    let drawn = sweep.study.vary.iter().filter(|varied| is_drawn(&varied.values)).count();
    if sweep.study.sampling == Sampling::Sobol && drawn + uncertain > MOST_SOBOL_KEYS {
        let message =
            format!("a Sobol sequence draws at most {MOST_SOBOL_KEYS} keys, with those of the table");
        let help = Some("take latin-hypercube".to_owned());
        return Err(SweepError::File(sweep.study.refuse(0..0, message, "too many", help)));
    }
    let all: Vec<_> = sweep.study.vary.iter().map(|varied| (varied.key.clone(), typical(varied))).collect();
    let former_names = match parsed(sweep, &[]) {
        Ok(former_names) => former_names,
        Err(error) if sweep.bodies.is_none() && parsed(sweep, &all).is_err() => {
            return Err(SweepError::Model(error));
        }
        Err(_) => return Ok(Vec::new()),
    };
    if parsed(sweep, &all).is_err() {
        for (varied, change) in sweep.study.vary.iter().zip(&all) {
            if let Err(error) = parsed(sweep, std::slice::from_ref(change)) {
                return Err(refused(sweep, varied.span.clone(), &varied.key.to_string(), &change.1, &error));
            }
        }
    }
    columns(sweep)?;
    Ok(former_names)
}

/// Refuses columns of which the model takes no value.
fn columns(sweep: &Sweep) -> Result<(), SweepError> {
    let (Some(bodies), Some(table)) = (&sweep.bodies, &sweep.study.table) else { return Ok(()) };
    for key in &bodies.keys {
        let given =
            (0..(bodies.rows() as usize).min(BODIES)).filter_map(|body| bodies.given(key, body, None).ok());
        let tried: Vec<_> =
            given.map(|given| (parsed(sweep, &[(key.key.clone(), given.clone())]), given)).collect();
        if let (Some((Err(error), given)), true) =
            (tried.first(), tried.iter().all(|(found, _)| found.is_err()))
        {
            let mapped = sweep.study.columns.iter().flatten().find(|column| column.key == key.key);
            let named = table.columns.iter().find(|column| column.name == key.name);
            let span = mapped.map(|column| column.span.clone()).or(named.map(|column| column.span.clone()));
            let span = span.unwrap_or_else(|| table.span.clone());
            return Err(refused(sweep, span, &format!("column {:?}, {}", key.name, key.key), given, error));
        }
    }
    Ok(())
}

/// A value of a varied key: the first of a grid, the median of a distribution.
fn typical(varied: &Varied) -> KeyValue {
    match &varied.values {
        Values::Grid(grid) => in_unit(grid.point(0), grid.unit()),
        Values::Drawn(drawn) => {
            in_unit(KeyValue::Number(quantile(&drawn.distribution, 0.5)), drawn.unit.as_deref())
        }
    }
}

/// Notes on former names in the text of the model with these changes, if that is a model.
fn parsed(sweep: &Sweep, changes: &[(KeyPath, KeyValue)]) -> Result<Vec<String>, ModelError> {
    let text = sweep.template.changed(changes).unwrap_or_default();
    Model::parse(&sweep.model.file, &text).map(|model| model.former_names)
}

fn refused(
    sweep: &Sweep,
    span: std::ops::Range<usize>,
    name: &str,
    given: &KeyValue,
    error: &ModelError,
) -> SweepError {
    let (message, help) = match error {
        ModelError::Invalid { diagnostics, .. } => diagnostics
            .first()
            .map_or_else(Default::default, |first| (first.message.clone(), first.help.clone())),
        other => (other.to_string(), None),
    };
    let message = format!("{name} = {given} is not a valid model: {message}");
    SweepError::File(sweep.study.refuse(span, message, "not for this key", help))
}

/// Columns of the answers, with the kinds that the first rows show.
///
/// A quantity that none of the first rows has is refused; where no row is answered the kinds stay those of numbers. Beside them the mean time
/// of those rows (s).
pub(super) fn outputs(sweep: &Sweep, watch: &mut dyn crate::Watch) -> Result<(Vec<Output>, f64), SweepError> {
    let asked = &sweep.study.answer;
    let mut kinds: Vec<Option<CellKind>> = vec![None; asked.quantities.len()];
    let mut absent: Vec<Option<String>> = vec![None; asked.quantities.len()];
    let mut there = vec![false; asked.quantities.len()];
    let tried = sweep.rows.min(TRIED);
    let (start, mut answered) = (Instant::now(), 0);
    for candidate in 0..tried {
        let row = if candidate == 0 { 0 } else { candidate * (sweep.rows / tried) };
        let Ok(text) = sweep.model_text(row) else { continue };
        let Some(found) = answers_watched(&sweep.model, &text, asked, watch) else {
            return Err(SweepError::Interrupted);
        };
        answered += 1;
        for (index, quantity) in asked.quantities.iter().enumerate() {
            let Some(Answered::Objects(objects, ..)) = found.commands.get(&quantity.command) else {
                continue;
            };
            let Some(object) = objects.first() else { continue };
            match find(quantity, object) {
                QuantityValue::Value(value) => {
                    there[index] = true;
                    let kind = kind_of(value).ok_or_else(|| compound(sweep, quantity, value))?;
                    kinds[index].get_or_insert(kind);
                }
                QuantityValue::Infinite | QuantityValue::Unknown => there[index] = true,
                QuantityValue::Absent(reason) => {
                    absent[index].get_or_insert(reason);
                }
                QuantityValue::Unclear(reason) => {
                    let refused = sweep.study.refuse(quantity.span.clone(), reason, "which one?", None);
                    return Err(SweepError::File(refused));
                }
            }
        }
        if kinds.iter().all(Option::is_some) {
            break;
        }
    }
    let row_time = start.elapsed().as_secs_f64() / f64::from(answered.max(1));
    for (index, quantity) in asked.quantities.iter().enumerate() {
        if let (false, Some(reason)) = (there[index], &absent[index]) {
            let help = (tried > 1).then(|| "none of the first rows has it".to_owned());
            return Err(SweepError::File(sweep.study.refuse(
                quantity.span.clone(),
                reason.clone(),
                "no such quantity",
                help,
            )));
        }
    }
    let columns = asked.quantities.iter().enumerate().flat_map(|(index, quantity)| {
        let times = if quantity.command == Command::Simulate { asked.times.len() } else { 0 };
        (0..times.max(1)).map(move |time| (index, quantity, time, times))
    });
    let output = |(index, quantity, time, times): (usize, &Quantity, usize, usize)| {
        let kind = kinds[index].unwrap_or(CellKind::Number);
        let name = if times == 0 {
            quantity.name.clone()
        } else {
            format!("{} at {}", quantity.name, asked.times[time].0)
        };
        let unit = if kind == CellKind::Number { unit(quantity).to_owned() } else { String::new() };
        Output { name, unit, kind, quantity: index, time }
    };
    Ok((columns.map(output).collect(), row_time))
}

/// Refuses columns of one name, and keys that are given twice.
pub(super) fn names(sweep: &Sweep) -> Result<(), SweepError> {
    let of_table = sweep.bodies.iter().flat_map(|bodies| bodies.keys.iter().map(|key| &key.key));
    let varied = sweep.study.vary.iter().map(|varied| &varied.key);
    let keys: Vec<&KeyPath> = of_table.chain(varied).collect();
    for (index, key) in keys.iter().enumerate() {
        if keys[..index].iter().any(|other| other.names().eq(key.names())) {
            return Err(SweepError::GivenTwice { key: key.to_string() });
        }
    }
    let inputs = sweep.inputs.iter().map(|input| input.name.as_str());
    let outputs = sweep.outputs.iter().map(|output| output.name.as_str());
    let all: Vec<&str> =
        ["row", "status", "reason", "note"].into_iter().chain(inputs).chain(outputs).collect();
    match (0..all.len()).find(|index| all[..*index].contains(&all[*index])) {
        Some(twice) => Err(SweepError::SameColumn { name: all[twice].to_owned() }),
        None => Ok(()),
    }
}

fn kind_of(value: &Value) -> Option<CellKind> {
    match value {
        Value::Bool(_) => Some(CellKind::Boolean),
        Value::Number(_) => Some(CellKind::Number),
        Value::String(_) => Some(CellKind::Text),
        _ => None,
    }
}

fn compound(sweep: &Sweep, quantity: &Quantity, value: &Value) -> SweepError {
    let (what, names): (&str, Vec<String>) = match value {
        Value::Array(items) => {
            ("a list", (1..=items.len().min(9)).map(|number| number.to_string()).collect())
        }
        Value::Object(entries) => ("a table", entries.keys().take(30).cloned().collect()),
        _ => ("no single value", Vec::new()),
    };
    let message = format!("`{}` is {what}; name one of its entries", quantity.name);
    let help = (!names.is_empty()).then(|| format!("the entries are {}", names.join(", ")));
    SweepError::File(sweep.study.refuse(quantity.span.clone(), message, what, help))
}
