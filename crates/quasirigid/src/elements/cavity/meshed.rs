use nalgebra::Matrix3;

use super::liquid::Liquid;
use super::shape::Extent;
use crate::elements::finite::stokes::{StokesError, StokesFlow};
use crate::math::mesh::Mesh;
use crate::math::sym::{add, cross, scale};

/// Flows of finite elements in a cavity of any shape.
pub(super) struct MeshedFlow {
    flow: StokesFlow,
}

const AXES: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

impl MeshedFlow {
    /// The flows in a mesh of tetrahedra.
    pub fn new(mesh: &Mesh) -> Result<Self, StokesError> {
        Ok(Self { flow: StokesFlow::new(mesh)? })
    }

    /// What the mesh fills.
    pub fn extent(&self) -> Extent {
        let second = self.flow.second_moments();
        Extent {
            volume: self.flow.volume(),
            center: self.flow.center().into(),
            second: Matrix3::from_fn(|row, column| second[row][column]),
        }
    }

    /// Estimate of the error of the slow answers about each axis, relative to what they are.
    pub fn errors(&self) -> Result<[f64; 3], StokesError> {
        let loads = [0, 1, 2].map(|axis| self.load(axis));
        let flows = self.flow.solve(&loads)?;
        let share = |axis: usize| {
            let answer: f64 = loads[axis].iter().zip(&flows[axis]).map(|(load, u)| load * u).sum();
            self.flow.error_energy(&flows[axis]) / answer
        };
        Ok([0, 1, 2].map(share))
    }
}

impl Liquid for MeshedFlow {
    fn load(&self, axis: usize) -> Vec<f64> {
        let center = scale(-1.0, self.flow.center());
        self.flow.load(|place| cross(AXES[axis], add(place, center)))
    }

    fn flows(&self, loads: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
        self.flow.solve(loads).ok()
    }

    fn friction(&self, u: &[f64]) -> Vec<f64> {
        self.flow.stiffness_times(u)
    }

    fn mass(&self, u: &[f64]) -> Vec<f64> {
        self.flow.mass_times(u)
    }

    fn turned(&self, axis: usize, u: &[f64]) -> Vec<f64> {
        self.flow.turned(AXES[axis], u)
    }
}
