//! Page of a study: its summary with the columns that the figures need, of all rows or of as many as a page can show.

use quasirigid_io::record::{SweepColumn, SweepRecord};
use quasirigid_io::table_file::Cells;

use super::SweepError;
use super::folder::Folder;

/// Most rows that the figures of a page are made of.
const MAX_ROWS: usize = 200_000;

/// Report of a study with its summary, as one page.
pub(super) fn page(folder: &Folder<'_>, summary: &SweepRecord) -> Result<String, SweepError> {
    let inputs = summary.inputs.iter().filter(|input| input.kind != "carried").map(|input| &input.name);
    let mut columns = Vec::new();
    for name in inputs.chain(summary.quantities.iter().map(|quantity| &quantity.name)) {
        columns.extend(column(folder, name)?);
    }
    Ok(quasirigid_report::study_page(summary, &columns))
}

/// A column of numbers, or of truth values as 0 and 1; none of texts, which have no figure.
fn column(folder: &Folder<'_>, name: &str) -> Result<Option<SweepColumn>, SweepError> {
    let found = folder.read(&[name])?.into_iter().find(|column| column.name == name);
    let all: Vec<f64> = match found.map(|column| column.cells) {
        Some(Cells::Numbers(values)) => values.into_iter().map(|value| value.unwrap_or(f64::NAN)).collect(),
        Some(Cells::Booleans(values)) => {
            let number = |truth: Option<bool>| truth.map_or(f64::NAN, |truth| f64::from(u8::from(truth)));
            values.into_iter().map(number).collect()
        }
        Some(Cells::Texts(_) | Cells::Counts(_)) | None => return Ok(None),
    };
    let values = all.iter().copied().step_by(step(all.len())).collect();
    Ok(Some(SweepColumn { name: name.to_owned(), values }))
}

/// Distance between the rows that are kept: without a common factor with their number, so that no value of a grid is passed over.
fn step(rows: usize) -> usize {
    let coprime = |step: &usize| {
        let (mut a, mut b) = (rows, *step);
        while b > 0 {
            (a, b) = (b, a % b);
        }
        a <= 1 || *step == 1
    };
    (rows.div_ceil(MAX_ROWS).max(1)..).find(coprime).unwrap_or(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thinned_rows_meet_every_value_of_a_grid() {
        assert_eq!((step(0), step(MAX_ROWS)), (1, 1));
        for (outer, inner) in [(1000, 1000), (12_345, 77), (2, 600_000)] {
            let kept = step(outer * inner);
            let seen: std::collections::HashSet<usize> =
                (0..outer * inner).step_by(kept).map(|row| row % inner).collect();
            assert!(
                outer * inner / kept <= MAX_ROWS && seen.len() >= inner.min(MAX_ROWS) / 4,
                "{outer} {inner}: {kept}"
            );
        }
    }
}
