//! Search for the stages of a step of the Radau IIA method: the step and when the iteration has converged.

/// Step whose stages are sought.
#[derive(Clone, Copy, Debug)]
pub(super) struct Attempt<'a> {
    pub t: f64,
    pub h: f64,
    pub y: &'a [f64],
    /// One over the error allowed in each component.
    pub weights: &'a [f64],
}

impl Attempt<'_> {
    /// The state in units of the error allowed.
    fn size(&self) -> f64 {
        self.y.iter().zip(self.weights).map(|(y, weight)| (y * weight).powi(2)).sum::<f64>().sqrt()
    }
}

/// Result of a search for the stages.
#[derive(Clone, Copy, Debug)]
pub(super) enum Search {
    /// Stages found, with the ratio of the last two corrections above rounding.
    Found(f64),
    Slow(f64),
    NotFinite,
}

/// Limits of an iteration.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Most sweeps over the stages.
    pub sweeps: i32,
    /// Share of the error allowed below which the rest of the iteration ends it.
    pub converged: f64,
    /// Least ratio of consecutive corrections that is believed: the first correction, of a poor guess, may be far larger than the second.
    pub least: f64,
}

/// Convergence of the iteration, from the size of its corrections.
#[derive(Clone, Copy, Debug)]
pub(super) struct Convergence {
    limits: Limits,
    /// Rounding error of a correction.
    rounding: f64,
    /// Sweeps made.
    made: i32,
    before: f64,
    ratios: [f64; 2],
}

/// Rounding error of the iteration, in roundings of the state, and the ratio of corrections that shows it.
const ITERATION_ROUNDING: f64 = 32.0;
const STALLED: f64 = 0.3;

impl Convergence {
    /// Before the first sweep.
    pub fn new(attempt: Attempt, limits: Limits) -> Self {
        let rounding = ITERATION_ROUNDING * f64::EPSILON * attempt.size();
        Self { limits, rounding, made: 0, before: f64::INFINITY, ratios: [0.0; 2] }
    }

    /// Result after a sweep that has moved the stages so far; none if more sweeps are needed.
    pub fn after(&mut self, moved: f64) -> Option<Search> {
        if !moved.is_finite() {
            return Some(Search::NotFinite);
        }
        let Limits { sweeps, converged, least } = self.limits;
        let [_, before] = self.ratios;
        let last = if moved > 0.0 { moved / self.before } else { 0.0 };
        (self.ratios, self.before, self.made) = ([before, last], moved, self.made + 1);
        let worst = before.max(last).max(least);
        let stalled = last > STALLED && moved < self.rounding;
        let found = stalled || worst < 1.0 && moved * worst / (1.0 - worst) < converged;
        if self.made > 1 && found {
            return Some(Search::Found(if stalled { before } else { last }));
        }
        let remaining = sweeps - self.made;
        let hopeless = last >= 1.0 || moved * last.powi(remaining) > converged.max(self.rounding);
        (remaining == 0 || self.made > 2 && hopeless).then_some(Search::Slow(last))
    }
}
