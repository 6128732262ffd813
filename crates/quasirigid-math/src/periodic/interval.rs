use super::Unfolded;
use super::solution::PeriodicSolution;
use crate::eigen::Dense;
use crate::lu::Lu;

/// Radau points of an interval.
pub(super) const STAGES: usize = 3;
/// `√6`.
const ROOT: f64 = 2.449_489_742_783_178;
/// Radau points, as shares of the interval; the last one is the next node.
pub(super) const POINTS: [f64; STAGES] = [0.4 - 0.1 * ROOT, 0.4 + 0.1 * ROOT, 1.0];
/// Weights of the Radau points.
pub(super) const WEIGHTS: [f64; STAGES] = INTEGRALS[STAGES - 1];
/// Integrals of the polynomials of the Radau points from the node to each of them.
const INTEGRALS: [[f64; STAGES]; STAGES] = [
    [(88.0 - 7.0 * ROOT) / 360.0, (296.0 - 169.0 * ROOT) / 1800.0, (-2.0 + 3.0 * ROOT) / 225.0],
    [(296.0 + 169.0 * ROOT) / 1800.0, (88.0 + 7.0 * ROOT) / 360.0, (-2.0 - 3.0 * ROOT) / 225.0],
    [(16.0 - ROOT) / 36.0, (16.0 + ROOT) / 36.0, 1.0 / 9.0],
];
/// Step of a difference over the size of the component: the root of the rounding, since rates are smooth.
const DIFFERENCE: f64 = 1.5e-8;

/// Interval between two nodes, linear in changes of its node, of the period and of the parameters.
pub(super) struct Interval {
    /// Factors of the equations of the stages.
    factors: Lu,
    /// Rows of the stages: changes by each component of the node, by the period and the parameters, and to close their equations.
    stages: Vec<f64>,
    width: usize,
    /// Rows of the next node, in the same columns; the last has the gap to the node that is there.
    pub next: Vec<f64>,
}

impl Interval {
    /// Linear equations of an interval of a solution; none where they are singular.
    pub fn linear(system: &mut impl Unfolded, solution: &PeriodicSolution, i: usize) -> Option<Self> {
        let (size, parameters, step) = (system.size(), solution.parameters(), solution.step());
        let width = size + 2 + parameters.len();
        let rates = rates(system, solution, i);
        let mut matrix = Dense::zero(STAGES * size);
        let mut directions = Vec::with_capacity(STAGES);
        for (l, z) in solution.stages(i).chunks(size).enumerate() {
            directions.push(system.directions(z));
            add_slopes(system, (z, parameters, &rates[l * size..(l + 1) * size]), |row, column, slope| {
                for (j, integrals) in INTEGRALS.iter().enumerate() {
                    matrix.add(j * size + row, l * size + column, -step * integrals[l] * slope);
                }
            });
        }
        let gaps = gaps(solution, i, &rates);
        let mut right = vec![0.0; STAGES * size * width];
        for (row, right) in right.chunks_mut(width).enumerate() {
            let (integrals, k) = (&INTEGRALS[row / size], row % size);
            matrix.add(row, row, 1.0);
            right[k] = 1.0;
            right[size] = passed(integrals, |l| rates[l * size + k]) / solution.intervals() as f64;
            for (index, entry) in right[size + 1..width - 1].iter_mut().enumerate() {
                *entry = step * passed(integrals, |l| directions[l][index][k]);
            }
            right[width - 1] = gaps[row];
        }
        let factors = Lu::new(&matrix)?;
        let stages = factors.solve(&right, width)?;
        let next = stages[(STAGES - 1) * size * width..].to_vec();
        let mut interval = Self { factors, stages, width, next };
        interval.close(solution, i);
        Some(interval)
    }

    /// Takes the gaps of a solution that has moved, with the slopes as they were; none where the equations are singular.
    pub fn update(
        &mut self,
        system: &mut impl Unfolded,
        solution: &PeriodicSolution,
        i: usize,
    ) -> Option<()> {
        let rates = rates(system, solution, i);
        let closing = self.factors.solve(&gaps(solution, i, &rates), 1)?;
        let last = self.width - 1;
        self.stages.chunks_mut(self.width).zip(closing).for_each(|(row, closing)| row[last] = closing);
        self.close(solution, i);
        Some(())
    }

    /// Takes the gap to the next node.
    fn close(&mut self, solution: &PeriodicSolution, i: usize) {
        let there = solution.node(i + 1);
        let before = (STAGES - 1) * there.len();
        let (last, width) = (self.width - 1, self.width);
        let rows = self.stages[before * width..].chunks(width).zip(&solution.stages(i)[before..]);
        for ((next, (row, stage)), there) in self.next.chunks_mut(width).zip(rows).zip(there) {
            next[last] = row[last] + stage - there;
        }
    }

    /// Changes of the stages by those of the node, of the period and of the parameters.
    pub fn change(&self, node: &[f64], shared: &[f64]) -> Vec<f64> {
        let rows = self.stages.chunks(self.width);
        rows.map(|row| {
            let given = row.iter().zip(node.iter().chain(shared)).map(|(entry, change)| entry * change);
            given.sum::<f64>() + row[self.width - 1]
        })
        .collect()
    }
}

/// Rates at the stages of an interval, one behind the other.
fn rates(system: &mut impl Unfolded, solution: &PeriodicSolution, i: usize) -> Vec<f64> {
    let size = system.size();
    let mut rates = vec![0.0; STAGES * size];
    for (z, rate) in solution.stages(i).chunks(size).zip(rates.chunks_mut(size)) {
        system.rate(z, solution.parameters(), rate);
    }
    rates
}

/// Gaps of the equations of the stages: the change since the node less that by the rates.
fn gaps(solution: &PeriodicSolution, i: usize, rates: &[f64]) -> Vec<f64> {
    let node = solution.node(i);
    let gap = |(row, stage): (usize, &f64)| {
        let k = row % node.len();
        let by_rates = passed(&INTEGRALS[row / node.len()], |l| rates[l * node.len() + k]);
        node[k] + solution.step() * by_rates - stage
    };
    solution.stages(i).iter().enumerate().map(gap).collect()
}

/// Integral from the node to a stage of values at the stages.
fn passed(integrals: &[f64; STAGES], value: impl Fn(usize) -> f64) -> f64 {
    integrals.iter().enumerate().map(|(l, integral)| integral * value(l)).sum()
}

/// Gives the slopes of the rates by each component, by differences.
fn add_slopes(
    system: &mut impl Unfolded,
    (z, parameters, rate): (&[f64], &[f64], &[f64]),
    mut add: impl FnMut(usize, usize, f64),
) {
    let (mut place, mut moved) = (z.to_vec(), vec![0.0; z.len()]);
    for column in 0..z.len() {
        place[column] += DIFFERENCE * system.scale(column).max(z[column].abs());
        let step = place[column] - z[column];
        system.rate(&place, parameters, &mut moved);
        place[column] = z[column];
        for (row, (moved, rate)) in moved.iter().zip(rate).enumerate() {
            add(row, column, (moved - rate) / step);
        }
    }
}
