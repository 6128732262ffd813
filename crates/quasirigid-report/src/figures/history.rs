//! Figures of a history: spin, energy, nutation, and the difference between systems of equations.

use quasirigid_io::record::{Column, HistoryRecord, RunRecord};

use super::curve::{Curve, unit};
use crate::columns::{TimeUnit, column, norm, vectors};
use crate::figure::{Figure, Quantity, Series};

/// Revolutions after which the spin is drawn once more, with the beginning enlarged.
const MANY_REVOLUTIONS: f64 = 60.0;
/// Revolutions that the enlargement shows.
const FIRST_REVOLUTIONS: f64 = 20.0;
/// Rows the enlargement needs to be worth drawing.
const ENOUGH_ROWS: usize = 60;

/// Colours of curves, which limit the number drawn together.
const COLOURS: [&str; 4] = ["s1", "s2", "s3", "s4"];

/// Components of the angular velocity.
pub fn spin(history: &HistoryRecord) -> Figure {
    first_rows(history, usize::MAX)
}

fn first_rows(history: &HistoryRecord, rows: usize) -> Figure {
    let time = TimeUnit::of(&history.columns, rows);
    let names = [("wx", "ωx"), ("wy", "ωy"), ("wz", "ωz")];
    let curves = names.iter().zip(COLOURS).filter_map(|(&(name, label), class)| {
        let mut curve = Curve { name, label, class }.series(&history.columns, &time, |value| value)?;
        curve.x.truncate(rows);
        curve.y.truncate(rows);
        Some(curve.of_rows(history.rows().min(rows as u64)))
    });
    Figure {
        id: "spin",
        title: "Spin in body axes".into(),
        caption: "Components of the angular velocity in the axes of the body. Where they swing faster than a pixel is wide, \
                  a band spans their extremes."
            .into(),
        series: curves.collect(),
        ..Figure::over_time("t", &time, Quantity { name: "ω", unit: unit(&history.columns, "wx"), log: false })
    }
}

/// The beginning of a long run, in which single revolutions can be seen.
pub fn first_revolutions(history: &HistoryRecord) -> Option<Figure> {
    let t = &column(&history.columns, "t")?.values;
    let (first, last) = (*t.first()?, *t.last()?);
    let until = first + (last - first) * FIRST_REVOLUTIONS / history.revolutions;
    let rows = t.iter().take_while(|&&t| t <= until).count();
    if !history.is_whole() || history.revolutions < MANY_REVOLUTIONS || rows < ENOUGH_ROWS || rows == t.len()
    {
        return None;
    }
    Some(Figure {
        id: "first-turns",
        title: "Spin in body axes: the beginning".into(),
        caption: format!("About the first {FIRST_REVOLUTIONS} revolutions of the figure above."),
        ..first_rows(history, rows)
    })
}

/// Energy, the part of it dissipated, and the drift of the integrator.
pub fn energy(history: &HistoryRecord) -> Figure {
    let time = TimeUnit::of(&history.columns, usize::MAX);
    let curves = [
        Curve { name: "dissipated", label: "loss", class: "s1" },
        Curve { name: "energy_drift", label: "drift", class: "s2 dashed" },
        Curve { name: "energy", label: "energy", class: "s3" },
    ];
    Figure {
        id: "energy",
        title: "Energy, its loss, and numerical drift".into(),
        caption: "Energy of the motion, and what the dashpots took of it; beside it the size of the change made by the integrator \
                  alone, since one can imitate the other."
            .into(),
        series: curves
            .iter()
            .filter_map(|curve| Some(curve.series(&history.columns, &time, f64::abs)?.of_rows(history.rows())))
            .collect(),
        ..Figure::over_time("t", &time, Quantity { name: "energy", unit: unit(&history.columns, "dissipated"), log: true })
    }
}

/// Nutation of every system, so that the dissipative body stands beside the rigid one: the greatest angle, and of the first the least.
pub fn nutation(record: &RunRecord, main: &HistoryRecord) -> Figure {
    let kind = record.body.kind;
    let time = TimeUnit::of(&main.columns, usize::MAX);
    let greatest = record.histories.iter().zip(COLOURS).filter_map(|(history, class)| {
        degrees(history, &time, Curve { name: "nutation_max", label: &history.system, class })
    });
    let least = degrees(main, &time, Curve { name: "nutation_min", label: "least", class: "s1 dashed" });
    Figure {
        id: "nutation",
        title: kind.title().into(),
        caption: format!(
            "Greatest angle between the angular momentum and the axis of the steady spin that it circles, over one turn of the \
             {}. Dashed: the least angle of the first system; the two differ for a body of three different moments.",
            kind.nutation()
        ),
        series: greatest.chain(least).collect(),
        ..Figure::over_time("t", &time, Quantity { name: kind.nutation(), unit: "°".into(), log: false })
    }
}

fn degrees(history: &HistoryRecord, time: &TimeUnit, curve: Curve) -> Option<Series> {
    Some(curve.series(&history.columns, time, f64::to_degrees)?.of_rows(history.rows()))
}

/// Difference in spin of every other system from the first, relative to the spin; none of a record with one history, or of histories at
/// different times.
pub fn difference(record: &RunRecord) -> Option<Figure> {
    let [main, others @ ..] = record.histories.as_slice() else { return None };
    let time = TimeUnit::of(&main.columns, usize::MAX);
    let curves = others.iter().zip(COLOURS).filter_map(|(other, class)| {
        let (x, y) = distances(&main.columns, &other.columns)?;
        let x = x.into_iter().map(|t| t / time.length).collect();
        Some(Series::line(&other.system, class, x, y))
    });
    let series: Vec<Series> = curves.collect();
    (!series.is_empty()).then(|| Figure {
        id: "difference",
        title: "Difference in spin between systems of equations".into(),
        caption: format!(
            "Distance of the angular velocity of each system from that of the {} one at the same time, relative to its size.",
            main.system
        ),
        series,
        ..Figure::over_time("t", &time, Quantity { name: "difference", unit: "1".into(), log: true })
    })
}

/// Times of the rows that two histories share, and the relative distance of their spins there; none unless the rows are at the same times.
pub fn distances(one: &[Column], other: &[Column]) -> Option<(Vec<f64>, Vec<f64>)> {
    let (t, same) = (&column(one, "t")?.values, &column(other, "t")?.values);
    let rows = t.len().min(same.len());
    if t[..rows] != same[..rows] {
        return None;
    }
    let [one, other] = [one, other].map(|columns| vectors(columns, ["wx", "wy", "wz"]));
    let distance = |(a, b): (&[f64; 3], &[f64; 3])| norm([0, 1, 2].map(|i| a[i] - b[i])) / norm(*a);
    Some((t[..rows].to_vec(), one?.iter().zip(&other?).take(rows).map(distance).collect()))
}
