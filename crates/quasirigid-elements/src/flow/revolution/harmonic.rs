//! Equations of one harmonic of the flow in a cavity of revolution: three scalar operators coupled by the pressure.
//! The combinations `u_r ± u_θ` and `u_z` have Laplacians of their own, so each part is factored by itself.
//! Equations (L4) and (L10), docs/theory/13-inside.md.

use nalgebra::DMatrix;

use super::grid::Grid;
use super::layout::Layout;
use super::matrices::{Dense, Scalar};
use crate::flow::incompressible::Incompressible;
use crate::math::factor::Factor;

/// Equations of the flows of one harmonic; numbers stand row by row, part after part.
pub(super) struct Harmonic<'a> {
    pub m: usize,
    pub grid: &'a Grid,
    pub blocks: &'a [Dense],
    /// Scalars of order zero round the axis, and of higher orders, which vanish on the axis.
    pub scalars: &'a [Scalar; 2],
    /// Factors of the operator of each part.
    pub factors: [&'a Factor; 3],
}

impl Harmonic<'_> {
    fn scalars(&self) -> [&Scalar; 3] {
        Layout::orders(self.m).map(|k| &self.scalars[usize::from(k > 0)])
    }

    /// The rows of the parts among those of `width` numbers.
    fn parts<'b>(&self, rows: &'b [f64], width: usize) -> [&'b [f64]; 3] {
        let [a, b, _] = self.scalars().map(|scalar| scalar.nodes.len() * width);
        [&rows[..a], &rows[a..a + b], &rows[a + b..]]
    }

    /// Divergence of a unit of each part in a patch, per share of the pressure.
    fn divergences(&self, block: &Dense) -> [DMatrix<f64>; 3] {
        let [by_r, round, by_z] = &block.divergence;
        let (m, whole) = (self.m as f64, Layout::round(self.m));
        [0.5 * whole * (by_r + (1.0 + m) * round), 0.5 * whole * (by_r + (1.0 - m) * round), whole * by_z]
    }

    fn pressures(&self) -> usize {
        self.blocks.iter().map(Dense::pressures).sum()
    }
}

impl Incompressible for Harmonic<'_> {
    fn flow(&self, forces: &mut [f64], width: usize) {
        let mut rest = forces;
        for ((scalar, factor), weight) in
            self.scalars().into_iter().zip(self.factors).zip(Layout::weights(self.m))
        {
            let (part, others) = rest.split_at_mut(scalar.nodes.len() * width);
            factor.solve(part, width);
            part.iter_mut().for_each(|value| *value /= weight);
            rest = others;
        }
    }

    fn divergence(&self, u: &[f64], width: usize) -> Vec<f64> {
        let parts = self.parts(u, width);
        let mut divergence = Vec::with_capacity(self.pressures() * width);
        for (patch, block) in self.grid.patches.iter().zip(self.blocks) {
            let mut sum = DMatrix::zeros(block.pressures(), width);
            for ((scalar, part), matrix) in self.scalars().into_iter().zip(parts).zip(self.divergences(block))
            {
                let value = |node: usize, column: usize| match scalar.unknowns[patch.nodes[node]] {
                    Some(unknown) => part[unknown as usize * width + column],
                    None => 0.0,
                };
                sum += matrix * DMatrix::from_fn(patch.nodes.len(), width, value);
            }
            divergence.extend(sum.transpose().iter());
        }
        divergence
    }

    fn push(&self, p: &[f64], width: usize) -> Vec<f64> {
        let mut pushes = self.scalars().map(|scalar| vec![0.0; scalar.nodes.len() * width]);
        let mut start = 0;
        for (patch, block) in self.grid.patches.iter().zip(self.blocks) {
            let count = block.pressures();
            let own = DMatrix::from_row_slice(count, width, &p[start..start + count * width]);
            start += count * width;
            for ((scalar, push), matrix) in
                self.scalars().into_iter().zip(&mut pushes).zip(self.divergences(block))
            {
                let part = matrix.tr_mul(&own);
                for (node, row) in patch.nodes.iter().zip(part.row_iter()) {
                    if let Some(unknown) = scalar.unknowns[*node] {
                        let place = unknown as usize * width;
                        push[place..place + width]
                            .iter_mut()
                            .zip(&row)
                            .for_each(|(sum, value)| *sum += value);
                    }
                }
            }
        }
        pushes.concat()
    }

    fn weigh(&self, divergence: &mut [f64], width: usize) {
        let mut rest = divergence;
        for block in self.blocks {
            let count = block.pressures();
            let (own, others) = rest.split_at_mut(count * width);
            let solved = block.pressure.solve(&DMatrix::from_row_slice(count, width, own));
            let values = solved.transpose() / Layout::round(self.m);
            own.copy_from_slice(values.as_slice());
            rest = others;
        }
    }
}
