//! Campbell diagram: frequencies of the modes over the spin.

use quasirigid_io::model::BodyKind;
use quasirigid_io::record::CampbellRecord;

use crate::figure::{Figure, Mark, Quantity, Series};

/// Ratio of the greatest to the least frequency from which the axis is logarithmic.
const SPREAD: f64 = 1000.0;

/// Frequencies in body axes, those of modes that grow apart, and the spin itself.
pub fn campbell(kind: BodyKind, record: &CampbellRecord) -> Figure {
    let points = |label: &str, class: &'static str, grows: bool| {
        let rows = record.spins.iter().zip(&record.frequencies).zip(&record.decay_rates);
        let (x, y) = rows.filter(|(_, rate)| (**rate < 0.0) == grows).map(|((x, y), _)| (*x, *y)).unzip();
        Series::line(label, class, x, y).of_points()
    };
    let frequencies = record.frequencies.iter().copied();
    let (low, high) = (frequencies.clone().fold(f64::INFINITY, f64::min), frequencies.fold(0.0, f64::max));
    // point by point, since on a logarithmic axis it is no straight line
    let mut spins = record.spins.clone();
    spins.dedup();
    let line = Series::line("Ω", "s3 dashed", spins.clone(), spins);
    let series = [points("modes", "s1", false), points("growing", "s2", true), line];
    Figure {
        id: "campbell",
        title: "Frequencies of the modes over the spin".into(),
        caption: format!(
            "Frequencies in body axes of the small motions about the steady spin near the axis of {} inertia, with the displacements \
             that the spin gives; modes that grow stand out. Dashed: the spin itself. A damper is tuned where its line meets that of the \
             {}, which rises with the spin.",
            record.axis,
            kind.nutation()
        ),
        series: series.into_iter().filter(|series| !series.x.is_empty()).collect(),
        marks: vec![Mark { x: record.spin, label: "this run".into() }],
        link: None,
        x: Quantity { name: "Ω", unit: "rad/s".into(), log: false },
        y: Quantity { name: "frequency", unit: "rad/s".into(), log: high > SPREAD * low },
    }
}
