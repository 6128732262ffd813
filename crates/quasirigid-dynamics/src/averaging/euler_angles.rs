use super::poinsot::{FreeRotation, FreeRotationError};
use crate::math::vec3::norm;

/// Euler angles 3-1-3 of the principal axes (intermediate, short, long) against axes whose third is the angular momentum. (A9)
///
/// `φ` turns the long axis about the angular momentum, `θ` is the angle between them, `ψ` turns the body about the long axis: the angles
/// that radar and photometry of small bodies report.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EulerAngles {
    /// Precession `φ` (rad).
    pub precession: f64,
    /// Nutation `θ` (rad), from 0 to π.
    pub nutation: f64,
    /// Rotation `ψ` (rad).
    pub rotation: f64,
}

impl EulerAngles {
    /// The angles of a motion at a time (s).
    #[must_use]
    pub fn from_motion(motion: &FreeRotation, t: f64) -> Self {
        let [first, second, vertical] = motion.attitude(t);
        let [along, intermediate, short] = vertical;
        Self {
            precession: first[0].atan2(-second[0]),
            nutation: norm([intermediate, short, 0.0]).atan2(along),
            rotation: intermediate.atan2(short),
        }
    }

    /// The motion that passes through these angles with the angular momentum `G` (N·m·s), of a body with these principal
    /// moments (kg·m²), ascending.
    ///
    /// # Errors
    /// [`FreeRotationError`], as of [`FreeRotation::through`].
    pub fn motion(&self, moments: [f64; 3], G: f64) -> Result<FreeRotation, FreeRotationError> {
        let [sine, cosine] = [self.nutation.sin(), self.nutation.cos()];
        let K = [cosine, sine * self.rotation.sin(), sine * self.rotation.cos()];
        FreeRotation::through(moments, [0, 1, 2].map(|i| G * K[i] / moments[i]))
    }
}
