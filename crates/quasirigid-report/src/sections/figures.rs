//! Which columns are drawn, and how.

use maud::{Markup, html};
use quasirigid_io::record::{HistoryRecord, RunRecord};

use super::curve::{Curve, unit};
use crate::columns::{TimeUnit, column, main_history};
use crate::figure::{Figure, Quantity};
use crate::sphere;

/// Turns after which the spin is drawn once more, its beginning enlarged.
const MANY_TURNS: f64 = 60.0;
/// Turns that the enlargement shows.
const FIRST_TURNS: f64 = 20.0;
/// Rows the enlargement needs to be worth drawing.
const ENOUGH_ROWS: usize = 60;

/// As many curves as there are colours are drawn together.
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
                    @if let Some(first_turns) = first_turns(history) { (first_turns.draw()) }
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

/// The beginning of a long run, in which single turns can be seen.
fn first_turns(history: &HistoryRecord) -> Option<Figure> {
    let t = &column(&history.columns, "t")?.values;
    let (first, last) = (*t.first()?, *t.last()?);
    let until = first + (last - first) * FIRST_TURNS / history.turns;
    let rows = t.iter().take_while(|&&t| t <= until).count();
    if history.turns < MANY_TURNS || rows < ENOUGH_ROWS || rows == t.len() {
        return None;
    }
    Some(Figure {
        id: "first-turns",
        title: "Spin in body axes: the beginning",
        caption: format!("About the first {FIRST_TURNS} turns of the figure above."),
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

/// Of every system, so that what dissipation changes stands beside what it would have been without.
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
