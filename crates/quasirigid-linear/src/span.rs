//! Projection of matrices on the span of a few vectors.

use super::eigen::Dense;
use super::krylov::dot;

/// Vectors that are orthonormal in the inner product of a symmetric positive definite matrix `C`.
#[derive(Clone, Debug)]
pub struct Span {
    vectors: Vec<Vec<f64>>,
}

impl Span {
    /// The span of some vectors, without those that are combinations of others.
    pub fn orthonormal(vectors: Vec<Vec<f64>>, stiffness: impl Fn(&[f64]) -> Vec<f64>) -> Self {
        let (mut kept, mut forces): (Vec<Vec<f64>>, Vec<Vec<f64>>) = (Vec::new(), Vec::new());
        for mut x in vectors {
            for _ in 0..2 {
                for (y, force) in kept.iter().zip(&forces) {
                    let share = dot(force, &x);
                    x.iter_mut().zip(y).for_each(|(x, y)| *x -= share * y);
                }
            }
            let mut force = stiffness(&x);
            let length = dot(&x, &force).max(0.0).sqrt();
            if length > f64::EPSILON.sqrt() {
                x.iter_mut().chain(&mut force).for_each(|entry| *entry /= length);
                kept.push(x);
                forces.push(force);
            }
        }
        Self { vectors: kept }
    }

    /// The vectors.
    #[must_use]
    pub fn into_vectors(self) -> Vec<Vec<f64>> {
        self.vectors
    }

    /// A matrix on the span, from its products with vectors.
    pub fn projected(&self, times: impl Fn(&[f64]) -> Vec<f64>) -> Dense {
        let mut matrix = Dense::zero(self.vectors.len());
        for (column, x) in self.vectors.iter().enumerate() {
            let image = times(x);
            self.vectors.iter().enumerate().for_each(|(row, y)| matrix.add(row, column, dot(y, &image)));
        }
        matrix
    }

    /// The combination of the vectors of the span with these coefficients.
    #[must_use]
    pub fn combined(&self, shares: &[f64]) -> Vec<f64> {
        let size = self.vectors.first().map_or(0, Vec::len);
        (0..size).map(|row| self.vectors.iter().zip(shares).map(|(x, share)| share * x[row]).sum()).collect()
    }
}

/// Index of the largest entry of a vector.
#[must_use]
pub fn largest(x: &[f64]) -> Option<usize> {
    (0..x.len()).max_by(|a, b| x[*a].abs().total_cmp(&x[*b].abs()))
}
