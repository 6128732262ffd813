use super::divergence::Divergence;
use crate::flow::incompressible::Incompressible;
use crate::math::factor::Factor;

/// Equations of the flow. (L4)
///
/// With walls that fix all three components, `A` is the same scalar operator for each of them.
pub(super) struct Saddle<'a> {
    /// Factor of `∫ ∇N_a·∇N_b dV` over the nodes that move, with inertia if the flow has any.
    pub laplacian: &'a Factor,
    pub divergence: &'a Divergence,
    /// Factor of the pressure's mass matrix, which `B A⁻¹ Bᵀ` is close to.
    pub pressure: &'a Factor,
    /// Rate of inertia, and the factor of the pressure's Laplacian, which `B A⁻¹ Bᵀ` is close to where inertia dominates `[@cahouet1988]`.
    pub inertia: Option<(f64, &'a Factor)>,
}

impl Incompressible for Saddle<'_> {
    fn flow(&self, forces: &mut [f64], width: usize) {
        self.laplacian.solve(forces, 3 * width);
    }

    fn divergence(&self, u: &[f64], width: usize) -> Vec<f64> {
        self.divergence.times(u, width)
    }

    fn push(&self, p: &[f64], width: usize) -> Vec<f64> {
        self.divergence.transposed_times(p, width)
    }

    fn weigh(&self, divergence: &mut [f64], width: usize) {
        self.pressure.solve(divergence, width);
    }

    fn pressure(&self, divergence: &[f64], weighted: &[f64], width: usize) -> Vec<f64> {
        let Some((rate, laplacian)) = self.inertia else { return weighted.to_vec() };
        let mut inert = divergence.to_vec();
        laplacian.solve(&mut inert, width);
        weighted.iter().zip(inert).map(|(viscous, inert)| viscous + rate * inert).collect()
    }
}
