//! Transfer matrices by the Schur form.

use super::schur::Schur;
use super::{C, Matrix, System};
use crate::eigen::NoConvergence;

/// Response of a system, ready for many frequencies.
#[derive(Clone, Debug)]
pub(super) struct Response {
    T: Matrix,
    inputs: Matrix,
    outputs: Matrix,
    through: Matrix,
}

impl Response {
    pub fn of(system: &System) -> Result<Self, NoConvergence> {
        let schur = Schur::of(&system.A)?;
        Ok(Self {
            inputs: schur.Q.adjoint() * system.B.map(C::from),
            outputs: system.C.map(C::from) * &schur.Q,
            through: system.D.map(C::from),
            T: schur.T,
        })
    }

    /// Transfer matrix at a complex frequency (1/s).
    pub fn at(&self, s: C) -> Matrix {
        let mut x = self.inputs.clone();
        for mut column in x.column_iter_mut() {
            for i in (0..self.T.nrows()).rev() {
                let above: C = (i + 1..self.T.nrows()).map(|k| self.T[(i, k)] * column[k]).sum();
                column[i] = (column[i] + above) / (s - self.T[(i, i)]);
            }
        }
        &self.outputs * x + &self.through
    }
}

/// Largest singular value.
pub(super) fn gain(matrix: &Matrix) -> f64 {
    let square =
        if matrix.nrows() < matrix.ncols() { matrix * matrix.adjoint() } else { matrix.adjoint() * matrix };
    if square.iter().any(|entry| !entry.re.is_finite() || !entry.im.is_finite()) {
        return f64::INFINITY;
    }
    let largest = square.symmetric_eigenvalues().iter().copied().fold(0.0, f64::max);
    largest.sqrt()
}
