//! Figures of the evolution: nutation and power against time, power against `D/I₃` with the resonances, dissipation by harmonic.

use std::collections::BTreeMap;

use quasirigid_io::model::BodyKind;
use quasirigid_io::record::{Column, CrossingRecord, EvolutionRecord, HarmonicRecord};

use super::curve::{Curve, unit};
use crate::columns::{TimeUnit, column, ends};
use crate::figure::{Figure, Mark, Quantity, Series};
use crate::number::digits;

/// Harmonics drawn, width of a group of bars, and classes of the bars.
const HARMONICS: usize = 12;
const GROUP: f64 = 0.72;
const BARS: [&str; 4] = ["s1 bars", "s2 bars", "s3 bars", "s4 bars"];
/// Resonances marked in the map.
const MARKED: usize = 4;
/// Ratio of the time at the end to that of the first row after the start from which the axis is logarithmic.
const LOGARITHMIC_RATIO: f64 = 300.0;
/// Least time of a logarithmic axis over the time at the end.
const EARLIEST: f64 = 1e-6;

/// Nutation against time, on a logarithmic axis where the rows span many decades.
pub fn nutation(kind: BodyKind, evolution: &EvolutionRecord) -> Figure {
    let curves = [
        Curve { name: "nutation_max", label: "max", class: "s1" },
        Curve { name: "nutation_min", label: "min", class: "s2" },
    ];
    let y = Quantity { name: kind.nutation(), unit: "°".into(), log: false };
    Figure {
        id: "evolution-nutation",
        title: format!("{} over many revolutions", kind.title()),
        caption: format!(
            "Greatest and least angle between the angular momentum and the axis that it circles, in one period of the \
             {}.{}",
            kind.nutation(),
            if evolution.separatrix_time.is_some() { " At the separatrix that axis changes." } else { "" }
        ),
        ..over_time(evolution, &curves, f64::to_degrees, y)
    }
}

/// Mean power against time.
pub fn power(kind: BodyKind, evolution: &EvolutionRecord) -> Figure {
    let nutation = kind.nutation();
    let curve = Curve { name: "power", label: "power", class: "s1" };
    let y = Quantity { name: "power", unit: unit(&evolution.columns, "power"), log: true };
    Figure {
        id: "evolution-power",
        title: "Mean power dissipated over many revolutions".into(),
        caption: format!(
            "{}{}",
            if evolution.road == "direct" {
                format!(
                    "Taken over the interval from row to row of the full system; it vanishes with the {nutation}."
                )
            } else {
                format!("Averaged over the {nutation}; it vanishes with it.")
            },
            if evolution.separatrix_time.is_some() {
                " It dips at the separatrix, where the spin lingers near the middle axis."
            } else {
                ""
            }
        ),
        ..over_time(evolution, &[curve], |power| power, y)
    }
}

/// Curves against time, without names and caption.
fn over_time(
    evolution: &EvolutionRecord,
    curves: &[Curve<'_>],
    value: fn(f64) -> f64,
    y: Quantity,
) -> Figure {
    let columns = with_gaps(&evolution.columns);
    let time = TimeUnit::of(&columns, usize::MAX);
    let mut series: Vec<Series> =
        curves.iter().filter_map(|curve| curve.series(&columns, &time, value)).collect();
    let log = spans_decades(&columns);
    if log {
        series.iter_mut().for_each(without_the_start);
    }
    let marks = separatrix_mark(evolution, &time);
    let mut figure = Figure { series, marks, ..Figure::over_time("evolution", &time, y) };
    figure.x.log = log;
    figure
}

/// Factor between the power that was followed and that of the reduced equations up to which the latter is drawn.
const FACTOR: f64 = 10.0;

/// Power against `D/I₃` instead of time, with the resonances marked.
pub fn map(kind: BodyKind, evolution: &EvolutionRecord) -> Figure {
    let columns = with_gaps(&evolution.columns);
    let values = |name: &str| column(&columns, name).map_or_else(Vec::new, |column| column.values.clone());
    let (place, followed) = (values("D_over_I3"), values("power"));
    let near = |(reduced, followed): (f64, &f64)| {
        if (reduced / followed).ln().abs() <= FACTOR.ln() { reduced } else { f64::NAN }
    };
    let reduced: Vec<f64> = values("polynomial_power").into_iter().zip(&followed).map(near).collect();
    let curves = [("followed", "s1", followed), ("reduced", "s2", reduced)];
    let drawn = curves.into_iter().filter(|(.., power)| power.iter().any(|power| power.is_finite()));
    let crossing = |crossing: &CrossingRecord| Mark {
        x: crossing.ratio,
        label: format!("{} Ωₚ = {} rad/s", crossing.harmonic, digits(crossing.frequency, 3)),
    };
    Figure {
        id: "evolution-map",
        title: "Mean power along the evolution".into(),
        caption: format!(
            "From the axis of least inertia towards that of greatest, D/I₃ = 1: the power that was followed, and that of the \
             reduced equations, which know no resonance, where it is within a factor of ten. Lines mark where a harmonic of the {} meets an elastic \
             frequency.",
            kind.nutation()
        ),
        series: drawn.map(|(label, class, power)| Series::line(label, class, place.clone(), power)).collect(),
        marks: evolution.resonances.iter().take(MARKED).map(crossing).collect(),
        link: None,
        x: Quantity { name: "D/I₃", unit: "1".into(), log: false },
        y: Quantity { name: "power", unit: unit(&columns, "power"), log: true },
    }
}

/// Share of each harmonic of the nutation in the mean power at the start, by dissipator.
pub fn harmonics(kind: BodyKind, evolution: &EvolutionRecord) -> Figure {
    let nutation = kind.nutation();
    let harmonics = &evolution.harmonics[..evolution.harmonics.len().min(HARMONICS)];
    let parts = parts(harmonics);
    let width = GROUP / parts.len().max(1) as f64;
    let bars = |(i, (label, shares)): (usize, (String, Vec<f64>))| {
        let x = harmonics.iter().map(|harmonic| harmonic.number as f64).collect();
        let left = i as f64 * width - 0.5 * GROUP;
        let y = shares.into_iter().map(|share| 100.0 * share).collect();
        Series::line(&label, BARS[i], x, y).of_bars([left, left + width])
    };
    Figure {
        id: "evolution-harmonics",
        title: format!("Dissipation by harmonic of the {nutation}"),
        caption: format!(
            "Share in the mean power at the start of each harmonic of the {nutation}, the motion of the angular momentum in the axes of \
             the body, and of each dissipator in it."
        ),
        series: parts.into_iter().enumerate().map(bars).collect(),
        ..Figure::new(
            Quantity { name: "harmonic", unit: "1".into(), log: false },
            Quantity { name: "share of the power", unit: "%".into(), log: false },
        )
    }
}

/// Dissipators with their share in each harmonic, the largest first, those beyond the colours as one.
fn parts(harmonics: &[HarmonicRecord]) -> Vec<(String, Vec<f64>)> {
    let mut sums: BTreeMap<&str, f64> = BTreeMap::new();
    for (name, share) in harmonics.iter().flat_map(|harmonic| &harmonic.dissipation) {
        *sums.entry(name).or_default() += share;
    }
    if sums.len() < 2 {
        return vec![(String::new(), harmonics.iter().map(|harmonic| harmonic.share).collect())];
    }
    let mut names: Vec<(&str, f64)> = sums.into_iter().collect();
    names.sort_by(|a, b| b.1.total_cmp(&a.1));
    let of = |name: &str| {
        let share = |harmonic: &HarmonicRecord| harmonic.dissipation.get(name).copied().unwrap_or(0.0);
        (name.to_owned(), harmonics.iter().map(share).collect::<Vec<f64>>())
    };
    if names.len() <= BARS.len() {
        return names.iter().map(|(name, _)| of(name)).collect();
    }
    let (first, others) = names.split_at(BARS.len() - 1);
    let rest = others.iter().map(|(name, _)| of(name).1).reduce(|mut sum, part| {
        sum.iter_mut().zip(part).for_each(|(sum, part)| *sum += part);
        sum
    });
    let rest = rest.map(|shares| (format!("{} others", others.len()), shares));
    first.iter().map(|(name, _)| of(name)).chain(rest).collect()
}

/// Whether the rows after the start span so many decades of time that a logarithmic axis shows more.
fn spans_decades(columns: &[Column]) -> bool {
    let Some(t) = column(columns, "t") else { return false };
    let after = t.values.iter().copied().filter(|t| *t > 0.0);
    ends(after).is_some_and(|(first, last)| last > LOGARITHMIC_RATIO * first)
}

/// Leaves out the rows that a logarithmic axis cannot show, or that would fill it with the first moments.
fn without_the_start(series: &mut Series) {
    let last = series.x.iter().copied().filter(|t| t.is_finite()).fold(0.0, f64::max);
    let early = series.x.iter().take_while(|t| **t < EARLIEST * last).count();
    series.x.drain(..early);
    series.y.drain(..early.min(series.y.len()));
}

fn separatrix_mark(evolution: &EvolutionRecord, time: &TimeUnit) -> Vec<Mark> {
    let mark = |seconds| Mark { x: seconds / time.length, label: "separatrix".into() };
    evolution.separatrix_time.map(mark).into_iter().collect()
}

/// The columns with a gap wherever the angular momentum comes to circle another axis: a curve jumps there.
fn with_gaps(columns: &[Column]) -> Vec<Column> {
    let axes = column(columns, "circled_axis").map_or(&[][..], |column| &column.values);
    let changes =
        |row: usize| matches!(axes.get(row.wrapping_sub(1)..=row), Some([a, b]) if (a - b).abs() > 0.5);
    let with_gaps = |column: &Column| {
        let mut values = Vec::with_capacity(column.values.len());
        for (row, &value) in column.values.iter().enumerate() {
            if changes(row) {
                values.push(if column.name == "t" { column.values[row - 1] } else { f64::NAN });
            }
            values.push(value);
        }
        Column { values, ..column.clone() }
    };
    columns.iter().map(with_gaps).collect()
}
