//! Figures of a study, chosen by what was varied: a map over two grids, a curve over one, else a histogram.
//! Rows that share the grid point of a figure are one value of it, their median.

use maud::{Markup, html};
use quasirigid_io::record::{Ordered, QuantityRecord, SweepColumn, SweepRecord};

use crate::figure::{Grid, Stop, band, histogram, map};

/// Most quantities that have figures of their own.
const MAX_FIGURES: usize = 12;

/// Column with its unit.
#[derive(Clone, Copy)]
struct Shown<'a> {
    name: &'a str,
    unit: &'a str,
    values: &'a [f64],
}

/// The figures of every numeric quantity.
pub fn section(record: &SweepRecord, columns: &[SweepColumn]) -> Markup {
    let values =
        |name: &str| columns.iter().find(|column| column.name == name).map(|column| &column.values[..]);
    let with_values = |quantity: &QuantityRecord| {
        values(&quantity.name).is_some_and(|values| values.iter().any(|value| value.is_finite()))
    };
    let numeric: Vec<&QuantityRecord> =
        record.quantities.iter().filter(|quantity| with_values(quantity)).collect();
    let grids: Vec<Shown<'_>> = (record.inputs.iter())
        .filter(|input| matches!(input.kind.as_str(), "grid" | "list"))
        .filter_map(|input| {
            Some(Shown { name: &input.name, unit: &input.unit, values: values(&input.name)? })
        })
        .filter(|input| distinct(input.values).len() > 1)
        .collect();
    let random = record.inputs.iter().any(|input| matches!(input.kind.as_str(), "distribution" | "table"));
    html! {
        @if !numeric.is_empty() {
            section aria-label="Figures" {
                h2 { "Figures" }
                @for (number, quantity) in numeric.iter().take(MAX_FIGURES).enumerate() {
                    @if let Some(values) = values(&quantity.name) {
                        (of_quantity(&grids, random, quantity, values, number))
                    }
                }
                @if numeric.len() > MAX_FIGURES { p.absent { "The first " (MAX_FIGURES) " quantities are drawn; the others are in the scatter." } }
            }
        }
    }
}

fn of_quantity(
    grids: &[Shown<'_>],
    random: bool,
    quantity: &QuantityRecord,
    values: &[f64],
    number: usize,
) -> Markup {
    let shown = Shown { name: &quantity.name, unit: &quantity.unit, values };
    let id = |kind: &str| format!("{kind}-{number}");
    let over_grid = match grids {
        [x] => curve(&id("curve"), *x, shown),
        [x, y, ..] => over_two(&id("map"), *x, *y, shown),
        [] => None,
    };
    let percentiles: Vec<(f64, f64)> =
        quantity.percentiles.iter().map(|percentile| (percentile.percent, percentile.value)).collect();
    let counted = if random || over_grid.is_none() {
        histogram(&id("histogram"), [&quantity.name, &quantity.unit], values, &percentiles)
    } else {
        None
    };
    html! {
        @if let Some(figure) = over_grid { (figure) }
        @if let Some(figure) = counted { (figure) }
    }
}

fn curve(id: &str, x: Shown<'_>, y: Shown<'_>) -> Option<Markup> {
    let across = distinct(x.values);
    let mut shared = vec![Vec::new(); across.len()];
    for (at, value) in x.values.iter().zip(y.values).filter(|(_, value)| value.is_finite()) {
        if let Some(place) = place(&across, *at) {
            shared[place].push(*value);
        }
    }
    let stop = |(x, values): (&f64, &mut Vec<f64>)| {
        let values = Ordered::new(y.name, std::mem::take(values));
        Some(Stop {
            x: *x,
            y: [values.percentile(16.0)?, values.percentile(50.0)?, values.percentile(84.0)?],
        })
    };
    let stops: Vec<Stop> = across.iter().zip(&mut shared).filter_map(stop).collect();
    band(id, [x.name, x.unit], [y.name, y.unit], &stops)
}

fn over_two(id: &str, x: Shown<'_>, y: Shown<'_>, quantity: Shown<'_>) -> Option<Markup> {
    let (across, along) = (distinct(x.values), distinct(y.values));
    let mut cells = vec![vec![Vec::new(); across.len()]; along.len()];
    for (row, value) in quantity.values.iter().enumerate().filter(|(_, value)| value.is_finite()) {
        if let (Some(column), Some(line)) = (place(&across, x.values[row]), place(&along, y.values[row])) {
            cells[line][column].push(*value);
        }
    }
    let middle = |values: &mut Vec<f64>| {
        Ordered::new(quantity.name, std::mem::take(values)).percentile(50.0).unwrap_or(f64::NAN)
    };
    let values = cells.iter_mut().map(|row| row.iter_mut().map(middle).collect()).collect();
    let grid = Grid { x: across, y: along, values };
    map(id, [x.name, x.unit], [y.name, y.unit], [quantity.name, quantity.unit], &grid)
}

/// Place of a value among different ones.
fn place(among: &[f64], value: f64) -> Option<usize> {
    among.binary_search_by(|known| known.total_cmp(&value)).ok()
}

/// Different finite values, ascending.
fn distinct(values: &[f64]) -> Vec<f64> {
    let mut values: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    values
}
