//! Forces by formulas of the motion that may act in a short part of it: each step is compared with a quadrature along its own path, and taken
//! back where the two differ. (Z5), (Z7)

use super::impulse::{SEEN, impulse};
use super::sliding::Sliding;
use super::{Allowed, Missed, allowed_impulse};
use crate::dynamics::external::Forced;
use crate::math::expression::{Expression, Lobatto};
use crate::math::ode::StepRule;
use crate::math::vec3::{add, norm, scale};
use crate::model::force::{Felt, ForceLaw, TIME, VARIABLES, Windows};
use crate::model::{FlexibleBody, Marker};

/// Evaluations of a formula along a step.
const IN_STEP: u64 = 50_000;
/// Shortest step that is taken back, relative to the time.
const SHORTEST_STEP: f64 = 1e-13;

/// Variables of a formula along a step, at the points of Lobatto.
pub(in crate::dynamics) type Along = [Felt; Lobatto::POINTS];

/// Force by formulas of the motion.
#[derive(Clone, Debug)]
pub(super) struct FeltForce<'a> {
    /// Index of the force.
    force: usize,
    pub body: &'a FlexibleBody,
    pub law: &'a ForceLaw<Marker>,
    windows: Option<&'a Windows>,
    formulas: &'a [Expression; 3],
    /// `∫|F| dt` so far.
    pub whole: f64,
    /// Error that a step may have.
    allowed: f64,
    pub sliding: Sliding,
}

/// What the steps saw of a force.
pub(super) enum Sight {
    /// All of it.
    Seen,
    /// Not all: the step is taken back, and the next ones stop at these times.
    Again(Vec<f64>),
    /// Not all, in a step that is too short to be divided.
    Missed(Missed),
}

/// The forces by formulas whose parts may act in a short part of the motion.
pub(super) fn felt_forces(system: Forced<'_>) -> Vec<FeltForce<'_>> {
    let own = system.forces.iter().enumerate().filter_map(|(force, given)| {
        let (law, windows) = given.law.timed();
        let formulas = law.formulas()?;
        let narrow = formulas.iter().any(|formula| formula.is_narrow_in(|variable| variable != TIME));
        narrow.then_some(FeltForce {
            force,
            body: system.body,
            law,
            windows,
            formulas,
            whole: 0.0,
            allowed: 0.0,
            sliding: Sliding::default(),
        })
    });
    own.collect()
}

impl FeltForce<'_> {
    /// Sets the error that a step may have, from that of the angular momentum and of the velocity.
    pub fn allow(&mut self, allowed: Allowed) {
        self.allowed = allowed_impulse(self.body, self.law.place(), allowed);
    }

    fn value(&self, variables: &[f64]) -> [f64; 3] {
        if self.windows.is_some_and(|windows| !windows.contains(variables[TIME])) {
            return [0.0; 3];
        }
        self.formulas.each_ref().map(|formula| formula.value(variables))
    }

    /// Compares what a step saw with the impulse along its path, in a run to a time `end` (s). (Z5)
    pub fn look(&mut self, lobatto: &Lobatto, rule: StepRule, along: &Along, end: f64) -> Sight {
        let places: [&[f64]; Lobatto::POINTS] = std::array::from_fn(|i| along[i].as_slice());
        if self.formulas.iter().all(|formula| formula.is_quiet(lobatto, &places)) {
            let sizes: f64 = along.iter().map(|variables| norm(self.value(variables))).sum();
            return self.seen(rule, &[], rule.h.abs() * sizes / Lobatto::POINTS as f64, end);
        }
        let at = |t: f64| -> [f64; VARIABLES] {
            let weights = lobatto.weights_at(((t - rule.t) / rule.h).clamp(0.0, 1.0));
            std::array::from_fn(|variable| {
                weights.iter().zip(along).map(|(weight, felt)| weight * felt[variable]).sum()
            })
        };
        let (from, to) = (rule.t, rule.t + rule.h);
        let [ends, breaks] = self.changes(&at, [from, to]);
        let bound = self.bound(&at, &lobatto.points, &ends);
        if 2.0 * bound <= self.allowed {
            return self.seen(rule, &breaks, bound, end);
        }
        let (mut exact, mut whole) = ([0.0; 3], 0.0);
        for cell in ends.array_windows() {
            let (sum, size) = impulse(&|t| self.value(&at(t)), &lobatto.points, *cell);
            (exact, whole) = (add(exact, sum), whole + size);
        }
        let difference = norm(add(rule.sum(|t| self.value(&at(t))), scale(-1.0, exact)));
        if difference <= SEEN * (self.whole + whole) + self.allowed {
            return self.seen(rule, &breaks, whole, end);
        }
        if rule.h <= SHORTEST_STEP * to.abs() {
            let whole = self.whole + whole;
            return Sight::Missed(Missed::Impulse {
                force: self.force,
                interval: [from, to],
                difference,
                whole,
            });
        }
        let inside = |t: &f64| *t > from + SHORTEST_STEP * to.abs() && *t < to - SHORTEST_STEP * to.abs();
        let mut stops: Vec<f64> = ends.into_iter().filter(inside).collect();
        if stops.is_empty() {
            stops.push(0.5 * (from + to));
        }
        Sight::Again(stops)
    }

    /// Impulse of the largest values in the intervals in which the formulas are even, looked for at the shares `looks` of each.
    fn bound(&self, at: &dyn Fn(f64) -> [f64; VARIABLES], looks: &[f64], ends: &[f64]) -> f64 {
        let largest = |[from, to]: [f64; 2]| {
            let sizes = looks.iter().map(|share| norm(self.value(&at(from + share * (to - from)))));
            (to - from).abs() * sizes.fold(0.0, |most: f64, size| if size <= most { most } else { size })
        };
        ends.array_windows().map(|cell| largest(*cell)).sum()
    }

    /// Takes up a step that saw all of the force, `∫|F| dt` over it, and its corners and jumps. (Z7)
    fn seen(&mut self, rule: StepRule, breaks: &[f64], whole: f64, end: f64) -> Sight {
        self.whole += whole;
        match self.sliding.step(rule, breaks, end) {
            None => Sight::Seen,
            Some(step) => Sight::Missed(Missed::Slides { force: self.force, t: rule.t, step }),
        }
    }

    /// Ends of the intervals along a step in which the formulas are even, and their corners and jumps. (Z2)
    fn changes(&self, at: &dyn Fn(f64) -> [f64; VARIABLES], [from, to]: [f64; 2]) -> [Vec<f64>; 2] {
        let (mut ends, mut breaks) = (vec![from, to], Vec::new());
        for formula in self.formulas {
            let mut path = |t: f64, variables: &mut Vec<f64>| {
                variables.clear();
                variables.extend_from_slice(&at(t));
            };
            let found = formula.changes_on_path(&mut path, [from, to], IN_STEP);
            ends.extend(found.ends);
            breaks.extend(found.breaks);
        }
        ends.sort_by(f64::total_cmp);
        ends.dedup_by(|later, kept| *later - *kept <= SHORTEST_STEP * later.abs());
        [ends, breaks]
    }
}
