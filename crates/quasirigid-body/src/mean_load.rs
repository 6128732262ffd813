//! Displacements under the mean centrifugal load of a rotation that may wobble: those about which the body vibrates.
//! Equation (G17), docs/theory/11-materials.md.

use super::{FlexibleBody, MotionState, Principal};
use crate::math::sym3::Sym;
use crate::math::vec3::scale;

/// Iterations of the stiffness that the spin softens.
const MOST_ITERATIONS: usize = 100;
/// Relative change of the displacements that is rounding.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// Relative change that no further iteration makes smaller, and that is accepted.
const STALLED: f64 = 1e-12;

impl FlexibleBody {
    /// Displacements `q` (in the units of the coordinates) at which springs balance the mean centrifugal load of a rotation,
    /// `C q = ½ ⟨ωᵀ(∂J/∂q)ω⟩`, from the mean products `⟨ωωᵀ⟩` (rad²/s², body axes). (G17)
    ///
    /// Those of a steady spin `ω` for the products `ωωᵀ`. None where the spin softens the body so far that they are not found.
    #[must_use]
    pub fn displaced_by(&self, products: Sym) -> Option<Vec<f64>> {
        let Principal { moments, axes } = Principal::compute(products);
        let spins = [0, 1, 2].map(|i| scale(moments[i].max(0.0).sqrt(), axes[i]));
        let still = vec![0.0; self.coordinates().len()];
        let (mut q, mut last) = (still.clone(), f64::INFINITY);
        for _ in 0..MOST_ITERATIONS {
            let mut next = still.clone();
            for omega in spins {
                let load = self.load(MotionState { omega, q: &q, rate: &still });
                next.iter_mut().zip(load).for_each(|(sum, load)| *sum += load);
            }
            self.solve_stiffness(&mut next, 1);
            let size = next.iter().fold(0.0, |size: f64, q| size.max(q.abs()));
            let change = next.iter().zip(&q).fold(0.0, |most: f64, (new, old)| most.max((new - old).abs()));
            q = next;
            if !size.is_finite() {
                return None;
            }
            if change <= ROUNDING * size || (change >= last && change <= STALLED * size) {
                return Some(q);
            }
            last = change;
        }
        None
    }
}
