//! Stages of the Radau IIA method: sweeps for the non-stiff components, solutions at four shifts for the stiff ones.
//! The inverse of the weights is diagonalised once, so that a solution of all stages is one real and three complex ones.
//! Transformation of the stages `[@hairer1999]`.

use super::Checkpoint;
use super::radau_search::{Attempt, Convergence, Limits, Search};
use super::radau_tableau::{A, C, FROM_EIGEN, GAMMA, SHIFTS, STAGES, TO_EIGEN};
use super::stiff::Stiff;
use crate::simd::Arithmetic;

/// Stages of a step of the method Radau IIA, found by iteration.
#[derive(Clone, Debug)]
pub(super) struct Stages {
    /// Changes of the state from the start of the step to each stage.
    pub changes: [Vec<f64>; STAGES],
    /// Rates at the stages.
    pub rates: [Vec<f64>; STAGES],
    /// Changes and rates of the step before, and the rate at its start.
    earlier: [[Vec<f64>; STAGES]; 2],
    earlier_rate: Vec<f64>,
    place: Vec<f64>,
    /// Right-hand sides and solutions of the stiff part, at each shift.
    solutions: [Vec<[f64; 2]>; SHIFTS],
    /// Sweeps over the stages.
    pub sweeps: u64,
}

/// The state at the end of the step is better than the error estimate by the share of the error that the iteration may leave.
const LIMITS: Limits = Limits { sweeps: 12, converged: 3e-5, least: 0.0 };

/// Contribution of each stage to the real and imaginary parts at the shifts; a complex shift counts twice.
const TO_SHIFTS: [[f64; 2 * SHIFTS]; STAGES] = {
    let mut rows = [[0.0; 2 * SHIFTS]; STAGES];
    let (mut stage, mut shift) = (0, 0);
    while stage < STAGES {
        while shift < SHIFTS {
            let twice = if shift == 0 { 1.0 } else { 2.0 };
            rows[stage][2 * shift] = twice * TO_EIGEN[shift][stage][0];
            rows[stage][2 * shift + 1] = twice * TO_EIGEN[shift][stage][1];
            shift += 1;
        }
        (stage, shift) = (stage + 1, 0);
    }
    rows
};

/// Contribution of the real and the imaginary part of the solution at each shift to the stages, filled up with a zero.
const FROM_SHIFTS: [[[f64; STAGES + 1]; 2]; SHIFTS] = {
    let mut rows = [[[0.0; STAGES + 1]; 2]; SHIFTS];
    let (mut shift, mut stage) = (0, 0);
    while shift < SHIFTS {
        while stage < STAGES {
            rows[shift][0][stage] = FROM_EIGEN[shift][stage][0];
            rows[shift][1][stage] = -FROM_EIGEN[shift][stage][1];
            stage += 1;
        }
        (shift, stage) = (shift + 1, 0);
    }
    rows
};

impl Stages {
    /// Stages of a system with so many components, of which those from `stiff` on are stiff.
    pub fn new(components: usize, stiff: usize) -> Self {
        let list = || std::array::from_fn(|_| vec![0.0; components]);
        Self {
            changes: list(),
            rates: list(),
            earlier: [list(), list()],
            earlier_rate: vec![0.0; components],
            place: vec![0.0; components],
            solutions: std::array::from_fn(|_| vec![[0.0; 2]; components - stiff]),
            sweeps: 0,
        }
    }

    /// First guess: nothing changes.
    pub fn guess_still(&mut self, rate: &[f64]) {
        self.changes.iter_mut().for_each(|change| change.fill(0.0));
        self.rates.iter_mut().for_each(|row| row.copy_from_slice(rate));
    }

    /// First guess: the polynomial of the last step continues over one that is `ratio` times as long.
    pub fn guess_continued(&mut self, ratio: f64) {
        let [changes, rates] = &self.earlier;
        for (stage, c) in C.iter().enumerate() {
            let x = 1.0 + ratio * c;
            let (start, through_start) = lagrange(x);
            combine(rates, &through_start, &mut self.rates[stage]);
            for (rate, earlier) in self.rates[stage].iter_mut().zip(&self.earlier_rate) {
                *rate += start * earlier;
            }
            let mut weights = through_start;
            weights[STAGES - 1] -= 1.0;
            combine(changes, &weights, &mut self.changes[stage]);
        }
    }

    /// Keeps the stages of a step, with the rate at its start, for the guess of the next.
    pub fn keep(&mut self, rate: &[f64]) {
        for (kept, new) in self.earlier.iter_mut().zip([&self.changes, &self.rates]) {
            kept.iter_mut().zip(new).for_each(|(kept, new)| kept.copy_from_slice(new));
        }
        self.earlier_rate.copy_from_slice(rate);
    }

    /// Saves the last step, from which the next guess starts, and the count of sweeps.
    pub fn save(&self, checkpoint: &mut Checkpoint) {
        self.earlier.iter().flatten().chain([&self.earlier_rate]).for_each(|list| checkpoint.save_list(list));
        checkpoint.save_count(self.sweeps);
    }

    /// Loads a saved step.
    pub fn load(&mut self, checkpoint: &mut Checkpoint) -> Option<()> {
        let Self { earlier, earlier_rate, sweeps, .. } = self;
        for list in earlier.iter_mut().flatten().chain([earlier_rate]) {
            checkpoint.load_into(list)?;
        }
        *sweeps = checkpoint.load_count()?;
        Some(())
    }

    /// Improves the guess until it satisfies the equations of the stages.
    pub fn find<S: Stiff, R: Arithmetic>(&mut self, system: &mut S, attempt: Attempt) -> Search {
        let mut convergence = Convergence::new(attempt, LIMITS);
        loop {
            let rest = self.sweep::<S, R>(system, attempt);
            let moved = (rest + self.solve_stiff(system, attempt)).sqrt();
            if let Some(search) = convergence.after(moved) {
                if matches!(search, Search::Found(_)) {
                    self.close(attempt.h, system.stiff());
                }
                return search;
            }
        }
    }

    /// One sweep over the stages, each with the newest rates of the others; returns the squared change of the non-stiff components, in
    /// units of the error allowed.
    fn sweep<S: Stiff, R: Arithmetic>(&mut self, system: &mut S, attempt: Attempt) -> f64 {
        let Attempt { t, h, y, weights } = attempt;
        let stiff = system.stiff();
        let mut moved = 0.0;
        for stage in 0..STAGES {
            let (place, change) = (&mut self.place, &mut self.changes[stage]);
            combine(&self.rates, &A[stage].map(|weight| h * weight), &mut place[..stiff]);
            for ((new, change), weight) in place.iter().zip(&mut change[..stiff]).zip(weights) {
                let step = (new - *change) * weight;
                moved += step * step;
                *change = *new;
            }
            for ((place, change), y) in place.iter_mut().zip(change).zip(y) {
                *place = y + *change;
            }
            system.rate::<R>(t + C[stage] * h, place, &mut self.rates[stage]);
        }
        self.sweeps += 1;
        moved
    }

    /// Solves for the stiff components with the rest of the rates as they are; returns their squared change.
    fn solve_stiff(&mut self, system: &mut impl Stiff, attempt: Attempt) -> f64 {
        let stiff = system.stiff();
        self.load_shifts(attempt.h, stiff);
        for (shift, solution) in self.solutions.iter_mut().enumerate() {
            system.solve(shift, solution);
        }
        let mut moved = 0.0;
        for (i, weight) in attempt.weights[stiff..].iter().enumerate() {
            let mut corrections = [0.0; STAGES + 1];
            for (solution, rows) in self.solutions.iter().zip(&FROM_SHIFTS) {
                for (part, row) in solution[i].iter().zip(rows) {
                    corrections.iter_mut().zip(row).for_each(|(sum, entry)| *sum += entry * part);
                }
            }
            for (change, correction) in self.changes.iter_mut().zip(corrections) {
                moved += (correction * weight).powi(2);
                change[stiff + i] += correction;
            }
        }
        moved
    }

    /// Residuals of the stiff components in the equations of the stages, at each shift.
    fn load_shifts(&mut self, h: f64, stiff: usize) {
        let gammas = GAMMA.map(|gamma| gamma.map(|part| part / h));
        for i in 0..self.place.len() - stiff {
            let (mut slopes, mut changes) = ([0.0; 2 * SHIFTS], [0.0; 2 * SHIFTS]);
            for ((rate, change), row) in self.rates.iter().zip(&self.changes).zip(&TO_SHIFTS) {
                let (rate, change) = (rate[stiff + i], change[stiff + i]);
                slopes.iter_mut().zip(row).for_each(|(sum, entry)| *sum += entry * rate);
                changes.iter_mut().zip(row).for_each(|(sum, entry)| *sum += entry * change);
            }
            for (shift, [re, im]) in gammas.into_iter().enumerate() {
                let (x, y) = (changes[2 * shift], changes[2 * shift + 1]);
                self.solutions[shift][i] =
                    [slopes[2 * shift] - (re * x - im * y), slopes[2 * shift + 1] - (re * y + im * x)];
            }
        }
    }

    /// Recomputes the changes of the non-stiff components from the last rates.
    fn close(&mut self, h: f64, stiff: usize) {
        for (change, weights) in self.changes.iter_mut().zip(&A) {
            combine(&self.rates, &weights.map(|weight| h * weight), &mut change[..stiff]);
        }
    }
}

/// Weighted sum of rows, as long as the list that takes it.
fn combine(rows: &[Vec<f64>; STAGES], weights: &[f64; STAGES], sums: &mut [f64]) {
    let rows = rows.each_ref().map(|row| &row[..sums.len()]);
    for (i, sum) in sums.iter_mut().enumerate() {
        *sum = 0.0;
        for (row, weight) in rows.iter().zip(weights) {
            *sum += weight * row[i];
        }
    }
}

/// Nodes of a step: its start and its stages.
const NODES: [f64; STAGES + 1] = [0.0, C[0], C[1], C[2], C[3], C[4], C[5], C[6]];
/// For each node, the product of its distances from the others.
const DISTANCES: [f64; STAGES + 1] = {
    let mut products = [1.0; STAGES + 1];
    let (mut node, mut other) = (0, 0);
    while node <= STAGES {
        while other <= STAGES {
            products[node] *= if other == node { 1.0 } else { NODES[node] - NODES[other] };
            other += 1;
        }
        (node, other) = (node + 1, 0);
    }
    products
};

/// Weights of the values at the start and at the stages in the polynomial through them, at a place `x > 1` in steps.
pub(super) fn lagrange(x: f64) -> (f64, [f64; STAGES]) {
    let whole: f64 = NODES.iter().map(|node| x - node).product();
    let weight = |node: usize| whole / ((x - NODES[node]) * DISTANCES[node]);
    (weight(0), std::array::from_fn(|stage| weight(stage + 1)))
}
