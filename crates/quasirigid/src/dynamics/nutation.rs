use super::steady::{all_steady_spins, steady_momentum};
use crate::math::ode::{Dop853, Solver, System};
use crate::math::polynomial::{Kernel, Series};
use crate::math::rotation::angle;
use crate::math::simd::{Arithmetic, Plain};
use crate::math::sphere::{StationaryKind, deviator};
use crate::math::vec3::{add, cross, dot, norm, scale};
use crate::model::ReducedBody;

/// Nutation, or wobble: the least and the greatest angle between the angular momentum and the axis of the steady spin that it circles,
/// over one turn of the nutation. (P8)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nutation {
    /// The angular momentum of the steady spin circled, as a unit vector in body axes: that of the deformed body, momentum wheels
    /// included.
    pub axis: [f64; 3],
    /// Least angle (rad).
    pub least: f64,
    /// Greatest angle (rad).
    pub greatest: f64,
}

/// Finds the nutation at one momentum after the other. (P8)
#[derive(Clone, Debug)]
pub struct Nutations<'b> {
    body: &'b ReducedBody,
    /// `∇H`, but for what is the same along every axis.
    slope: Kernel,
    slow_energy: Series,
    /// Momenta (N·m·s) of steady spins that others circle.
    steady: Vec<[f64; 3]>,
    /// Slow energy (J) and `|K|` of the last level, with its nutation.
    last: Option<(f64, f64, Nutation)>,
}

/// Error allowed per step of a turn in the direction of the momentum, relative to the angle from the next steady spin, and at least.
const TOLERANCE: f64 = 1e-11;
const ROUNDING: f64 = 1e-15;
/// Steps that one turn may take.
const STEPS: usize = 2_000;
/// Looks within a step.
const LOOKS: usize = 6;
/// Halvings of a step that find where an angle is least or greatest.
const HALVINGS: usize = 40;
/// A return nearer to the start than this share of the size of the turn closes it.
const CLOSED: f64 = 1e-4;
/// Rate of change of the direction, relative to the spin, below which a spin is steady.
const AT_REST: f64 = 1e-12;
/// Levels whose energies and momenta differ by less, relative to themselves, are the same.
const SAME: f64 = 1e-15;

/// The direction of the momentum along its level.
struct Along<'a> {
    slope: &'a Kernel,
    momentum: f64,
}

impl Along<'_> {
    #[inline(always)]
    fn velocity(&self, u: [f64; 3]) -> [f64; 3] {
        let [x, y, z, _] = self.slope.value::<Plain>(scale(self.momentum, u));
        cross(u, [x, y, z])
    }
}

impl System<[f64; 3]> for Along<'_> {
    fn rate<A: Arithmetic>(&mut self, _: f64, u: &[f64; 3], rate: &mut [f64; 3]) {
        *rate = self.velocity(*u);
    }
}

impl<'b> Nutations<'b> {
    /// The nutations of a reduced body.
    #[must_use]
    pub fn new(body: &'b ReducedBody) -> Self {
        let slow_energy = body.energy_of_momentum.even();
        let slope = Kernel::new(&deviator(&slow_energy.gradient(), 1.0));
        Self { body, slope, slow_energy, steady: Vec::new(), last: None }
    }

    /// The nutation at a momentum `K` (N·m·s, body axes); none where nothing turns, where every spin is steady, and on a separatrix.
    pub fn at(&mut self, K: [f64; 3]) -> Option<Nutation> {
        let (G, energy) = (norm(K), self.slow_energy.scalar(K));
        if !(G > 0.0 && G.is_finite()) {
            return None;
        }
        if let Some((known, momentum, nutation)) = self.last
            && (energy - known).abs() <= SAME * known.abs()
            && (G - momentum).abs() <= SAME * G
        {
            return Some(nutation);
        }
        self.move_steady(G);
        let nutation = self.turn(scale(G.recip(), K), G)?;
        self.last = Some((energy, G, nutation));
        Some(nutation)
    }

    /// The steady spins with this momentum, from those with another.
    fn move_steady(&mut self, G: f64) {
        if self.steady.is_empty() {
            let spins = all_steady_spins(self.body, G).isolated.into_iter();
            self.steady =
                spins.filter(|spin| spin.kind != StationaryKind::Saddle).map(|spin| spin.momentum).collect();
        } else if self.steady.iter().any(|K| (norm(*K) - G).abs() > SAME * G) {
            let moved = self.steady.iter().filter_map(|K| {
                steady_momentum(&self.body.Omega, scale(norm(*K).recip(), *K), G).map(Into::into)
            });
            self.steady = moved.collect();
        }
    }

    fn turn(&self, start: [f64; 3], momentum: f64) -> Option<Nutation> {
        let along = Along { slope: &self.slope, momentum };
        let velocity = along.velocity(start);
        let spin = norm(self.body.Omega.vector(scale(momentum, start)));
        if norm(velocity) <= AT_REST * spin {
            let axis = self.circled(start)?;
            let angle = angle(axis, start);
            return Some(Nutation { axis, least: angle, greatest: angle });
        }
        let size = angle(self.circled(start)?, start).min(1.0);
        let places = once_round(&along, start, velocity, (TOLERANCE * size).max(ROUNDING))?;
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

    /// The steady spin next to a direction.
    fn circled(&self, direction: [f64; 3]) -> Option<[f64; 3]> {
        let axes = self.steady.iter().map(|K| scale(norm(*K).recip(), *K));
        axes.max_by(|a, b| dot(*a, direction).total_cmp(&dot(*b, direction)))
    }
}

/// A place on a level and when it is passed.
type Passed = (f64, [f64; 3]);

/// Places on the level through a unit vector, once round, close together; none where it does not come back.
fn once_round(along: &Along<'_>, start: [f64; 3], velocity: [f64; 3], allowed: f64) -> Option<Vec<Passed>> {
    let system = Along { slope: along.slope, momentum: along.momentum };
    let mut solver = Dop853::<_, _, Plain>::new(system, 0.0, start, [allowed; 3]);
    let from_start = |u: [f64; 3]| add(u, scale(-1.0, start));
    let behind = |u: [f64; 3]| dot(from_start(u), velocity) < 0.0;
    let (mut places, mut extent) = (vec![(0.0, start)], 0.0_f64);
    for _ in 0..STEPS {
        let (t, before) = (solver.t(), *solver.y());
        solver.step(f64::INFINITY).ok()?;
        let (dense, h) = (solver.dense(), solver.t() - t);
        for look in 1..=LOOKS {
            let time = t + h * look as f64 / LOOKS as f64;
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

/// Where the angle from an axis is least or greatest between two places next to each other; none if it is so at neither. The way
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

/// The first of the numbers from 0 to 1 of which something holds that holds of 1 and not of 0.
fn first(holds: impl Fn(f64) -> bool) -> f64 {
    let (mut from, mut to) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (from + to);
        if holds(middle) { to = middle } else { from = middle }
    }
    to
}
