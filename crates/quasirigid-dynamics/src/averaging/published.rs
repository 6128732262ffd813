//! Published estimates of damping times of wobbling small bodies, for comparison. (A11)

use std::f64::consts::PI;

/// Homogeneous solid body with the same loss at every frequency, as estimates of damping times assume.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmallBody {
    /// Mass (kg).
    pub mass: f64,
    /// Density (kg/m³).
    pub density: f64,
    /// Shear modulus `μ` (Pa).
    pub shear: f64,
    /// Quality factor `Q`.
    pub quality: f64,
}

/// Published estimate of the time in which a wobble is damped, `τ = D₀ μQ/ρR²Ω³`. (A11)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DampingEstimate {
    /// Authors and year.
    pub source: &'static str,
    /// Least and greatest `D₀ = 1/K₃²`.
    pub factors: [f64; 2],
}

/// The estimates that studies of small bodies quote: Burns and Safronov (1973), MNRAS 165, 403, from elongated to nearly spherical
/// bodies, and Harris (1994), Icarus 107, 209.
pub const DAMPING_ESTIMATES: [DampingEstimate; 2] = [
    DampingEstimate { source: "Harris 1994", factors: [1.0 / 0.03; 2] },
    DampingEstimate { source: "Burns and Safronov 1973", factors: [1.0 / 0.1, 1.0 / 0.01] },
];

/// Radius (m) of a homogeneous ball of a mass (kg) and a density (kg/m³).
#[must_use]
pub fn ball_radius(mass: f64, density: f64) -> f64 {
    (0.75 * mass / (PI * density)).cbrt()
}

/// Newton's constant (m³/(kg·s²)).
const GRAVITATION: f64 = 6.6743e-11;

/// Spin (rad/s) at which loose material leaves the equator of a ball of this density (kg/m³), `√(4πGρ/3)`: 2.3 h at 2000 kg/m³, and faster
/// than asteroids above some 200 m spin `[@pravec2000]`. (A13)
#[must_use]
pub fn spin_barrier(density: f64) -> f64 {
    (4.0 / 3.0 * PI * GRAVITATION * density).sqrt()
}

impl SmallBody {
    /// Radius (m) of the ball of the same volume.
    #[must_use]
    pub fn radius(&self) -> f64 {
        ball_radius(self.mass, self.density)
    }

    /// `μQ/ρR²Ω³` (s) at a spin (rad/s): the unit of the estimates. (A11)
    #[must_use]
    pub fn damping_unit(&self, spin: f64) -> f64 {
        self.shear * self.quality / (self.density * self.radius().powi(2) * spin.powi(3))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The period at the barrier is `3.3 h/√ρ` with the density in g/cm³.
    #[test]
    fn the_spin_barrier_is_that_of_asteroids() {
        let hours = |density: f64| 2.0 * PI / spin_barrier(density) / 3600.0;
        assert!((hours(1000.0) - 3.3).abs() < 0.01 && (hours(4000.0) - 1.65).abs() < 0.005);
    }

    /// Harris's own form of his estimate: a period of 17 h is damped in 1 Gyr at a diameter of 1 km, for the constants he takes,
    /// `μQ = 5e11 Pa` and 2000 kg/m³; the time goes with `P³/D²`.
    #[test]
    fn harris_in_his_own_units() {
        let [harris, burns] = DAMPING_ESTIMATES;
        // K₃² from 0.1 for elongated bodies to 0.01 for nearly spherical ones; 0.03 by Harris.
        assert!([0, 1].iter().all(|i| (harris.factors[*i] * 0.03 - 1.0).abs() < 1e-15));
        assert!(
            [(0, 0.1), (1, 0.01)].iter().all(|(i, shape)| (burns.factors[*i] * shape - 1.0).abs() < 1e-15)
        );
        for (diameter, period) in [(1.0, 17.0), (0.3, 5.0), (4.0, 170.0)] {
            let radius = 500.0 * diameter;
            let body = SmallBody {
                mass: 4.0 / 3.0 * PI * f64::powi(radius, 3) * 2000.0,
                density: 2000.0,
                shear: 5e9,
                quality: 100.0,
            };
            let found = harris.factors[0] * body.damping_unit(2.0 * PI / (3600.0 * period));
            let own: f64 = f64::powi(period / 17.0, 3) / f64::powi(diameter, 2) * 31_557_600e9;
            assert!((found / own - 1.0).abs() < 0.03, "{found:e} {own:e}");
        }
    }
}
