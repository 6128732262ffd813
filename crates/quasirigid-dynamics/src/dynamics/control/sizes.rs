//! Sizes of the states of controllers, by which the errors of steps are judged: those that change the motion by its own size.
//! "Errors allowed", docs/theory/20-control.md.

use super::{ControlBlock, Seen};
use crate::dynamics::scale::Scales;
use crate::math::vec3::norm;
use crate::model::control::{Actuator, BodyController, LinearLaw};

impl ControlBlock<'_> {
    /// Size of each number of the block; infinite of what is constant between instants.
    pub fn sizes(&self, seen: &Seen, block: &[f64], scales: &Scales) -> Vec<f64> {
        let mut sizes = vec![f64::INFINITY; self.len()];
        let sensed = self.sensed(seen);
        for (rod, place) in self.controls.rods.iter().zip(self.rods.clone()) {
            sizes[place] = rod.material.coercivity;
        }
        sizes[..self.controls.wheels.len()].fill(scales.angular_momentum);
        let continuous = self.controls.controllers.iter().zip(&self.places);
        for (controller, place) in continuous.filter(|(controller, _)| controller.sampling.is_none()) {
            let inputs = controller.inputs(&self.state(seen, block, sensed), None);
            let Some(law) = controller.law.linearized(&inputs, &block[place.states.clone()]) else {
                continue;
            };
            let torque = scales.angular_momentum * scales.spin;
            let law = in_torques(law, controller, norm(sensed.field.field));
            for (size, weight) in sizes[place.states.clone()].iter_mut().zip(weights(&law, scales.spin)) {
                *size = if weight > 0.0 { torque / weight } else { 1.0 };
            }
        }
        sizes
    }
}

/// Law whose outputs are torques (N·m): those of dipole moments times the field (T).
fn in_torques(mut law: LinearLaw, controller: &BodyController, field: f64) -> LinearLaw {
    for (row, output) in law.C.iter_mut().zip(&controller.outputs) {
        if matches!(output.to, Actuator::Moment { .. }) {
            row.iter_mut().for_each(|gain| *gain *= field);
        }
    }
    law
}

/// Torque (N·m) per unit of each state: its own, or that of the states that it drives within a time `1/rate`; zero of a state that drives
/// nothing.
fn weights(law: &LinearLaw, rate: f64) -> Vec<f64> {
    let n = law.A.len();
    let size = |entry: f64| if entry.is_finite() { entry.abs() } else { 0.0 };
    let column = |rows: &[Vec<f64>], i: usize| rows.iter().map(|row| size(row[i])).fold(0.0, f64::max);
    let mut weights: Vec<f64> = (0..n).map(|i| column(&law.C, i)).collect();
    for _ in 1..n {
        let known = weights.clone();
        for i in (0..n).filter(|i| known[*i] == 0.0) {
            weights[i] = (0..n).map(|j| size(law.A[j][i]) * known[j] / rate).fold(0.0, f64::max);
        }
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A state that drives another one that drives the torque, and one that drives nothing.
    #[test]
    fn states_weigh_by_the_torque_that_they_cause() {
        let A = vec![vec![-9.0, 4.0, 0.0], vec![0.0, -7.0, 0.0], vec![1.0, 1.0, 1.0]];
        let law = LinearLaw { A, C: vec![vec![-0.5, 0.0, 0.0], vec![0.2, 0.0, 0.0]], ..LinearLaw::default() };
        assert_eq!(weights(&law, 0.1), [0.5, 4.0 * 0.5 / 0.1, 0.0]);
    }
}
