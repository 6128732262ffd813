use super::interval::{POINTS, STAGES, WEIGHTS};

/// Guess of a periodic solution: its period, and its state at a share of it, from 0 to 1.
pub struct Guess<'a> {
    /// Period.
    pub period: f64,
    /// State at a share of the period.
    pub state: &'a dyn Fn(f64) -> Vec<f64>,
    /// Parameters.
    pub parameters: Vec<f64>,
}

/// Periodic solution: nodes that share the period evenly, with the states at the Radau points between them.
#[derive(Clone, Debug)]
pub struct PeriodicSolution {
    period: f64,
    parameters: Vec<f64>,
    nodes: Vec<Vec<f64>>,
    /// States at the Radau points of each interval, one behind the other.
    stages: Vec<Vec<f64>>,
}

impl PeriodicSolution {
    /// The guess at nodes and Radau points.
    pub(super) fn sampled(guess: &Guess, intervals: usize, parameters: usize) -> Self {
        let at = |share: f64| (guess.state)(share / intervals as f64);
        let nodes = (0..intervals).map(|i| at(i as f64)).collect();
        let stages = (0..intervals).map(|i| POINTS.iter().flat_map(|point| at(i as f64 + point)).collect());
        let mut given = guess.parameters.clone();
        given.resize(parameters, 0.0);
        Self { period: guess.period, parameters: given, nodes, stages: stages.collect() }
    }

    /// The solution with each state, or each row of states at the Radau points of an interval, as a function gives it.
    pub(super) fn map(mut self, given: impl Fn(&[f64]) -> Vec<f64>) -> Self {
        self.nodes.iter_mut().chain(&mut self.stages).for_each(|states| *states = given(states));
        self
    }

    /// Period.
    #[must_use]
    pub fn period(&self) -> f64 {
        self.period
    }

    /// Parameters `π`.
    #[must_use]
    pub fn parameters(&self) -> &[f64] {
        &self.parameters
    }

    /// Length of an interval.
    pub(super) fn step(&self) -> f64 {
        self.period / self.intervals() as f64
    }

    /// Number of intervals between nodes.
    #[must_use]
    pub fn intervals(&self) -> usize {
        self.nodes.len()
    }

    /// State at a share of the period, from 0 to 1, by the polynomial of its interval.
    #[must_use]
    pub fn at(&self, share: f64) -> Vec<f64> {
        let place = share.rem_euclid(1.0) * self.intervals() as f64;
        let i = (place as usize).min(self.intervals() - 1);
        let x = place - i as f64;
        let [a, b, c] = POINTS;
        let points = [0.0, a, b, c];
        let weights = points.map(|point| {
            let others = points.iter().filter(|other| **other != point);
            others.map(|other| (x - other) / (point - other)).product::<f64>()
        });
        let size = self.nodes[i].len();
        let value = |k: usize| {
            let stages = (0..STAGES).map(|stage| weights[1 + stage] * self.stages[i][stage * size + k]);
            weights[0] * self.nodes[i][k] + stages.sum::<f64>()
        };
        (0..size).map(value).collect()
    }

    /// States at the Radau points of a period, each with its share of it.
    pub fn samples(&self) -> impl Iterator<Item = (f64, &[f64])> {
        let size = self.nodes.first().map_or(1, Vec::len);
        let count = self.intervals() as f64;
        let points = self.stages.iter().flat_map(move |stages| stages.chunks(size));
        points.zip(WEIGHTS.iter().cycle()).map(move |(state, weight)| (weight / count, state))
    }

    pub(super) fn node(&self, i: usize) -> &[f64] {
        &self.nodes[i % self.nodes.len()]
    }

    pub(super) fn stages(&self, i: usize) -> &[f64] {
        &self.stages[i]
    }

    pub(super) fn move_by(&mut self, i: usize, node: &[f64], stages: &[f64]) {
        self.nodes[i].iter_mut().zip(node).for_each(|(value, change)| *value += change);
        self.stages[i].iter_mut().zip(stages).for_each(|(value, change)| *value += change);
    }

    /// Moves the period and the parameters.
    pub(super) fn move_shared(&mut self, shared: &[f64]) {
        self.period += shared[0];
        self.parameters.iter_mut().zip(&shared[1..]).for_each(|(value, change)| *value += change);
    }
}
