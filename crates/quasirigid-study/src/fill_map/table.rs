//! The points of a map as a table.

use quasirigid_io::record::{FillMapRecord, FillMotionRecord, FillPointRecord};
use quasirigid_io::table_file::{CellColumn, Cells, csv_header, csv_rows};

/// The points of a map as CSV, a row each, by spin, then by fill.
#[must_use]
pub fn csv(record: &FillMapRecord) -> Vec<u8> {
    let columns = columns(&record.points);
    [csv_header(&columns), csv_rows(&columns)].concat()
}

fn columns(points: &[FillPointRecord]) -> Vec<CellColumn> {
    let column =
        |name: &str, unit: &str, cells: Cells| CellColumn { name: name.into(), unit: unit.into(), cells };
    let numbers = |value: &dyn Fn(&FillPointRecord) -> Option<f64>| {
        Cells::Numbers(points.iter().map(|point| value(point).filter(|value| value.is_finite())).collect())
    };
    let texts =
        |value: &dyn Fn(&FillPointRecord) -> Option<String>| Cells::Texts(points.iter().map(value).collect());
    type Motion = fn(&FillPointRecord) -> &Option<FillMotionRecord>;
    let motion = |name: &str, of: Motion| {
        let value =
            |part: fn(&FillMotionRecord) -> Option<f64>| numbers(&|point| of(point).as_ref().and_then(part));
        [
            column(&format!("{name}.frequency"), "rad/s", value(|motion| Some(motion.frequency))),
            column(&format!("{name}.decay_rate"), "1/s", value(|motion| Some(motion.decay_rate))),
            column(&format!("{name}.time_constant"), "s", value(|motion| motion.time_constant)),
        ]
    };
    let nearest = |point: &FillPointRecord| point.nearest.clone();
    let mut columns = vec![
        column("spin", "rad/s", numbers(&|point| Some(point.spin))),
        column("fill", "", numbers(&|point| Some(point.fill))),
        column("liquid_mass", "kg", numbers(&|point| Some(point.liquid_mass))),
    ];
    columns.extend(motion("nutation", |point| &point.nutation));
    columns.push(column("rigid_rate", "rad/s", numbers(&|point| point.rigid_rate)));
    columns.push(column(
        "slowest.name",
        "",
        texts(&|point| point.slowest.as_ref().map(|motion| motion.name.clone())),
    ));
    columns.extend(motion("slowest", |point| &point.slowest));
    columns.extend([
        column("nearest.tank", "", texts(&|point| nearest(point).map(|slosh| slosh.tank))),
        column("nearest.mode", "", numbers(&|point| nearest(point).map(|slosh| slosh.mode as f64))),
        column("nearest.frequency", "rad/s", numbers(&|point| nearest(point).map(|slosh| slosh.frequency))),
        column("nearest.ratio", "", numbers(&|point| nearest(point).map(|slosh| slosh.ratio))),
        column("status", "", texts(&|point| Some(point.status.clone()))),
        column("reason", "", texts(&|point| point.reason.clone())),
    ]);
    columns
}
