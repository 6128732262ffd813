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

/// Convergence of the iteration, from the size of its corrections.
#[derive(Clone, Copy, Debug)]
pub(super) struct Convergence {
    /// Share of the error allowed below which the rest of the iteration ends it.
    converged: f64,
    /// Rounding error of a correction.
    rounding: f64,
    least: f64,
    /// Sweeps made, and their limit.
    made: i32,
    limit: i32,
    before: f64,
    ratios: [f64; 2],
}

/// Rounding error of the iteration, in roundings of the state, and the ratio of corrections that shows it.
const ROUNDING: f64 = 32.0;
const STALLED: f64 = 0.3;

/// KNOB
pub fn knob(i: usize, default: f64) -> f64 {
    static K: std::sync::OnceLock<Vec<f64>> = std::sync::OnceLock::new();
    let k = K.get_or_init(|| std::env::var("KNOBS").unwrap_or_default().split(',').map(|x| x.parse().unwrap_or(f64::NAN)).collect());
    match k.get(i) { Some(x) if !x.is_nan() => *x, _ => default }
}

impl Convergence {
    /// Before the first of so many sweeps.
    pub fn new(attempt: Attempt, converged: f64, limit: i32, least: f64) -> Self {
        let rounding = ROUNDING * f64::EPSILON * attempt.size();
        Self { converged, rounding, least, made: 0, limit, before: f64::INFINITY, ratios: [0.0; 2] }
    }

    /// Result after a sweep that has moved the stages so far; none if more sweeps are needed.
    pub fn after(&mut self, moved: f64) -> Option<Search> {
        if !moved.is_finite() {
            return Some(Search::NotFinite);
        }
        let [_, before] = self.ratios;
        let last = moved / self.before;
        (self.ratios, self.before, self.made) = ([before, last], moved, self.made + 1);
        let worst = before.max(last).max(self.least);
        let stalled = last > STALLED && moved < self.rounding;
        let found = stalled || worst < 1.0 && moved * worst / (1.0 - worst) < self.converged;
        if self.made > 1 && found {
            return Some(Search::Found(if stalled { before } else { last }));
        }
        let remaining = self.limit - self.made;
        let hopeless = last >= 1.0 || moved * last.powi(remaining) > self.converged.max(self.rounding);
        (remaining == 0 || self.made > 2 && hopeless).then_some(Search::Slow(last))
    }
}
