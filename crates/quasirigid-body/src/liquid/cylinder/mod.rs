//! Cylinder of liquid that spins about its axis: exact solenoidal fields at every Reynolds number that they resolve. (L20)

mod fields;
mod lines;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod waves;

use nalgebra::Complex;

use super::known::{self, Key};
use fields::fields;

type C = Complex<f64>;

/// Spinning liquid, in units of its radius and viscosity.
#[derive(Clone, Copy, Debug)]
pub(super) struct SpinningCylinder {
    /// Half the height over the radius.
    pub half: f64,
    /// Spin, `τ = Ω a²/ν`: the Reynolds number.
    pub tau: f64,
}

/// Functions of the radius per fourth root of `|σ| + 2τ`, from the thickness of the boundary layer, in addition to the least number;
/// functions of the height likewise, times `√h`.
const PER_LAYER: f64 = 1.3;
const MIN_FUNCTIONS: f64 = 5.0;
/// Step of the numbers of functions, and their limit, at which a response takes a second.
const FUNCTIONS_STEP: usize = 4;
const MAX_FUNCTIONS: usize = 44;

impl SpinningCylinder {
    /// Force per rate, per `I ν/a²` with the frozen inertia `I` about the axis of the motion, for a motion `e^{imφ}` about the spin at
    /// the frequency `σ = s a²/ν` in the body. NaN where the fields have no finite solution. (L20)
    ///
    /// `m` is 0 about the spin and 1 for `(1, i, 0)`.
    pub fn drag(self, m: usize, sigma: C) -> C {
        let size = (sigma.norm() + 2.0 * self.tau).sqrt().sqrt();
        let counted =
            |number: f64| ((number.ceil() as usize).next_multiple_of(FUNCTIONS_STEP)).min(MAX_FUNCTIONS);
        let numbers =
            [1.0, self.half.sqrt().max(0.5)].map(|long| counted(MIN_FUNCTIONS + PER_LAYER * size * long));
        let key = Key { m, numbers, shape: (true, self.half.to_bits()) };
        known::drag(key, || fields(m, self.half, numbers), sigma, self.tau)
    }
}
