//! Intervals by the profile likelihood: the least over the other keys, along one of them. Equation (O20).

use quasirigid_io::model::Named;
use quasirigid_math::least_squares::{LeastSquares, least_squares};
use rayon::prelude::*;

use super::curvature::Curvature;
use super::problem::Problem;

/// Deviations of a normal quantity within which it lies with 68 % and with 95 %.
pub(super) const DEVIATIONS: [f64; 2] = [1.0, 1.959_963_984_540_054];
/// Difference of the rise over one deviation from that of the parabola, from which an interval is followed.
const BENT: f64 = 0.1;
/// Fall of the sum below its least, in rises over a deviation, from which the least was none.
const BELOW: f64 = 1e-2;
/// Error of the root of a rise, relative; most steps towards it, and the farthest of them in deviations.
const CLOSE: f64 = 2e-3;
const TRIES: usize = 20;
const FAR: f64 = 1e4;

/// Keys whose intervals are those of the profile likelihood.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Profiles {
    /// Those along which the sum of squares is no parabola, and those at a bound.
    Auto,
    /// All.
    All,
    /// None.
    None,
}

impl Named for Profiles {
    const VALUES: &'static [(&'static str, Self, &'static str)] = &[
        ("auto", Self::Auto, "where the squares are no parabola over a deviation, and at bounds"),
        ("all", Self::All, "of every key"),
        ("none", Self::None, "intervals are those of the deviations"),
    ];
}

/// Intervals of a key, over its scale.
#[derive(Clone, Debug, Default)]
pub(super) struct Profile {
    /// Ends of the intervals of 68 % and of 95 %; none where nothing sets them.
    pub intervals: [[Option<f64>; 2]; 2],
    /// Whether the profile was followed.
    pub is_followed: bool,
    /// A point below the least, and its sum.
    pub deeper: Option<(Vec<f64>, f64)>,
}

/// Intervals of every key.
pub(super) fn profiles(
    problem: &Problem<'_>,
    least: &LeastSquares,
    about: &Curvature,
    asked: Profiles,
) -> Vec<Profile> {
    let each = |key: usize| profile(&Along { problem, least, about, key }, asked);
    (0..problem.keys.len()).into_par_iter().map(each).collect()
}

fn profile(along: &Along<'_>, asked: Profiles) -> Profile {
    let (key, x) = (along.key, along.least.parameters[along.key]);
    let [low, high] = along.problem.keys[key].bounds();
    let is_held = along.least.held[key];
    let Some(sigma) = along.deviation() else { return Profile::default() };
    let normal =
        || DEVIATIONS.map(|many| [-1.0, 1.0].map(|side| Some((x + side * many * sigma).clamp(low, high))));
    let mut walk = Walk { along, sigma, deeper: None };
    let follow = match asked {
        Profiles::All => true,
        Profiles::None => false,
        Profiles::Auto => is_held || walk.is_bent(),
    };
    if !follow {
        let intervals = if is_held { [[None; 2]; 2] } else { normal() };
        return Profile { intervals, is_followed: false, deeper: walk.deeper };
    }
    let sides = [-1.0, 1.0].map(|side| walk.ends(side));
    let intervals = [0, 1].map(|level| [sides[0][level], sides[1][level]]);
    Profile { intervals, is_followed: true, deeper: walk.deeper }
}

/// The problem along one key.
#[derive(Clone, Copy)]
struct Along<'a> {
    problem: &'a Problem<'a>,
    least: &'a LeastSquares,
    about: &'a Curvature,
    key: usize,
}

impl Along<'_> {
    /// Deviation of the key; at a bound, the way inwards over which the parabola of the key alone rises as over a deviation.
    fn deviation(&self) -> Option<f64> {
        if !self.least.held[self.key] {
            return self.about.covariance[self.key][self.key].map(f64::sqrt).filter(|sigma| *sigma > 0.0);
        }
        let column = &self.least.jacobian[self.key];
        let curved: f64 = column.iter().map(|d| d * d).sum();
        let slope = column.iter().zip(&self.least.residuals).map(|(d, r)| d * r).sum::<f64>().abs();
        let reach = self.about.level / (slope + (slope * slope + curved * self.about.level).sqrt());
        (reach > 0.0 && reach.is_finite()).then_some(reach)
    }

    /// Root of the rise of the sum at a place of the key, in deviations, and the point of the least there; the other keys start at a guess.
    fn rise(&self, place: f64, guess: &[f64]) -> Option<(f64, Vec<f64>)> {
        let mut others = guess.to_vec();
        others.remove(self.key);
        let mut bounds = self.problem.bounds();
        bounds.remove(self.key);
        let whole = |others: &[f64]| {
            let mut point = others.to_vec();
            point.insert(self.key, place);
            point
        };
        let (square, point) = if others.is_empty() {
            let point = whole(&others);
            (self.problem.losses(&point)?.iter().map(|r| r * r).sum(), point)
        } else {
            let mut all = |points: &[Vec<f64>]| {
                self.problem.all(&points.iter().map(|point| whole(point)).collect::<Vec<_>>())
            };
            let found = least_squares(&others, &bounds, &mut all)?;
            (found.square, whole(&found.parameters))
        };
        Some(((square - self.least.square) / self.about.level, point))
    }
}

/// Steps along a key.
struct Walk<'a> {
    along: &'a Along<'a>,
    sigma: f64,
    deeper: Option<(Vec<f64>, f64)>,
}

impl Walk<'_> {
    /// Whether the sum rises otherwise than a parabola over a deviation on one of the sides.
    fn is_bent(&mut self) -> bool {
        let x = self.along.least.parameters[self.along.key];
        let [low, high] = self.along.problem.keys[self.along.key].bounds();
        let mut bent = false;
        for side in [-1.0, 1.0] {
            let place = (x + side * self.sigma).clamp(low, high);
            let many = (place - x) / self.sigma;
            let start = self.along.least.parameters.clone();
            let rise = self.at(place, &start).map(|(rise, _)| rise);
            bent |= rise.is_none_or(|rise| (rise - many * many).abs() > BENT);
        }
        bent
    }

    /// The rise at a place, from the nearest point that is known; places below the least are kept.
    fn at(&mut self, place: f64, from: &[f64]) -> Option<(f64, Vec<f64>)> {
        let key = self.along.key;
        let slopes = &self.along.about.covariance[key];
        let own = slopes[key].filter(|own| *own > 0.0);
        let move_by = |j: usize| Some(slopes[j]? / own? * (place - from[key]));
        let bounds = self.along.problem.bounds();
        let moved = from.iter().enumerate().map(|(j, x)| x + move_by(j).unwrap_or(0.0));
        let guess: Vec<f64> = moved.zip(bounds).map(|(x, [low, high])| x.clamp(low, high)).collect();
        let (rise, point) = self.along.rise(place, &guess)?;
        let deepest = self.deeper.as_ref().map_or(-BELOW, |(_, deepest)| *deepest);
        if rise < deepest {
            self.deeper = Some((point.clone(), rise));
        }
        Some((rise, point))
    }

    /// Places on a side where the rise is that of the intervals of 68 % and of 95 %; the bound where it lies nearer, none where no place is.
    fn ends(&mut self, side: f64) -> [Option<f64>; 2] {
        let x = self.along.least.parameters.clone();
        let mut inside = (x[self.along.key], 0.0, x);
        DEVIATIONS.map(|goal| self.end(side, goal, &mut inside))
    }

    /// A place where the root of the rise is the goal. (O20)
    fn end(&mut self, side: f64, goal: f64, inside: &mut (f64, f64, Vec<f64>)) -> Option<f64> {
        let key = self.along.key;
        let x = self.along.least.parameters[key];
        let [low, high] = self.along.problem.keys[key].bounds();
        let mut outside: Option<(f64, f64)> = None;
        let ahead = if inside.1 > 0.0 {
            (goal / inside.1).min(4.0) * (inside.0 - x).abs()
        } else {
            goal * self.sigma
        };
        let mut place = x + side * ahead;
        for _ in 0..TRIES {
            place = place.clamp(low, high);
            let found = self.at(place, &inside.2.clone());
            let root = found.as_ref().map_or(f64::INFINITY, |(rise, _)| rise.max(0.0).sqrt());
            if (root - goal).abs() <= CLOSE * goal {
                return Some(place);
            }
            match found {
                Some((_, point)) if root < goal => {
                    if place == low || place == high {
                        return Some(place);
                    }
                    *inside = (place, root, point);
                }
                _ => outside = Some((place, root)),
            }
            place = match outside {
                Some((out, root)) if root.is_finite() => {
                    let share = ((goal - inside.1) / (root - inside.1)).clamp(0.1, 0.9);
                    inside.0 + share * (out - inside.0)
                }
                Some((out, _)) => 0.5 * (inside.0 + out),
                None => x + (inside.0 - x) * (goal / inside.1.max(1e-9)).clamp(1.2, 4.0),
            };
            if (place - x).abs() > FAR * self.sigma {
                return None;
            }
        }
        // the model ends there, or the sum jumps
        outside.map(|_| inside.0)
    }
}
