//! Population: the time of the evolution of every body against its size, in thirds by the period or rate of its rotation.

use maud::{Markup, html};
use quasirigid_io::record::{InputRecord, SweepColumn, SweepRecord};

use crate::figure::{Figure, Quantity, Series};
use crate::number::digits;

/// Most bodies that are drawn.
const MOST: usize = 4000;
/// Words of keys that are sizes, and of those that tell the rotation.
const SIZES: [&str; 3] = ["diameter", "semi_axes", "radius"];
const ROTATIONS: [&str; 5] = ["periods", "period", "rotation", "rate", "angular_velocity"];
/// Quantity that is drawn.
const TIME: &str = "evolve.time";
const CLASSES: [&str; 3] = ["s1", "s2", "s3"];
const TITLE: &str = "Time against size and rotation";

/// The figure of a study that varies a size, and asks for the time of the evolution.
pub fn section(record: &SweepRecord, columns: &[SweepColumn]) -> Markup {
    html! {
        @if let Some(figure) = figure(record, columns) {
            section aria-label="Population" { h2 { "Population" } (figure.draw()) }
        }
    }
}

fn figure(record: &SweepRecord, columns: &[SweepColumn]) -> Option<Figure> {
    let values = |name: &str| Some(&columns.iter().find(|column| column.name == name)?.values);
    let varies = |input: &&InputRecord| {
        values(&input.name).is_some_and(|values| values.iter().any(|value| *value != values[0]))
    };
    let input = |words: &[&str]| {
        let told = |input: &&InputRecord| {
            let key = if input.key.is_empty() { &input.name } else { &input.key };
            key.split('.').any(|segment| words.contains(&segment))
        };
        record.inputs.iter().filter(|input| input.kind != "carried").filter(told).find(varies)
    };
    let size = input(&SIZES)?;
    let times = values(TIME)?;
    let sizes = values(&size.name)?;
    let step = times.len().div_ceil(MOST).max(1);
    let positive =
        |row: &usize| [times, sizes].iter().all(|column| column[*row].is_finite() && column[*row] > 0.0);
    let rows: Vec<usize> = (0..times.len()).step_by(step).filter(positive).collect();
    let unit = record.quantities.iter().find(|quantity| quantity.name == TIME)?.unit.clone();
    let quantity = |name: &'static str, unit: &str| Quantity { name, unit: unit.to_owned(), log: true };
    let mut figure = Figure::new(quantity("size", &size.unit), quantity("time", &unit));
    (figure.id, figure.title) = ("population", TITLE.into());
    let series = |label: &str, class: &'static str, rows: &[usize]| {
        let of = |column: &Vec<f64>| rows.iter().map(|row| column[*row]).collect();
        Series::line(label, class, of(sizes), of(times)).of_points()
    };
    let rotation = input(&ROTATIONS).and_then(|input| Some((input, values(&input.name)?)));
    match rotation {
        Some((input, rotations)) => {
            let mut ordered: Vec<usize> =
                rows.into_iter().filter(|row| rotations[*row].is_finite()).collect();
            ordered.sort_by(|a, b| rotations[*a].abs().total_cmp(&rotations[*b].abs()));
            for (third, class) in ordered.chunks(ordered.len().div_ceil(3).max(1)).zip(CLASSES) {
                let [first, last] = [third.first()?, third.last()?].map(|row| digits(rotations[*row], 3));
                figure.series.push(series(&format!("{first} to {last} {}", input.unit), class, third));
            }
            figure.caption = format!(
                "{TIME} against {}, a point each row, in thirds by {}. Infinite times are left out.",
                size.name, input.name
            );
        }
        None => {
            figure.series.push(series("", CLASSES[0], &rows));
            figure.caption =
                format!("{TIME} against {}, a point each row. Infinite times are left out.", size.name);
        }
    }
    figure.has_curves().then_some(figure)
}
