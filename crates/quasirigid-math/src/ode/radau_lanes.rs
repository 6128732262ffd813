//! Stages of the Radau IIA method side by side, a lane for each: one sweep evaluates the rates at every stage at once and solves for all of them.
//! The lane that is left over takes the start of the step, which the first guess and the error estimate need too.
//! Equation (T6), docs/theory/08-full-system.md.

use super::Checkpoint;
use super::radau_predictor::Predictor;
use super::radau_search::{Attempt, Convergence, Limits, Search};
use super::radau_shifts::{FROM_SHIFTS, TO_SHIFTS, WEIGHTS, exchanged, factors, product, sum};
use super::radau_tableau::{A, ERROR, GAMMA, SHIFTS, STAGES, START};
use super::stiff::Stiff;
use crate::lanes::Lanes;
use crate::simd::{Arithmetic, Rounding, Task, dispatch_lanes};

/// Stages of a step in lanes.
#[derive(Clone, Debug)]
pub(super) struct LaneStages {
    rounding: Rounding,
    /// Number of steering components before the integrals, and the first stiff component.
    steering: usize,
    stiff: usize,
    /// Changes of each component from the start of the step, and its rates.
    changes: Vec<Lanes>,
    rates: Vec<Lanes>,
    place: Vec<Lanes>,
    /// Changes of the stiff components, and the residuals of their equations, at the shifts.
    shifted: Vec<Lanes>,
    residuals: Vec<Lanes>,
    /// Rows of the solution at the shifts: factors of the residuals, and of the residuals with real and imaginary parts exchanged.
    solution: Vec<[Lanes; 2]>,
    predictor: Predictor,
    /// Sweeps over the stages.
    pub sweeps: u64,
}

/// Lane of the end of the step.
const END: usize = STAGES - 1;
/// Any number of stiff components: others are known to the compiler.
const ANY: usize = 0;
/// Sweeps are cheap, and the error that they leave adds up over thousands of steps.
const LIMITS: Limits = Limits { sweeps: 20, converged: 1e-6, least: 0.05 };

/// Search for the stages, as work that is compiled for the widest registers.
struct Find<'a, S> {
    stages: &'a mut LaneStages,
    system: &'a mut S,
    attempt: Attempt<'a>,
}

impl<S: Stiff> Task for Find<'_, S> {
    type Output = Search;

    #[inline(always)]
    fn run<R: Arithmetic>(self) -> Search {
        self.stages.iterate::<S, R>(self.system, self.attempt)
    }
}

/// Rates at the stages, as work that is compiled once however many components are stiff.
struct Rates<'a, S> {
    system: &'a mut S,
    place: &'a [Lanes],
    rates: &'a mut [Lanes],
}

impl<S: Stiff> Task for Rates<'_, S> {
    type Output = ();

    #[inline(always)]
    fn run<R: Arithmetic>(self) {
        self.system.rates_beside::<R>(self.place, self.rates);
    }
}

/// First guess.
struct Guess<'a> {
    stages: &'a mut LaneStages,
    ratio: f64,
}

impl Task for Guess<'_> {
    type Output = ();

    #[inline(always)]
    fn run<R: Arithmetic>(self) {
        self.stages.predict::<R>(self.ratio);
    }
}

impl LaneStages {
    /// Stages of a system with so many components.
    pub fn new(components: usize, steering: usize, stiff: usize, rounding: Rounding) -> Self {
        let list = |length: usize| vec![Lanes::splat(0.0); length];
        let shifted = components - stiff;
        Self {
            rounding,
            steering,
            stiff,
            changes: list(components),
            rates: list(components),
            place: list(components),
            shifted: list(shifted),
            residuals: list(shifted),
            solution: vec![[Lanes::splat(0.0); 2]; shifted * shifted],
            predictor: Predictor::new(steering + shifted),
            sweeps: 0,
        }
    }

    /// First guess: nothing changes.
    pub fn guess_still(&mut self, rate: &[f64]) {
        self.changes.fill(Lanes::splat(0.0));
        self.rates.iter_mut().zip(rate).for_each(|(lanes, rate)| *lanes = Lanes::splat(*rate));
    }

    /// First guess: the polynomial of the last steps continues over one that is `ratio` times as long as the last.
    pub fn guess_continued(&mut self, ratio: f64) {
        dispatch_lanes(self.rounding, Guess { stages: self, ratio });
    }

    #[inline(always)]
    fn predict<R: Arithmetic>(&mut self, ratio: f64) {
        self.predictor.prepare(ratio);
        let Self { predictor, rates, changes, steering, stiff, .. } = self;
        for (i, rate) in rates[..*steering].iter_mut().enumerate() {
            *rate = predictor.value::<R>(i);
        }
        for (i, change) in changes[*stiff..].iter_mut().enumerate() {
            *change = predictor.change::<R>(*steering + i);
        }
    }

    /// Takes the solutions `(s − L)⁻¹` at the shifts of a system into lanes.
    pub fn factor(&mut self, system: &mut impl Stiff) {
        let size = self.shifted.len();
        for column in 0..size {
            let solved: [Vec<[f64; 2]>; SHIFTS] = std::array::from_fn(|shift| {
                let mut unit = vec![[0.0; 2]; size];
                unit[column][0] = 1.0;
                system.solve(shift, &mut unit);
                unit
            });
            for row in 0..size {
                self.solution[row * size + column] = factors(solved.each_ref().map(|solved| solved[row]));
            }
        }
    }

    /// Improves the guess until it satisfies the equations of the stages.
    pub fn find<S: Stiff>(&mut self, system: &mut S, attempt: Attempt) -> Search {
        dispatch_lanes(self.rounding, Find { stages: self, system, attempt })
    }

    #[inline(always)]
    fn iterate<S: Stiff, R: Arithmetic>(&mut self, system: &mut S, attempt: Attempt) -> Search {
        for (shifted, change) in self.shifted.iter_mut().zip(&self.changes[self.stiff..]) {
            *shifted = product::<R>(&TO_SHIFTS, *change, Lanes::splat(0.0));
        }
        let mut weights = WEIGHTS;
        for column in &mut weights {
            *column = *column * Lanes::splat(attempt.h);
        }
        for (change, rate) in self.changes[..self.steering].iter_mut().zip(&self.rates) {
            *change = product::<R>(&weights, *rate, Lanes::splat(0.0));
        }
        let gammas = factors(GAMMA.map(|[re, im]| [-re / attempt.h, -im / attempt.h]));
        let mut convergence = Convergence::new(attempt, LIMITS);
        loop {
            let moved = match self.shifted.len() {
                2 => self.sweep::<S, R, 2>(system, attempt, &weights, &gammas),
                4 => self.sweep::<S, R, 4>(system, attempt, &weights, &gammas),
                6 => self.sweep::<S, R, 6>(system, attempt, &weights, &gammas),
                _ => self.sweep::<S, R, ANY>(system, attempt, &weights, &gammas),
            };
            if let Some(search) = convergence.after(moved) {
                if matches!(search, Search::Found(_)) {
                    self.close::<S, R>(system, attempt.y, &weights);
                }
                return search;
            }
        }
    }

    /// One sweep over the stages with so many stiff components; returns the change of the components in units of the error allowed. (T6)
    #[inline(always)]
    fn sweep<S: Stiff, R: Arithmetic, const SIZE: usize>(
        &mut self,
        system: &mut S,
        attempt: Attempt,
        columns: &[Lanes; STAGES],
        gammas: &[Lanes; 2],
    ) -> f64 {
        let Attempt { y, weights, .. } = attempt;
        let zero = Lanes::splat(0.0);
        let Self { steering, stiff, changes, rates, place, shifted, residuals, solution, .. } = self;
        let (steering, stiff) = (*steering, *stiff);
        let size = if SIZE == ANY { shifted.len() } else { SIZE };
        let mut moved = zero;
        for i in 0..steering {
            let change = product::<R>(columns, rates[i], zero);
            let step = (change - changes[i]) * Lanes::splat(weights[i]);
            moved = step.mul_add::<R>(step, moved);
            changes[i] = change;
            place[i] = change + Lanes::splat(y[i]);
        }
        let (changes, weights) = (&mut changes[stiff..stiff + size], &weights[stiff..stiff + size]);
        let (shifted, residuals) = (&mut shifted[..size], &mut residuals[..size]);
        for i in 0..size {
            place[stiff + i] = changes[i] + Lanes::splat(y[stiff + i]);
        }
        R::call(Rates { system: &mut *system, place, rates });
        let rates = &rates[stiff..stiff + size];
        for i in 0..size {
            let scaled = gammas[0] * shifted[i];
            let scaled = gammas[1].mul_add::<R>(exchanged(shifted[i]), scaled);
            residuals[i] = product::<R>(&TO_SHIFTS, rates[i], scaled);
        }
        for i in 0..size {
            let (mut straight, mut crossed) = (zero, zero);
            let row = &solution[i * size..(i + 1) * size];
            for k in 0..size {
                straight = row[k][0].mul_add::<R>(residuals[k], straight);
                crossed = row[k][1].mul_add::<R>(exchanged(residuals[k]), crossed);
            }
            let correction = straight + crossed;
            shifted[i] = shifted[i] + correction;
            let correction = product::<R>(&FROM_SHIFTS, correction, zero);
            let step = correction * Lanes::splat(weights[i]);
            moved = step.mul_add::<R>(step, moved);
            changes[i] = changes[i] + correction;
        }
        self.sweeps += 1;
        sum(moved).sqrt()
    }

    /// Computes the rates of the integrals, and the changes of the steering components from the last rates.
    #[inline(always)]
    fn close<S: Stiff, R: Arithmetic>(&mut self, system: &mut S, y: &[f64], columns: &[Lanes; STAGES]) {
        for i in self.steering..self.stiff {
            self.place[i] = Lanes::splat(y[i]);
        }
        system.integrands_beside::<R>(&self.place, &mut self.rates);
        for (change, rate) in self.changes[..self.steering].iter_mut().zip(&self.rates) {
            *change = product::<R>(columns, *rate, Lanes::splat(0.0));
        }
    }

    /// Weighted sum of the rates at the start and at the stages that measures the error.
    pub fn error(&self, h: f64, error: &mut [f64]) {
        let [a, b, c, d, e, f, g] = ERROR;
        let weights = Lanes([a, b, c, d, e, f, g, START]);
        for (error, rate) in error.iter_mut().zip(&self.rates) {
            *error = h * sum(*rate * weights);
        }
    }

    /// Keeps the stages of a step for the guess of the next.
    pub fn keep(&mut self) {
        let Self { predictor, rates, changes, steering, stiff, .. } = self;
        let tracks = rates[..*steering].iter().chain(&changes[*stiff..]);
        predictor.keep(tracks);
    }

    /// Changes from the start of a step of length `h` to a stage.
    pub fn changes(&self, stage: usize, h: f64) -> Vec<f64> {
        let mut changes: Vec<f64> = self.changes.iter().map(|change| change.0[stage]).collect();
        self.integrate(stage, h, &mut changes);
        changes
    }

    /// Writes the change from the start to the end of a step of length `h`, and the rate there.
    pub fn end(&self, h: f64, change: &mut [f64], rate: &mut [f64]) {
        change.iter_mut().zip(&self.changes).for_each(|(change, lanes)| *change = lanes.0[END]);
        self.integrate(END, h, change);
        rate.iter_mut().zip(&self.rates).for_each(|(rate, lanes)| *rate = lanes.0[END]);
    }

    /// Writes the changes of the integrals from the start of a step to a stage.
    fn integrate(&self, stage: usize, h: f64, changes: &mut [f64]) {
        let [a, b, c, d, e, f, g] = A[stage];
        let weights = Lanes([a, b, c, d, e, f, g, 0.0]);
        for i in self.steering..self.stiff {
            changes[i] = h * sum(self.rates[i] * weights);
        }
    }

    /// Saves the last steps, from which the next guess starts, and the count of sweeps.
    pub fn save(&self, checkpoint: &mut Checkpoint) {
        self.predictor.save(checkpoint);
        checkpoint.save_count(self.sweeps);
    }

    /// Loads saved steps.
    pub fn load(&mut self, checkpoint: &mut Checkpoint) -> Option<()> {
        self.predictor.load(checkpoint)?;
        self.sweeps = checkpoint.load_count()?;
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::eigen::Dense;
    use crate::lu::{ComplexDense, ComplexLu};
    use crate::ode::system::System;

    /// A linear system without symmetry.
    struct Linear {
        L: Dense,
        factors: Vec<ComplexLu>,
    }

    const SIZE: usize = 5;

    impl System<Vec<f64>> for Linear {
        fn rate<R: Arithmetic>(&mut self, _: f64, y: &Vec<f64>, rate: &mut Vec<f64>) {
            rate.copy_from_slice(&self.L.times(y));
        }
    }

    impl Stiff for Linear {
        fn stiff(&self) -> usize {
            0
        }

        fn shift(&mut self, shifts: [[f64; 2]; SHIFTS]) {
            let factored = |shift: [f64; 2]| {
                let mut matrix = ComplexDense::zero(SIZE);
                matrix.add_scaled([-1.0, 0.0], &self.L);
                (0..SIZE).for_each(|i| matrix.add(i, i, shift));
                ComplexLu::new(&matrix).unwrap()
            };
            self.factors = shifts.map(factored).into();
        }

        fn solve(&mut self, shift: usize, right: &mut [[f64; 2]]) {
            right.copy_from_slice(&self.factors[shift].solve(right, 1).unwrap());
        }
    }

    /// The rows of the solution in lanes do what the solution at each shift does.
    #[test]
    fn solution_in_lanes_is_the_solution_at_each_shift() {
        let mut L = Dense::zero(SIZE);
        (0..SIZE * SIZE).for_each(|i| L.add(i / SIZE, i % SIZE, (1.7 * i as f64 + 0.3).sin()));
        let mut system = Linear { L, factors: Vec::new() };
        system.shift(GAMMA);
        let mut stages = LaneStages::new(SIZE, 0, 0, Rounding::Reproducible);
        stages.factor(&mut system);
        let right = |shift: usize, i: usize| [(i as f64 + 0.4 * shift as f64).cos(), (3.0 * i as f64).sin()];
        let parts = |at: &dyn Fn(usize) -> [f64; 2]| {
            let [[a, _], [b, bi], [c, ci], [d, di]] = std::array::from_fn(at);
            Lanes([a, b, bi, c, ci, d, di, 0.0])
        };
        let rights: Vec<Lanes> = (0..SIZE).map(|i| parts(&|shift| right(shift, i))).collect();
        let solved: [Vec<[f64; 2]>; SHIFTS] = std::array::from_fn(|shift| {
            let real = |number: [f64; 2]| if shift == 0 { [number[0], 0.0] } else { number };
            let mut solved: Vec<_> = (0..SIZE).map(|i| real(right(shift, i))).collect();
            system.solve(shift, &mut solved);
            solved
        });
        for row in 0..SIZE {
            let known = parts(&|shift| solved[shift][row]);
            let mut found = Lanes::splat(0.0);
            for (right, [straight, crossed]) in rights.iter().zip(&stages.solution[row * SIZE..]) {
                found = found + *straight * *right + *crossed * exchanged(*right);
            }
            for lane in 0..STAGES {
                assert!((found.0[lane] - known.0[lane]).abs() < 1e-13, "{row} {lane}: {found:?} {known:?}");
            }
        }
    }
}
