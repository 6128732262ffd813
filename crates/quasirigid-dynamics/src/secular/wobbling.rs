//! Start with a given wobble.

use crate::averaging::{FreeRotation, FreeRotationError};
use crate::dynamics::Start;
use crate::math::rotation::ALIGNED;
use crate::model::{Mode, Principal, ReducedBody};

impl Start {
    /// Start with the angular momentum of a wobble of the frozen body: `nutation` (rad) is the largest angle between angular momentum and
    /// circled axis, `rate` (rad/s) that of the steady spin about the axis with the same `|K|`. Body axes and inertial ones coincide.
    ///
    /// The angular velocity is `Ω(K)` of the reduced equations, whose validity is not judged here. (A1), (R11)
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
        Ok(Self::new(reduced.angular_velocity(K), ALIGNED))
    }
}
