use thiserror::Error;

use super::tableau::{A, B, C, D, E3, E5, EXTRA, STAGES};
use crate::math::simd::{Arithmetic, scaled_sum};

/// A system `ẏ = rate(t, y)`.
pub trait System<const N: usize> {
    /// The rate of the state.
    fn rate<R: Arithmetic>(&self, t: f64, y: &[f64; N]) -> [f64; N];
}

/// Explicit Runge–Kutta method of order 8 with error control and dense output (DOP853) `[@hairer1993]`.
///
/// The state is kept in two parts, so that many small steps lose no digits.
#[derive(Clone, Debug)]
pub struct Dop853<const N: usize> {
    t: f64,
    y: [f64; N],
    /// What rounding has kept out of `y`.
    carry: [f64; N],
    /// Error allowed per step in each component; infinite where it is not controlled.
    allowed: [f64; N],
    rate: [f64; N],
    h: f64,
    work: Work,
    last: Step<N>,
}

/// Work done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Steps accepted.
    pub steps: u64,
    /// Steps rejected.
    pub rejected: u64,
    /// Evaluations of the rate.
    pub evaluations: u64,
}

/// A step that could not be made.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum StepError {
    /// The step fell to the rounding of `t`.
    #[error(
        "the step at t = {t} s fell below the resolution of time: the solution runs away, or the tolerance is too small"
    )]
    TooSmall {
        /// Time reached (s).
        t: f64,
    },
    /// The rate is NaN or infinite.
    #[error("the rate at t = {t} s is not a finite number")]
    NotFinite {
        /// Time reached (s).
        t: f64,
    },
}

/// The last step: all that dense output needs.
#[derive(Clone, Copy, Debug)]
struct Step<const N: usize> {
    t: f64,
    h: f64,
    y: [f64; N],
    end: [f64; N],
    stages: [[f64; N]; STAGES + EXTRA + 1],
}

/// The solution over the last step, as a polynomial of degree 7 in time.
#[derive(Clone, Copy, Debug)]
pub struct Dense<const N: usize> {
    t: f64,
    h: f64,
    y: [f64; N],
    coefficients: [[f64; N]; 7],
}

/// Step factors: caution, and the limits of one change.
const CAUTION: f64 = 0.9;
const SHRINK: f64 = 0.333;
const GROW: f64 = 6.0;
/// Order of the error estimate plus one.
const ORDER: f64 = 8.0;

impl<const N: usize> Dop853<N> {
    /// Starts at a state, with the error allowed per step in each component.
    #[inline(always)]
    pub fn new<R: Arithmetic>(system: &impl System<N>, t: f64, y: [f64; N], allowed: [f64; N]) -> Self {
        let rate = system.rate::<R>(t, &y);
        let none = Step { t, h: 0.0, y, end: y, stages: [[0.0; N]; STAGES + EXTRA + 1] };
        let work = Work { evaluations: 2, ..Work::default() };
        let mut solver = Self { t, y, carry: [0.0; N], allowed, rate, h: 0.0, work, last: none };
        solver.h = solver.first_step::<R>(system);
        solver
    }

    /// Time reached.
    pub fn t(&self) -> f64 {
        self.t
    }

    /// State reached.
    pub fn y(&self) -> &[f64; N] {
        &self.y
    }

    /// Work done so far.
    pub fn work(&self) -> Work {
        self.work
    }

    /// Adds a small change to the state reached, as a projection on a known invariant does. The rate at the start of
    /// the next step stays as it was: the change must be no larger than the error of a step.
    #[inline(always)]
    pub fn correct(&mut self, change: [f64; N]) {
        for (i, change) in change.into_iter().enumerate() {
            let change = change + self.carry[i];
            let sum = self.y[i] + change;
            self.carry[i] = change - (sum - self.y[i]);
            self.y[i] = sum;
        }
    }

    /// Makes one step, not beyond `end`.
    ///
    /// # Errors
    /// [`StepError`] if no step can be made; the state is then the last good one.
    #[inline(always)]
    pub fn step<R: Arithmetic>(&mut self, system: &impl System<N>, end: f64) -> Result<(), StepError> {
        let mut rejected = false;
        loop {
            let remaining = end - self.t;
            let reaches = self.h >= 0.999_999 * remaining;
            let h = if reaches { remaining } else { self.h };
            if !(h > f64::EPSILON * self.t.abs()) {
                return Err(StepError::TooSmall { t: self.t });
            }
            let trial = self.trial::<R>(system, h);
            let error = self.error(&trial, h);
            if !error.is_finite() {
                if self.rate.iter().any(|rate| !rate.is_finite()) {
                    return Err(StepError::NotFinite { t: self.t });
                }
                self.h = SHRINK * h;
                self.work.rejected += 1;
                rejected = true;
                continue;
            }
            let factor = (CAUTION * error.powf(-1.0 / ORDER)).clamp(SHRINK, GROW);
            if error <= 1.0 {
                let growth = if rejected { factor.min(1.0) } else { factor };
                self.h = if reaches { self.h.max(h * growth) } else { h * growth };
                self.accept::<R>(system, trial, if reaches { end } else { self.t + h });
                return Ok(());
            }
            self.h = h * factor;
            self.work.rejected += 1;
            rejected = true;
        }
    }

    /// The solution over the last step.
    #[inline(always)]
    pub fn dense<R: Arithmetic>(&mut self, system: &impl System<N>) -> Dense<N> {
        let Step { t, h, y, end, mut stages } = self.last;
        for stage in STAGES + 1..=STAGES + EXTRA {
            let place = combined::<R, N>(&A[stage], &stages[..stage], h, y);
            stages[stage] = system.rate::<R>(t + C[stage] * h, &place);
        }
        self.work.evaluations += EXTRA as u64;
        let mut coefficients = [[0.0; N]; 7];
        for i in 0..N {
            let change = end[i] - y[i];
            coefficients[0][i] = change;
            coefficients[1][i] = h * stages[0][i] - change;
            coefficients[2][i] = 2.0 * change - h * (stages[0][i] + stages[STAGES][i]);
        }
        for (row, weights) in D.iter().enumerate() {
            coefficients[3 + row] = combined::<R, N>(weights, &stages, h, [0.0; N]);
        }
        Dense { t, h, y, coefficients }
    }

    /// Stages of a step; its `end` is the change of the state, with what rounding had kept out of it.
    #[inline(always)]
    fn trial<R: Arithmetic>(&mut self, system: &impl System<N>, h: f64) -> Step<N> {
        let mut stages = [[0.0; N]; STAGES + EXTRA + 1];
        stages[0] = self.rate;
        for stage in 1..STAGES {
            let place = combined::<R, N>(&A[stage], &stages[..stage], h, self.y);
            stages[stage] = system.rate::<R>(self.t + C[stage] * h, &place);
        }
        self.work.evaluations += STAGES as u64 - 1;
        let change = combined::<R, N>(&B, &stages[..STAGES], h, self.carry);
        Step { t: self.t, h, y: self.y, end: change, stages }
    }

    /// Error estimate of a trial in units of the allowed error.
    #[inline(always)]
    fn error(&self, trial: &Step<N>, h: f64) -> f64 {
        let (mut fifth, mut third) = (0.0, 0.0);
        for i in 0..N {
            let (mut e5, mut e3) = (0.0, 0.0);
            for stage in 0..STAGES {
                e5 += E5[stage] * trial.stages[stage][i];
                e3 += E3[stage] * trial.stages[stage][i];
            }
            let unit = self.allowed[i].recip();
            fifth += (e5 * unit) * (e5 * unit);
            third += (e3 * unit) * (e3 * unit);
        }
        if fifth == 0.0 && third == 0.0 {
            return f64::MIN_POSITIVE;
        }
        h * fifth / (fifth + 0.01 * third).sqrt()
    }

    /// Adds the change of a trial to the state, keeping what rounding drops.
    #[inline(always)]
    fn accept<R: Arithmetic>(&mut self, system: &impl System<N>, trial: Step<N>, t: f64) {
        self.last = trial;
        self.carry = [0.0; N];
        self.correct(trial.end);
        self.last.end = self.y;
        self.t = t;
        self.rate = system.rate::<R>(t, &self.y);
        self.last.stages[STAGES] = self.rate;
        self.work.steps += 1;
        self.work.evaluations += 1;
    }

    /// A first step from the size of the state, its rate and the change of its rate.
    #[inline(always)]
    fn first_step<R: Arithmetic>(&self, system: &impl System<N>) -> f64 {
        let size = |v: &[f64; N]| -> f64 {
            let squares = v.iter().zip(&self.allowed).map(|(v, allowed)| (v / allowed) * (v / allowed));
            (squares.sum::<f64>() / N as f64).sqrt()
        };
        let (state, rate) = (size(&self.y), size(&self.rate));
        let guess = if state > 1e-10 && rate > 1e-10 { 0.01 * state / rate } else { 1e-6 };
        let next = system.rate::<R>(self.t + guess, &scaled_sum::<R, N>(self.rate, guess, self.y));
        let curvature = size(&std::array::from_fn(|i| next[i] - self.rate[i])) / guess;
        let largest = rate.max(curvature);
        let step =
            if largest > 1e-15 { (0.01 / largest).powf(1.0 / ORDER) } else { (1e-3 * guess).max(1e-6) };
        step.min(100.0 * guess)
    }
}

impl<const N: usize> Dense<N> {
    /// The state at a time within the step.
    #[must_use]
    pub fn at(&self, t: f64) -> [f64; N] {
        let x = (t - self.t) / self.h;
        let mut sum = [0.0; N];
        for (power, row) in self.coefficients.iter().enumerate().rev() {
            let factor = if power % 2 == 0 { x } else { 1.0 - x };
            for i in 0..N {
                sum[i] = (sum[i] + row[i]) * factor;
            }
        }
        std::array::from_fn(|i| self.y[i] + sum[i])
    }
}

/// `base + h Σ weight · stage`.
#[inline(always)]
fn combined<R: Arithmetic, const N: usize>(
    weights: &[f64],
    stages: &[[f64; N]],
    h: f64,
    base: [f64; N],
) -> [f64; N] {
    let mut sum = [0.0; N];
    for (weight, stage) in weights.iter().zip(stages) {
        sum = scaled_sum::<R, N>(*stage, *weight, sum);
    }
    scaled_sum::<R, N>(sum, h, base)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::simd::Plain;

    /// Arenstorf's orbit of the restricted three-body problem: closes after its period `[@hairer1993]`.
    struct Arenstorf;

    impl System<4> for Arenstorf {
        fn rate<R: Arithmetic>(&self, _: f64, y: &[f64; 4]) -> [f64; 4] {
            let mu = 0.012_277_471;
            let [x, v, xd, vd] = *y;
            let d1 = ((x + mu).powi(2) + v * v).powf(1.5);
            let d2 = ((x - 1.0 + mu).powi(2) + v * v).powf(1.5);
            let a = x + 2.0 * vd - (1.0 - mu) * (x + mu) / d1 - mu * (x - 1.0 + mu) / d2;
            let b = v - 2.0 * xd - (1.0 - mu) * v / d1 - mu * v / d2;
            [xd, vd, a, b]
        }
    }

    #[test]
    fn arenstorf_orbit_closes() {
        let start = [0.994, 0.0, 0.0, -2.001_585_106_379_082_5];
        let period = 17.065_216_560_157_964;
        let mut solver = Dop853::new::<Plain>(&Arenstorf, 0.0, start, [1e-12; 4]);
        while solver.t() < period {
            solver.step::<Plain>(&Arenstorf, period).unwrap();
        }
        let gap = (0..2).map(|i| (solver.y()[i] - start[i]).abs()).fold(0.0, f64::max);
        assert!(gap < 1e-8, "gap {gap:e}, {:?}", solver.work());
    }

    struct Oscillator;

    impl System<2> for Oscillator {
        fn rate<R: Arithmetic>(&self, _: f64, y: &[f64; 2]) -> [f64; 2] {
            [y[1], -y[0]]
        }
    }

    #[test]
    fn dense_output_is_as_good_as_the_steps() {
        let mut solver = Dop853::new::<Plain>(&Oscillator, 0.0, [1.0, 0.0], [1e-11; 2]);
        let mut worst: f64 = 0.0;
        while solver.t() < 20.0 {
            let from = solver.t();
            solver.step::<Plain>(&Oscillator, 20.0).unwrap();
            let dense = solver.dense::<Plain>(&Oscillator);
            for part in 0..=10 {
                let t = from + (solver.t() - from) * f64::from(part) / 10.0;
                worst = worst.max((dense.at(t)[0] - t.cos()).abs());
            }
        }
        assert!(worst < 1e-10, "{worst:e}");
    }

    #[test]
    fn an_infinite_rate_is_reported() {
        struct Blowup;
        impl System<1> for Blowup {
            fn rate<R: Arithmetic>(&self, _: f64, y: &[f64; 1]) -> [f64; 1] {
                [y[0] * y[0]]
            }
        }
        let mut solver = Dop853::new::<Plain>(&Blowup, 0.0, [1.0], [1e-9]);
        let failure = loop {
            if let Err(error) = solver.step::<Plain>(&Blowup, 2.0) {
                break error;
            }
        };
        let (StepError::TooSmall { t } | StepError::NotFinite { t }) = failure;
        assert!((t - 1.0).abs() < 1e-3);
    }
}
