//! Assembly of the Stokes problem in a mesh: Laplacian, mass, divergence and pressure matrices over the moving nodes.
//! The walls fix all three components, so one scalar Laplacian serves each; a small mass makes the pressure's Laplacian regular.
//! Equation (L4), docs/theory/13-inside.md; elements of `[@taylor1973]`.

use std::sync::Arc;

use super::StokesError;
use super::cell::{CORNERS, Matrices, NODES};
use super::divergence::Divergence;
use super::grid::Grid;
use super::saddle::Saddle;
use crate::flow::incompressible;
use crate::math::factor::{Factor, Method, NotPositive};
use crate::math::symmetric::{Pattern, Symmetric};

/// Matrices of a cavity for one component of the velocity, over the nodes that move.
pub(super) struct Assembly {
    /// Number of each node among those that move.
    pub unknowns: Vec<Option<u32>>,
    /// `∫ ∇N_a·∇N_b dV` (m).
    pub stiffness: Symmetric,
    /// `∫ N_a N_b dV` (m³).
    pub mass: Symmetric,
    /// `∫ ∇λ_p·∇λ_q dV` (m) and `∫ λ_p λ_q dV` (m³) of the pressure.
    pressure: [Symmetric; 2],
    divergence: Divergence,
    laplacian: Factor,
    weight: Factor,
    /// A place of the cavity (m).
    middle: [f64; 3],
}

/// Share of the pressure's mass in its Laplacian, which is singular without it.
const ANCHOR: f64 = 1e-6;

impl Assembly {
    /// Sums the cells and factors the matrices.
    ///
    /// # Errors
    /// [`StokesError::NoInterior`], [`StokesError::Singular`].
    pub fn new(grid: &Grid) -> Result<Self, StokesError> {
        let nodes = grid.cells.iter().flatten().copied().filter(|node| !grid.walls[*node]);
        let corners = grid.cells.iter().flat_map(|cell| cell[..CORNERS].iter().copied());
        let (moving, vertices) = (Numbering::new(grid, nodes), Numbering::new(grid, corners));
        if moving.nodes.is_empty() {
            return Err(StokesError::NoInterior);
        }
        let mut stiffness = Symmetric::zero(moving.pattern(grid, NODES));
        let mut mass = stiffness.clone();
        let mut pressure = [(); 2].map(|()| Symmetric::zero(vertices.pattern(grid, CORNERS)));
        let mut divergence = Divergence::new(moving.nodes.len(), vertices.nodes.len());
        for cell in &grid.cells {
            let matrices = Matrices::new(&cell.map(|node| grid.places[node]));
            let unknowns = cell.map(|node| moving.of[node]);
            let own = [0, 1, 2, 3].map(|corner| vertices.of[cell[corner]]);
            add(&mut stiffness, &unknowns, matrices.stiffness.as_flattened());
            add(&mut mass, &unknowns, matrices.mass.as_flattened());
            add(&mut pressure[0], &own, matrices.pressure_stiffness.as_flattened());
            add(&mut pressure[1], &own, matrices.pressure.as_flattened());
            divergence.add(unknowns, own.map(Option::unwrap_or_default), matrices.divergence);
        }
        let factor = |matrix: &Symmetric, numbering: &Numbering| {
            Factor::new(matrix, Method::default()).map_err(|soft| numbering.singular(grid, &soft))
        };
        let laplacian = factor(&stiffness, &moving)?;
        let weight = factor(&pressure[1], &vertices)?;
        let middle = grid.places[moving.nodes[0]];
        Ok(Self { unknowns: moving.of, stiffness, mass, pressure, divergence, laplacian, weight, middle })
    }

    /// Flows under forces stored row by row, `width` to a row, in place; with inertia `rate ∫ N_a N_b dV` (1/m²).
    ///
    /// # Errors
    /// [`StokesError::NoConvergence`], [`StokesError::Singular`].
    pub fn solve(&self, forces: &mut [f64], width: usize, rate: f64) -> Result<(), StokesError> {
        let (divergence, pressure) = (&self.divergence, &self.weight);
        if rate == 0.0 {
            let saddle = Saddle { laplacian: &self.laplacian, divergence, pressure, inertia: None };
            return incompressible::solve(&saddle, forces, width);
        }
        let factor = |stiffness: &Symmetric, share: f64, mass: &Symmetric| {
            let sum = stiffness.plus(share, mass).expect("both stand on one pattern");
            Factor::new(&sum, Method::default()).map_err(|_| StokesError::Singular { at: self.middle })
        };
        let laplacian = factor(&self.stiffness, rate, &self.mass)?;
        let [stiffness, mass] = &self.pressure;
        let inert = factor(stiffness, anchor(ANCHOR, stiffness, mass), mass)?;
        let saddle = Saddle { laplacian: &laplacian, divergence, pressure, inertia: Some((rate, &inert)) };
        incompressible::solve(&saddle, forces, width)
    }

    /// `√∫|d|² dV` of the discrete divergence `d` of a flow.
    #[cfg(test)]
    pub fn divergence_of(&self, u: &[f64]) -> f64 {
        let (laplacian, divergence, pressure) = (&self.laplacian, &self.divergence, &self.weight);
        incompressible::divergence_of(&Saddle { laplacian, divergence, pressure, inertia: None }, u)
    }
}

/// Rate of inertia that is a share of a Laplacian, which alone would leave the constant free.
pub(super) fn anchor(share: f64, stiffness: &Symmetric, mass: &Symmetric) -> f64 {
    share * stiffness.norm() / mass.norm()
}

/// Some of the nodes, numbered.
pub(super) struct Numbering {
    /// Number of each node.
    pub of: Vec<Option<u32>>,
    nodes: Vec<usize>,
}

impl Numbering {
    pub fn new(grid: &Grid, nodes: impl Iterator<Item = usize>) -> Self {
        let mut nodes: Vec<usize> = nodes.collect();
        nodes.sort_unstable();
        nodes.dedup();
        let mut of = vec![None; grid.places.len()];
        nodes.iter().zip(0..).for_each(|(node, number)| of[*node] = Some(number));
        Self { of, nodes }
    }

    pub fn size(&self) -> usize {
        self.nodes.len()
    }

    /// Pattern of the matrices of cells over their first nodes.
    pub fn pattern(&self, grid: &Grid, first: usize) -> Arc<Pattern> {
        let joined = |cell: &[usize; NODES]| cell[..first].iter().filter_map(|node| self.of[*node]).collect();
        let lists: Vec<Vec<u32>> = grid.cells.iter().map(joined).collect();
        let ends: Vec<u32> = (0..=self.nodes.len() as u32).collect();
        let pattern = Pattern::new(&ends, lists.iter().map(Vec::as_slice));
        Arc::new(pattern.expect("numbers ascend and each list holds some of them"))
    }

    /// Error for a matrix over these nodes that is not positive.
    pub fn singular(&self, grid: &Grid, soft: &NotPositive) -> StokesError {
        let direction = soft.direction.iter().zip(&self.nodes);
        let most = direction.max_by(|(a, _), (b, _)| a.abs().total_cmp(&b.abs()));
        StokesError::Singular { at: most.map(|(_, node)| grid.places[*node]).unwrap_or_default() }
    }
}

pub(super) fn add(sum: &mut Symmetric, unknowns: &[Option<u32>], matrix: &[f64]) {
    sum.add(unknowns, matrix).expect("the pattern has the places of every cell");
}
