//! Figures of a history: spin, energy, nutation, and the sphere of the angular momentum.

use maud::{Markup, html};
use quasirigid_io::record::{HistoryRecord, RunRecord};

use super::curve::{Curve, unit};
use crate::columns::{TimeUnit, column, main_history};
use crate::figure::{Figure, Quantity};
use crate::sphere;

/// Revolutions after which the spin is drawn once more, with the beginning enlarged.
const MANY_TURNS: f64 = 60.0;
/// Revolutions that the enlargement shows.
const FIRST_TURNS: f64 = 20.0;
/// Rows the enlargement needs to be worth drawing.
const ENOUGH_ROWS: usize = 60;

/// Colours of curves, which limit the number drawn together.
const COLOURS: [&str; 4] = ["s1", "s2", "s3", "s4"];

/// Spin, energy, nutation and the sphere of the angular momentum.
pub fn section(record: &RunRecord) -> Markup {
    html! {
        section.figures aria-label="Figures" {
            h2 { "How it went" }
            @match main_history(record) {
                None => p.absent { "No history, nothing to draw." },
                Some(history) => {
                    (spin(history, usize::MAX).draw())
                    @if let Some(first_revolutions) = first_revolutions(history) { (first_revolutions.draw()) }
                    (energy(history).draw())
                    (nutation(record, history).draw())
                    (sphere::figure(&record.body, history))
                }
            }
        }
    }
}

/// The first `rows` rows.
fn spin(history: &HistoryRecord, rows: usize) -> Figure {
    let time = TimeUnit::of(&history.columns, rows);
    let names = [("wx", "ωx"), ("wy", "ωy"), ("wz", "ωz")];
    let curves = names.iter().zip(COLOURS).filter_map(|(&(name, label), class)| {
        let mut curve = Curve { name, label, class }.series(&history.columns, &time, |value| value)?;
        curve.x.truncate(rows);
        curve.y.truncate(rows);
        Some(curve)
    });
    Figure {
        id: "spin",
        title: "Spin in body axes",
        caption: "Components of the angular velocity in the axes of the body. Where they swing faster than a pixel is wide, \
                  a band spans their extremes."
            .into(),
        series: curves.collect(),
        x: Quantity { name: "t", unit: time.name },
        y: Quantity { name: "ω", unit: unit(&history.columns, "wx") },
        log: false,
        marks: Vec::new(),
    }
}

/// The beginning of a long run, in which single revolutions can be seen.
fn first_revolutions(history: &HistoryRecord) -> Option<Figure> {
    let t = &column(&history.columns, "t")?.values;
    let (first, last) = (*t.first()?, *t.last()?);
    let until = first + (last - first) * FIRST_TURNS / history.revolutions;
    let rows = t.iter().take_while(|&&t| t <= until).count();
    if history.revolutions < MANY_TURNS || rows < ENOUGH_ROWS || rows == t.len() {
        return None;
    }
    Some(Figure {
        id: "first-turns",
        title: "Spin in body axes: the beginning",
        caption: format!("About the first {FIRST_TURNS} revolutions of the figure above."),
        ..spin(history, rows)
    })
}

fn energy(history: &HistoryRecord) -> Figure {
    let time = TimeUnit::of(&history.columns, usize::MAX);
    let curves = [
        Curve { name: "dissipated", label: "loss", class: "s1" },
        Curve { name: "energy_drift", label: "drift", class: "s2 dashed" },
    ];
    Figure {
        id: "energy",
        title: "Energy dissipated, and numerical drift",
        caption: "Energy taken by the dashpots; beside it the size of the change made by the integrator alone, since one can \
                  imitate the other."
            .into(),
        series: curves.iter().filter_map(|curve| curve.series(&history.columns, &time, f64::abs)).collect(),
        x: Quantity { name: "t", unit: time.name },
        y: Quantity { name: "energy", unit: unit(&history.columns, "dissipated") },
        log: true,
        marks: Vec::new(),
    }
}

/// Nutation of every system, so that the dissipative body stands beside the rigid one.
fn nutation(record: &RunRecord, main: &HistoryRecord) -> Figure {
    let time = TimeUnit::of(&main.columns, usize::MAX);
    let curves = record.histories.iter().zip(COLOURS).filter_map(|(history, class)| {
        Curve { name: "nutation_max", label: &history.system, class }.series(
            &history.columns,
            &time,
            f64::to_degrees,
        )
    });
    Figure {
        id: "nutation",
        title: "Nutation",
        caption:
            "Greatest angle between the angular momentum and the axis of the steady spin that it circles, over one turn of the nutation."
                .into(),
        series: curves.collect(),
        x: Quantity { name: "t", unit: time.name },
        y: Quantity { name: "nutation", unit: "°".into() },
        log: false,
        marks: Vec::new(),
    }
}
