//! Figures of a study, chosen by what was varied: a map over two grids, a curve over one, else a histogram.
//! Rows that share the grid point of a figure are one value of it, their median.

use maud::{Markup, html};
use quasirigid_io::record::{StudyColumn, StudyRecord, StudyRole};

use super::tables::of;
use crate::figure::{Grid, Stop, band, histogram, map};

/// Most quantities that have figures of their own.
const MOST: usize = 12;

/// The figures of every quantity.
pub fn section(record: &StudyRecord) -> Markup {
    let quantities = of(record, |role| role == StudyRole::Quantity);
    let numeric: Vec<&StudyColumn> =
        quantities.into_iter().filter(|column| column.values.iter().any(|value| value.is_finite())).collect();
    let shown = &numeric[..numeric.len().min(MOST)];
    html! {
        @if !shown.is_empty() {
            section aria-label="Figures" {
                h2 { "Figures" }
                @for (number, quantity) in shown.iter().enumerate() { (of_quantity(record, quantity, number)) }
                @if numeric.len() > MOST { p.absent { "The first " (MOST) " quantities are drawn; the others are in the scatter." } }
            }
        }
    }
}

fn of_quantity(record: &StudyRecord, quantity: &StudyColumn, number: usize) -> Markup {
    let grids = of(record, |role| role == StudyRole::Grid);
    let several: Vec<&StudyColumn> =
        grids.into_iter().filter(|column| distinct(&column.values).len() > 1).collect();
    let id = |kind: &str| format!("{kind}-{number}");
    let over_grid = match several[..] {
        [x] => curve(&id("curve"), x, quantity),
        [x, y, ..] => over_two(&id("map"), x, y, quantity),
        [] => None,
    };
    let random =
        record.columns.iter().any(|column| matches!(column.role, StudyRole::Drawn | StudyRole::Table));
    let counted = if random || over_grid.is_none() {
        histogram(&id("histogram"), [&quantity.name, &quantity.unit], &quantity.values, &quantity.percentiles)
    } else {
        None
    };
    html! {
        @if let Some(figure) = over_grid { (figure) }
        @if let Some(figure) = counted { (figure) }
    }
}

fn curve(id: &str, x: &StudyColumn, y: &StudyColumn) -> Option<Markup> {
    let stops: Vec<Stop> = distinct(&x.values)
        .into_iter()
        .filter_map(|at| {
            let mut values = where_equal(&[(x, at)], y);
            values.sort_by(f64::total_cmp);
            Some(Stop {
                x: at,
                y: [quantile(&values, 0.16)?, quantile(&values, 0.5)?, quantile(&values, 0.84)?],
            })
        })
        .collect();
    band(id, [&x.name, &x.unit], [&y.name, &y.unit], &stops)
}

fn over_two(id: &str, x: &StudyColumn, y: &StudyColumn, quantity: &StudyColumn) -> Option<Markup> {
    let (across, along) = (distinct(&x.values), distinct(&y.values));
    let mut cells = vec![vec![Vec::new(); across.len()]; along.len()];
    for (row, value) in quantity.values.iter().enumerate().filter(|(_, value)| value.is_finite()) {
        let place = |among: &[f64], at: f64| among.binary_search_by(|known| known.total_cmp(&at)).ok();
        if let (Some(column), Some(line)) = (place(&across, x.values[row]), place(&along, y.values[row])) {
            cells[line][column].push(*value);
        }
    }
    let middle = |values: &mut Vec<f64>| {
        values.sort_by(f64::total_cmp);
        quantile(values, 0.5).unwrap_or(f64::NAN)
    };
    let values = cells.iter_mut().map(|row| row.iter_mut().map(middle).collect()).collect();
    let grid = Grid { x: across, y: along, values };
    map(id, [&x.name, &x.unit], [&y.name, &y.unit], [&quantity.name, &quantity.unit], &grid)
}

/// Different finite values, ascending.
fn distinct(values: &[f64]) -> Vec<f64> {
    let mut values: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    values
}

fn where_equal(keys: &[(&StudyColumn, f64)], quantity: &StudyColumn) -> Vec<f64> {
    let fits = |row: &usize| keys.iter().all(|(column, value)| column.values[*row] == *value);
    (0..quantity.values.len())
        .filter(fits)
        .map(|row| quantity.values[row])
        .filter(|value| value.is_finite())
        .collect()
}

/// Value below which a share of ascending values lies, linear between them; none without values.
fn quantile(sorted: &[f64], share: f64) -> Option<f64> {
    let place = share * (sorted.len().checked_sub(1)?) as f64;
    let (low, rest) = (place.floor() as usize, place.fract());
    let high = (low + 1).min(sorted.len() - 1);
    Some(sorted[low] + rest * (sorted[high] - sorted[low]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_linear_between_values() {
        let values = [1.0, 2.0, 4.0, 8.0, 16.0];
        assert_eq!(
            [0.0, 0.5, 0.625, 1.0].map(|share| quantile(&values, share)),
            [1.0, 4.0, 6.0, 16.0].map(Some)
        );
        assert_eq!((quantile(&[3.0], 0.84), quantile(&[], 0.5)), (Some(3.0), None));
    }
}
