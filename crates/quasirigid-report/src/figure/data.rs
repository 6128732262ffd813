//! Data of a chart for the scripts of the page: points on the scales of the axes.
//! A curve of more rows than a page can hold is kept as the extremes of intervals of rows, so that a zoom shows a true envelope.

use maud::{Markup, html};
use quasirigid_io::record::Packed;
use serde_json::{Value, json};

use super::axis::Axis;
use super::{Figure, Mark, Quantity, Series};
use crate::number::over_power;
use crate::packed;

/// Most points of a curve in the page.
const MAX_POINTS: usize = 4_000;

/// The data, packed.
pub fn script(figure: &Figure, x: &Axis, y: &Axis) -> Markup {
    html! { script.figure-data type="application/octet-stream" { (packed::data(data(figure, x, y))) } }
}

fn data(figure: &Figure, x: &Axis, y: &Axis) -> Value {
    let mut grids: Vec<Vec<f32>> = Vec::new();
    let series: Vec<Value> = figure
        .series
        .iter()
        .map(|series| {
            let (grid, values) = points(series, x, y);
            let known = grids.iter().position(|known| *known == grid);
            let number = known.unwrap_or_else(|| {
                grids.push(grid);
                grids.len() - 1
            });
            json!({
                "label": series.label, "class": series.class, "grid": number, "values": Packed(values),
                "rows": series.rows, "points": series.points, "bar": series.bar,
            })
        })
        .collect();
    let link = figure.link.as_ref().map(|link| json!({ "group": link.group, "factor": link.factor }));
    let mut abscissa = axis(&figure.x, x);
    abscissa["link"] = json!(link);
    let mark = |mark: &Mark| json!({ "x": scaled(x, mark.x), "label": mark.label, "above": figure.is_above(mark, x, y) });
    let marks: Vec<Value> = figure.marks.iter().map(mark).collect();
    json!({
        "name": figure.id, "title": figure.title, "x": abscissa, "y": axis(&figure.y, y),
        "grids": grids.into_iter().map(Packed).collect::<Vec<_>>(), "series": series, "marks": marks,
    })
}

fn axis(quantity: &Quantity, axis: &Axis) -> Value {
    json!({
        "name": quantity.name, "unit": quantity.unit, "power": axis.power, "low": axis.low, "high": axis.high,
        "log": axis.log, "whole": axis.whole,
    })
}

/// A value on the scale of an axis; not a number where the axis cannot show it.
fn scaled(axis: &Axis, value: f64) -> f64 {
    let scaled = if axis.log { value.log10() } else { over_power(value, axis.power) };
    if scaled.is_finite() { scaled } else { f64::NAN }
}

/// The points of a curve, or the lowest and the highest of each interval of its rows in the order of the rows.
fn points(series: &Series, x: &Axis, y: &Axis) -> (Vec<f32>, Vec<f32>) {
    let rows: Vec<usize> = (0..series.x.len().min(series.y.len())).collect();
    let kept = if series.points || rows.len() <= MAX_POINTS { rows } else { extremes(&rows, &series.y) };
    kept.into_iter().map(|row| (scaled(x, series.x[row]) as f32, scaled(y, series.y[row]) as f32)).unzip()
}

fn extremes(rows: &[usize], values: &[f64]) -> Vec<usize> {
    let interval = rows.len().div_ceil(MAX_POINTS / 2);
    let two = |rows: &[usize]| {
        let finite = || rows.iter().copied().filter(|row| values[*row].is_finite());
        let order = |a: &usize, b: &usize| values[*a].total_cmp(&values[*b]);
        let least = finite().min_by(order).unwrap_or(rows[0]);
        let greatest = finite().max_by(order).unwrap_or(rows[0]);
        [least.min(greatest), least.max(greatest)]
    };
    rows.chunks(interval).flat_map(two).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series(rows: usize, value: impl Fn(f64) -> f64) -> Series {
        let x: Vec<f64> = (0..rows).map(|row| row as f64).collect();
        let y = x.iter().map(|t| value(*t)).collect();
        Series { label: "a".into(), class: "s1", x, y, rows: rows as u64, points: false, bar: None }
    }

    fn axes(series: &Series) -> [Axis; 2] {
        let axis = |values: &[f64]| Axis::linear(values.iter().copied(), 0.0).unwrap();
        [axis(&series.x), axis(&series.y)]
    }

    #[test]
    fn short_curves_are_whole_and_long_ones_keep_every_spike() {
        let short = series(MAX_POINTS, |t| t.sin());
        let [x, y] = axes(&short);
        assert_eq!(points(&short, &x, &y).1.len(), MAX_POINTS);
        let spike = 77_777.0;
        let long = series(100_000, |t| if t == spike { 3.0 } else { (0.1 * t).sin() });
        let [x, y] = axes(&long);
        let (grid, values) = points(&long, &x, &y);
        assert!(grid.len() <= MAX_POINTS && grid.is_sorted(), "{}", grid.len());
        let highest = (0..values.len()).max_by(|a, b| values[*a].total_cmp(&values[*b])).unwrap();
        assert_eq!((grid[highest], values[highest]), (spike as f32 / 10f32.powi(x.power), 3.0));
    }

    #[test]
    fn intervals_without_numbers_are_gaps() {
        let long = series(40_000, |t| if t < 20_000.0 { f64::NAN } else { t });
        let [x, y] = axes(&long);
        let (grid, values) = points(&long, &x, &y);
        assert_eq!(values.len() % 2, 0);
        let gap = grid.iter().zip(&values).take_while(|(_, value)| value.is_nan()).count();
        assert_eq!(gap, values.len() / 2);
    }
}
