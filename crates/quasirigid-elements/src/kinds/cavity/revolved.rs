use super::liquid::Liquid;
use crate::flow::Velocity;
use crate::flow::revolution::{Fineness, Outline, RevolvedFlow};
use crate::flow::stokes::StokesError;
use crate::math::krylov::dot;

/// Flows in a cavity of revolution, of high degree.
pub(super) struct MeridianFlow {
    flow: RevolvedFlow,
    /// The axis of revolution.
    axis: usize,
    /// Loads about each axis of the cavity.
    loads: [Vec<f64>; 3],
    /// Responses to the loads.
    slow: Vec<Vec<f64>>,
}

impl MeridianFlow {
    /// Flows in a cavity of revolution, of a given fineness.
    pub fn new(outline: &Outline, axis: usize, fineness: Fineness) -> Result<Self, StokesError> {
        let flow = RevolvedFlow::new(outline, fineness)?;
        let mut own = Self { flow, axis, loads: Default::default(), slow: Vec::new() };
        own.loads = [0, 1, 2].map(|axis| own.flow.load(own.own(axis)));
        own.slow = own.flow.solve(&own.loads, 0.0)?;
        Ok(own)
    }

    /// Slow response about each axis, `∫|∇u|² dV`.
    pub fn answers(&self) -> [f64; 3] {
        [0, 1, 2].map(|axis| dot(&self.loads[axis], &self.slow[axis]))
    }

    /// Number of an axis where that of revolution is the last.
    fn own(&self, axis: usize) -> usize {
        (axis + 2 - self.axis) % 3
    }
}

impl Liquid for MeridianFlow {
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
        self.flow.turned(self.own(axis), u)
    }

    fn sample(&self, flows: &[Vec<f64>], visit: &mut dyn FnMut(f64, &[Velocity])) {
        self.flow.sample(flows, visit);
    }
}
