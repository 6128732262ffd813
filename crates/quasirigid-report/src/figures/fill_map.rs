//! Time constants of a map over the fill of tanks and the spin: a curve for each of a few spins.

use std::f64::consts::PI;

use quasirigid_io::record::{FillMapRecord, FillPointRecord};

use crate::figure::{Figure, Mark, Quantity, Series};
use crate::number::{tidy, time_unit};

/// Classes of the curves, the slowest spin first; of each the dashed one is where the nutation grows.
const CLASSES: [[&str; 2]; 4] =
    [["s1", "s1 dashed"], ["s2", "s2 dashed"], ["s3", "s3 dashed"], ["s4", "s4 dashed"]];

/// Time constant of the nutation over the fill, as an SVG file of its own; none of a map without a nutation.
#[must_use]
pub fn fill_map_picture(record: &FillMapRecord) -> Option<String> {
    figure(record)?.picture()
}

fn figure(record: &FillMapRecord) -> Option<Figure> {
    let all = record.points.iter().chain(&record.worst).chain(&record.dips);
    let longest = all.filter_map(size).filter(|time| time.is_finite()).fold(0.0, f64::max);
    let (unit, length) = time_unit(longest);
    let spins = shown(record);
    let mut series = Vec::new();
    for (spin, [solid, dashed]) in spins.iter().zip(CLASSES) {
        let points = of_spin(record, *spin);
        let fills: Vec<f64> = points.iter().map(|point| point.fill).collect();
        let curve = |grows: bool| {
            let value = |point: &&FillPointRecord| {
                let own = point.decay_rate().is_some_and(|rate| (rate < 0.0) == grows);
                size(point).filter(|_| own).map_or(f64::NAN, |time| time / length)
            };
            points.iter().map(value).collect::<Vec<f64>>()
        };
        let label = format!("{} rpm", tidy(30.0 / PI * spin, 3));
        let [decays, grows] = [false, true].map(curve);
        let drawn = |times: &[f64]| times.iter().any(|time| time.is_finite());
        if drawn(&decays) {
            series.push(Series::line(&label, solid, fills.clone(), decays.clone()));
        }
        if drawn(&grows) {
            let label = if drawn(&decays) { String::new() } else { label };
            series.push(Series::line(&label, dashed, fills, grows));
        }
    }
    if series.is_empty() {
        return None;
    }
    let rate = |point: &&FillPointRecord| point.decay_rate().unwrap_or(f64::INFINITY);
    let worst = record.worst.iter().min_by(|a, b| rate(a).total_cmp(&rate(b)));
    let quantity = |name: &'static str, unit: &str, log: bool| Quantity { name, unit: unit.to_owned(), log };
    Some(Figure {
        id: "fills",
        title: "Time constant of the nutation over the fill".into(),
        caption: "e-folding time of the nutation at a few spins. Dashed: it grows.".into(),
        x: quantity("fill", "1", false),
        y: quantity("e-folding time", unit, true),
        link: None,
        series,
        marks: worst.map(|point| Mark { x: point.fill, label: "worst fill".into() }).into_iter().collect(),
    })
}

/// e-folding time (s) of decay or growth of the nutation at a point.
fn size(point: &FillPointRecord) -> Option<f64> {
    point.nutation.as_ref()?.time_constant.map(f64::abs)
}

/// Spins (rad/s) that have a curve: at most one for each class, from the slowest to the fastest.
fn shown(record: &FillMapRecord) -> Vec<f64> {
    let mut spins: Vec<f64> = record.points.iter().map(|point| point.spin).collect();
    spins.dedup();
    let last = spins.len().saturating_sub(1);
    let curves = spins.len().min(CLASSES.len());
    (0..curves).map(|curve| spins[curve * last / (curves - 1).max(1)]).collect()
}

/// Points of a spin by fill, with those that were found between the points of the map.
fn of_spin(record: &FillMapRecord, spin: f64) -> Vec<&FillPointRecord> {
    let all = record.points.iter().chain(&record.worst).chain(&record.dips);
    let mut points: Vec<&FillPointRecord> = all.filter(|point| point.spin == spin).collect();
    points.sort_by(|a, b| a.fill.total_cmp(&b.fill));
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasirigid_io::record::FillMotionRecord;

    fn point(spin: f64, fill: f64, time: f64) -> FillPointRecord {
        let nutation = FillMotionRecord {
            name: "nutation".into(),
            frequency: 1.0,
            decay_rate: time.recip(),
            time_constant: Some(time),
        };
        FillPointRecord {
            spin,
            fill,
            liquid_mass: 1.0,
            status: FillPointRecord::ANSWERED.into(),
            reason: None,
            nutation: Some(nutation),
            rigid_rate: None,
            dissipation: std::collections::BTreeMap::new(),
            slowest: None,
            nearest: None,
        }
    }

    fn map(spins: &[f64]) -> FillMapRecord {
        let times = [[0.2, 500.0], [0.5, -20.0], [0.8, -200.0]];
        let points =
            spins.iter().flat_map(|spin| times.map(|[fill, time]| point(*spin, fill, time))).collect();
        FillMapRecord {
            name: "stage".into(),
            sentence: String::new(),
            holds: true,
            tanks: vec!["fuel".into()],
            points,
            worst: spins.iter().map(|spin| point(*spin, 0.55, -10.0)).collect(),
            dips: Vec::new(),
        }
    }

    /// Growth and decay have curves of their own, a spin alone too; the worst fill is marked, and stands in the curve.
    #[test]
    fn growth_is_dashed_and_the_worst_fill_is_marked() {
        let figure = figure(&map(&[2.0])).unwrap();
        let classes: Vec<&str> = figure.series.iter().map(|series| series.class).collect();
        assert_eq!(classes, ["s1", "s1 dashed"]);
        assert_eq!(figure.marks[0].x, 0.55);
        assert!(figure.series[1].x.contains(&0.55));
        assert!(fill_map_picture(&map(&[2.0])).unwrap().contains("stroke-dasharray"));
    }

    #[test]
    fn four_of_many_spins_are_drawn_from_the_slowest_to_the_fastest() {
        let spins: Vec<f64> = (1..=20).map(f64::from).collect();
        assert_eq!(shown(&map(&spins)), [1.0, 7.0, 13.0, 20.0]);
        assert!(
            fill_map_picture(&FillMapRecord { points: Vec::new(), worst: Vec::new(), ..map(&[1.0]) })
                .is_none()
        );
    }
}
