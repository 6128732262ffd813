//! Laws with sines and cosines of the time: whether they are constant in axes that turn at a constant rate, and at which. (M6)
//! The rate follows from the derivative by the time and that by the attitude; whether the law is constant is asked at irregular times.

use nalgebra::{DVector, Vector3};

use super::slopes::{Instant, Slopes, THETA};
use super::state::SteadyStateGuess;
use super::steadiness::{changed, weighted};
use crate::math::rotation::{self, Turn};
use crate::model::force::{Force, TIME};
use crate::model::{FlexibleBody, Marker};

type V = Vector3<f64>;

/// Rotation of the axes in which a law may be constant.
pub(super) enum Pace {
    /// The time changes nothing.
    Constant,
    /// Angular velocity (rad/s, inertial axes).
    FrameRotation(V),
}

/// Times at which a law is compared, for each rate in it, and the part of a revolution between them.
const TIMES: u32 = 24;
const GOLDEN: f64 = 0.618_033_988_749_894_8;
/// Relative change of a law along the rotation of the start from which another rotation is looked for; share of the largest slope by the
/// attitude below which a slope is none.
const CONSTANT_LAW: f64 = 1e-9;

/// Rates (rad/s) of the sines and cosines of the time in the formulas of a force; none where the time occurs otherwise.
pub(super) fn rates(force: &Force<Marker>) -> Option<Vec<f64>> {
    let rates = |formulas: &[crate::math::expression::Expression; 3]| {
        let each: Option<Vec<_>> = formulas.iter().map(|formula| formula.rates(TIME)).collect();
        Some(each?.concat())
    };
    force.law.formulas().map_or_else(|| Some(Vec::new()), rates)
}

/// Irregular times (s) over several revolutions at each rate.
pub(super) fn times(rates: &[f64]) -> impl Iterator<Item = f64> {
    let period = |rate: &f64| std::f64::consts::TAU / rate;
    let periods: Vec<f64> = rates.iter().filter(|rate| **rate > 0.0).map(period).collect();
    periods.into_iter().flat_map(|period| (1..=TIMES).map(move |k| GOLDEN * f64::from(k) * period))
}

/// Rotation of the axes in which a force may be constant near a state; none if it is constant in no axes there.
pub(super) fn pace(body: &FlexibleBody, force: &Force<Marker>, near: &SteadyStateGuess) -> Option<Pace> {
    let rates = rates(force)?;
    let forces = std::slice::from_ref(force);
    let SteadyStateGuess { attitude, omega, place, velocity, .. } = *near;
    let velocity = if body.translation().is_some() { Turn::of(attitude).to_body(velocity) } else { velocity };
    let start = Instant { t: 0.0, attitude, omega, q: vec![0.0; body.coordinates().len()], place, velocity };
    let slopes = Slopes::of(body, forces, &start);
    let period = rates.iter().fold(0.0, |most: f64, rate| most.max(*rate)).recip();
    let now = weighted(body, &slopes, period);
    let stays = |t: f64| {
        !changed(&now, &weighted(body, &Slopes::of(body, forces, &Instant { t, ..start.clone() }), period))
    };
    if times(&rates).all(stays) {
        return Some(Pace::Constant);
    }
    let by_time = Slopes::by_time(body, forces, &start);
    let by_attitude = slopes.by.columns(THETA, 3).into_owned();
    let left = |rate: &V| (&by_time + &by_attitude * DVector::from_column_slice(rate.as_slice())).norm();
    let fits = |rate: &V| left(rate) <= CONSTANT_LAW * (by_time.norm() + by_attitude.norm() * rate.norm());
    let own = V::from(omega);
    let rate = if fits(&own) {
        own
    } else {
        let factors = by_attitude.clone().svd(true, true);
        let found = factors.solve(&-&by_time, CONSTANT_LAW * factors.singular_values.max()).ok()?;
        V::new(found[0], found[1], found[2])
    };
    (rate.norm() > 0.0 && fits(&rate))
        .then(|| Pace::FrameRotation(rotation::to_inertial(attitude, rate.into()).into()))
}
