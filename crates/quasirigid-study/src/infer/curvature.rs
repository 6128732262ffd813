//! What residuals tell about the keys at the least: covariance, and combinations that are not told. Equations (O5), (O6), (O19)

use quasirigid_math::least_squares::{LeastSquares, Spectrum, jacobian};

use super::loss::Loss;
use super::problem::Problem;

/// Relative deviation of a combination of keys from which the data do not tell it.
const UNSEEN: f64 = 1.0;
/// Singular value, over the largest, below which it is the error of the differences.
const NULL: f64 = 1e-7;
/// Share of a key in a combination from which it is part of it.
const PART: f64 = 0.1;

/// Combination of keys, by their relative changes.
pub(super) struct Unseen {
    pub changes: Vec<(usize, f64)>,
    /// Standard deviation; none if the data do not see it at all.
    pub sigma: Option<f64>,
}

/// The problem about its least.
pub(super) struct Curvature {
    /// Covariance of the points of the search; none of keys that are not told or held at a bound.
    pub covariance: Vec<Vec<Option<f64>>>,
    /// Combinations that are not told.
    pub unseen: Vec<Unseen>,
    /// Rise of the sum of losses over one deviation.
    pub level: f64,
    /// Deviation of the data, where their scatter gives it.
    pub scatter: Option<f64>,
}

/// Mean square of what acts and its mean slope, over the measured values: one both under least squares.
#[derive(Clone, Copy)]
struct Weights {
    act: f64,
    slope: f64,
}

/// Curvature at the least; none where the residuals beside it do not exist.
pub(super) fn curvature(problem: &Problem<'_>, found: &LeastSquares) -> Option<Curvature> {
    let residuals = problem.residuals(&found.parameters)?;
    let (weights, columns) = match problem.loss.kind {
        Loss::Squares => (Weights { act: 1.0, slope: 1.0 }, found.jacobian.clone()),
        _ => (weights(problem, &residuals), plain_jacobian(problem, &found.parameters, &residuals)?),
    };
    let free: Vec<usize> = (0..problem.keys.len()).filter(|key| !found.held[*key]).collect();
    let freedom = (residuals.len() as f64 - free.len() as f64).max(1.0);
    let scatter = (!problem.data.has_deviations()).then(|| (found.square / freedom).sqrt());
    let measured = problem.data.count();
    let sizes: Vec<f64> =
        (0..problem.keys.len()).map(|k| problem.keys[k].size(found.parameters[k])).collect();
    // rows of the measured values with a factor, those of priors as they are
    let scaled = |factor: f64| -> Vec<Vec<f64>> {
        let of = |k: &usize| {
            let rows = columns[*k].iter().enumerate();
            rows.map(|(row, d)| d * sizes[*k] * if row < measured { factor } else { 1.0 }).collect()
        };
        free.iter().map(of).collect()
    };
    let unit = scatter.unwrap_or(1.0);
    let seen = Seen::of(&scaled(weights.slope.sqrt()), &scaled(weights.act.sqrt()), unit);
    let at = |k: usize| free.iter().position(|each| *each == k);
    let entry = |i: usize, j: usize| {
        let (a, b) = (at(i)?, at(j)?);
        Some(seen.covariance(a, b)? * sizes[i] * sizes[j])
    };
    let count = problem.keys.len();
    let unseen = seen.unseen.iter().map(|k| seen.combination(*k, &free)).collect();
    Some(Curvature {
        covariance: (0..count).map(|i| (0..count).map(|j| entry(i, j)).collect()).collect(),
        unseen,
        level: unit * unit * weights.act / weights.slope,
        scatter,
    })
}

/// Means of a robust loss over the measured values; what acts counts no less than under normal errors of the deviations given.
fn weights(problem: &Problem<'_>, residuals: &[f64]) -> Weights {
    let measured = &residuals[..problem.data.count()];
    let count = measured.len() as f64;
    let freedom = (count - problem.keys.len() as f64).max(1.0);
    let act = measured.iter().map(|r| problem.loss.influence(*r).powi(2)).sum::<f64>() / freedom;
    let slope = measured.iter().map(|r| problem.loss.slope(*r)).sum::<f64>() / count;
    let [normal, _] = problem.loss.of_normal_errors();
    // where nothing lies within the scale, the slope is that of a single value
    Weights { act: act.max(normal), slope: slope.max(1.0 / count) }
}

/// Derivatives of the residuals themselves.
fn plain_jacobian(problem: &Problem<'_>, x: &[f64], residuals: &[f64]) -> Option<Vec<Vec<f64>>> {
    let mut all =
        |points: &[Vec<f64>]| points.iter().map(|point| problem.residuals(point)).collect::<Vec<_>>();
    jacobian(x, residuals, &problem.bounds(), &mut all)
}

/// Singular values of the residuals by the relative changes of the keys, and the covariance of those that are seen.
pub(super) struct Seen {
    spectrum: Spectrum,
    /// Deviations of the combinations.
    deviations: Vec<f64>,
    unseen: Vec<usize>,
    /// Covariances of the combinations that are seen.
    between: Vec<Vec<f64>>,
}

impl Seen {
    /// From the derivatives that bend the sum, and those that act in the noise.
    pub fn of(bends: &[Vec<f64>], acts: &[Vec<f64>], unit: f64) -> Self {
        let spectrum = Spectrum::of(bends);
        let rows = acts.first().map_or(0, Vec::len);
        let moved: Vec<Vec<f64>> = spectrum
            .combinations
            .iter()
            .map(|v| {
                (0..rows)
                    .map(|row| v.iter().zip(acts).map(|(share, column)| share * column[row]).sum())
                    .collect()
            })
            .collect();
        let count = moved.len();
        let w = &spectrum.singular;
        let between = |a: usize, b: usize| {
            let product: f64 = moved[a].iter().zip(&moved[b]).map(|(x, y)| x * y).sum();
            unit * unit * product / (w[a] * w[b]).powi(2)
        };
        let between: Vec<Vec<f64>> =
            (0..count).map(|a| (0..count).map(|b| between(a, b)).collect()).collect();
        let deviations: Vec<f64> = (0..count).map(|k| between[k][k].sqrt()).collect();
        let largest = w.first().copied().unwrap_or(0.0);
        let is_unseen = |k: &usize| !(deviations[*k] <= UNSEEN) || w[*k] <= NULL * largest;
        let unseen = (0..count).filter(is_unseen).collect();
        Self { spectrum, deviations, unseen, between }
    }

    fn part(&self, k: usize, key: usize) -> bool {
        self.spectrum.combinations[k][key].abs() > PART
    }

    /// Covariance of the relative changes of two keys; none where the data do not tell one of them.
    pub fn covariance(&self, i: usize, j: usize) -> Option<f64> {
        let lost = |key: usize| self.unseen.iter().any(|k| self.part(*k, key));
        if lost(i) || lost(j) {
            return None;
        }
        let v = &self.spectrum.combinations;
        let seen: Vec<usize> = (0..v.len()).filter(|k| !self.unseen.contains(k)).collect();
        let each = seen.iter().flat_map(|a| seen.iter().map(move |b| (*a, *b)));
        Some(each.map(|(a, b)| v[a][i] * self.between[a][b] * v[b][j]).sum())
    }

    fn combination(&self, k: usize, free: &[usize]) -> Unseen {
        let largest = self.spectrum.singular.first().copied().unwrap_or(0.0);
        let keys = (0..free.len()).filter(|key| self.part(k, *key));
        Unseen {
            changes: keys.map(|key| (free[key], self.spectrum.combinations[k][key])).collect(),
            sigma: (self.spectrum.singular[k] > NULL * largest).then_some(self.deviations[k]),
        }
    }
}
