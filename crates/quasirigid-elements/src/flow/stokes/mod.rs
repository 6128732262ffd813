//! Slow viscous flow of a liquid that fills a closed cavity: quadratic velocity, linear continuous pressure
//! `[@taylor1973]`.
//!
//! The walls fix the liquid in all three components, so that the Laplacian is the same for each component of the velocity: one factor of it
//! serves all, and the pressure follows by conjugate gradients.

mod assembly;
mod cell;
mod divergence;
mod error;
mod grid;
mod moments;
mod potential;
mod recovery;
mod saddle;
#[cfg(test)]
mod tests;

pub use error::StokesError;
pub(crate) use moments::Moments;
pub(crate) use potential::slip;

use self::assembly::Assembly;
use self::cell::{NODES, points};
use self::grid::Grid;
use super::Velocity;
use crate::math::vec3::{add, cross, scale};
use quasirigid_mesh::Mesh;

/// A cavity full of liquid, discretised.
///
/// Velocities `u` and the loads on them are lists with the three components of each node that moves, one node after
/// another. The number `ψ` of a component stands for its shape function below.
pub(crate) struct StokesFlow {
    grid: Grid,
    assembly: Assembly,
    moments: Moments,
}

impl StokesFlow {
    /// The cavity that the tetrahedra of a mesh fill, of 4 or 10 nodes; other nodes, faces and lines do not count.
    ///
    /// Walls are the faces of one cell only. Cells of 10 nodes are curved as their edges are; those of 4 get nodes in
    /// the middles of their edges.
    ///
    /// # Errors
    /// [`StokesError`] if the tetrahedra are no single cavity in which liquid can flow.
    pub fn new(mesh: &Mesh) -> Result<Self, StokesError> {
        let grid = Grid::new(mesh)?;
        let moments = Moments::of(&grid);
        if !moments.in_range() {
            return Err(StokesError::OutOfRange { volume: moments.volume });
        }
        Ok(Self { assembly: Assembly::new(&grid)?, grid, moments })
    }

    /// Number of components of the velocity: three for each node that is not on a wall.
    pub fn unknowns(&self) -> usize {
        3 * self.assembly.mass.size()
    }

    /// Volume and moments of the mesh.
    pub fn moments(&self) -> &Moments {
        &self.moments
    }

    /// `∫ ψ·f dV` of a field by place; exact for polynomials of degree 2 where edges are straight.
    pub fn load(&self, field: &dyn Fn([f64; 3]) -> [f64; 3]) -> Vec<f64> {
        let mut load = vec![0.0; self.unknowns()];
        for cell in &self.grid.cells {
            for point in points(&cell.map(|node| self.grid.places[node])) {
                let value = scale(point.volume, field(point.place));
                for (node, share) in cell.iter().zip(point.functions) {
                    if let Some(unknown) = self.assembly.unknowns[*node] {
                        let own = &mut load[3 * unknown as usize..][..3];
                        own.iter_mut().zip(value).for_each(|(sum, value)| *sum += share * value);
                    }
                }
            }
        }
        load
    }

    /// Flows under loads: each is that of least `½∫|∇u|² + rate |u|² dV − load·u` among those without discrete divergence, with a rate of
    /// inertia in 1/m². (L4)
    ///
    /// # Errors
    /// [`StokesError::NoConvergence`] if cells are so thin that the pressure is not found.
    pub fn solve(&self, loads: &[Vec<f64>], rate: f64) -> Result<Vec<Vec<f64>>, StokesError> {
        let width = loads.len();
        if width == 0 {
            return Ok(Vec::new());
        }
        let rows = 0..self.unknowns();
        let mut flows: Vec<f64> = rows.flat_map(|row| loads.iter().map(move |load| load[row])).collect();
        self.assembly.solve(&mut flows, width, rate)?;
        Ok((0..width).map(|flow| flows.iter().skip(flow).step_by(width).copied().collect()).collect())
    }

    /// `∫ ∇ψ:∇u dV`.
    pub fn stiffness_times(&self, u: &[f64]) -> Vec<f64> {
        self.assembly.stiffness.times_block(u, 3)
    }

    /// `∫ ψ·u dV`.
    pub fn mass_times(&self, u: &[f64]) -> Vec<f64> {
        self.assembly.mass.times_block(u, 3)
    }

    /// `∫ ψ·(axis × u) dV`.
    pub fn turned(&self, axis: [f64; 3], u: &[f64]) -> Vec<f64> {
        let turned = u.as_chunks().0.iter().flat_map(|u| cross(axis, *u));
        self.mass_times(&turned.collect::<Vec<_>>())
    }

    /// Visits quadrature points, with the share of the volume and the velocity of each flow.
    pub fn sample(&self, flows: &[Vec<f64>], visit: &mut dyn FnMut(f64, &[Velocity])) {
        let at = |u: &Vec<f64>, node: usize| match self.assembly.unknowns[node] {
            Some(unknown) => [0, 1, 2].map(|axis| u[3 * unknown as usize + axis]),
            None => [0.0; 3],
        };
        for cell in &self.grid.cells {
            let fields: Vec<[[f64; 3]; NODES]> = flows.iter().map(|u| cell.map(|node| at(u, node))).collect();
            for point in points(&cell.map(|node| self.grid.places[node])) {
                let velocity = |field: &[[f64; 3]; NODES]| {
                    let shares = field.iter().zip(point.functions);
                    let u = shares.fold([0.0; 3], |sum, (value, share)| add(sum, scale(share, *value)));
                    Velocity { u, gradient: point.gradient(field) }
                };
                visit(point.volume, &fields.iter().map(velocity).collect::<Vec<_>>());
            }
        }
    }

    /// Discrete divergence relative to the gradient, in the mean square; zero where nothing flows.
    #[cfg(test)]
    pub fn divergence(&self, u: &[f64]) -> f64 {
        let gradient = u.iter().zip(self.stiffness_times(u)).map(|(u, force)| u * force).sum::<f64>().sqrt();
        if gradient > 0.0 { self.assembly.divergence_of(u) / gradient } else { 0.0 }
    }

    /// Estimate of `∫ |∇(v − u)|² dV`, where `v` is the exact flow in this cavity and `u` the one found.
    ///
    /// The work `load·u` is off by an amount of this size too, but of either sign, for `u` has a divergence between the nodes. The volume
    /// that cells miss at a round wall comes on top.
    pub fn error_energy(&self, u: &[f64]) -> f64 {
        recovery::error_energy(&self.grid, |node| match self.assembly.unknowns[node] {
            Some(unknown) => [0, 1, 2].map(|axis| u[3 * unknown as usize + axis]),
            None => [0.0; 3],
        })
    }
}
