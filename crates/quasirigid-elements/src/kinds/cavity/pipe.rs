//! Viscous flow along a slender ring: polynomials of the distance from the middle of the tube.
//! A slender ring is a straight pipe without a gradient of pressure; across its axis its flow is left out.
//! Equation (L9), docs/theory/13-inside.md.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector};

use super::liquid::Liquid;

/// Flow along a slender ring, `u = R (1 − s²) s^{2k}` with the distance `s` from the middle of the tube in its radii: the flow in a
/// straight pipe without a gradient of pressure. (L9)
pub(super) struct PipeFlow {
    mass: DMatrix<f64>,
    friction: DMatrix<f64>,
    load: DVector<f64>,
}

impl PipeFlow {
    /// Profiles in a ring of this radius with a tube of that radius (m): one holds the slow response, each step of a chain needs one more.
    /// None if they are linearly dependent up to rounding.
    pub fn new(radius: f64, tube_radius: f64, profiles: usize) -> Option<Self> {
        let length = 2.0 * PI * radius;
        let area = PI * tube_radius * tube_radius;
        // With x = s² the mean over the tube is ∫dx: of xᵏ it is 1/(k+1).
        let mean = |power: usize| 1.0 / (power as f64 + 1.0);
        let squares = |j: usize, k: usize| mean(j + k) - 2.0 * mean(j + k + 1) + mean(j + k + 2);
        // d/ds of sᵐ is m s^{m−1}; the mean of s^{m+n−2} is 2/(m+n).
        let slopes = |j: usize, k: usize| {
            let pair =
                |m: usize, n: usize| if m * n > 0 { 2.0 * (m * n) as f64 / (m + n) as f64 } else { 0.0 };
            let (m, n) = (2 * j, 2 * k);
            pair(m, n) - pair(m + 2, n) - pair(m, n + 2) + pair(m + 2, n + 2)
        };
        let whole = length * area * radius * radius;
        let mass = DMatrix::from_fn(profiles, profiles, |j, k| whole * squares(j, k));
        let friction =
            DMatrix::from_fn(profiles, profiles, |j, k| whole / (tube_radius * tube_radius) * slopes(j, k));
        let load = DVector::from_fn(profiles, |k, _| whole * (mean(k) - mean(k + 1)));
        Some(Self { mass, friction, load })
    }
}

impl Liquid for PipeFlow {
    fn load(&self, axis: usize) -> Vec<f64> {
        let along = if axis == 2 { 1.0 } else { 0.0 };
        (along * &self.load).as_slice().to_vec()
    }

    fn flows(&self, loads: &[Vec<f64>], rate: f64) -> Option<Vec<Vec<f64>>> {
        let factor = (&self.friction + rate * &self.mass).cholesky()?;
        let solved = |load: &Vec<f64>| factor.solve(&DVector::from_column_slice(load));
        Some(loads.iter().map(|load| solved(load).as_slice().to_vec()).collect())
    }

    fn friction(&self, u: &[f64]) -> Vec<f64> {
        (&self.friction * DVector::from_column_slice(u)).as_slice().to_vec()
    }

    fn mass(&self, u: &[f64]) -> Vec<f64> {
        (&self.mass * DVector::from_column_slice(u)).as_slice().to_vec()
    }

    fn turned(&self, _: usize, u: &[f64]) -> Vec<f64> {
        vec![0.0; u.len()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinds::cavity::liquid::{Memory, Relaxations};

    /// `P = π²R³a⁴/4` of Poiseuille's profile.
    #[test]
    fn a_ring_is_a_pipe() {
        let (radius, tube) = (0.7, 0.02);
        let flow = PipeFlow::new(radius, tube, 2).unwrap();
        let found = Relaxations::of(&flow, Memory { depth: 2, modes: 0 }, 1.0).unwrap();
        let P = found.slow_tensor();
        let exact = PI * PI * f64::powi(radius, 3) * f64::powi(tube, 4) / 4.0;
        assert!((P[(2, 2)] / exact - 1.0).abs() < 1e-12);
        assert_eq!((P[(0, 0)], P[(1, 2)]), (0.0, 0.0));
    }

    /// Relaxations at the zeros of `J₀`.
    #[test]
    fn relaxations_of_a_ring_are_those_of_a_pipe() {
        let (radius, tube) = (0.7, 0.02);
        let flow = PipeFlow::new(radius, tube, 9).unwrap();
        let root = flow.friction.clone().cholesky().unwrap().l().try_inverse().unwrap();
        let times = (&root * &flow.mass * root.transpose()).symmetric_eigenvalues();
        for zero in [2.404_825_557_695_773_f64, 5.520_078_110_286_311] {
            let found = times.iter().filter(|time| (*time * (zero / tube).powi(2) - 1.0).abs() < 1e-9);
            assert_eq!(found.count(), 1, "{zero}");
        }
    }
}
