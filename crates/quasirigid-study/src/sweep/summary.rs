//! Summary of a study: statistics of each quantity, rank correlations with each input, and reasons of the rows without an answer.
//! Columns are read one by one from the parts, so that the summary of 10⁸ rows needs memory for two columns.

use std::collections::BTreeMap;

use quasirigid_io::record::{
    CorrelationRecord, InputRecord, Ordered, PercentileRecord, QuantityRecord, ReasonRecord, SweepRecord,
    by_rate, growth_rate,
};
use quasirigid_io::study_file::{Grid, Values};
use quasirigid_io::table_file::{CellColumn, CellKind, Cells};

use super::folder::{Folder, kind_word};
use super::rank::spearman;
use super::{Column, Output, Sweep, SweepError};
use quasirigid_io::model::KeyValue;

/// Texts whose frequencies are listed.
const LISTED: usize = 50;

/// Source of the columns of a study, by name.
pub(super) type Read<'r> = &'r dyn Fn(&[&str]) -> Result<Vec<CellColumn>, SweepError>;

/// Summary of a folder with all its parts.
pub(super) fn of_folder(sweep: &Sweep, folder: &Folder<'_>) -> Result<SweepRecord, SweepError> {
    summary(sweep, &|wanted| folder.read(wanted))
}

/// Summary of columns.
pub(super) fn summary(sweep: &Sweep, read: Read<'_>) -> Result<SweepRecord, SweepError> {
    let mut quantities = Vec::new();
    let mut correlations = Vec::new();
    for output in &sweep.outputs {
        let Some(column) = one(read, &output.name)? else { continue };
        quantities.push(statistics(output, &column.cells, &sweep.study.answer.percentiles));
        let Cells::Numbers(values) = &column.cells else { continue };
        let mut found = Vec::new();
        for input in sweep.inputs.iter().filter(|input| input.key && input.kind == CellKind::Number) {
            if let Some(CellColumn { cells: Cells::Numbers(given), .. }) = one(read, &input.name)? {
                found.push(correlation(input, output, &given, values));
            }
        }
        let size = |record: &CorrelationRecord| record.rho.map_or(-1.0, f64::abs);
        found.sort_by(|a, b| size(b).total_cmp(&size(a)));
        correlations.extend(found);
    }
    let (status, reasons) = reasons(read)?;
    Ok(SweepRecord {
        version: env!("CARGO_PKG_VERSION").into(),
        name: name(sweep),
        sha256: sweep.sha256.clone(),
        files: sweep.files.clone(),
        notes: sweep.notes().to_vec(),
        study: sweep.study.source.text.clone(),
        model: sweep.model.text.clone(),
        rows: sweep.rows,
        status,
        inputs: sweep.inputs.iter().map(|input| of_input(sweep, input)).collect(),
        quantities,
        correlations,
        reasons,
    })
}

/// Name of a study: that of its file, or of the folder of a file called `study.toml`.
pub(super) fn name(sweep: &Sweep) -> String {
    let file = &sweep.study.source.file;
    let folder = file
        .parent()
        .and_then(|parent| parent.file_name())
        .filter(|_| file.file_stem() == Some("study".as_ref()));
    folder.or(file.file_stem()).unwrap_or_default().to_string_lossy().into_owned()
}

fn one(read: Read<'_>, name: &str) -> Result<Option<CellColumn>, SweepError> {
    Ok(read(&[name])?.into_iter().next())
}

fn of_input(sweep: &Sweep, input: &Column) -> InputRecord {
    let varied = sweep.study.vary.iter().find(|varied| varied.key.to_string() == input.name);
    let (kind, grid) = match varied.map(|varied| &varied.values) {
        None if input.key => ("table", None),
        None => ("carried", None),
        Some(Values::Drawn(_)) => ("distribution", None),
        Some(Values::Grid(grid @ Grid::List(_))) => ("list", Some(grid)),
        Some(Values::Grid(grid)) => ("grid", Some(grid)),
    };
    let number = |given: KeyValue| match given {
        KeyValue::Number(number) => Some(number),
        KeyValue::Integer(integer) => Some(integer as f64),
        _ => None,
    };
    let points =
        grid.map_or_else(Vec::new, |grid| (0..grid.len()).filter_map(|i| number(grid.point(i))).collect());
    let geometric = matches!(grid, Some(Grid::Numbers { geometric: true, .. }));
    let of_table = sweep.bodies.iter().flat_map(|bodies| &bodies.keys);
    let key = of_table.filter(|key| key.name == input.name).map(|key| key.key.to_string()).next();
    let key = key.or(varied.map(|varied| varied.key.to_string())).unwrap_or_default();
    InputRecord {
        name: input.name.clone(),
        key,
        unit: input.unit.clone(),
        kind: kind.into(),
        points,
        geometric,
    }
}

fn statistics(output: &Output, cells: &Cells, percents: &[f64]) -> QuantityRecord {
    let (values, counts) = match cells {
        Cells::Numbers(values) => (values.iter().flatten().copied().collect(), BTreeMap::new()),
        Cells::Booleans(values) => (Vec::new(), counted(values.iter().flatten().map(bool::to_string))),
        Cells::Texts(values) => (Vec::new(), counted(values.iter().flatten().cloned())),
        Cells::Counts(_) => (Vec::new(), BTreeMap::new()),
    };
    let by_rate = by_rate(&output.name, &values);
    let sorted = Ordered::new(&output.name, values);
    let finite: Vec<f64> = sorted.values().filter(|value| value.is_finite()).collect();
    let (rows, count) = match cells {
        Cells::Numbers(all) => (all.len(), sorted.len()),
        Cells::Booleans(all) => (all.len(), all.iter().flatten().count()),
        Cells::Texts(all) => (all.len(), all.iter().flatten().count()),
        Cells::Counts(all) => (all.len(), all.len()),
    };
    let percentile = |percent: &f64| {
        sorted.percentile(*percent).map(|value| PercentileRecord { percent: *percent, value })
    };
    QuantityRecord {
        name: output.name.clone(),
        unit: output.unit.clone(),
        kind: kind_word(output.kind).into(),
        count: count as u64,
        nulls: (rows - count) as u64,
        infinite: (sorted.len() - finite.len()) as u64,
        percentiles: percents.iter().filter_map(percentile).collect(),
        // the sum of numbers near the largest would overflow
        mean: (!finite.is_empty() && !by_rate)
            .then(|| finite.iter().map(|value| value / finite.len() as f64).sum()),
        min: finite.first().copied(),
        max: finite.last().copied(),
        counts,
    }
}

fn counted(texts: impl Iterator<Item = String>) -> BTreeMap<String, u64> {
    let mut all: BTreeMap<String, u64> = BTreeMap::new();
    texts.for_each(|text| *all.entry(text).or_default() += 1);
    let mut listed: Vec<(String, u64)> = all.into_iter().collect();
    listed.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    listed.truncate(LISTED);
    listed.into_iter().collect()
}

fn correlation(
    input: &Column,
    output: &Output,
    given: &[Option<f64>],
    values: &[Option<f64>],
) -> CorrelationRecord {
    let of_values: Vec<f64> = values.iter().flatten().copied().collect();
    let by_rate = by_rate(&output.name, &of_values);
    let place = |value: f64| if by_rate { growth_rate(value) } else { value };
    let pairs: Vec<(f64, f64)> =
        given.iter().zip(values).filter_map(|(x, y)| Some(((*x)?, place((*y)?)))).collect();
    let (rho, p) = spearman(&pairs);
    CorrelationRecord {
        input: input.name.clone(),
        quantity: output.name.clone(),
        rho,
        rows: pairs.len() as u64,
        p,
    }
}

/// Rows by status, and the reasons of those that are not answered, with their numbers masked.
fn reasons(read: Read<'_>) -> Result<(BTreeMap<String, u64>, Vec<ReasonRecord>), SweepError> {
    let columns = read(&["row", "status", "reason"])?;
    // an input of a study may be called so too: ours are the first and the last of their names
    let rows = columns
        .iter()
        .find_map(|column| if let Cells::Counts(rows) = &column.cells { Some(rows) } else { None });
    let texts = |name: &str| {
        columns.iter().rev().find_map(|column| match &column.cells {
            Cells::Texts(texts) if column.name == name => Some(texts),
            _ => None,
        })
    };
    let (Some(rows), Some(states), Some(reasons)) = (rows, texts("status"), texts("reason")) else {
        return Ok((BTreeMap::new(), Vec::new()));
    };
    let mut status: BTreeMap<String, u64> =
        crate::asked::Status::ALL.map(|status| (status.word().to_owned(), 0)).into();
    let mut grouped: BTreeMap<(String, String), ReasonRecord> = BTreeMap::new();
    for ((row, state), reason) in rows.iter().zip(states).zip(reasons) {
        let state = state.clone().unwrap_or_default();
        *status.entry(state.clone()).or_default() += 1;
        if let Some(example) = reason {
            let masked = masked(example);
            let record = grouped.entry((state.clone(), masked.clone())).or_insert_with(|| ReasonRecord {
                status: state,
                reason: masked,
                count: 0,
                first_row: *row as u64,
                example: example.clone(),
            });
            record.count += 1;
        }
    }
    let mut reasons: Vec<ReasonRecord> = grouped.into_values().collect();
    reasons.sort_by_key(|record| (std::cmp::Reverse(record.count), record.first_row));
    Ok((status, reasons))
}

/// A text with `#` in place of numbers.
fn masked(text: &str) -> String {
    let mut masked = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let before = masked.chars().next_back();
        let word = before.is_some_and(|before| before.is_alphanumeric() || before == '_');
        let length = if word { 0 } else { number_length(rest) };
        if length > 0 {
            masked.push('#');
            rest = &rest[length..];
        } else {
            masked.push(first);
            rest = &rest[first.len_utf8()..];
        }
    }
    masked
}

/// Length of the number that a text starts with, or zero.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let sign = usize::from(bytes.first().is_some_and(|byte| *byte == b'-' || *byte == b'+'));
    if !bytes.get(sign).is_some_and(u8::is_ascii_digit) {
        return 0;
    }
    let mut end = sign;
    while let Some(byte) = bytes.get(end) {
        let digit_follows = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_digit);
        match byte {
            byte if byte.is_ascii_digit() => end += 1,
            b'.' if digit_follows(end + 1) => end += 1,
            b'e' | b'E' if digit_follows(end + 1) => end += 1,
            b'e' | b'E'
                if bytes.get(end + 1).is_some_and(|b| *b == b'-' || *b == b'+') && digit_follows(end + 2) =>
            {
                end += 2
            }
            _ => break,
        }
    }
    end
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_masked_and_names_are_not() {
        let text = "model.toml:12:3: `mass` is -1.5e-3 kg of x2, D/I3 = 0.9 (1 of 3).";
        assert_eq!(masked(text), "model.toml:#:#: `mass` is # kg of x2, D/I3 = # (# of #).");
    }
}
