//! Matrix of the coordinates about a steady spin: dense for few coordinates; for many the sparse part of the body itself and the part that
//! the recoil of a free body adds.
//! Equations (M2), docs/theory/15-modes.md; (S6), docs/theory/01-system.md.

use std::sync::Arc;

use crate::math::eigen::Dense;
use crate::math::sparse::SparseRows;
use crate::math::vec3::{add, dot, scale};

/// Matrix of the coordinates in the equations about a steady spin. (M2)
#[derive(Clone, Debug)]
pub enum SpinMatrix {
    /// Every entry.
    Dense(Dense),
    /// `X + S m Sᵀ`: a sparse matrix, and what the recoil adds. (S6)
    Recoiling(Recoiling),
}

/// Sparse matrix with the part that the recoil in translation adds, `X + S m Sᵀ`. (S6)
#[derive(Clone, Debug)]
pub struct Recoiling {
    /// `X`.
    pub own: SparseRows<f64>,
    /// Linear momentum per unit rate of each coordinate, rows of `S` (kg, kg·m); empty where nothing recoils.
    pub moments: Arc<Vec<[f64; 3]>>,
    /// `m`.
    pub middle: [[f64; 3]; 3],
}

impl SpinMatrix {
    /// An entry.
    #[must_use]
    pub fn at(&self, row: usize, column: usize) -> f64 {
        match self {
            Self::Dense(matrix) => matrix.at(row, column),
            Self::Recoiling(Recoiling { own, moments, middle }) => {
                let own = own.row(row).find(|(other, _)| *other == column).map_or(0.0, |(_, entry)| *entry);
                match moments.is_empty() {
                    true => own,
                    false => own + dot(moments[row], middle.map(|m| dot(m, moments[column]))),
                }
            }
        }
    }

    /// Product with a vector.
    #[must_use]
    pub fn times(&self, x: &[f64]) -> Vec<f64> {
        match self {
            Self::Dense(matrix) => matrix.times(x),
            Self::Recoiling(Recoiling { own, moments, middle }) => {
                let mut product = own.times(x);
                let sum = moments.iter().zip(x).fold([0.0; 3], |sum, (S, x)| add(sum, scale(*x, *S)));
                let recoil = middle.map(|m| dot(m, sum));
                product.iter_mut().zip(&**moments).for_each(|(entry, S)| *entry += dot(*S, recoil));
                product
            }
        }
    }
}

/// Sum of the entries of a matrix.
pub(super) enum SpinSum {
    Dense(Dense),
    Sparse { size: usize, parts: Vec<(usize, usize, f64)>, middle: [[f64; 3]; 3] },
}

impl SpinSum {
    pub fn zero(size: usize, sparse: bool) -> Self {
        match sparse {
            true => Self::Sparse { size, parts: Vec::new(), middle: [[0.0; 3]; 3] },
            false => Self::Dense(Dense::zero(size)),
        }
    }

    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        match self {
            Self::Dense(matrix) => matrix.add(row, column, value),
            Self::Sparse { parts, .. } => parts.push((row, column, value)),
        }
    }

    /// Adds what the recoil adds: each entry of the coordinates that move, or its form in the momenta.
    pub fn recoil(
        &mut self,
        moving: impl Fn(usize) -> bool,
        entry: impl Fn(usize, usize) -> f64,
        form: [[f64; 3]; 3],
    ) {
        match self {
            Self::Dense(matrix) => {
                let moving: Vec<usize> = (0..matrix.size()).filter(|j| moving(*j)).collect();
                for &j in &moving {
                    moving.iter().for_each(|&k| matrix.add(j, k, entry(j, k)));
                }
            }
            Self::Sparse { middle, .. } => *middle = form,
        }
    }

    pub fn finished(self, moments: &Arc<Vec<[f64; 3]>>) -> SpinMatrix {
        match self {
            Self::Dense(matrix) => SpinMatrix::Dense(matrix),
            Self::Sparse { size, parts, middle } => SpinMatrix::Recoiling(Recoiling {
                own: SparseRows::sum(size, parts),
                moments: Arc::clone(moments),
                middle,
            }),
        }
    }
}
