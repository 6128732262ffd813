//! State spaces `ẋ = A x + B u`, `y = C x + D u`: their response, and truncation with a bound on the error.
//! Equations (M22) and (M23), docs/theory/15-modes.md.

mod balanced;
mod balancing;
mod components;
mod lyapunov;
mod modal;
mod poles;
mod response;
mod scales;
mod schur;
mod split;
#[cfg(test)]
mod tests;
mod triangular;
mod truncation;

use nalgebra::{Complex, DMatrix};

pub use truncation::{Truncation, TruncationError, TruncationMethod, TruncationRequest};

type C = Complex<f64>;
type Real = DMatrix<f64>;
type Matrix = DMatrix<C>;

/// State space, its matrices by rows.
#[derive(Clone, Debug, PartialEq)]
pub struct StateSpace {
    /// Matrix of the states.
    pub A: Vec<Vec<f64>>,
    /// Matrix of the inputs.
    pub B: Vec<Vec<f64>>,
    /// Matrix of the outputs.
    pub C: Vec<Vec<f64>>,
    /// Matrix from inputs to outputs.
    pub D: Vec<Vec<f64>>,
}

/// The same as matrices.
#[derive(Clone, Debug)]
struct System {
    A: Real,
    B: Real,
    C: Real,
    D: Real,
}

impl System {
    fn of(space: &StateSpace) -> Self {
        let (states, inputs, outputs) = (space.A.len(), space.D.first().map_or(0, Vec::len), space.D.len());
        let matrix = |rows: &[Vec<f64>], height, width| {
            DMatrix::from_row_iterator(height, width, rows.iter().flatten().copied())
        };
        Self {
            A: matrix(&space.A, states, states),
            B: matrix(&space.B, states, inputs),
            C: matrix(&space.C, outputs, states),
            D: matrix(&space.D, outputs, inputs),
        }
    }

    fn listed(&self) -> StateSpace {
        let rows = |matrix: &Real| matrix.row_iter().map(|row| row.iter().copied().collect()).collect();
        StateSpace { A: rows(&self.A), B: rows(&self.B), C: rows(&self.C), D: rows(&self.D) }
    }

    fn states(&self) -> usize {
        self.A.nrows()
    }

    /// Two systems with the same inputs, whose outputs add.
    fn beside(&self, other: &Self) -> Self {
        let (first, second) = (self.states(), other.states());
        let mut A = Real::zeros(first + second, first + second);
        A.view_mut((0, 0), (first, first)).copy_from(&self.A);
        A.view_mut((first, first), (second, second)).copy_from(&other.A);
        let mut B = Real::zeros(first + second, self.B.ncols());
        B.rows_mut(0, first).copy_from(&self.B);
        B.rows_mut(first, second).copy_from(&other.B);
        let mut C = Real::zeros(self.C.nrows(), first + second);
        C.columns_mut(0, first).copy_from(&self.C);
        C.columns_mut(first, second).copy_from(&other.C);
        Self { A, B, C, D: &self.D + &other.D }
    }
}
