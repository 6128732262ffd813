//! DOP853 on lanes: eight trajectories of an autonomous system side by side, each with a step size of its own.
//! A trial is made in every lane at once; each accepts or rejects its own. Every operation is the one that [`Dop853`](super::Dop853) does, in
//! its order, so that a trajectory has the same bits in any lane and alone.
//! Method and coefficients `[@hairer1993]`.

use std::marker::PhantomData;

use super::dop853::{GROW, SAFETY_FACTOR, SHRINK, eighth_root, interpolant};
use super::dop853_tableau::{A, B, E3, E5, EXTRA, STAGES};
use super::system::{DenseOutput, REACH};
use crate::lanes::{Lanes, Mask};
use crate::simd::{Arithmetic, Task};

/// An autonomous system `ẏ = rate(y)` in lanes.
pub trait LaneSystem<const D: usize> {
    /// A trajectory takes a lane, in which the rate may depend on its start.
    fn begin(&mut self, lane: usize, start: &[f64; D]) {
        let _ = (lane, start);
    }

    /// Rate of the state in each lane.
    fn rate<R: Arithmetic>(&self, y: &[Lanes; D]) -> [Lanes; D];
}

/// Start of a trajectory at the time zero.
#[derive(Clone, Copy, Debug)]
pub struct LaneStart<const D: usize> {
    /// State.
    pub y: [f64; D],
    /// Rate of the state.
    pub rate: [f64; D],
    /// First step.
    pub h: f64,
    /// Error allowed per step in each component; infinite where it is not controlled.
    pub allowed: [f64; D],
}

/// DOP853 on lanes.
pub(super) struct Dop853Lanes<'a, S, R, const D: usize> {
    system: &'a mut S,
    t: Lanes,
    end: Lanes,
    h: Lanes,
    y: [Lanes; D],
    carry: [Lanes; D],
    /// Inverse of the error allowed per step.
    unit: [Lanes; D],
    /// Whether the last trial of the lane was rejected.
    rejected: Mask,
    /// Whether the rate just beyond `t` is undefined.
    undefined: Mask,
    /// Start, length and state at the start of the last step.
    last: (Lanes, Lanes),
    start: [Lanes; D],
    /// Rates at the stages; the rate of the state reached is at [`STAGES`].
    stages: [[Lanes; D]; STAGES + EXTRA + 1],
    arithmetic: PhantomData<R>,
}

/// What a trial came to in each lane.
pub(super) struct Trial {
    /// The step was made.
    pub accepted: Mask,
    /// The step was too small to try, and the lane stays as it is.
    pub stuck: Mask,
}

/// Rates of a system in lanes, as work that is compiled once.
struct LaneRate<'a, S, const D: usize> {
    system: &'a S,
    y: &'a [Lanes; D],
    rate: &'a mut [Lanes; D],
}

impl<S: LaneSystem<D>, const D: usize> Task for LaneRate<'_, S, D> {
    type Output = ();

    #[inline(always)]
    fn run<A: Arithmetic>(self) {
        *self.rate = self.system.rate::<A>(self.y);
    }
}

/// `Σ weight · stage`, written out, so that sums whose weights the compiler knows stay in registers and skip the zeros.
#[inline(always)]
fn weighted<R: Arithmetic, const D: usize>(weights: &[f64], stages: &[[Lanes; D]]) -> [Lanes; D] {
    let mut sum = [Lanes::splat(0.0); D];
    macro_rules! add {
        ($($place:literal)+) => {
            $(if $place < stages.len() && weights[$place] != 0.0 {
                for i in 0..D {
                    sum[i] = stages[$place][i].mul_add::<R>(Lanes::splat(weights[$place]), sum[i]);
                }
            })+
        };
    }
    add!(0 1 2 3 4 5 6 7 8 9 10 11 12 13 14);
    sum
}

/// `base + h Σ weight · stage`.
#[inline(always)]
fn combine<R: Arithmetic, const D: usize>(
    base: &[Lanes; D],
    h: Lanes,
    weights: &[f64],
    stages: &[[Lanes; D]],
) -> [Lanes; D] {
    let mut sum = weighted::<R, D>(weights, stages);
    for i in 0..D {
        sum[i] = sum[i].mul_add::<R>(h, base[i]);
    }
    sum
}

impl<'a, S: LaneSystem<D>, R: Arithmetic, const D: usize> Dop853Lanes<'a, S, R, D> {
    /// Every lane idle.
    #[inline(always)]
    pub fn new(system: &'a mut S) -> Self {
        let zero = Lanes::splat(0.0);
        Self {
            system,
            t: zero,
            end: zero,
            h: zero,
            y: [zero; D],
            carry: [zero; D],
            unit: [zero; D],
            rejected: Mask::NONE,
            undefined: Mask::NONE,
            last: (zero, zero),
            start: [zero; D],
            stages: [[zero; D]; STAGES + EXTRA + 1],
            arithmetic: PhantomData,
        }
    }

    /// Puts a trajectory into a lane, at the time zero.
    pub fn load(&mut self, lane: usize, start: &LaneStart<D>, end: f64) {
        self.system.begin(lane, &start.y);
        self.place(lane, start, end);
    }

    fn place(&mut self, lane: usize, start: &LaneStart<D>, end: f64) {
        (self.t.0[lane], self.end.0[lane], self.h.0[lane]) = (0.0, end, start.h);
        self.rejected.set(lane, false);
        self.undefined.set(lane, start.rate.iter().any(|rate| !rate.is_finite()));
        for i in 0..D {
            (self.y[i].0[lane], self.carry[i].0[lane]) = (start.y[i], 0.0);
            self.unit[i].0[lane] = start.allowed[i].recip();
            self.stages[STAGES][i].0[lane] = start.rate[i];
        }
    }

    /// Leaves a lane idle: its steps have no length.
    pub fn unload(&mut self, lane: usize) {
        let nothing = LaneStart { y: [0.0; D], rate: [0.0; D], h: 0.0, allowed: [f64::INFINITY; D] };
        self.place(lane, &nothing, 0.0);
    }

    /// Time reached in each lane.
    #[inline(always)]
    pub fn t(&self) -> Lanes {
        self.t
    }

    /// State reached in a lane.
    pub fn y(&self, lane: usize) -> [f64; D] {
        self.y.map(|component| component.0[lane])
    }

    /// Whether the rate just beyond the time of a lane is undefined.
    pub fn undefined(&self, lane: usize) -> bool {
        self.undefined.get(lane)
    }

    /// Tries a step in every lane.
    #[inline(always)]
    pub fn step(&mut self) -> Trial {
        let remaining = self.end - self.t;
        let reaches = (Lanes::splat(REACH) * remaining).at_most(self.h);
        let h = remaining.select(reaches, self.h);
        let stuck = h.at_most(Lanes::splat(f64::EPSILON) * self.t.abs());
        self.stages[0] = self.stages[STAGES];
        let start = self.y;
        self.rates_at::<1, STAGES>(&start, h);
        let change = combine::<R, D>(&self.carry, h, &B, &self.stages[..STAGES]);
        let error = self.error(h);
        let accepted = error.at_most(Lanes::splat(1.0)) & !stuck;
        self.adapt(h, error, [reaches, accepted, stuck]);
        self.accept(h, &change, [reaches, accepted]);
        Trial { accepted, stuck }
    }

    /// Rates at the stages from one to before another, each with weights that the compiler knows.
    #[inline(always)]
    fn rates_at<const FROM: usize, const TO: usize>(&mut self, start: &[Lanes; D], h: Lanes) {
        macro_rules! stages {
            ($($stage:literal)+) => {
                $(if FROM <= $stage && $stage < TO {
                    let place = combine::<R, D>(start, h, &A[$stage], &self.stages[..$stage]);
                    R::call(LaneRate { system: self.system, y: &place, rate: &mut self.stages[$stage] });
                })+
            };
        }
        stages!(1 2 3 4 5 6 7 8 9 10 11 12 13 14 15);
    }

    /// Error estimate of a trial in units of the allowed error.
    #[inline(always)]
    fn error(&self, h: Lanes) -> Lanes {
        let zero = Lanes::splat(0.0);
        let (e5, e3) =
            (weighted::<R, D>(&E5, &self.stages[..STAGES]), weighted::<R, D>(&E3, &self.stages[..STAGES]));
        let (mut fifth, mut third) = (zero, zero);
        for i in 0..D {
            let (e5, e3) = (e5[i] * self.unit[i], e3[i] * self.unit[i]);
            fifth = fifth + e5 * e5;
            third = third + e3 * e3;
        }
        let error = h * fifth / (fifth + Lanes::splat(0.01) * third).sqrt();
        let none = fifth.max(third).at_most(zero);
        Lanes::splat(f64::MIN_POSITIVE).select(none, error)
    }

    /// Steps that follow the trial.
    #[inline(always)]
    fn adapt(&mut self, h: Lanes, error: Lanes, [reaches, accepted, stuck]: [Mask; 3]) {
        let defined = error.at_most(Lanes::splat(f64::MAX));
        let factor = Lanes::splat(SAFETY_FACTOR) / error.map(eighth_root);
        let factor =
            factor.min(Lanes::splat(GROW)).max(Lanes::splat(SHRINK)).select(defined, Lanes::splat(SHRINK));
        let longer = h * factor.min(Lanes::splat(1.0)).select(self.rejected, factor);
        let longer = self.h.max(longer).select(reaches, longer);
        let next = longer.select(accepted, h * factor);
        self.h = self.h.select(stuck, next);
        self.rejected = !accepted;
        self.undefined = !stuck & !defined | stuck & self.undefined;
    }

    /// Adds the changes of the accepted trials to the states, keeping their rounding errors.
    #[inline(always)]
    fn accept(&mut self, h: Lanes, change: &[Lanes; D], [reaches, accepted]: [Mask; 2]) {
        self.last = (self.t, h);
        self.start = self.y;
        for i in 0..D {
            let sum = self.y[i] + change[i];
            let carry = change[i] - (sum - self.y[i]);
            self.y[i] = sum.select(accepted, self.y[i]);
            self.carry[i] = carry.select(accepted, self.carry[i]);
        }
        let reached = self.end.select(reaches, self.t + h);
        self.t = reached.select(accepted, self.t);
        R::call(LaneRate { system: self.system, y: &self.y, rate: &mut self.stages[STAGES] });
    }

    /// Rates at the further stages that the dense output of the last step needs, in every lane.
    #[inline(always)]
    pub fn prepare_dense(&mut self) {
        let start = self.start;
        self.rates_at::<{ STAGES + 1 }, { STAGES + EXTRA + 1 }>(&start, self.last.1);
    }

    /// The solution of a lane over its last step, which was accepted, once the further stages are [prepared](Self::prepare_dense).
    #[inline(always)]
    pub fn dense(&self, lane: usize) -> DenseOutput<[f64; D]> {
        let of = |state: &[Lanes; D]| state.map(|component| component.0[lane]);
        let stages = std::array::from_fn(|stage| of(&self.stages[stage]));
        let last = (self.last.0.0[lane], self.last.1.0[lane]);
        interpolant::<[f64; D], R>(last, &of(&self.start), &self.y(lane), &stages)
    }
}
