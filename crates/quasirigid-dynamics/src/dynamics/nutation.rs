//! Nutation angle: least and greatest angle between the angular momentum and the axis of the steady spin circled.
//! The angle varies over a period without any dissipation, so both are taken over one circuit of the level of the slow energy through the
//! state, not at the instant. From one level to the next the extreme angles are followed by Newton's method, which costs a thirtieth of a
//! circuit.
//! Equation (P8), docs/theory/05-propagation.md; (N1), docs/theory/17-levels.md.

use super::steady::{all_steady_spins, steady_angular_momentum};
use crate::math::ode::{Checkpoint, Dop853, Solver, System};
use crate::math::polynomial::Kernel;
use crate::math::rotation::angle;
use crate::math::simd::{Arithmetic, Unfused};
use crate::math::sphere::{StationaryKind, deviator};
use crate::math::vec3::{add, cross, dot, norm, scale};
use crate::model::ReducedBody;

/// Nutation, or wobble: the least and the greatest angle between the angular momentum and the axis of the steady spin that it circles,
/// over one period of the nutation. (P8)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nutation {
    /// Direction of the angular momentum of the steady spin circled, body axes: that of the deformed body, momentum wheels included.
    pub axis: [f64; 3],
    /// Least angle (rad).
    pub least: f64,
    /// Greatest angle (rad).
    pub greatest: f64,
}

/// Computes the nutation at successive angular momenta. (P8)
#[derive(Clone, Debug)]
pub struct Nutations<'b> {
    body: &'b ReducedBody,
    /// `∇H` without its isotropic part.
    slope: Kernel,
    slow_energy: Kernel,
    /// Angular momenta (N·m·s) of the steady spins that others circle.
    steady: Vec<[f64; 3]>,
    last: Option<Level>,
}

/// A level of the slow energy at an angular momentum.
#[derive(Clone, Debug)]
struct Level {
    /// Slow energy (J).
    energy: f64,
    /// `|K|` (N·m·s).
    angular_momentum: f64,
    nutation: Nutation,
    /// Directions of `K` where the angle from the axis is stationary; none where it is the same all round.
    extremes: Vec<[f64; 3]>,
    /// Greatest angle (rad) of the last level that was gone round; 0 where none is followed from it.
    circuit: f64,
}

/// Error allowed per step in the direction of the angular momentum: relative to the angle from the next steady spin, and at least.
const STEP_TOLERANCE: f64 = 1e-11;
const DIRECTION_ROUNDING: f64 = 1e-15;
/// Limit of steps per circuit.
const MAX_STEPS: usize = 2_000;
/// Places checked within a step.
const CHECKS_PER_STEP: usize = 6;
/// Halvings that locate an extreme angle.
const HALVINGS: usize = 40;
/// Distance from the start, as a share of the size of the circuit, at which the circuit counts as closed.
const CLOSED: f64 = 1e-4;
/// Rate of change of the direction, relative to the angular velocity, below which a spin is steady.
const AT_REST: f64 = 1e-12;
/// Relative difference of energies and of angular momenta below which levels are the same.
const SAME_LEVEL: f64 = 1e-15;
/// Least angle (rad) that is followed; the energy resolves smaller ones to less than ten digits.
const FOLLOWED: f64 = 1e-3;
/// Relative change of the greatest angle after which a level is gone round anew.
const FAR: f64 = 0.02;
/// Limit of Newton's steps to an extreme angle, and the last of them (rad).
const NEWTON_STEPS: usize = 6;
const NEWTON_CLOSED: f64 = 1e-13;
/// Step of the differences in Newton's method (rad).
const DIFFERENCE: f64 = 1e-6;
/// Share of the motion of the direction towards or away from the axis that is none.
const CIRCLE: f64 = 1e-10;
/// Angle (rad) by which the state may lie outside the extremes that are followed.
const OUTSIDE: f64 = 1e-10;

/// Motion of the direction of the angular momentum along its level.
struct Along<'a> {
    slope: &'a Kernel,
    angular_momentum: f64,
}

impl Along<'_> {
    #[inline(always)]
    fn velocity(&self, u: [f64; 3]) -> [f64; 3] {
        let [x, y, z, _] = self.slope.at(scale(self.angular_momentum, u));
        cross(u, [x, y, z])
    }

    /// Whether the direction moves around an axis, neither towards it nor away.
    fn keeps_angle(&self, axis: [f64; 3], u: [f64; 3]) -> bool {
        let velocity = self.velocity(u);
        dot(velocity, axis).abs() <= CIRCLE * norm(velocity)
    }
}

impl System<[f64; 3]> for Along<'_> {
    fn rate<A: Arithmetic>(&mut self, _: f64, u: &[f64; 3], rate: &mut [f64; 3]) {
        *rate = self.velocity(*u);
    }
}

impl<'b> Nutations<'b> {
    /// Nutations of a reduced body.
    #[must_use]
    pub fn new(body: &'b ReducedBody) -> Self {
        let energy = body.energy_of_momentum.even();
        let slope = Kernel::new(&deviator(&energy.gradient(), 1.0));
        Self { body, slope, slow_energy: Kernel::new(&energy), steady: Vec::new(), last: None }
    }

    /// Saves what the next nutations start from.
    pub fn save(&self, checkpoint: &mut Checkpoint) {
        checkpoint.save_list(self.steady.as_flattened());
        checkpoint.save_list(&self.last.as_ref().map(Level::numbers).unwrap_or_default());
    }

    /// Goes on from a checkpoint; none if it is of something else.
    pub fn load(&mut self, checkpoint: &mut Checkpoint) -> Option<()> {
        let steady = checkpoint.load_list()?;
        let (steady, rest) = steady.as_chunks();
        self.steady = steady.to_vec();
        self.last = match &checkpoint.load_list()?[..] {
            [] => None,
            numbers => Some(Level::of_numbers(numbers)?),
        };
        rest.is_empty().then_some(())
    }

    /// Nutation at an angular momentum `K` (N·m·s, body axes); none at `K = 0`, where every spin is steady, and on a separatrix.
    pub fn at(&mut self, K: [f64; 3]) -> Option<Nutation> {
        let (G, energy) = (norm(K), self.slow_energy.at(K)[0]);
        if !(G > 0.0 && G.is_finite()) {
            return None;
        }
        if let Some(last) = &self.last
            && (energy - last.energy).abs() <= SAME_LEVEL * last.energy.abs()
            && (G - last.angular_momentum).abs() <= SAME_LEVEL * G
        {
            return Some(last.nutation);
        }
        self.move_steady(G);
        let u = scale(G.recip(), K);
        let level = self.followed(u, G, energy).or_else(|| self.gone_round(u, G, energy))?;
        let nutation = level.nutation;
        self.last = Some(level);
        Some(nutation)
    }

    /// Moves the steady spins to this angular momentum from the last one.
    fn move_steady(&mut self, G: f64) {
        if self.steady.is_empty() {
            let spins = all_steady_spins(self.body, G).isolated.into_iter();
            self.steady = spins
                .filter(|spin| spin.kind != StationaryKind::Saddle)
                .map(|spin| spin.angular_momentum)
                .collect();
        } else if self.steady.iter().any(|K| (norm(*K) - G).abs() > SAME_LEVEL * G) {
            let gradient = self.body.energy_of_momentum.gradient();
            let moved = self.steady.iter().filter_map(|K| {
                steady_angular_momentum(&gradient, scale(norm(*K).recip(), *K), G).map(Into::into)
            });
            self.steady = moved.collect();
        }
    }

    /// The level through a direction, by a circuit.
    fn gone_round(&self, start: [f64; 3], angular_momentum: f64, energy: f64) -> Option<Level> {
        let along = Along { slope: &self.slope, angular_momentum };
        let velocity = along.velocity(start);
        let spin = norm(self.body.angular_velocity(scale(angular_momentum, start)));
        if norm(velocity) <= AT_REST * spin {
            let nutation = Nutation::alike(self.circled(start)?, start);
            return Some(Level { energy, angular_momentum, nutation, extremes: Vec::new(), circuit: 0.0 });
        }
        let size = angle(self.circled(start)?, start).min(1.0);
        let places = once_round(&along, start, velocity, (STEP_TOLERANCE * size).max(DIRECTION_ROUNDING))?;
        let mean = places.windows(2).fold([0.0; 3], |sum, pair| {
            let ((before, from), (after, to)) = (pair[0], pair[1]);
            add(sum, scale(after - before, add(from, to)))
        });
        let axis = self.circled(mean)?;
        if places.iter().all(|(_, u)| along.keeps_angle(axis, *u)) {
            let nutation = Nutation::alike(axis, start);
            let circuit = nutation.greatest;
            return Some(Level { energy, angular_momentum, nutation, extremes: Vec::new(), circuit });
        }
        let exact = |u: [f64; 3]| {
            let found = self.stationary(&along, axis, energy, u).filter(|_| angle(axis, u) >= FOLLOWED);
            found.unwrap_or(u)
        };
        let extremes = places.windows(2).filter_map(|pair| extreme(&along, axis, pair).map(exact));
        let extremes: Vec<_> = extremes.collect();
        let passed = places.iter().map(|(_, u)| u);
        let nutation = Nutation::between(axis, passed.chain(&extremes));
        let circuit = if extremes.is_empty() { 0.0 } else { nutation.greatest };
        Some(Level { energy, angular_momentum, nutation, extremes, circuit })
    }

    /// The level through a direction, its extreme angles followed from the last level; none where they cannot be. Circles about the axis
    /// have none: the angle is that of the direction.
    fn followed(&self, start: [f64; 3], angular_momentum: f64, energy: f64) -> Option<Level> {
        let last = self.last.as_ref()?;
        let axis = self.circled(last.nutation.axis)?;
        if last.is_circle() {
            let nutation = Nutation::alike(axis, start);
            let here = nutation.greatest;
            let near = here >= FOLLOWED && (here / last.circuit - 1.0).abs() <= FAR;
            return near.then(|| Level { energy, angular_momentum, nutation, ..last.clone() });
        }
        let along = Along { slope: &self.slope, angular_momentum };
        let extremes = last.extremes.iter().map(|u| self.stationary(&along, axis, energy, *u));
        let extremes = extremes.collect::<Option<Vec<_>>>()?;
        let nutation = Nutation::between(axis, extremes.iter());
        let Nutation { least, greatest, .. } = nutation;
        let here = angle(axis, start);
        let near = least >= FOLLOWED && (greatest / last.circuit - 1.0).abs() <= FAR;
        let on_it = here >= least - OUTSIDE && here <= greatest + OUTSIDE;
        (near && on_it).then_some(Level {
            energy,
            angular_momentum,
            nutation,
            extremes,
            circuit: last.circuit,
        })
    }

    /// Direction on a level, next to another one, at which the angle from an axis is stationary, by Newton's method with differences; none
    /// where it does not close.
    fn stationary(&self, along: &Along<'_>, axis: [f64; 3], energy: f64, near: [f64; 3]) -> Option<[f64; 3]> {
        let defect = |u: [f64; 3]| {
            let above = self.slow_energy.at(scale(along.angular_momentum, u))[0] - energy;
            [above, dot(along.velocity(u), axis)]
        };
        let unit = |v: [f64; 3]| scale(norm(v).recip(), v);
        let mut u = near;
        for _ in 0..NEWTON_STEPS {
            let across = unit(cross(axis, u));
            let tangents = [across, cross(u, across)];
            let [f, g] = defect(u);
            let [[f_a, g_a], [f_b, g_b]] = tangents.map(|tangent| {
                let [there, turned] = defect(unit(add(u, scale(DIFFERENCE, tangent))));
                [(there - f) / DIFFERENCE, (turned - g) / DIFFERENCE]
            });
            let determinant = f_a * g_b - f_b * g_a;
            let [a, b] = [(f_b * g - f * g_b) / determinant, (f * g_a - f_a * g) / determinant];
            u = unit(add(u, add(scale(a, tangents[0]), scale(b, tangents[1]))));
            if a.hypot(b) <= NEWTON_CLOSED {
                return Some(u).filter(|u| angle(*u, near) <= FAR * angle(axis, near));
            }
        }
        None
    }

    /// Direction of the steady spin nearest to a direction.
    fn circled(&self, direction: [f64; 3]) -> Option<[f64; 3]> {
        let axes = self.steady.iter().map(|K| scale(norm(*K).recip(), *K));
        axes.max_by(|a, b| dot(*a, direction).total_cmp(&dot(*b, direction)))
    }
}

impl Nutation {
    /// The angle of a direction from an axis, the same all round.
    fn alike(axis: [f64; 3], direction: [f64; 3]) -> Self {
        let angle = angle(axis, direction);
        Self { axis, least: angle, greatest: angle }
    }

    /// Least and greatest angle of directions from an axis.
    fn between<'a>(axis: [f64; 3], directions: impl Iterator<Item = &'a [f64; 3]>) -> Self {
        let (least, greatest) = directions
            .map(|u| angle(axis, *u))
            .fold((f64::INFINITY, 0.0_f64), |(low, high), angle| (low.min(angle), high.max(angle)));
        Self { axis, least, greatest }
    }
}

impl Level {
    /// Whether the angle is the same all round, as for a body of revolution.
    fn is_circle(&self) -> bool {
        self.extremes.is_empty() && self.circuit > 0.0
    }

    /// Numbers from which it is made again.
    fn numbers(&self) -> Vec<f64> {
        let Nutation { axis: [x, y, z], least, greatest } = self.nutation;
        let mut numbers = vec![self.energy, self.angular_momentum, self.circuit, x, y, z, least, greatest];
        numbers.extend(self.extremes.as_flattened());
        numbers
    }

    fn of_numbers(numbers: &[f64]) -> Option<Self> {
        let ([energy, angular_momentum, circuit, x, y, z, least, greatest], rest) =
            numbers.split_first_chunk()?;
        let (extremes, left) = rest.as_chunks();
        let nutation = Nutation { axis: [*x, *y, *z], least: *least, greatest: *greatest };
        let [energy, angular_momentum, circuit] = [*energy, *angular_momentum, *circuit];
        let extremes = extremes.to_vec();
        left.is_empty().then_some(Self { energy, angular_momentum, nutation, extremes, circuit })
    }
}

/// Place on a level with the time of its passage.
type Passed = (f64, [f64; 3]);

/// Places on the level through a unit vector, once round, close together; none where the level does not close.
fn once_round(along: &Along<'_>, start: [f64; 3], velocity: [f64; 3], allowed: f64) -> Option<Vec<Passed>> {
    let system = Along { slope: along.slope, angular_momentum: along.angular_momentum };
    let mut solver = Dop853::<_, _, Unfused>::new(system, 0.0, start, [allowed; 3]);
    let from_start = |u: [f64; 3]| add(u, scale(-1.0, start));
    let behind = |u: [f64; 3]| dot(from_start(u), velocity) < 0.0;
    let (mut places, mut extent) = (vec![(0.0, start)], 0.0_f64);
    for _ in 0..MAX_STEPS {
        let (t, before) = (solver.t(), *solver.y());
        solver.step(f64::INFINITY).ok()?;
        let (dense, h) = (solver.dense(), solver.t() - t);
        for look in 1..=CHECKS_PER_STEP {
            let time = t + h * look as f64 / CHECKS_PER_STEP as f64;
            let u = dense.at(time);
            extent = extent.max(norm(from_start(u)));
            places.push((time, u));
        }
        if behind(before) && !behind(*solver.y()) {
            let back = first(|share| !behind(dense.at(t + share * h)));
            if norm(from_start(dense.at(t + back * h))) < CLOSED * extent {
                return Some(places);
            }
        }
    }
    None
}

/// Place between two neighbours where the angle from an axis is least or greatest; none without an extremum between them. The path
/// between them is a cubic.
fn extreme(along: &Along<'_>, axis: [f64; 3], pair: &[Passed]) -> Option<[f64; 3]> {
    let ((before, from), (after, to)) = (pair[0], pair[1]);
    let ends = [from, to].map(|u| scale(after - before, along.velocity(u)));
    let rises = |velocity: [f64; 3]| dot(velocity, axis) > 0.0;
    if rises(ends[0]) == rises(ends[1]) {
        return None;
    }
    let at = |s: f64| {
        let r = 1.0 - s;
        let places = add(scale(r * r * (1.0 + 2.0 * s), from), scale(s * s * (1.0 + 2.0 * r), to));
        add(places, add(scale(s * r * r, ends[0]), scale(-s * s * r, ends[1])))
    };
    Some(at(first(|share| rises(along.velocity(at(share))) != rises(ends[0]))))
}

/// Bisection: first number from 0 to 1 at which a condition holds that is false at 0 and true at 1.
fn first(holds: impl Fn(f64) -> bool) -> f64 {
    let (mut from, mut to) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (from + to);
        if holds(middle) { to = middle } else { from = middle }
    }
    to
}
