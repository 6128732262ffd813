use super::Orbit;

/// A magnetic field, inertial axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MagneticField {
    /// The same everywhere (T).
    Uniform([f64; 3]),
    /// Of a dipole at the centre of an orbit: `B = (3(m·n)n − m)/r³`, `n` from the centre to the body.
    Dipole {
        /// `μ₀/4π` times the dipole moment (T·m³), inertial axes.
        strength: [f64; 3],
        /// The orbit on which the body passes through the field.
        orbit: Orbit,
    },
}
