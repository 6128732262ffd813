//! Figures of a comparison: one curve for each run. Curves of equations that do not hold say so in their names.

use quasirigid_io::model::BodyKind;
use quasirigid_io::record::{Column, HistoryRecord};

use super::{Compared, kind};
use crate::columns::{TimeUnit, column, main_history, norm, vectors};
use crate::figure::{Figure, Quantity, Series};
use crate::figures::history::distances;
use crate::sections::overview::answered;

/// Styles of curves, which limit the number drawn together.
const STYLES: [&str; 8] = ["s1", "s2", "s3", "s4", "s1 dashed", "s2 dashed", "s3 dashed", "s4 dashed"];

/// The figures with a curve.
pub fn of(runs: &[Compared<'_>]) -> Vec<Figure> {
    let kind = kind(runs);
    let mut figures =
        vec![nutation(kind, runs), spin(runs), loss(runs), difference(runs), evolution(kind, runs)];
    figures.retain(Figure::has_curves);
    figures
}

fn nutation(kind: BodyKind, runs: &[Compared<'_>]) -> Figure {
    let caption = format!(
        "Greatest angle between the angular momentum and the axis of the steady spin that it circles, over one turn of the {}.",
        kind.nutation()
    );
    figure("nutation", kind.title(), &caption, (kind.nutation(), "°", false), runs, |_, history| {
        Some(values(&history.columns, "nutation_max")?.map(f64::to_degrees).collect())
    })
}

fn spin(runs: &[Compared<'_>]) -> Figure {
    figure("rate", "Size of the angular velocity", "", ("|ω|", "rad/s", false), runs, |_, history| {
        Some(vectors(&history.columns, ["wx", "wy", "wz"])?.into_iter().map(norm).collect())
    })
}

fn loss(runs: &[Compared<'_>]) -> Figure {
    let caption = "Energy taken by the dashpots since the start.";
    figure("loss", "Energy dissipated", caption, ("energy", "J", true), runs, |_, history| {
        Some(values(&history.columns, "dissipated")?.collect())
    })
}

/// Difference from the first run, where rows are at the same times.
fn difference(runs: &[Compared<'_>]) -> Figure {
    let first = runs.first().and_then(|run| main_history(run.record));
    let caption = "Distance of the angular velocity from that of the first run at the same time, relative to its size; of runs with \
                   rows at the same times.";
    figure(
        "difference",
        "Difference in spin from the first run",
        caption,
        ("difference", "1", true),
        runs,
        |place, history| {
            if place == 0 {
                return None;
            }
            Some(distances(&first?.columns, &history.columns)?.1)
        },
    )
}

fn values<'a>(columns: &'a [Column], name: &str) -> Option<impl Iterator<Item = f64> + 'a> {
    Some(column(columns, name)?.values.iter().copied())
}

/// A figure over the time of the histories.
fn figure(
    id: &'static str,
    title: &'static str,
    caption: &str,
    (name, unit, log): (&'static str, &str, bool),
    runs: &[Compared<'_>],
    value: impl Fn(usize, &HistoryRecord) -> Option<Vec<f64>>,
) -> Figure {
    let histories = || runs.iter().filter_map(|run| main_history(run.record));
    let time = TimeUnit::of_longest(histories().map(|history| &history.columns[..]));
    let curve = |(place, run): (usize, &Compared<'_>)| {
        let history = main_history(run.record)?;
        let x: Vec<f64> = values(&history.columns, "t")?.map(|t| t / time.length).collect();
        let mut y = value(place, history)?;
        y.resize(x.len(), f64::NAN);
        let label = if run.holds() { run.label.to_owned() } else { format!("{} (does not hold)", run.label) };
        Some(Series::line(&label, STYLES[place], x, y).of_rows(history.rows()))
    };
    Figure {
        id,
        title: title.into(),
        caption: caption.into(),
        series: runs.iter().take(STYLES.len()).enumerate().filter_map(curve).collect(),
        ..Figure::over_time("t", &time, Quantity { name, unit: unit.into(), log })
    }
}

/// Nutation over many revolutions, of the runs with an answer.
fn evolution(kind: BodyKind, runs: &[Compared<'_>]) -> Figure {
    let answers = || {
        runs.iter()
            .take(STYLES.len())
            .zip(STYLES)
            .filter_map(|(run, style)| Some((run, style, answered(run.record)?)))
    };
    let time = TimeUnit::of_longest(answers().map(|(.., evolution)| &evolution.columns[..]));
    let curves = answers().filter_map(|(run, style, evolution)| {
        let x = values(&evolution.columns, "t")?.map(|t| t / time.length).collect();
        let y = values(&evolution.columns, "nutation_max")?.map(f64::to_degrees).collect();
        Some(Series::line(run.label, style, x, y))
    });
    Figure {
        id: "evolution-nutation",
        title: format!("{} over many revolutions", kind.title()),
        caption: format!(
            "Greatest angle between the angular momentum and the axis that it circles, in one period of the {}; of the runs \
             with an answer.",
            kind.nutation()
        ),
        series: curves.collect(),
        ..Figure::over_time(
            "evolution",
            &time,
            Quantity { name: kind.nutation(), unit: "°".into(), log: false },
        )
    }
}
