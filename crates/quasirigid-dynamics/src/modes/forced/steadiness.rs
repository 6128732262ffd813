//! Test of steadiness: the loads and their slopes are constant in axes that rotate with the body. (M6)

use nalgebra::{DMatrix, Vector3};

use super::error::SteadyError;
use super::slopes::{DISPLACED, Instant, OMEGA, Slopes, THETA, VELOCITY};
use super::state::SteadyState;
use super::system::length;
use super::timed;
use crate::math::vec3::norm;
use crate::model::force::Force;
use crate::model::{FlexibleBody, Marker, Support};

type V = Vector3<f64>;

/// Later times of the test, in revolutions.
const TURNS: [f64; 6] = [0.0917, 0.25, 0.3819, 0.5, 0.7181, 3.1237];
/// Change below which a load or slope counts as constant, relative to the largest one.
const CONSTANT_LOAD: f64 = 1e-8;

/// Tests each force and the support at some later times.
pub(super) fn check(
    body: &FlexibleBody,
    forces: &[Force<Marker>],
    state: &SteadyState,
) -> Result<(), SteadyError> {
    let spin = norm(state.omega);
    let speed = norm(state.velocity);
    let held = body.translation().is_none();
    let rates: Vec<f64> = forces.iter().filter_map(timed::rates).flatten().collect();
    let fastest = rates.iter().fold(0.0, |most: f64, rate| most.max(*rate));
    let period = if spin > 0.0 {
        std::f64::consts::TAU / spin
    } else if held && speed > 0.0 {
        length(body) / speed
    } else if fastest > 0.0 {
        std::f64::consts::TAU / fastest
    } else {
        return Ok(());
    };
    let loads =
        |forces: &[Force<Marker>], at: &Instant| weighted(body, &Slopes::of(body, forces, at), period);
    // The loads of the support are the same for each force.
    let driven = matches!(body.support(), Support::Prescribed { .. });
    let support = driven.then(|| (&[][..], "the acceleration of the support".to_owned()));
    let each =
        forces.iter().map(|force| (std::slice::from_ref(force), format!("the force {:?}", force.name)));
    let start = state.at(0.0);
    let now: Vec<_> =
        support.into_iter().chain(each).map(|(forces, what)| (forces, what, loads(forces, &start))).collect();
    for t in TURNS.map(|turns| turns * period).into_iter().chain(timed::times(&rates)) {
        let later = later(body, state, t);
        for (forces, what, now) in &now {
            let then = loads(forces, &later);
            if changed(now, &then) {
                return Err(SteadyError::Changes {
                    what: what.clone(),
                    part: Some(varies(now, &then).into()),
                });
            }
        }
    }
    Ok(())
}

/// State at a later time, a driven pole moved along its path.
fn later(body: &FlexibleBody, state: &SteadyState, t: f64) -> Instant {
    let mut later = state.at(t);
    if let Support::Prescribed { acceleration, .. } = body.support() {
        let a = V::from(acceleration.each_ref().map(|component| component.value(&[0.0])));
        let axis = V::from(state.axis.unwrap_or_default());
        let rate = norm(state.omega);
        let along = a.dot(&axis) * axis;
        let (out, ahead) = (a - along, axis.cross(&a));
        let (sin, cos) = (rate * t).sin_cos();
        let (v, x) = (V::from(state.velocity), V::from(state.place));
        let turns = acceleration.iter().any(|component| component.uses(0));
        let (change, path) = if turns && rate > 0.0 {
            (
                along * t + (out * sin + ahead * (1.0 - cos)) / rate,
                along * (0.5 * t * t) + (out * (1.0 - cos) + ahead * (rate * t - sin)) / (rate * rate),
            )
        } else {
            (a * t, a * (0.5 * t * t))
        };
        later.velocity = (v + change).into();
        later.place = (x + v * t + path).into();
    }
    later
}

/// What differs most, in words.
fn varies(now: &DMatrix<f64>, then: &DMatrix<f64>) -> &'static str {
    let gaps = (then - now).abs();
    match (0..gaps.ncols())
        .max_by(|a, b| gaps.column(*a).amax().total_cmp(&gaps.column(*b).amax()))
        .unwrap_or(0)
    {
        0 => "its load",
        column => match column - 1 {
            THETA..OMEGA => "its slope by the attitude",
            OMEGA..VELOCITY => "its slope by the angular velocity",
            VELOCITY..DISPLACED => "its slope by the velocity",
            _ => "its slope by a displacement or its rate",
        },
    }
}

/// True if loads or their slopes differ from those at `t = 0`.
pub(super) fn changed(now: &DMatrix<f64>, then: &DMatrix<f64>) -> bool {
    let gap = (then - now).amax();
    !(gap <= CONSTANT_LOAD * now.amax().max(then.amax()))
}

/// Value and slopes in units of a moment: lengths in units of the body's, coordinates of its inertia, times of the period.
pub(super) fn weighted(body: &FlexibleBody, slopes: &Slopes, period: f64) -> DMatrix<f64> {
    let n = body.coordinates().len();
    let elastic = body.elastic();
    let free = body.translation().is_some();
    let length = length(body);
    let inertia = length * length * body.invariants().mass;
    let unit = |j: usize| {
        let pairs = &body.invariants().pairs;
        pairs.row(j).find(|(k, _)| *k == j).map_or(1.0, |(_, pair)| (inertia / pair.A).sqrt())
    };
    let row = |i: usize| {
        if i < 3 {
            1.0
        } else if i < 3 + n {
            unit(i - 3)
        } else {
            length
        }
    };
    let column = |k: usize| match k {
        THETA..OMEGA => 1.0,
        OMEGA..VELOCITY => period.recip(),
        // The velocity of a constrained pole is given in inertial axes, and no unknown.
        VELOCITY..DISPLACED => {
            if free {
                length / period
            } else {
                0.0
            }
        }
        _ if k < DISPLACED + elastic => unit(k - DISPLACED),
        _ => unit(k - DISPLACED - elastic) / period,
    };
    let (rows, columns) = slopes.by.shape();
    let value = |i: usize| {
        if i < 3 {
            slopes.value.moment[i]
        } else if i < 3 + n {
            slopes.value.generalized[i - 3]
        } else {
            slopes.value.force[i - 3 - n]
        }
    };
    DMatrix::from_fn(rows, columns + 1, |i, k| {
        row(i) * if k == 0 { value(i) } else { column(k - 1) * slopes.by[(i, k - 1)] }
    })
}
