//! Ball or spheroid of liquid that spins about its axis: exact solenoidal fields at every Reynolds number that they resolve, beyond it
//! the boundary layer scaled to them. (L16), (L17)

mod fields;
mod radial;
mod spinning_boundary_layer;
#[cfg(test)]
mod tests;

use nalgebra::Complex;

use fields::fields;

use super::known::{self, Key};

type C = Complex<f64>;

/// Spinning liquid, in units of the radius of its equator and its viscosity.
#[derive(Clone, Copy, Debug)]
pub(super) struct SpinningSpheroid {
    /// Square of the ratio of the semi-axes along the spin and across it.
    pub stretch: f64,
    /// Spin, `τ = Ω a²/ν`: the Reynolds number.
    pub tau: f64,
}

/// Radial functions per fourth root of `|σ| + 2τ`, from the thickness of the boundary layer, in addition to the least number.
const PER_LAYER: f64 = 1.4;
/// Degrees per fourth root of `τ`, in addition to the least number.
const PER_SPIN: f64 = 1.1;
/// Least number of functions and of degrees.
const MIN_FUNCTIONS: f64 = 4.0;
/// Step of the numbers of functions and of degrees, so that fields are reused.
const STEP: usize = 4;

impl SpinningSpheroid {
    /// `|σ| + 2τ` up to which fields are computed, in some tenths of a second; beyond, the ratio to the boundary layer is that of the
    /// same motion at this value.
    fn resolved(&self) -> f64 {
        if self.stretch == 1.0 { 4e6 } else { 4e5 }
    }

    /// Force per rate, per `I ν/a²` with the load of the flow squared in place of `I`, of a motion `e^{imφ}` about the spin at the
    /// frequency `σ = s a²/ν` in the body. NaN where the fields have no finite solution. (L16)
    ///
    /// `m` is 0 about the spin and 1 for `(1, i, 0)`.
    pub fn drag(self, m: usize, sigma: C) -> C {
        let size = sigma.norm() + 2.0 * self.tau;
        if size <= self.resolved() {
            return self.exact(m, sigma);
        }
        let share = self.resolved() / size;
        let near = Self { tau: share * self.tau, ..self };
        let [inviscid, layer] = spinning_boundary_layer::drag(self, m, sigma);
        let [inviscid_near, layer_near] = spinning_boundary_layer::drag(near, m, share * sigma);
        inviscid + layer * (near.exact(m, share * sigma) - inviscid_near) / layer_near
    }

    fn exact(self, m: usize, sigma: C) -> C {
        let size = sigma.norm() + 2.0 * self.tau;
        let counted = |number: f64| (number.ceil() as usize).next_multiple_of(STEP);
        let count = counted(MIN_FUNCTIONS + PER_LAYER * size.sqrt().sqrt());
        let degrees = counted(MIN_FUNCTIONS + PER_SPIN * self.tau.sqrt().sqrt());
        let key = Key { m, numbers: [degrees, count], shape: (false, self.stretch.to_bits()) };
        known::drag(key, || fields(m, degrees, count, self.stretch), sigma, self.tau)
    }
}
