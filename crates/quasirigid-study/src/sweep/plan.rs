//! Plan of the rows: the table of bodies times the grids, the first key slowest, times the draws.

use quasirigid_io::model::{KeyPath, KeyValue};
use quasirigid_io::study_file::{Grid, StudyFile, Values};
use quasirigid_io::table_file::CellKind;

use super::bodies::Bodies;
use super::cell::Cell;
use super::distribution::quantile;
use super::{Column, MOST_ROWS, Sweep, is_drawn};

/// Number of rows of a study; none if they are too many.
pub(super) fn rows(study: &StudyFile, bodies: Option<&Bodies>) -> Option<u64> {
    let grids = study.vary.iter().filter_map(|varied| match &varied.values {
        Values::Grid(grid) => Some(grid.len() as u64),
        Values::Drawn(_) => None,
    });
    let mut factors = grids.chain([bodies.map_or(1, Bodies::rows), study.samples as u64]);
    factors.try_fold(1u64, u64::checked_mul).filter(|rows| *rows <= MOST_ROWS)
}

/// Columns of the inputs: keys of the table, columns that it carries through, keys that are varied.
pub(super) fn inputs(study: &StudyFile, bodies: Option<&Bodies>) -> Vec<Column> {
    let of_table = bodies.into_iter().flat_map(|bodies| {
        let keys = bodies.keys.iter().map(|key| Column {
            name: key.name.clone(),
            unit: key.unit.clone().unwrap_or_default(),
            kind: key.kind,
            key: true,
        });
        let kept = bodies.kept.iter().map(|(name, _)| Column {
            name: name.clone(),
            unit: String::new(),
            kind: CellKind::Text,
            key: false,
        });
        keys.chain(kept).collect::<Vec<_>>()
    });
    let varied = study.vary.iter().map(|varied| Column {
        name: varied.key.to_string(),
        unit: varied.values.unit().unwrap_or_default().to_owned(),
        kind: kind(&varied.values),
        key: true,
    });
    of_table.chain(varied).collect()
}

fn kind(values: &Values) -> CellKind {
    let number = |value: &KeyValue| matches!(value, KeyValue::Number(_) | KeyValue::Integer(_));
    match values {
        Values::Grid(Grid::List(list)) if list.iter().all(|value| matches!(value, KeyValue::Bool(_))) => {
            CellKind::Boolean
        }
        Values::Grid(Grid::List(list)) if !list.iter().all(number) => CellKind::Text,
        _ => CellKind::Number,
    }
}

/// Keys with their values in a row.
pub(super) fn changes(sweep: &Sweep, row: u64) -> Result<Vec<(KeyPath, KeyValue)>, String> {
    let mut changes = match &sweep.bodies {
        Some(bodies) => bodies.changes(body(sweep, row), &|number| drawn(sweep, row, number))?,
        None => Vec::new(),
    };
    let values = values(sweep, row);
    changes.extend(
        sweep
            .study
            .vary
            .iter()
            .zip(values)
            .map(|(varied, value)| (varied.key.clone(), in_unit(value, varied.values.unit()))),
    );
    Ok(changes)
}

/// Cells of the inputs of a row.
pub(super) fn cells(sweep: &Sweep, row: u64) -> Vec<Cell> {
    let draw = |number| drawn(sweep, row, number);
    let of_table =
        sweep.bodies.as_ref().map_or_else(Vec::new, |bodies| bodies.cells(body(sweep, row), &draw));
    let varied = sweep.study.vary.iter().zip(values(sweep, row)).map(|(varied, value)| match value {
        KeyValue::Number(number) => Cell::Number(number),
        KeyValue::Integer(integer) if kind(&varied.values) == CellKind::Number => {
            Cell::Number(integer as f64)
        }
        KeyValue::Bool(truth) if kind(&varied.values) == CellKind::Boolean => Cell::Boolean(truth),
        KeyValue::Text(text) => Cell::Text(text),
        other => Cell::Text(other.to_string()),
    });
    of_table.into_iter().chain(varied).collect()
}

/// A number as it is handed to the model, with its unit.
pub(super) fn in_unit(value: KeyValue, unit: Option<&str>) -> KeyValue {
    match (value, unit) {
        (KeyValue::Number(number), Some(unit)) => KeyValue::Text(format!("{number:?} {unit}")),
        (value, _) => value,
    }
}

/// Index of the body of a row.
fn body(sweep: &Sweep, row: u64) -> usize {
    let rows = sweep.bodies.as_ref().map_or(1, Bodies::rows);
    usize::try_from(row / (sweep.rows / rows)).unwrap_or(usize::MAX)
}

/// Number between 0 and 1 from which a row draws an uncertain key of the table, behind those that the study draws.
fn drawn(sweep: &Sweep, row: u64, number: u32) -> f64 {
    let varied = sweep.study.vary.iter().filter(|varied| is_drawn(&varied.values)).count() as u32;
    sweep.design.at(row, varied + number)
}

/// Values of the varied keys in a row, numbers without their units.
fn values(sweep: &Sweep, row: u64) -> Vec<KeyValue> {
    let mut rest = row / sweep.design.samples;
    let drawn = sweep.study.vary.iter().filter(|varied| is_drawn(&varied.values)).count() as u32;
    let mut key = drawn;
    let mut values: Vec<KeyValue> = Vec::with_capacity(sweep.study.vary.len());
    for varied in sweep.study.vary.iter().rev() {
        values.push(match &varied.values {
            Values::Grid(grid) => {
                let count = grid.len() as u64;
                let index = usize::try_from(rest % count).unwrap_or(0);
                rest /= count;
                grid.point(index)
            }
            Values::Drawn(law) => {
                key -= 1;
                KeyValue::Number(quantile(&law.distribution, sweep.design.at(row, key)))
            }
        });
    }
    values.reverse();
    values
}
