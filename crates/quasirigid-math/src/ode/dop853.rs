//! Explicit Runge–Kutta method DOP853: order 8, step control by embedded orders 5 and 3, dense output of order 7.
//! The state is kept in two parts, because a history of millions of steps would lose digits in a single sum.
//! Method and coefficients `[@hairer1993]`.

use std::marker::PhantomData;

use super::Checkpoint;
use super::dop853_tableau::{A, B, C, D, E3, E5, EXTRA, STAGES};
use super::stretch::{StepRule, Stretch};
use super::system::{DenseOutput, POWERS, Rate, Solver, State, StepError, System, Work, accumulate, towards};
use crate::simd::Arithmetic;

/// Explicit Runge–Kutta method of order 8 with error control and dense output (DOP853) `[@hairer1993]`.
///
/// The state is kept in two parts, so that many small steps lose no digits.
#[derive(Clone, Debug)]
pub struct Dop853<S, Y, R> {
    system: S,
    t: f64,
    y: Y,
    /// Rounding error of `y`, kept for the next step.
    carry: Y,
    /// Error allowed per step in each component; infinite where it is not controlled.
    allowed: Y,
    h: f64,
    work: Work,
    /// Start and length of the last step.
    last: (f64, f64),
    /// State at the start of the last step.
    start: Y,
    /// Rates at the stages; the rate of the state reached is at [`STAGES`].
    stages: [Y; STAGES + EXTRA + 1],
    /// State at which a stage's rate is evaluated, then the change of a trial.
    place: Y,
    arithmetic: PhantomData<R>,
}

/// Step factors: safety, and the limits of one change.
pub(super) const SAFETY_FACTOR: f64 = 0.9;
pub(super) const SHRINK: f64 = 0.333;
pub(super) const GROW: f64 = 6.0;

/// Root by the order of the error estimate plus one, by operations that every processor rounds alike.
#[inline(always)]
pub(super) fn eighth_root(number: f64) -> f64 {
    number.sqrt().sqrt().sqrt()
}

/// Rates at the later stages of a step from a time and a state; the rate at its start is in the first.
#[inline(always)]
fn stage_rates<S: System<Y>, Y: State, R: Arithmetic>(
    system: &mut S,
    (t, y): (f64, &Y),
    h: f64,
    stages: &mut [Y],
    place: &mut Y,
    work: &mut Work,
) {
    for stage in 1..STAGES {
        place.combine::<R>(y, h, &A[stage], &stages[..stage]);
        R::call(Rate { system, t: t + C[stage] * h, y: place, rate: &mut stages[stage] });
    }
    work.evaluations += STAGES as u64 - 1;
}

impl<S: System<Y>, Y: State, R: Arithmetic> Dop853<S, Y, R> {
    /// Starts at a state, with the error allowed per step in each component.
    #[inline(always)]
    pub fn new(system: S, t: f64, y: Y, allowed: Y) -> Self {
        let zero = y.zeroed();
        let stages = std::array::from_fn(|_| zero.clone());
        let (start, place) = (y.clone(), zero.clone());
        let work = Work::default();
        let last = (t, 0.0);
        let arithmetic = PhantomData;
        let mut solver =
            Self { system, t, y, carry: zero, allowed, h: 0.0, work, last, start, stages, place, arithmetic };
        solver.evaluate_end();
        solver.h = solver.first_step();
        solver
    }

    /// System that is integrated.
    pub fn system(&self) -> &S {
        &self.system
    }

    /// The same, to change; [`rewind`](Solver::rewind) then takes the change up.
    pub fn system_mut(&mut self) -> &mut S {
        &mut self.system
    }

    /// Step that the method would make next.
    pub fn h(&self) -> f64 {
        self.h
    }

    /// Chooses the step that the method tries next, which it shortens as its errors ask.
    pub fn try_step(&mut self, h: f64) {
        self.h = h;
    }

    /// Rate of the state reached.
    pub fn rate(&self) -> &Y {
        &self.stages[STAGES]
    }

    /// Evaluates the rate of the state reached.
    #[inline(always)]
    fn evaluate_end(&mut self) {
        let Self { system, t, y, stages, .. } = self;
        R::call(Rate { system, t: *t, y, rate: &mut stages[STAGES] });
        self.work.evaluations += 1;
    }

    /// Rates at the stages of a step, and its change of the state, with the rounding error kept so far, in `place`.
    #[inline(always)]
    fn trial(&mut self, h: f64) {
        let Self { system, stages, place, work, .. } = self;
        stage_rates::<S, Y, R>(system, (self.t, &self.y), h, stages, place, work);
        place.combine::<R>(&self.carry, h, &B, &stages[..STAGES]);
    }

    /// Length of the last step.
    pub fn last_step(&self) -> f64 {
        self.last.1
    }

    /// The state at a time in the last step, by a step of its own from the same start.
    pub fn within(&mut self, t: f64) -> Y {
        let h = t - self.last.0;
        let Self { system, stages, place, work, .. } = self;
        stage_rates::<S, Y, R>(system, (self.last.0, &self.start), h, stages, place, work);
        place.combine::<R>(&self.start, h, &B, &stages[..STAGES]);
        place.clone()
    }

    /// Error estimate of a trial in units of the allowed error.
    #[inline(always)]
    fn error(&self, h: f64) -> f64 {
        let (mut fifth, mut third) = (0.0, 0.0);
        for (i, allowed) in self.allowed.as_ref().iter().enumerate() {
            let (mut e5, mut e3) = (0.0, 0.0);
            for stage in 0..STAGES {
                e5 = R::mul_add(self.stages[stage].as_ref()[i], E5[stage], e5);
                e3 = R::mul_add(self.stages[stage].as_ref()[i], E3[stage], e3);
            }
            let unit = allowed.recip();
            fifth += (e5 * unit) * (e5 * unit);
            third += (e3 * unit) * (e3 * unit);
        }
        if fifth == 0.0 && third == 0.0 {
            return f64::MIN_POSITIVE;
        }
        h * fifth / (fifth + 0.01 * third).sqrt()
    }

    /// Adds the change of a trial to the state, keeping the rounding error.
    #[inline(always)]
    fn accept(&mut self, h: f64, t: f64) {
        self.last = (self.t, h);
        self.start.clone_from(&self.y);
        self.carry.as_mut().fill(0.0);
        accumulate(&mut self.y, &mut self.carry, &self.place);
        self.t = t;
        self.work.steps += 1;
        self.evaluate_end();
    }

    /// A first step from the size of the state, its rate and the change of its rate.
    #[inline(always)]
    fn first_step(&mut self) -> f64 {
        let allowed = self.allowed.as_ref();
        let size = |v: &[f64]| -> f64 {
            let squares = v.iter().zip(allowed).map(|(v, allowed)| (v / allowed) * (v / allowed));
            (squares.sum::<f64>() / allowed.len() as f64).sqrt()
        };
        let (state, rate) = (size(self.y.as_ref()), size(self.stages[STAGES].as_ref()));
        let guess = if state > 1e-10 && rate > 1e-10 { 0.01 * state / rate } else { 1e-6 };
        self.place.combine::<R>(&self.y, guess, &[1.0], &self.stages[STAGES..=STAGES]);
        let Self { system, t, place, stages, .. } = self;
        R::call(Rate { system, t: *t + guess, y: place, rate: &mut stages[0] });
        self.work.evaluations += 1;
        let mut change = self.stages[0].clone();
        for (change, rate) in change.as_mut().iter_mut().zip(self.stages[STAGES].as_ref()) {
            *change -= rate;
        }
        let largest = rate.max(size(change.as_ref()) / guess);
        let step = if largest > 1e-15 { eighth_root(0.01 / largest) } else { (1e-3 * guess).max(1e-6) };
        step.min(100.0 * guess)
    }
}

impl<S: System<Y>, Y: State, R: Arithmetic> Solver for Dop853<S, Y, R> {
    type State = Y;

    fn t(&self) -> f64 {
        self.t
    }

    fn y(&self) -> &Y {
        &self.y
    }

    fn work(&self) -> Work {
        self.work
    }

    #[inline(always)]
    fn step(&mut self, end: f64) -> Result<(), StepError> {
        let mut rejected = false;
        let mut undefined = self.stages[STAGES].as_ref().iter().any(|rate| !rate.is_finite());
        let (first, rest) = self.stages.split_at_mut(STAGES);
        first[0].clone_from(&rest[0]);
        loop {
            let (h, reaches) = towards(end, self.t, self.h, undefined)?;
            self.trial(h);
            let error = self.error(h);
            undefined = !error.is_finite();
            if undefined {
                self.h = SHRINK * h;
                self.work.rejected += 1;
                rejected = true;
                continue;
            }
            let factor = (SAFETY_FACTOR / eighth_root(error)).clamp(SHRINK, GROW);
            if error <= 1.0 {
                let growth = if rejected { factor.min(1.0) } else { factor };
                self.h = if reaches { self.h.max(h * growth) } else { h * growth };
                self.accept(h, if reaches { end } else { self.t + h });
                return Ok(());
            }
            self.h = h * factor;
            self.work.rejected += 1;
            rejected = true;
        }
    }

    /// The change keeps the rate at the start of the next step as it was.
    #[inline(always)]
    fn correct(&mut self, change: &Y) {
        accumulate(&mut self.y, &mut self.carry, change);
    }

    fn rewind(&mut self, t: f64, y: Y) {
        self.t = t;
        self.y = y;
        self.carry.as_mut().fill(0.0);
        self.evaluate_end();
    }

    fn enter(&mut self, stretch: Stretch) {
        self.system.enter(stretch);
    }

    fn restart(&mut self, stretch: Stretch) {
        self.system.enter(stretch);
        self.evaluate_end();
        self.h = self.first_step();
    }

    fn rule(&self) -> StepRule {
        StepRule::explicit(self.last)
    }

    fn save(&self, checkpoint: &mut Checkpoint) {
        let Self { t, y, carry, h, work, last, start, stages, .. } = self;
        [*t, *h, last.0, last.1].into_iter().for_each(|number| checkpoint.save(number));
        [y, carry, start, &stages[STAGES]].into_iter().for_each(|list| checkpoint.save_list(list.as_ref()));
        checkpoint.save_work(*work);
    }

    fn load(&mut self, checkpoint: &mut Checkpoint) -> Option<()> {
        let Self { t, y, carry, h, work, last, start, stages, .. } = self;
        for number in [t, h, &mut last.0, &mut last.1] {
            *number = checkpoint.load()?;
        }
        for list in [y, carry, start, &mut stages[STAGES]] {
            checkpoint.load_into(list.as_mut())?;
        }
        *work = checkpoint.load_work()?;
        Some(())
    }

    #[inline(always)]
    fn dense(&mut self) -> DenseOutput<Y> {
        let (t, h) = self.last;
        for stage in STAGES + 1..=STAGES + EXTRA {
            let Self { system, place, start, stages, .. } = self;
            place.combine::<R>(start, h, &A[stage], &stages[..stage]);
            R::call(Rate { system, t: t + C[stage] * h, y: place, rate: &mut stages[stage] });
        }
        self.work.evaluations += EXTRA as u64;
        interpolant::<Y, R>((t, h), &self.start, &self.y, &self.stages)
    }
}

/// Dense output of a step at `t` of length `h` between two states, from the rates at all its stages.
#[inline(always)]
pub(super) fn interpolant<Y: State, R: Arithmetic>(
    (t, h): (f64, f64),
    start: &Y,
    end: &Y,
    stages: &[Y; STAGES + EXTRA + 1],
) -> DenseOutput<Y> {
    let zero = start.zeroed();
    let mut coefficients: [Y; POWERS] = std::array::from_fn(|_| zero.clone());
    for i in 0..zero.as_ref().len() {
        let change = end.as_ref()[i] - start.as_ref()[i];
        let (first, last) = (stages[0].as_ref()[i], stages[STAGES].as_ref()[i]);
        coefficients[0].as_mut()[i] = change;
        coefficients[1].as_mut()[i] = h * first - change;
        coefficients[2].as_mut()[i] = 2.0 * change - h * (first + last);
    }
    for (row, weights) in D.iter().enumerate() {
        coefficients[3 + row].combine::<R>(&zero, h, weights, stages);
    }
    DenseOutput { t, h, y: start.clone(), coefficients }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::Unfused;

    type Method<S, const N: usize> = Dop853<S, [f64; N], Unfused>;

    /// Arenstorf's orbit of the restricted three-body problem: closes after its period `[@hairer1993]`.
    struct Arenstorf;

    impl System<[f64; 4]> for Arenstorf {
        fn rate<R: Arithmetic>(&mut self, _: f64, y: &[f64; 4], rate: &mut [f64; 4]) {
            let mu = 0.012_277_471;
            let [x, v, xd, vd] = *y;
            let d1 = ((x + mu).powi(2) + v * v).powf(1.5);
            let d2 = ((x - 1.0 + mu).powi(2) + v * v).powf(1.5);
            let a = x + 2.0 * vd - (1.0 - mu) * (x + mu) / d1 - mu * (x - 1.0 + mu) / d2;
            let b = v - 2.0 * xd - (1.0 - mu) * v / d1 - mu * v / d2;
            *rate = [xd, vd, a, b];
        }
    }

    #[test]
    fn arenstorf_orbit_closes() {
        let start = [0.994, 0.0, 0.0, -2.001_585_106_379_082_5];
        let period = 17.065_216_560_157_964;
        let mut solver = Method::new(Arenstorf, 0.0, start, [1e-12; 4]);
        while solver.t() < period {
            solver.step(period).unwrap();
        }
        let gap = (0..2).map(|i| (solver.y()[i] - start[i]).abs()).fold(0.0, f64::max);
        assert!(gap < 1e-8, "gap {gap:e}, {:?}", solver.work());
    }

    struct Oscillator;

    impl System<[f64; 2]> for Oscillator {
        fn rate<R: Arithmetic>(&mut self, _: f64, y: &[f64; 2], rate: &mut [f64; 2]) {
            *rate = [y[1], -y[0]];
        }
    }

    #[test]
    fn dense_output_is_as_good_as_the_steps() {
        let mut solver = Method::new(Oscillator, 0.0, [1.0, 0.0], [1e-11; 2]);
        let mut worst: f64 = 0.0;
        while solver.t() < 20.0 {
            let from = solver.t();
            solver.step(20.0).unwrap();
            let dense = solver.dense();
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
        impl System<[f64; 1]> for Blowup {
            fn rate<R: Arithmetic>(&mut self, _: f64, y: &[f64; 1], rate: &mut [f64; 1]) {
                *rate = [y[0] * y[0]];
            }
        }
        let mut solver = Method::new(Blowup, 0.0, [1.0], [1e-9]);
        let failure = loop {
            if let Err(error) = solver.step(2.0) {
                break error;
            }
        };
        let (StepError::TooSmall { t } | StepError::NotFinite { t } | StepError::Crawls { t, .. }) = failure;
        assert!((t - 1.0).abs() < 1e-3);
    }
}
