//! Page of a study: the record that the report reads, of all rows or of as many, evenly chosen, as a page can show.

use quasirigid_io::record::{
    QuantityRecord, StudyColumn, StudyInfluence, StudyRecord, StudyRefusal, StudyRole, SweepRecord,
};
use quasirigid_io::table_file::{CellColumn, Cells};

use super::folder::Folder;
use super::{Sweep, SweepError};

/// Most rows that a page shows.
const MOST: u64 = 20_000;

/// Report of a study with its summary, as one page.
pub(super) fn page(sweep: &Sweep, folder: &Folder<'_>, summary: &SweepRecord) -> Result<String, SweepError> {
    let role = |kind: &str| match kind {
        "distribution" => StudyRole::Drawn,
        "table" => StudyRole::Table,
        _ => StudyRole::Grid,
    };
    let mut columns = Vec::new();
    for input in summary.inputs.iter().filter(|input| input.kind != "carried") {
        columns.extend(column(folder, &input.name, role(&input.kind), None)?);
    }
    for quantity in &summary.quantities {
        columns.extend(column(folder, &quantity.name, StudyRole::Quantity, Some(quantity))?);
    }
    let influence = |each: &quasirigid_io::record::CorrelationRecord| {
        let (input, quantity, rows) = (each.input.clone(), each.quantity.clone(), each.rows as usize);
        Some(StudyInfluence { input, quantity, rank_correlation: each.rho?, rows })
    };
    let record = StudyRecord {
        name: summary.name.clone(),
        version: summary.version.clone(),
        rows: sweep.rows as usize,
        answered: summary.status.get("answered").copied().unwrap_or(0) as usize,
        text: summary.study.clone(),
        columns,
        influences: summary.correlations.iter().filter_map(influence).collect(),
        refusals: summary
            .reasons
            .iter()
            .map(|reason| StudyRefusal {
                status: reason.status.clone(),
                reason: reason.example.clone(),
                rows: reason.count as usize,
                first: reason.first_row as usize,
            })
            .collect(),
    };
    Ok(quasirigid_report::study_page(&record))
}

/// A column of numbers, or of truth values as 0 and 1; none of texts, which the page does not show.
fn column(
    folder: &Folder<'_>,
    name: &str,
    role: StudyRole,
    statistics: Option<&QuantityRecord>,
) -> Result<Option<StudyColumn>, SweepError> {
    let Some(CellColumn { unit, cells, .. }) =
        folder.read(&[name])?.into_iter().find(|each| each.name == name)
    else {
        return Ok(None);
    };
    let all: Vec<f64> = match cells {
        Cells::Numbers(values) => values.into_iter().map(|value| value.unwrap_or(f64::NAN)).collect(),
        Cells::Booleans(values) => values
            .into_iter()
            .map(|value| value.map_or(f64::NAN, |truth| f64::from(u8::from(truth))))
            .collect(),
        Cells::Texts(_) | Cells::Counts(_) => return Ok(None),
    };
    let step = (all.len() as u64).div_ceil(MOST).max(1) as usize;
    let percentiles =
        statistics.map(|of| of.percentiles.iter().map(|each| (each.percent, each.value)).collect());
    Ok(Some(StudyColumn {
        name: name.to_owned(),
        unit,
        role,
        values: all.into_iter().step_by(step).collect(),
        percentiles: percentiles.unwrap_or_default(),
    }))
}
