//! Searches from several starts, and again from deeper places that profiles find.

use quasirigid_math::least_squares::{LeastSquares, least_squares};
use quasirigid_math::random::Random;

use super::curvature::{Curvature, curvature};
use super::problem::Problem;
use super::profile::{DEVIATIONS, Profile, Profiles, profiles};

/// The most by which starts differ from the file, where a key has no range.
const SPREAD: f64 = 0.2;
/// Ratio of the ends of a range from which starts are spread over its logarithm.
const DECADE: f64 = 10.0;
const SEED: u64 = 20;
/// Difference of squares, over the least and the rise over a deviation, from which a least is deeper than another.
const DEEPER: f64 = 1e-3;

/// Distance of minima, in deviations and relative to a key, from which they are two.
const APART: f64 = 3.0;
const ELSEWHERE: f64 = 1e-3;

/// The deepest least that was found.
pub(super) struct Found {
    pub least: LeastSquares,
    pub curvature: Curvature,
    /// One for each key.
    pub profiles: Vec<Profile>,
    /// Whether other starts end in shallower minima.
    pub has_others: bool,
    /// Places elsewhere that fit nearly as well, with the rises of their sums over a deviation.
    pub alternatives: Vec<(Vec<f64>, f64)>,
}

/// The deepest least of all starts; none where the keys have no derivatives.
pub(super) fn deepest(problem: &Problem<'_>, starts: usize, asked: Profiles) -> Option<Found> {
    let bounds = problem.bounds();
    let search = |start: &Vec<f64>| least_squares(start, &bounds, &mut |points| problem.all(points));
    let mut found: Vec<LeastSquares> = self::starts(problem, starts).iter().filter_map(search).collect();
    found.sort_by(|a, b| a.square.total_cmp(&b.square));
    let mut others = found.split_off(found.len().min(1));
    let mut least = found.pop()?;
    let mut about = curvature(problem, &least)?;
    // what exact data leave is rough, and no sum to follow
    let asked = if problem.data.is_exact(&least.residuals) { Profiles::None } else { asked };
    let mut profiled = profiles(problem, &least, &about, asked);
    let deepest = profiled.iter().filter_map(|profile| profile.deeper.as_ref());
    let deepest = deepest.min_by(|a, b| a.1.total_cmp(&b.1)).and_then(|(point, _)| search(point));
    if let Some(deeper) = deepest.filter(|deeper| deeper.square < least.square) {
        others.push(std::mem::replace(&mut least, deeper));
        about = curvature(problem, &least)?;
        profiled = profiles(problem, &least, &about, asked);
    }
    if profiled.iter().any(|profile| profile.deeper.is_some()) {
        least.converged = false;
    }
    let is_shallower =
        |other: &LeastSquares| other.square - least.square > DEEPER * (least.square + about.level);
    Some(Found {
        has_others: others.iter().any(is_shallower),
        alternatives: alternatives(problem, &least, &about, &others),
        curvature: about,
        profiles: profiled,
        least,
    })
}

/// Minima elsewhere whose sums are within the interval of 95 %, each once.
fn alternatives(
    problem: &Problem<'_>,
    least: &LeastSquares,
    about: &Curvature,
    others: &[LeastSquares],
) -> Vec<(Vec<f64>, f64)> {
    let [_, wide] = DEVIATIONS;
    let apart = |a: &[f64], b: &[f64]| {
        problem.keys.iter().enumerate().any(|(i, key)| {
            let sigma = about.covariance[i][i].map_or(0.0, f64::sqrt);
            (a[i] - b[i]).abs() > (APART * sigma).max(ELSEWHERE * key.size(b[i]))
        })
    };
    let mut found: Vec<(Vec<f64>, f64)> = Vec::new();
    for other in others.iter().filter(|other| other.converged) {
        let rise = (other.square - least.square) / about.level;
        let is_new = found.iter().all(|(known, _)| apart(&other.parameters, known));
        if rise < wide * wide && is_new && apart(&other.parameters, &least.parameters) {
            found.push((other.parameters.clone(), rise));
        }
    }
    found
}

/// The file's values, and others within the ranges of the keys.
fn starts(problem: &Problem<'_>, others: usize) -> Vec<Vec<f64>> {
    let mut random = Random::new(SEED);
    let file = problem.start();
    let mut starts = vec![file.clone()];
    for _ in 0..others {
        let each = file.iter().zip(problem.bounds());
        starts.push(each.map(|(x, bound)| drawn(*x, bound, random.unit())).collect());
    }
    starts
}

fn drawn(x: f64, [low, high]: [f64; 2], share: f64) -> f64 {
    if low.is_finite() && high.is_finite() {
        let decades = low > 0.0 && high > DECADE * low;
        return if decades { low * (high / low).powf(share) } else { low + share * (high - low) };
    }
    (x + SPREAD * x.abs().max(1.0) * (2.0 * share - 1.0)).clamp(low, high)
}
