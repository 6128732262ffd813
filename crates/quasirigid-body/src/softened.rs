//! Stiffness of the elastic coordinates that a steady spin leaves, factored: as a dense matrix, or in the blocks of its sparse part with the
//! recoil as a correction of rank three.
//! Equation (M1), docs/theory/15-modes.md.

use nalgebra::Matrix3;

use super::{FlexibleBody, Recoiling, SpinMatrix};
use crate::math::blocks::{BlockFactor, Blocks};
use crate::math::eigen::Dense;
use crate::math::lu::Lu;

/// Factors of `C − N` of the elastic coordinates.
pub(super) enum Softened {
    Dense(Lu),
    Recoiling(SoftenedBlocks),
}

/// Factors of the sparse part `Y` of `C − N = Y + S m Sᵀ`.
pub(super) struct SoftenedBlocks {
    factor: BlockFactor,
    moments: Vec<[f64; 3]>,
    /// `Y⁻¹S`, and the matrix from `Sᵀx` to its shares in the correction.
    solved: Vec<[f64; 3]>,
    correction: Matrix3<f64>,
}

impl Softened {
    /// Factors at a centrifugal stiffness; none where a row is zero or a block singular.
    pub fn of(body: &FlexibleBody, centrifugal: &SpinMatrix) -> Option<Self> {
        match centrifugal {
            SpinMatrix::Dense(centrifugal) => dense(body, centrifugal).map(Self::Dense),
            SpinMatrix::Recoiling(centrifugal) => blocks(body, centrifugal).map(Self::Recoiling),
        }
    }

    /// Solutions for right-hand sides stored row by row, `width` to a row; none where the matrix is singular.
    pub fn solve(&self, right: &[f64], width: usize) -> Option<Vec<f64>> {
        match self {
            Self::Dense(factor) => factor.solve(right, width),
            Self::Recoiling(blocks) => blocks.solve(right, width),
        }
    }
}

fn dense(body: &FlexibleBody, centrifugal: &Dense) -> Option<Lu> {
    let elastic = body.elastic();
    let mut left = Dense::of(&body.stiffness().block(0..elastic));
    for j in 0..elastic {
        for k in 0..elastic {
            left.add(j, k, -centrifugal.at(j, k));
        }
    }
    Lu::new(&left)
}

fn blocks(body: &FlexibleBody, Recoiling { own, moments, middle }: &Recoiling) -> Option<SoftenedBlocks> {
    let elastic = body.elastic();
    let within = |(j, k, _): &(usize, usize, f64)| *j < elastic && *k < elastic;
    let springs = body.stiffness().iter().map(|(j, k, C)| (j, k, *C));
    let entries: Vec<_> = springs.chain(own.iter().map(|(j, k, N)| (j, k, -N))).filter(within).collect();
    let blocks = Blocks::of(elastic, entries.iter().map(|(j, k, _)| [*j, *k]));
    let factor = blocks.factor(entries.into_iter().map(|(j, k, entry)| (j, k, [entry, 0.0])))?;
    let mut softened = SoftenedBlocks {
        factor,
        moments: moments.iter().take(elastic).copied().collect(),
        solved: Vec::new(),
        correction: Matrix3::zeros(),
    };
    if !softened.moments.is_empty() {
        let solved = softened.solve(softened.moments.as_flattened(), 3)?;
        softened.solved = solved.as_chunks::<3>().0.to_vec();
        let recoil = -Matrix3::from(*middle).transpose();
        let inner = softened.sums(softened.solved.as_flattened(), 3);
        let inner = Matrix3::from_fn(|axis, column| inner[3 * axis + column]);
        softened.correction = recoil * (Matrix3::identity() + inner * recoil).try_inverse()?;
    }
    Some(softened)
}

impl SoftenedBlocks {
    fn solve(&self, right: &[f64], width: usize) -> Option<Vec<f64>> {
        let complex: Vec<[f64; 2]> = right.iter().map(|entry| [*entry, 0.0]).collect();
        let solved = self.factor.solve(&complex, width)?;
        let mut x: Vec<f64> = solved.iter().map(|[re, _]| *re).collect();
        if !self.solved.is_empty() {
            let sums = self.sums(&x, width);
            let share = |axis: usize, column: usize| {
                (0..3).map(|k| self.correction[(axis, k)] * sums[k * width + column]).sum::<f64>()
            };
            let shares: Vec<f64> =
                (0..3).flat_map(|axis| (0..width).map(move |column| share(axis, column))).collect();
            for (row, X) in x.chunks_exact_mut(width).zip(&self.solved) {
                for (column, entry) in row.iter_mut().enumerate() {
                    *entry -= (0..3).map(|axis| X[axis] * shares[axis * width + column]).sum::<f64>();
                }
            }
        }
        x.iter().all(|entry| entry.is_finite()).then_some(x)
    }

    /// `Sᵀx`, a row for each axis.
    fn sums(&self, x: &[f64], width: usize) -> Vec<f64> {
        let mut sums = vec![0.0; 3 * width];
        for (S, row) in self.moments.iter().zip(x.chunks_exact(width)) {
            for axis in 0..3 {
                row.iter().enumerate().for_each(|(column, x)| sums[axis * width + column] += S[axis] * x);
            }
        }
        sums
    }
}
