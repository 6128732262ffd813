//! A spin of the map: its points, and the worst one and the dips of the time constant, refined between them.
//! A resonance may be narrower than the distance of two fills: where a slosh frequency passes the rate of the nutation, a point is added.

use std::sync::atomic::{AtomicBool, Ordering};

use quasirigid_io::record::FillPointRecord;

use super::body::{FilledBody, Point};

/// Difference of fills at which a crossing or an extreme is found.
const FOUND: f64 = 1e-3;
/// Relative change of the decay rate between the last two places of an extreme at which it is found.
const SETTLED: f64 = 1e-3;
/// Relative difference of frequencies that are the same.
const ALIKE: f64 = 1e-9;
/// Most points that are added for a crossing and for an extreme.
const MOST_ADDED: usize = 24;
/// Smaller part of the golden section.
const GOLDEN: f64 = 0.381_966_011_250_105_1;

/// Points of a spin, its worst one and its dips.
pub(super) struct Refined {
    pub points: Vec<FillPointRecord>,
    pub worst: Option<FillPointRecord>,
    pub dips: Vec<FillPointRecord>,
}

/// Search along the fill at one spin.
struct Search<'a> {
    body: &'a FilledBody<'a>,
    spin: f64,
    cancelled: &'a AtomicBool,
}

impl Refined {
    /// The row of a spin (rad/s); none if the work was cancelled.
    pub fn new(body: &FilledBody<'_>, spin: f64, fills: &[f64], cancelled: &AtomicBool) -> Option<Self> {
        let search = Search { body, spin, cancelled };
        let grid = fills.iter().map(|fill| search.at(*fill)).collect::<Option<Vec<Point>>>()?;
        let mut points = grid.clone();
        for pair in grid.windows(2) {
            points.extend(search.crossings(pair)?);
        }
        points.sort_by(|a, b| a.record.fill.total_cmp(&b.record.fill));
        points.dedup_by(|a, b| a.record.fill == b.record.fill);
        let size = |point: &Point| rate(point).map(f64::abs);
        let dips = search.extremes(&points, |point| size(point).map(|rate| -rate))?;
        let mut least = search.extremes(&points, rate)?;
        least.extend(points.iter().chain(&dips).cloned());
        let worst = least.into_iter().filter(|point| rate(point).is_some());
        let worst = worst.min_by(|a, b| rate(a).unwrap_or(0.0).total_cmp(&rate(b).unwrap_or(0.0)));
        let records = |points: Vec<Point>| points.into_iter().map(|point| point.record).collect();
        Some(Self { points: records(grid), worst: worst.map(|point| point.record), dips: records(dips) })
    }
}

/// Decay rate of the nutation of a point.
fn rate(point: &Point) -> Option<f64> {
    point.record.decay_rate()
}

impl Search<'_> {
    fn at(&self, fill: f64) -> Option<Point> {
        (!self.cancelled.load(Ordering::Relaxed)).then(|| self.body.at(fill, self.spin))
    }

    /// Points at which slosh frequencies pass the rate of the nutation, between two neighbours; several that pass at one place have one.
    fn crossings(&self, pair: &[Point]) -> Option<Vec<Point>> {
        let [before, after] = pair else { return Some(Vec::new()) };
        let mut found: Vec<Point> = Vec::new();
        let mut followed: Vec<[f64; 2]> = Vec::new();
        for (slosh, ratio) in &before.ratios {
            let there = |point: &Point| {
                point.ratios.iter().find(|(known, _)| known == slosh).map(|(_, ratio)| ratio.ln())
            };
            let Some(last) = there(after) else { continue };
            // tanks that are alike pass together
            let alike =
                |ends: &[f64; 2]| (ends[0] - ratio.ln()).abs() < ALIKE && (ends[1] - last).abs() < ALIKE;
            if ratio.ln() * last >= 0.0 || followed.iter().any(alike) {
                continue;
            }
            followed.push([ratio.ln(), last]);
            let mut ends = [(before.record.fill, ratio.ln()), (after.record.fill, last)];
            for _ in 0..MOST_ADDED {
                let [(low, below), (high, above)] = ends;
                if high - low < FOUND {
                    break;
                }
                // by the secant, but never so near to an end that the other one stays
                let share = (below / (below - above)).clamp(0.1, 0.9);
                let point = self.at(low + share * (high - low))?;
                let Some(value) = there(&point) else { break };
                let side = usize::from(value * below < 0.0);
                ends[side] = (point.record.fill, value);
                found.push(point);
            }
        }
        Some(found)
    }

    /// Least places of a value between neighbours that are higher, refined.
    fn extremes(&self, points: &[Point], value: impl Fn(&Point) -> Option<f64>) -> Option<Vec<Point>> {
        let mut found = Vec::new();
        for three in points.windows(3) {
            let [Some(before), Some(middle), Some(after)] = [0, 1, 2].map(|place| value(&three[place]))
            else {
                continue;
            };
            if middle < before && middle <= after {
                found.push(self.least(three, &value)?);
            }
        }
        Some(found)
    }

    /// The least place of a value inside three points, by the golden section.
    fn least(&self, three: &[Point], value: &impl Fn(&Point) -> Option<f64>) -> Option<Point> {
        let (mut low, mut high) = (three[0].record.fill, three[2].record.fill);
        let mut best = three[1].clone();
        let mut settled = false;
        for _ in 0..MOST_ADDED {
            if settled && high - low < FOUND {
                break;
            }
            let middle = best.record.fill;
            let above = high - middle > middle - low;
            let fill =
                if above { middle + GOLDEN * (high - middle) } else { middle - GOLDEN * (middle - low) };
            let point = self.at(fill)?;
            let (Some(new), Some(old)) = (value(&point), value(&best)) else { break };
            settled = (new - old).abs() <= SETTLED * old.abs();
            let (inner, end) = if new < old { (point, middle) } else { (best, fill) };
            match (new < old) == above {
                true => low = end,
                false => high = end,
            }
            best = inner;
        }
        Some(best)
    }
}
