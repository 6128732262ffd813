//! A start that wobbles.

use crate::averaging::{FreeRotation, FreeRotationError};
use crate::dynamics::Start;
use crate::math::rotation::ALIGNED;
use crate::model::{Mode, Principal, ReducedBody};

impl Start {
    /// The start with the angular momentum of a rigid wobble: of the frozen body, at the `nutation` (rad), the largest angle between
    /// angular momentum and circled axis, and the size that the steady spin about that axis has at the `rate` (rad/s). Body axes
    /// and inertial ones coincide.
    ///
    /// The spin is `Ω(K)` of the reduced equations, whose validity it does not judge. (A1), (R11)
    ///
    /// # Errors
    /// [`FreeRotationError`] if the body has no such wobble.
    pub fn wobbling(
        reduced: &ReducedBody,
        mode: Mode,
        nutation: f64,
        rate: f64,
    ) -> Result<Self, FreeRotationError> {
        let principal = Principal::compute(reduced.J);
        let size = rate * principal.moments[mode.circled()];
        let motion = FreeRotation::at_nutation(principal.moments, size, mode, nutation)?;
        let rigid = motion.omega(0.0);
        let K = principal.vector([0, 1, 2].map(|i| principal.moments[i] * rigid[i]));
        Ok(Self::new(reduced.Omega.vector(K), ALIGNED))
    }
}
