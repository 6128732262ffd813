//! Matrices of a cavity of revolution: scalar Laplacians and masses over the meridian, divergence and pressure in patches.
//! A component of order `k` round the axis has `k²/r²` in its Laplacian; the two integrals are kept apart and summed for each order.
//! Equation (L10), docs/theory/13-inside.md.

use std::sync::Arc;

use nalgebra::{Cholesky, DMatrix, Dyn};

use super::grid::{Grid, Patch};
use crate::math::symmetric::{Pattern, Symmetric};

/// Nodes at which a component of a harmonic can differ from zero, numbered, and the matrices over them.
pub(super) struct Scalar {
    /// The nodes.
    pub nodes: Vec<usize>,
    /// Number of each node of the grid.
    pub unknowns: Vec<Option<u32>>,
    /// `∫ (∇N_a·∇N_b) r dr dz` (m).
    gradient: Symmetric,
    /// `∫ N_a N_b /r dr dz` (m).
    turn: Symmetric,
    /// `∫ N_a N_b r dr dz` (m³).
    pub mass: Symmetric,
}

impl Scalar {
    /// Matrices over the nodes of a grid that are counted.
    pub fn new(grid: &Grid, blocks: &[Dense], counts: impl Fn(usize) -> bool) -> Self {
        let nodes: Vec<usize> = (0..grid.places.len()).filter(|node| counts(*node)).collect();
        let mut unknowns = vec![None; grid.places.len()];
        nodes.iter().zip(0..).for_each(|(node, number)| unknowns[*node] = Some(number));
        let own = |patch: &Patch| patch.nodes.iter().filter_map(|node| unknowns[*node]).collect();
        let lists: Vec<Vec<u32>> = grid.patches.iter().map(own).collect();
        let ends: Vec<u32> = (0..=nodes.len() as u32).collect();
        let pattern = Pattern::new(&ends, lists.iter().map(Vec::as_slice));
        let zero =
            Symmetric::zero(Arc::new(pattern.expect("numbers ascend and each list holds some of them")));
        let [mut gradient, mut turn, mut mass] = [zero.clone(), zero.clone(), zero];
        for (patch, block) in grid.patches.iter().zip(blocks) {
            let own: Vec<Option<u32>> = patch.nodes.iter().map(|node| unknowns[*node]).collect();
            for (sum, part) in
                [(&mut gradient, &block.gradient), (&mut turn, &block.turn), (&mut mass, &block.mass)]
            {
                sum.add(&own, part.as_slice()).expect("the pattern has the places of every patch");
            }
        }
        Self { nodes, unknowns, gradient, turn, mass }
    }

    /// Laplacian of order `k` round the axis, `∫ (∇N_a·∇N_b + k² N_a N_b/r²) r dr dz`.
    pub fn stiffness(&self, k: usize) -> Symmetric {
        self.gradient.plus((k * k) as f64, &self.turn).expect("both stand on one pattern")
    }
}

/// Matrices of a patch over its nodes and the polynomials of its pressure.
pub(super) struct Dense {
    pub gradient: DMatrix<f64>,
    pub turn: DMatrix<f64>,
    pub mass: DMatrix<f64>,
    /// `∫ π ∂N/∂r r dr dz`, `∫ π N dr dz` and `∫ π ∂N/∂z r dr dz` (m²).
    pub divergence: [DMatrix<f64>; 3],
    /// Factor of `∫ π π r dr dz`.
    pub pressure: Cholesky<f64, Dyn>,
}

impl Dense {
    /// Matrices of a patch; none if rounding leaves the pressures linearly dependent.
    pub fn new(patch: &Patch) -> Option<Self> {
        let points = &patch.points;
        let (nodes, pressures) = (patch.nodes.len(), points.first()?.pressures.len());
        let part = |kind: usize| {
            DMatrix::from_fn(points.len(), nodes, |point, node| points[point].functions[node][kind])
        };
        let [value, by_r, by_z] = [0, 1, 2].map(part);
        let pressure =
            DMatrix::from_fn(points.len(), pressures, |point, number| points[point].pressures[number]);
        let weighted = |matrix: &DMatrix<f64>, power: i32| {
            let mut product = matrix.clone();
            for (mut row, point) in product.row_iter_mut().zip(points) {
                row *= point.share * point.at[0].powi(power);
            }
            product
        };
        let pushed = weighted(&pressure, 1);
        Some(Self {
            gradient: by_r.tr_mul(&weighted(&by_r, 1)) + by_z.tr_mul(&weighted(&by_z, 1)),
            turn: value.tr_mul(&weighted(&value, -1)),
            mass: value.tr_mul(&weighted(&value, 1)),
            divergence: [pushed.tr_mul(&by_r), weighted(&pressure, 0).tr_mul(&value), pushed.tr_mul(&by_z)],
            pressure: pressure.tr_mul(&pushed).cholesky()?,
        })
    }

    /// Number of polynomials of the pressure.
    pub fn pressures(&self) -> usize {
        self.divergence[0].nrows()
    }
}
