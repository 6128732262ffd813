use std::f64::consts::PI;

/// Magnetic constant `μ₀` (N/A²), CODATA 2018.
pub(crate) const MAGNETIC_CONSTANT: f64 = 1.256_637_062_12e-6;

/// Solid of one metal whose eddy currents have a closed form. (F16)
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Conductor {
    /// Solid sphere.
    Sphere {
        /// Conductivity (S/m).
        conductivity: f64,
        /// Radius (m).
        radius: f64,
    },
    /// Spherical shell.
    Shell {
        /// Conductivity (S/m).
        conductivity: f64,
        /// Outer radius (m).
        radius: f64,
        /// Thickness (m), at most the radius.
        thickness: f64,
    },
}

impl Conductor {
    /// Magnetic tensor (S·m⁴), the same about every axis: `(2π/15) σ (b⁵ − a⁵)` between the radii `a` and `b`, with the field of the
    /// currents themselves left out. (F16)
    #[must_use]
    pub fn magnetic_tensor(&self) -> f64 {
        let (conductivity, outer, inner) = match *self {
            Self::Sphere { conductivity, radius } => (conductivity, radius, 0.0),
            Self::Shell { conductivity, radius, thickness } => (conductivity, radius, radius - thickness),
        };
        2.0 * PI / 15.0 * conductivity * fifth_powers(outer, inner)
    }

    /// Time `τ` (s) in which the currents decay: at the angular velocity `ω` the field of the currents lowers the torque by about the share
    /// `(ωτ)²`. `μ₀σR²/√105` of a sphere, by the next term of its polarizability; `μ₀σRd/3` of a shell of the thickness `d`. (F16)
    #[must_use]
    pub fn decay_time(&self) -> f64 {
        match *self {
            Self::Sphere { conductivity, radius } => {
                MAGNETIC_CONSTANT * conductivity * radius * radius / 105f64.sqrt()
            }
            Self::Shell { conductivity, radius, thickness } => {
                MAGNETIC_CONSTANT * conductivity * radius * thickness / 3.0
            }
        }
    }
}

/// `b⁵ − a⁵` without the loss of digits in a thin shell.
fn fifth_powers(b: f64, a: f64) -> f64 {
    (b - a) * [4, 3, 2, 1, 0].map(|power| b.powi(power) * a.powi(4 - power)).iter().sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers by hand: copper of 10 cm, and Larets' shell of brass.
    #[test]
    fn tensors_are_those_of_spheres_and_shells() {
        let near =
            |found: f64, known: f64| assert!((found / known - 1.0).abs() < 1e-6, "{found:e} {known:e}");
        let sphere = Conductor::Sphere { conductivity: 5.8e7, radius: 0.1 };
        near(sphere.magnetic_tensor(), 242.949_831);
        let shell = Conductor::Shell { conductivity: 5.8e7, radius: 0.1, thickness: 0.1 };
        near(shell.magnetic_tensor(), sphere.magnetic_tensor());
        let thin = Conductor::Shell { conductivity: 1e7, radius: 0.3, thickness: 1e-9 };
        near(thin.magnetic_tensor(), 2.0 * PI / 3.0 * 1e7 * 0.3f64.powi(4) * 1e-9);
    }

    /// The share that `decay_time` promises beside the exact polarizability of a sphere, `1 − 3/x² + 3 cot(x)/x` with `x² = iμ₀σωR²`,
    /// summed as a series.
    #[test]
    fn currents_of_a_fast_sphere_lower_its_torque_by_the_share_of_the_decay_time() {
        let sphere = Conductor::Sphere { conductivity: 1e7, radius: 0.2 };
        let omega = 0.1 / sphere.decay_time();
        let y = MAGNETIC_CONSTANT * 1e7 * omega * 0.04;
        // Imaginary parts of −x²/15 − 2x⁴/315 − x⁶/1575 for x² = iy.
        let share = 1.0 - (y / 15.0 - y.powi(3) / 1575.0) / (y / 15.0);
        assert!((share / 0.01 - 1.0).abs() < 1e-9, "{share}");
    }
}
