use super::Orbit;
use crate::math::scalar::Smooth;
use crate::math::vec3::{add, dot, scale};

/// Magnetic field, inertial axes. (F8)
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MagneticField {
    /// Uniform field (T).
    Uniform([f64; 3]),
    /// Field of a dipole at the centre of an orbit: `B = (3(m·n)n − m)/r³`, `n` from the centre to the body.
    Dipole {
        /// `μ₀/4π` times the dipole moment (T·m³), inertial axes.
        strength: [f64; 3],
        /// Orbit of the body through the field.
        orbit: Orbit,
    },
}

impl MagneticField {
    /// Field (T, inertial axes) at the place of the body at a time (s).
    #[must_use]
    pub fn at<T: Smooth>(&self, t: T) -> [T; 3] {
        match self {
            Self::Uniform(field) => field.map(T::from),
            Self::Dipole { strength, orbit } => {
                let passage = orbit.at(t);
                let per_radius = T::from(1.0) / passage.radius;
                let n = scale(per_radius, passage.place);
                let m = strength.map(T::from);
                let shape = add(scale(T::from(3.0) * dot(m, n), n), m.map(|entry| -entry));
                scale(per_radius * per_radius * per_radius, shape)
            }
        }
    }
}
