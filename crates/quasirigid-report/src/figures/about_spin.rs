//! Figures of the reduced equations about the spin: time constant, frequency and dissipation against the nutation.

use quasirigid_io::model::BodyKind;
use quasirigid_io::record::AboutSpinRecord;

use crate::columns::column;
use crate::figure::{Figure, Mark, Quantity, Series};
use crate::number::{digits, percent};

/// Classes of the curves of dissipators; others are left out.
const CURVES: [&str; 4] = ["s1", "s2", "s3", "s4"];
/// Ratio of the greatest to the least time constant from which the axis is logarithmic.
const SPREAD: f64 = 30.0;

/// Time in which the nutation falls or grows by e, against the nutation.
pub fn time_constant(kind: BodyKind, about: &AboutSpinRecord) -> Figure {
    let nutation = kind.nutation();
    let rates = values(about, "decay_rate");
    let times = |sign: f64| -> Vec<f64> {
        let time = |rate: &f64| if sign * rate > 0.0 { (sign * rate).recip() } else { f64::NAN };
        rates.iter().map(time).collect()
    };
    let curves = [("decay", "s1", times(1.0)), ("growth", "s2", times(-1.0))];
    let finite: Vec<f64> = rates.iter().map(|rate| rate.abs()).filter(|rate| *rate > 0.0).collect();
    let (low, high) = finite.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), x| (a.min(*x), b.max(*x)));
    let series = curves.into_iter().filter(|(.., y)| y.iter().any(|time| time.is_finite()));
    Figure {
        id: "backbone-time",
        title: format!("Time constant of the {nutation}"),
        caption: format!(
            "Time in which the {nutation} falls or grows by e, by its greatest angle over a period. {}",
            border(about)
        ),
        series: series.map(|(label, class, y)| Series::line(label, class, angles(about), y)).collect(),
        ..over_nutation(
            (kind, about),
            Quantity { name: "time constant", unit: "s".into(), log: high > SPREAD * low },
        )
    }
}

/// Frequency of the nutation in body axes, against the nutation.
pub fn frequency(kind: BodyKind, about: &AboutSpinRecord) -> Figure {
    let nutation = kind.nutation();
    Figure {
        id: "backbone-frequency",
        title: format!("Frequency of the {nutation}"),
        caption: format!(
            "Frequency in body axes of the {nutation}, by its greatest angle over a period. {}",
            border(about)
        ),
        series: vec![Series::line("", "s1", angles(about), values(about, "frequency").to_vec())],
        ..over_nutation((kind, about), Quantity { name: "frequency", unit: "rad/s".into(), log: false })
    }
}

/// Share of each dissipator in the mean power, against the nutation.
pub fn dissipation(kind: BodyKind, about: &AboutSpinRecord) -> Figure {
    let nutation = kind.nutation();
    let mut shares: Vec<(&String, Vec<f64>)> = about
        .dissipators
        .iter()
        .map(|name| {
            (name, values(about, &format!("share of {name}")).iter().map(|share| 100.0 * share).collect())
        })
        .collect();
    let largest = |shares: &[f64]| shares.iter().copied().fold(0.0, f64::max);
    shares.sort_by(|a, b| largest(&b.1).total_cmp(&largest(&a.1)));
    let left_out = shares.len().saturating_sub(CURVES.len());
    let more =
        if left_out > 0 { format!(" {left_out} smaller ones are in the table.") } else { String::new() };
    let series = shares.into_iter().zip(CURVES);
    Figure {
        id: "backbone-dissipation",
        title: format!("Dissipation along the {nutation}"),
        caption: format!(
            "Share of each dissipator in the mean power, by the greatest angle of the {nutation}.{more} {}",
            border(about)
        ),
        series: series.map(|((name, y), class)| Series::line(name, class, angles(about), y)).collect(),
        ..over_nutation((kind, about), Quantity { name: "share of the power", unit: "%".into(), log: false })
    }
}

fn values<'a>(about: &'a AboutSpinRecord, name: &str) -> &'a [f64] {
    column(&about.columns, name).map_or(&[], |column| column.values.as_slice())
}

fn angles(about: &AboutSpinRecord) -> Vec<f64> {
    values(about, "nutation").iter().map(|angle| angle.to_degrees()).collect()
}

/// A figure over the nutation, without curves, names and caption.
fn over_nutation((kind, about): (BodyKind, &AboutSpinRecord), y: Quantity) -> Figure {
    let nutation = Quantity { name: kind.nutation(), unit: "°".into(), log: false };
    Figure { marks: marks(about), ..Figure::new(nutation, y) }
}

fn border(about: &AboutSpinRecord) -> String {
    format!(
        "The equations of degree {} leave {} of motion or dissipation at the border, and more beyond.",
        about.degree,
        percent(about.share)
    )
}

/// The border of the range, and the start where the figure has it.
fn marks(about: &AboutSpinRecord) -> Vec<Mark> {
    let mark = |angle: f64, name: &str| {
        let degrees = angle.to_degrees();
        Mark { x: degrees, label: format!("{name}, {}°", digits(degrees, 3)) }
    };
    let widest = values(about, "nutation").iter().copied().fold(0.0, f64::max);
    let start = about.start.filter(|start| *start <= widest);
    std::iter::once(mark(about.range, "range")).chain(start.map(|start| mark(start, "start"))).collect()
}
