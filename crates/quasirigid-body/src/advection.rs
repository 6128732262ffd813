use std::ops::Range;

use crate::math::scalar::Scalar;

/// Advection of a liquid: load of `ρ u·∇u` on the coordinates of the liquid, with the velocity `u` relative to the body. (L21)
///
/// Given by the terms of a few flows; each coordinate has a share of each flow. Advection takes no power.
#[derive(Clone, Debug, PartialEq)]
pub struct Advection {
    /// Coordinates of the liquid.
    pub coordinates: Range<usize>,
    /// Share of each flow in each coordinate: a row for each flow.
    pub shares: Vec<Vec<f64>>,
    /// `ρ∫u_a·(u_b·∇)u_c dV` (kg·m²) of three flows `[a, b, c]`, mean of both orders of the last two; nonzero terms only.
    pub terms: Vec<([usize; 3], f64)>,
}

impl Advection {
    /// Adds the load `−ρ∫u_j·(u·∇)u dV` at the rates of all coordinates to the loads on all coordinates.
    pub fn add_load<T: Scalar>(&self, rates: &[T], loads: &mut [T]) {
        let zero = T::from(0.0);
        let sum = |row: &Vec<f64>| {
            let own = row.iter().zip(&rates[self.coordinates.clone()]);
            own.fold(zero, |sum, (share, rate)| sum + T::from(*share) * *rate)
        };
        let flows: Vec<T> = self.shares.iter().map(sum).collect();
        let mut forces = vec![zero; flows.len()];
        for ([a, b, c], term) in &self.terms {
            forces[*a] = forces[*a] - T::from(*term) * flows[*b] * flows[*c];
        }
        for (row, force) in self.shares.iter().zip(forces) {
            for (load, share) in loads[self.coordinates.clone()].iter_mut().zip(row) {
                *load = *load + T::from(*share) * force;
            }
        }
    }

    /// Advection with its coordinates shifted down by `by`.
    #[must_use]
    pub fn moved(&self, by: usize) -> Self {
        let Range { start, end } = self.coordinates;
        Self { coordinates: start - by..end - by, ..self.clone() }
    }
}
