//! Inverse of the mass matrix of the full system, factored once: in blocks where coordinates fall apart, with the translation of a free body
//! as a correction of rank three.
//! Equation (T1), docs/theory/08-full-system.md.

use nalgebra::{Matrix3, Vector3};

use super::{FlexibleBody, Invariants};
use crate::math::cholesky::Cholesky;
use crate::math::sparse::SparseRows;
use crate::math::vec3::{add, dot, scale};

/// Inverse of the mass matrix `A − SSᵀ/m*` of a free body, `A` of a constrained one.
#[derive(Clone, Debug)]
pub(super) struct MassInverse {
    sparse: SparseInverse,
    /// `A⁻¹S` and `(m* − SᵀA⁻¹S)⁻¹`, the correction of rank three for a free body.
    recoil: Option<(Vec<[f64; 3]>, Matrix3<f64>)>,
    S: Vec<[f64; 3]>,
}

#[derive(Clone, Debug)]
enum SparseInverse {
    /// Inverse of a matrix of small blocks, itself of these blocks.
    Blocks(SparseRows<f64>),
    Factor(Cholesky),
}

/// Largest block that is inverted as a whole.
const BLOCK: usize = 6;
/// Number of coordinates up to which the inverse is one block, recoil included.
const SINGLE_BLOCK_COORDINATES: usize = 12;
/// Share of the whole mass below which a recoiling mass is rounding.
const LOST: f64 = 1e-13;

impl MassInverse {
    /// Inverse for a body; none if the matrix is not positive, as with a carrier whose mass is lost in rounding.
    pub fn new(body: &FlexibleBody) -> Option<Self> {
        let Invariants { pairs, S, mass, .. } = body.invariants();
        let entries = pairs.iter().map(|(j, k, pair)| (j, k, pair.A)).collect();
        let A: SparseRows<f64> = SparseRows::sum(S.len(), entries);
        let sparse = match blocks(&A) {
            Some(inverse) => SparseInverse::Blocks(inverse),
            None => SparseInverse::Factor(Cholesky::new(&A).ok()?),
        };
        let mut inverse = Self { sparse, recoil: None, S: S.clone() };
        if body.translation().is_some() {
            let rows: Vec<_> = S.iter().map(|S| [S[0], S[1], S[2], 0.0]).collect();
            let mut solved = vec![[0.0; 4]; S.len()];
            inverse.apply(&rows, &mut solved);
            let solved: Vec<[f64; 3]> = solved.iter().map(|[x, y, z, _]| [*x, *y, *z]).collect();
            let mut middle = *mass * Matrix3::identity();
            for (S, X) in S.iter().zip(&solved) {
                middle -= Vector3::from(*S) * Vector3::from(*X).transpose();
            }
            let least = middle.symmetric_eigenvalues().min();
            let middle = middle.try_inverse().filter(|_| least > LOST * mass)?;
            inverse.recoil = Some((solved, middle));
        }
        Some(if S.len() <= SINGLE_BLOCK_COORDINATES { inverse.joined() } else { inverse })
    }

    /// Inverse as one block, recoil included.
    fn joined(self) -> Self {
        let n = self.S.len();
        let mut parts = Vec::new();
        for column in 0..n {
            let unit: Vec<[f64; 4]> =
                (0..n).map(|row| [f64::from(u8::from(row == column)), 0.0, 0.0, 0.0]).collect();
            let mut solved = vec![[0.0; 4]; n];
            self.apply(&unit, &mut solved);
            parts.extend(solved.iter().enumerate().map(|(row, entries)| (row, column, entries[0])));
        }
        Self { sparse: SparseInverse::Blocks(SparseRows::sum(n, parts)), recoil: None, S: self.S }
    }

    /// Inverse times four columns, given row by row.
    pub fn apply(&self, rows: &[[f64; 4]], solved: &mut [[f64; 4]]) {
        match &self.sparse {
            SparseInverse::Blocks(inverse) => {
                for (j, solved) in solved.iter_mut().enumerate() {
                    *solved = [0.0; 4];
                    for (k, entry) in inverse.row(j) {
                        solved.iter_mut().zip(rows[k]).for_each(|(sum, part)| *sum += entry * part);
                    }
                }
            }
            SparseInverse::Factor(factor) => {
                solved.copy_from_slice(rows);
                factor.solve(solved.as_flattened_mut(), 4);
            }
        }
        if let Some((recoil, middle)) = &self.recoil {
            let mut moments = [[0.0; 3]; 4];
            for (S, solved) in self.S.iter().zip(&*solved) {
                for (moment, x) in moments.iter_mut().zip(solved) {
                    *moment = add(*moment, scale(*x, *S));
                }
            }
            let shifts = moments.map(|moment| <[f64; 3]>::from(middle * Vector3::from(moment)));
            for (solved, X) in solved.iter_mut().zip(recoil) {
                solved.iter_mut().zip(shifts).for_each(|(x, shift)| *x += dot(*X, shift));
            }
        }
    }
}

/// Inverse of a matrix whose blocks are contiguous and small; none if a block is larger than `BLOCK`.
fn blocks(A: &SparseRows<f64>) -> Option<SparseRows<f64>> {
    let mut parts = Vec::new();
    let mut start = 0;
    while start < A.size() {
        let mut end = start + 1;
        let mut row = start;
        while row < end {
            let last = A.row(row).map(|(column, _)| column + 1).max().unwrap_or(0);
            end = end.max(last);
            row += 1;
        }
        if end - start > BLOCK {
            return None;
        }
        let mut block = nalgebra::DMatrix::zeros(end - start, end - start);
        for row in start..end {
            for (column, entry) in A.row(row) {
                block[(row - start, column - start)] = *entry;
            }
        }
        let inverse = block.cholesky()?.inverse();
        for row in start..end {
            parts.extend((start..end).map(|column| (row, column, inverse[(row - start, column - start)])));
        }
        start = end;
    }
    Some(SparseRows::sum(A.size(), parts))
}
