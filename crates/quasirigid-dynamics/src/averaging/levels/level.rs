//! Level curve of the slow energy, traced once round: period, loss, angle and nutation.
//! The curve runs along `K × ∇H`, which keeps the energy exactly; curves of `K × Ω` do not close. The solid angle about the long axis gives
//! the precession without a singularity near that axis.
//! Equations (N3), (N4) and (N7), docs/theory/17-levels.md.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::energy::SlowEnergy;
use crate::math::ode::{Dop853, Solver, System};
use crate::math::rotation::angle;
use crate::math::simd::{Arithmetic, Unfused};
use crate::math::vec3::{add, cross, dot, norm, scale};

/// One circuit of the angular momentum along a level curve of the slow energy. (N4)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// Slow energy (J).
    pub energy: f64,
    /// Period (s).
    pub period: f64,
    /// Mean power dissipated (W).
    pub power: f64,
    /// Mean rate of revolutions about the angular momentum (1/s).
    pub revolutions: f64,
    /// Mean rate (rad/s) at which the axis of least inertia goes round the angular momentum. (N7)
    pub long_axis_precession_rate: f64,
    /// Least and greatest angle (rad) between the angular momentum and the steady spin circled.
    pub nutation: [f64; 2],
}

/// Error allowed per step, relative to the size of the level.
const STEP_TOLERANCE: f64 = 1e-13;
/// Error allowed per step in a unit vector at least: some roundings.
const DIRECTION_ROUNDING: f64 = 1e-15;
/// Limit of steps per circuit; next to a saddle a circuit takes some hundred.
const MAX_STEPS: usize = 20_000;
/// A return nearer to the start than this share of the size of the level closes it.
const CLOSED: f64 = 1e-4;
/// Places checked within a step.
const CHECKS_PER_STEP: usize = 6;
/// Difference of the slow energy in opposite directions, over its largest slope, that is rounding.
const SYMMETRIC: f64 = 1e-12;
/// Halvings of a step that find a crossing.
const HALVINGS: usize = 60;

/// State on a level: the place, the time (s), the energy dissipated (J), the angle turned about the angular momentum (rad), the solid
/// angle swept about the axis of least inertia (rad).
type State = [f64; 7];

/// Motion along a level at the speed of the canonical equations; time runs at the ratio `s`. (N3)
struct Along<'a> {
    energy: &'a SlowEnergy,
    /// Sense of the axis of least inertia that the level starts nearer to.
    axis: [f64; 3],
}

impl System<State> for Along<'_> {
    fn rate<A: Arithmetic>(&mut self, _: f64, y: &State, rate: &mut State) {
        let u = [y[0], y[1], y[2]];
        let (velocity, ratio) = self.energy.velocity(u);
        let [power, turning] = self.energy.power(u, scale(ratio, velocity));
        let slowness = ratio.recip();
        let swept = dot(self.axis, cross(u, velocity)) / (1.0 + dot(self.axis, u));
        *rate =
            [velocity[0], velocity[1], velocity[2], slowness, power * slowness, turning * slowness, swept];
    }
}

/// Traced level, with the sums that [`Level`] is made of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Traced {
    pub period: f64,
    /// Energy dissipated in a circuit (J).
    pub loss: f64,
    /// Angle turned about the angular momentum in a circuit (rad).
    pub turned: f64,
    /// Angle by which the axis of least inertia goes round the angular momentum in a circuit (rad).
    pub precession: f64,
    pub nutation: [f64; 2],
}

impl Traced {
    /// Smaller level next to the same minimum, at a `share` of the height above it. (N5)
    ///
    /// About an isolated minimum a circuit keeps its period and its angles, and amplitudes go with the root of the height. About a family
    /// of minima, whose nutation has a `limit` (rad), the speed goes with the distance from the family as the amplitude does.
    pub fn smaller(self, share: f64, limit: Option<f64>) -> Self {
        let root = share.sqrt();
        let longer = if limit.is_some() { root.recip() } else { 1.0 };
        let limit = limit.unwrap_or(0.0);
        Self {
            period: longer * self.period,
            loss: share * longer * self.loss,
            turned: longer * self.turned,
            precession: longer * self.precession,
            nutation: self.nutation.map(|angle| limit + root * (angle - limit)),
        }
    }

    /// Public level, with its slow energy (J).
    pub fn level(&self, energy: f64) -> Level {
        let Self { period, loss, turned, precession, nutation } = *self;
        Level {
            energy,
            period,
            power: loss / period,
            revolutions: turned / (TAU * period),
            long_axis_precession_rate: precession / period,
            nutation,
        }
    }
}

/// Follows the level through a unit vector once round; angles of nutation are measured from `pole`, and `look` sees the places passed.
/// None where the level does not close, as on a separatrix. (N4)
pub(super) fn traced(
    energy: &SlowEnergy,
    start: [f64; 3],
    pole: [f64; 3],
    mut look: impl FnMut([f64; 3]),
) -> Option<Traced> {
    let (velocity, _) = energy.velocity(start);
    let speed = norm(velocity);
    if !(speed > 0.0) {
        return None;
    }
    let allowed = allowed(energy, (speed / energy.fastest).min(1.0));
    let axis = scale(dot(energy.long_axis, start).signum(), energy.long_axis);
    let y = [start[0], start[1], start[2], 0.0, 0.0, 0.0, 0.0];
    let mut solver = Dop853::<_, _, Unfused>::new(Along { energy, axis }, 0.0, y, allowed);
    let behind = |y: &State| dot([y[0] - start[0], y[1] - start[1], y[2] - start[2]], velocity);
    let mut turn = Turn { nutation: [angle(pole, start); 2], extent: 0.0, last: start, azimuth: 0.0 };
    for _ in 0..MAX_STEPS {
        let (t, before) = (solver.t(), *solver.y());
        solver.step(f64::INFINITY).ok()?;
        let dense = solver.dense();
        let h = solver.t() - t;
        for i in 1..=CHECKS_PER_STEP {
            let y = dense.at(t + h * i as f64 / CHECKS_PER_STEP as f64);
            let u = [y[0], y[1], y[2]];
            turn.extent = turn.extent.max(norm(add(u, scale(-1.0, start))));
            turn.go(u, axis);
            look(u);
        }
        let away = |time: f64| {
            let y = dense.at(time);
            let u = [y[0], y[1], y[2]];
            dot(energy.velocity(u).0, pole)
        };
        let crossed = behind(&before) < 0.0 && behind(solver.y()) >= 0.0;
        let end = if crossed { crossing(|time| behind(&dense.at(time)), t, t + h) } else { t + h };
        let middle = 0.5 * (t + end);
        for [from, to] in [[t, middle], [middle, end]] {
            if (away(from) < 0.0) != (away(to) < 0.0) {
                let y = dense.at(crossing(away, from, to));
                turn.see(angle(pole, [y[0], y[1], y[2]]));
            }
        }
        if crossed {
            let y = dense.at(end);
            if norm([y[0] - start[0], y[1] - start[1], y[2] - start[2]]) < CLOSED * turn.extent {
                let precession = y[5] + TAU * (turn.azimuth / TAU).round() - y[6];
                return Some(Traced {
                    period: y[3],
                    loss: y[4],
                    turned: y[5],
                    precession,
                    nutation: from_nearer_sense(energy, start, turn.nutation),
                });
            }
        }
    }
    None
}

/// Angles from the nearer of both senses of an axis, where the slow energy is the same in opposite directions: there a level about one sense stands for
/// that about the other.
pub(super) fn from_nearer_sense(energy: &SlowEnergy, u: [f64; 3], angles: [f64; 2]) -> [f64; 2] {
    let opposite = energy.energy(scale(-1.0, u)) - energy.energy(u);
    let [least, greatest] = angles;
    let other = least > FRAC_PI_2 && opposite.abs() <= SYMMETRIC * energy.fastest;
    if other { [PI - greatest, PI - least] } else { angles }
}

/// Quantities gathered along the circuit.
struct Turn {
    nutation: [f64; 2],
    extent: f64,
    last: [f64; 3],
    /// Angle gone round the axis of least inertia (rad).
    azimuth: f64,
}

impl Turn {
    fn go(&mut self, u: [f64; 3], axis: [f64; 3]) {
        let along = dot(u, axis) * dot(self.last, axis);
        self.azimuth += dot(axis, cross(self.last, u)).atan2(dot(self.last, u) - along);
        self.last = u;
    }

    fn see(&mut self, angle: f64) {
        self.nutation = [self.nutation[0].min(angle), self.nutation[1].max(angle)];
    }
}

/// Errors allowed per step on a level of a size relative to the largest: the place to a share of the size of the level, the rest to a
/// share of their values over a circuit.
fn allowed(energy: &SlowEnergy, size: f64) -> State {
    let SlowEnergy { fastest, largest_power, fastest_turning, .. } = *energy;
    let place = (STEP_TOLERANCE * size).max(DIRECTION_ROUNDING);
    let time = 10.0 * STEP_TOLERANCE / fastest;
    let loss = if largest_power > 0.0 { largest_power * size * size * time } else { f64::INFINITY };
    [place, place, place, time, loss, fastest_turning * time, place]
}

/// Time between two times where a function changes its sign, by bisection.
fn crossing(function: impl Fn(f64) -> f64, mut from: f64, mut to: f64) -> f64 {
    let negative = function(from) < 0.0;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (from + to);
        if middle <= from || middle >= to {
            break;
        }
        if (function(middle) < 0.0) == negative {
            from = middle;
        } else {
            to = middle;
        }
    }
    0.5 * (from + to)
}
