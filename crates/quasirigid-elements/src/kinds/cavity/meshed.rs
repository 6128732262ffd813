use super::liquid::Liquid;
use super::shape::Extent;
use crate::flow::Velocity;
use crate::flow::stokes::{StokesError, StokesFlow};
use crate::math::krylov::dot;
use crate::math::vec3::{add, cross, scale};
use quasirigid_mesh::Mesh;

/// Flows of finite elements in a cavity of any shape.
pub(super) struct MeshedFlow {
    flow: StokesFlow,
    loads: [Vec<f64>; 3],
    /// Responses to the loads.
    slow: Vec<Vec<f64>>,
}

const AXES: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

impl MeshedFlow {
    /// Flows in a mesh of tetrahedra.
    pub fn new(mesh: &Mesh) -> Result<Self, StokesError> {
        let flow = StokesFlow::new(mesh)?;
        let center = scale(-1.0, flow.moments().center);
        let loads = AXES.map(|axis| flow.load(&|place| cross(axis, add(place, center))));
        let slow = flow.solve(&loads, 0.0)?;
        Ok(Self { flow, loads, slow })
    }

    /// Volume and moments of the mesh.
    pub fn extent(&self) -> Extent {
        self.flow.moments().into()
    }

    /// Estimate of the relative error of the slow responses about each axis.
    pub fn errors(&self) -> [f64; 3] {
        [0, 1, 2].map(|axis| {
            let (load, u) = (&self.loads[axis], &self.slow[axis]);
            self.flow.error_energy(u) / dot(load, u)
        })
    }
}

impl Liquid for MeshedFlow {
    fn load(&self, axis: usize) -> Vec<f64> {
        self.loads[axis].clone()
    }

    fn flows(&self, loads: &[Vec<f64>], rate: f64) -> Option<Vec<Vec<f64>>> {
        self.flow.solve(loads, rate).ok()
    }

    fn slow(&self) -> Option<Vec<Vec<f64>>> {
        Some(self.slow.clone())
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

    fn sample(&self, flows: &[Vec<f64>], visit: &mut dyn FnMut(f64, &[Velocity])) {
        self.flow.sample(flows, visit);
    }
}
