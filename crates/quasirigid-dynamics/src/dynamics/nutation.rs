//! Nutation angle: least and greatest angle between the angular momentum and the axis of the steady spin circled.
//! The angle varies over a period without any dissipation, so both are taken over one circuit of the level of the slow energy through the
//! state, not at the instant.
//! Equation (P8), docs/theory/05-propagation.md; (N1), docs/theory/17-levels.md.

use super::steady::{all_steady_spins, steady_angular_momentum};
use crate::math::ode::{Checkpoint, Dop853, Solver, System};
use crate::math::polynomial::{Kernel, Series};
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
    slow_energy: Series,
    /// Angular momenta (N·m·s) of the steady spins that others circle.
    steady: Vec<[f64; 3]>,
    /// Slow energy (J) and `|K|` of the last level, with its nutation.
    last: Option<(f64, f64, Nutation)>,
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
        let slow_energy = body.energy_of_momentum.even();
        let slope = Kernel::new(&deviator(&slow_energy.gradient(), 1.0));
        Self { body, slope, slow_energy, steady: Vec::new(), last: None }
    }

    /// Saves what the next nutations start from.
    pub fn save(&self, checkpoint: &mut Checkpoint) {
        checkpoint.save_list(self.steady.as_flattened());
        let last = self.last.map(|(energy, G, Nutation { axis: [x, y, z], least, greatest })| {
            vec![energy, G, x, y, z, least, greatest]
        });
        checkpoint.save_list(&last.unwrap_or_default());
    }

    /// Goes on from a checkpoint; none if it is of something else.
    pub fn load(&mut self, checkpoint: &mut Checkpoint) -> Option<()> {
        let steady = checkpoint.load_list()?;
        let (steady, rest) = steady.as_chunks();
        self.steady = steady.to_vec();
        self.last = match checkpoint.load_list()?[..] {
            [] => None,
            [energy, G, x, y, z, least, greatest] => {
                Some((energy, G, Nutation { axis: [x, y, z], least, greatest }))
            }
            _ => return None,
        };
        rest.is_empty().then_some(())
    }

    /// Nutation at an angular momentum `K` (N·m·s, body axes); none at `K = 0`, where every spin is steady, and on a separatrix.
    pub fn at(&mut self, K: [f64; 3]) -> Option<Nutation> {
        let (G, energy) = (norm(K), self.slow_energy.scalar(K));
        if !(G > 0.0 && G.is_finite()) {
            return None;
        }
        if let Some((known, angular_momentum, nutation)) = self.last
            && (energy - known).abs() <= SAME_LEVEL * known.abs()
            && (G - angular_momentum).abs() <= SAME_LEVEL * G
        {
            return Some(nutation);
        }
        self.move_steady(G);
        let nutation = self.turn(scale(G.recip(), K), G)?;
        self.last = Some((energy, G, nutation));
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

    fn turn(&self, start: [f64; 3], angular_momentum: f64) -> Option<Nutation> {
        let along = Along { slope: &self.slope, angular_momentum };
        let velocity = along.velocity(start);
        let spin = norm(self.body.angular_velocity(scale(angular_momentum, start)));
        if norm(velocity) <= AT_REST * spin {
            let axis = self.circled(start)?;
            let angle = angle(axis, start);
            return Some(Nutation { axis, least: angle, greatest: angle });
        }
        let size = angle(self.circled(start)?, start).min(1.0);
        let places = once_round(&along, start, velocity, (STEP_TOLERANCE * size).max(DIRECTION_ROUNDING))?;
        let mean = places.windows(2).fold([0.0; 3], |sum, pair| {
            let ((before, from), (after, to)) = (pair[0], pair[1]);
            add(sum, scale(after - before, add(from, to)))
        });
        let axis = self.circled(mean)?;
        let angles = places.windows(2).flat_map(|pair| [Some(pair[0].1), extreme(&along, axis, pair)]);
        let angles = angles.flatten().map(|u| angle(axis, u));
        let (least, greatest) =
            angles.fold((f64::INFINITY, 0.0_f64), |(low, high), angle| (low.min(angle), high.max(angle)));
        Some(Nutation { axis, least, greatest })
    }

    /// Direction of the steady spin nearest to a direction.
    fn circled(&self, direction: [f64; 3]) -> Option<[f64; 3]> {
        let axes = self.steady.iter().map(|K| scale(norm(*K).recip(), *K));
        axes.max_by(|a, b| dot(*a, direction).total_cmp(&dot(*b, direction)))
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
