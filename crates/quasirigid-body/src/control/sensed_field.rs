//! Magnetic field as sensors and coils on a body have it. (Y8)

use crate::force::MagneticField;
use crate::math::rotation::Turn;
use crate::math::vec3::{add, cross, scale};

/// Magnetic field at the place of a body, body axes. (Y8)
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SensedField {
    /// Field `B` (T).
    pub field: [f64; 3],
    /// Its rate `dB/dt` as the body sees it (T/s): that in inertial axes, less `ω × B`.
    pub rate: [f64; 3],
}

impl SensedField {
    /// Field at a time (s), in an attitude (unit quaternion, scalar first, from body to inertial axes) and at an angular velocity of the
    /// carrier (rad/s, body axes). (Y8)
    #[must_use]
    pub fn of(source: &MagneticField, t: f64, attitude: [f64; 4], omega: [f64; 3]) -> Self {
        let turn = Turn::of(attitude);
        let [field, change] = source.with_rate(t).map(|vector| turn.to_body(vector));
        Self { field, rate: add(change, scale(-1.0, cross(omega, field))) }
    }

    /// Torque (N·m, body axes) on a dipole moment (A·m², body axes). (Y8)
    #[must_use]
    pub fn torque(&self, moment: [f64; 3]) -> [f64; 3] {
        cross(moment, self.field)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::force::Orbit;
    use crate::math::rotation::{ALIGNED, product, turned};

    /// The rate is the slope of the field of a body that turns steadily along its orbit, by differences of the field alone.
    #[test]
    fn the_rate_is_the_slope_of_the_field_in_the_body() {
        let orbit = Orbit {
            mu: 3.986e14,
            semi_major_axis: 7.2e6,
            eccentricity: 0.1,
            inclination: 1.1,
            raan: 0.4,
            argument_of_periapsis: -0.7,
            mean_anomaly: 2.0,
            node_rate: 0.0,
            periapsis_rate: 0.0,
        };
        let source = MagneticField::Dipole { strength: [1e15, -2e15, -7.8e15], rate: 7.3e-5, orbit };
        let (start, omega) = ([0.6, 0.0, 0.48, 0.64], [0.003, -0.002, 0.001]);
        let at =
            |t: f64| SensedField::of(&source, t, product(start, turned(ALIGNED, scale(t, omega))), omega);
        let (t, step) = (700.0, 0.05);
        let [before, after] = [t - step, t + step].map(|t| at(t).field);
        let SensedField { field, rate } = at(t);
        for axis in 0..3 {
            let slope = (after[axis] - before[axis]) / (2.0 * step);
            // the square of the angle turned in a step
            assert!((slope - rate[axis]).abs() < 1e-6 * 0.004 * 3e-5, "{slope} {} {field:?}", rate[axis]);
        }
        assert!(rate.iter().all(|part| part.abs() > 1e-9), "{rate:?}");
    }
}
