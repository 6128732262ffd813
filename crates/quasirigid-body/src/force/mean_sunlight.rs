//! Mean torque of sunlight over the rotation of a body about an axis and over its orbit, the YORP effect, and the lag of the heat that a
//! surface emits. Equations (F30) to (F33), docs/theory/07-forces.md.

use std::f64::consts::TAU;

use super::SunlightLoads;
use crate::math::quadrature::gauss_legendre;
use crate::math::spherical_harmonics::legendre;
use crate::math::vec3::{add, cross, dot, scale, unit};

/// Stefan–Boltzmann constant (W/(m²·K⁴)), CODATA 2018.
const STEFAN_BOLTZMANN: f64 = 5.670_374_419e-8;

/// Torque of sunlight in the mean over the rotation about an axis of the body, by the height of the Sun over its equator. (F30)
#[derive(Clone, Debug, PartialEq)]
pub struct MeanSunlight {
    /// Legendre coefficients of the part along the axis, by the sine of the height.
    along: Vec<f64>,
    /// Of the part across the axis in the meridian of the Sun, over the cosine of the height.
    toward: Vec<f64>,
    /// Of the part a quarter of a turn ahead of that, over the cosine of the height.
    ahead: Vec<f64>,
}

/// Mean torque per pressure (m³) of a body on its orbit. (F31)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeanTorque {
    /// Along the spin.
    pub spin: f64,
    /// Across the spin, away from the normal of the orbit: with it the obliquity rises.
    pub obliquity: f64,
}

impl MeanSunlight {
    /// Means about an axis (any length, body axes) through a point (m, file's frame): the centre of mass. (F30)
    #[must_use]
    pub fn about(loads: &SunlightLoads, point: [f64; 3], axis: [f64; 3]) -> Self {
        let [x, y, z] = frame(unit(axis));
        let (nodes, longitudes) = (loads.degree() + 2, loads.degree() + 3);
        let mut coefficients = [(); 3].map(|()| vec![0.0; nodes]);
        for [height, weight] in gauss_legendre(nodes) {
            let cos_height = ((1.0 - height) * (1.0 + height)).sqrt();
            let mut means = [0.0; 3];
            for step in 0..longitudes {
                let (sin, cos) = (TAU * step as f64 / longitudes as f64).sin_cos();
                let toward = add(scale(cos, x), scale(sin, y));
                let ahead = add(scale(-sin, x), scale(cos, y));
                let [_, torque] = loads.about(point, add(scale(height, z), scale(cos_height, toward)));
                let parts =
                    [dot(torque, z), dot(torque, toward) / cos_height, dot(torque, ahead) / cos_height];
                means.iter_mut().zip(parts).for_each(|(mean, part)| *mean += part / longitudes as f64);
            }
            for (l, value) in legendre(nodes - 1, height).into_iter().enumerate() {
                let share = weight * (2 * l + 1) as f64 / 2.0 * value;
                coefficients.iter_mut().zip(means).for_each(|(of, mean)| of[l] += share * mean);
            }
        }
        let [along, toward, ahead] = coefficients;
        Self { along, toward, ahead }
    }

    /// Mean over an orbit whose normal is at an obliquity (rad) from the axis, where the first harmonic of what the surface sends out is the
    /// `response` times what it receives, a complex number: one without a lag. (F31), (F32)
    ///
    /// The light that comes in gives no mean torque; an eccentric orbit has the mean pressure of its time.
    #[must_use]
    pub fn torque(&self, obliquity: f64, [prompt, lagging]: [f64; 2]) -> MeanTorque {
        let (sin, cos) = obliquity.sin_cos();
        let steps = 2 * self.along.len() + 2;
        let mut sum = MeanTorque { spin: 0.0, obliquity: 0.0 };
        for step in 0..steps {
            // longitudes of the Sun from the ascending node of the equator
            let (ahead, _) = (TAU * (step as f64 + 0.5) / steps as f64).sin_cos();
            let height = -sin * ahead;
            let values = legendre(self.along.len() - 1, height);
            let at = |of: &[f64]| of.iter().zip(&values).map(|(a, b)| a * b).sum::<f64>();
            sum.spin += at(&self.along);
            sum.obliquity -= cos * ahead * (prompt * at(&self.toward) - lagging * at(&self.ahead));
        }
        MeanTorque { spin: sum.spin / steps as f64, obliquity: sum.obliquity / steps as f64 }
    }
}

/// Two unit vectors across a unit vector, and it, right-handed.
fn frame(z: [f64; 3]) -> [[f64; 3]; 3] {
    let least = (0..3).fold(0, |least, axis| if z[axis].abs() < z[least].abs() { axis } else { least });
    let mut across = [0.0; 3];
    across[least] = 1.0;
    let y = unit(cross(z, across));
    [cross(y, z), y, z]
}

/// Surface that scatters a share of the light at once and emits the rest as heat, which flows into the ground and back. (F32), (F33)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThermalSurface {
    /// Bond albedo, the share of the light that is scattered.
    pub albedo: f64,
    /// Emissivity.
    pub emissivity: f64,
    /// Thermal inertia (J/(m²·K·s^½)).
    pub thermal_inertia: f64,
}

impl ThermalSurface {
    /// Temperature (K) of a sphere that is as warm everywhere, in light of a mean irradiance (W/m²). (F33)
    #[must_use]
    pub fn mean_temperature(&self, irradiance: f64) -> f64 {
        ((1.0 - self.albedo) * irradiance / (4.0 * self.emissivity * STEFAN_BOLTZMANN)).powf(0.25)
    }

    /// Thermal parameter `Θ` at a rate (rad/s) about the mean temperature. (F33)
    #[must_use]
    pub fn thermal_parameter(&self, irradiance: f64, rate: f64) -> f64 {
        let radiated = 4.0 * self.emissivity * STEFAN_BOLTZMANN * self.mean_temperature(irradiance).powi(3);
        self.thermal_inertia * rate.sqrt() / radiated
    }

    /// First harmonic of what is emitted over that of what is absorbed: its size and its lag (rad), at a thermal parameter. (F33)
    #[must_use]
    pub fn emission(theta: f64) -> [f64; 2] {
        let x = theta / 2f64.sqrt();
        [(1.0 + x).hypot(x).recip(), x.atan2(1.0 + x)]
    }

    /// First harmonic of all that the surface sends out over that of what it receives, a complex number whose angle is that of the lag. (F32)
    #[must_use]
    pub fn response(&self, irradiance: f64, rate: f64) -> [f64; 2] {
        let [size, lag] = Self::emission(self.thermal_parameter(irradiance, rate));
        let emitted = (1.0 - self.albedo) * size;
        [self.albedo + emitted * lag.cos(), emitted * lag.sin()]
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    /// First harmonic of the emission of a half-space under an absorbed flux of the mean one, by Crank and Nicolson in the depth, in units of the
    /// skin depth and the radian; of `T⁴` itself, or its straight line.
    fn emitted(theta: f64, absorbed: impl Fn(f64) -> f64, exact: bool) -> [f64; 2] {
        const CELLS: usize = 160;
        const STEPS: usize = 720;
        let dx = 8.0 / CELLS as f64; // in skin depths √(2κ/ω): ∂T/∂t = ½ ∂²T/∂x²
        let dt = TAU / STEPS as f64;
        let r = 0.25 * dt / (dx * dx);
        let slope = theta / 2f64.sqrt(); // flux into the ground, −∂T/∂x times this, over four times the mean
        let mut T = vec![1.0_f64; CELLS + 1];
        let mut harmonic = [0.0; 2];
        for step in 0..12 * STEPS {
            let t = dt * (step as f64 + 1.0);
            // half a cell at the surface: ½dx dT/dt = ½ ∂T/∂x + (absorbed − emitted)/(8·slope), emission on its tangent
            let (flux, tangent) =
                if exact { (T[0].powi(4), 4.0 * T[0].powi(3)) } else { (1.0 + 4.0 * (T[0] - 1.0), 4.0) };
            let gain = dt / (4.0 * slope * dx);
            let (mut lower, mut diagonal, mut upper, mut right) = (
                vec![-r; CELLS + 1],
                vec![1.0 + 2.0 * r; CELLS + 1],
                vec![-r; CELLS + 1],
                vec![0.0; CELLS + 1],
            );
            for k in 1..CELLS {
                right[k] = T[k] + r * (T[k - 1] - 2.0 * T[k] + T[k + 1]);
            }
            diagonal[0] = 1.0 + 2.0 * r + 0.5 * gain * tangent;
            upper[0] = -2.0 * r;
            right[0] = T[0]
                + 2.0 * r * (T[1] - T[0])
                + gain * (0.5 * (absorbed(t) + absorbed(t - dt)) - flux + 0.5 * tangent * T[0]);
            (diagonal[CELLS], lower[CELLS], right[CELLS]) =
                (1.0 + 2.0 * r, -2.0 * r, T[CELLS] + 2.0 * r * (T[CELLS - 1] - T[CELLS]));
            for k in 1..=CELLS {
                let share = lower[k] / diagonal[k - 1];
                diagonal[k] -= share * upper[k - 1];
                right[k] -= share * right[k - 1];
            }
            T[CELLS] = right[CELLS] / diagonal[CELLS];
            for k in (0..CELLS).rev() {
                T[k] = (right[k] - upper[k] * T[k + 1]) / diagonal[k];
            }
            if step >= 11 * STEPS {
                let out = if exact { T[0].powi(4) } else { 1.0 + 4.0 * (T[0] - 1.0) };
                let (sin, cos) = t.sin_cos();
                harmonic = [
                    harmonic[0] + 2.0 * out * cos / STEPS as f64,
                    harmonic[1] + 2.0 * out * sin / STEPS as f64,
                ];
            }
        }
        [harmonic[0].hypot(harmonic[1]), harmonic[1].atan2(harmonic[0])]
    }

    /// The closed form is that of a half-space whose radiation is a straight line of the temperature; of the fourth power, under the Sun over
    /// the equator, it is what is known as the error of the linear theory.
    #[test]
    fn emission_lags_as_by_the_heat_equation() {
        for theta in [0.3, 1.0, 4.0] {
            let [size, lag] = ThermalSurface::emission(theta);
            let wave = |t: f64| 1.0 + 0.1 * t.cos();
            let [found, found_lag] = emitted(theta, wave, false);
            assert!(
                (10.0 * found / size - 1.0).abs() < 3e-3 && (found_lag - lag).abs() < 3e-3,
                "{theta}: {found} {size} {found_lag} {lag}"
            );
            // Insolation over the equator: mean 4/π of that of the sphere, first harmonic 2.
            let sun = |t: f64| 4.0 * t.cos().max(0.0);
            let [size_of_sun, lag_of_sun] = emitted(theta, sun, true);
            assert!(
                (size_of_sun / 2.0 / size - 1.0).abs() < 0.2 && (lag_of_sun - lag).abs() < 0.15,
                "{theta}"
            );
        }
    }

    #[test]
    fn heat_that_does_not_lag_leaves_all_light_at_once() {
        let bare = ThermalSurface { albedo: 0.1, emissivity: 0.9, thermal_inertia: 0.0 };
        assert_eq!(bare.response(1361.0, 1e-4), [1.0, 0.0]);
        let rock = ThermalSurface { thermal_inertia: 1e9, ..bare };
        let [prompt, lagging] = rock.response(1361.0, 1e-4);
        assert!((prompt - 0.1).abs() < 1e-3 && lagging < 1e-3 && lagging > 0.0);
        let [size, lag] = ThermalSurface::emission(1e9);
        assert!(size < 1e-8 && (lag - PI / 4.0).abs() < 1e-8);
    }
}
