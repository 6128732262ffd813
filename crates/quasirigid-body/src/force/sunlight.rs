//! Pressure of sunlight on a body whose surface scatters and emits by Lambert's law, without a lag: force and torque depend on the
//! direction of the Sun in the body alone, and are sums of spherical harmonics of it.
//! Equations (F27) to (F29), docs/theory/07-forces.md.

use super::Trajectory;
use crate::math::scalar::{Scalar, Smooth};
use crate::math::spherical_harmonics::{count, each_harmonic};
use crate::math::vec3::{cross, scale, unit};

/// Irradiance of the Sun at one astronomical unit (W/m²), nominal of the IAU (2015).
pub const SOLAR_CONSTANT: f64 = 1361.0;
/// Astronomical unit (m).
const ASTRONOMICAL_UNIT: f64 = 149_597_870_700.0;
/// Speed of light (m/s).
pub const SPEED_OF_LIGHT: f64 = 299_792_458.0;

/// Where the Sun stands.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub enum SunPath {
    /// In one direction.
    Fixed {
        /// Vector towards the Sun, of any length, inertial axes.
        direction: [f64; 3],
        /// Distance (m).
        distance: f64,
    },
    /// At the centre of the path of the body.
    Orbit(Trajectory),
}

impl SunPath {
    /// Unit vector towards the Sun, inertial axes, and the pressure `Φ/c` of its light (Pa) at a time (s). (F27)
    #[must_use]
    pub fn at<T: Smooth>(&self, t: T) -> ([T; 3], T) {
        match self {
            Self::Fixed { direction, distance } => {
                let largest = direction.iter().fold(0.0_f64, |most, entry| most.max(entry.abs()));
                let toward = unit(direction.map(|entry| entry / largest));
                (toward.map(T::from), T::from(light_pressure(*distance)))
            }
            Self::Orbit(path) => {
                let passage = path.at(t);
                let per_radius = T::from(1.0) / passage.radius;
                let units = T::from(ASTRONOMICAL_UNIT) * per_radius;
                let toward = scale(-per_radius, passage.place);
                (toward, T::from(light_pressure(ASTRONOMICAL_UNIT)) * units * units)
            }
        }
    }
}

/// Pressure of sunlight (Pa) on a black surface across it at a distance (m) from the Sun.
#[must_use]
pub fn light_pressure(distance: f64) -> f64 {
    let units = ASTRONOMICAL_UNIT / distance;
    SOLAR_CONSTANT / SPEED_OF_LIGHT * units * units
}

/// Force and torque of sunlight per pressure, by the direction of the Sun in the body: sums of spherical harmonics. (F29)
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct SunlightLoads {
    center: [f64; 3],
    degree: usize,
    /// Force (m²) and torque (m³) of each harmonic.
    coefficients: Vec<[f64; 6]>,
}

impl SunlightLoads {
    /// Loads by their harmonics up to a degree, in the order of [`each_harmonic`]; the torque is about `center` (m, file's frame).
    ///
    /// # Panics
    /// If the number of harmonics is not that of the degree.
    #[must_use]
    pub fn new(center: [f64; 3], degree: usize, coefficients: Vec<[f64; 6]>) -> Self {
        assert_eq!(coefficients.len(), count(degree), "harmonics of the degree {degree}");
        Self { center, degree, coefficients }
    }

    /// Point (m, file's frame) that the torque is about.
    #[must_use]
    pub fn center(&self) -> [f64; 3] {
        self.center
    }

    /// Highest degree.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The loads without the harmonics above a degree.
    #[must_use]
    pub fn truncated(&self, degree: usize) -> Self {
        let mut degrees = Vec::with_capacity(self.coefficients.len());
        each_harmonic(self.degree, [0.0, 0.0, 1.0], |l, _| degrees.push(l));
        let kept = self.coefficients.iter().zip(degrees).filter(|(_, l)| *l <= degree);
        Self::new(self.center, degree.min(self.degree), kept.map(|(each, _)| *each).collect())
    }

    /// Force (m²) and torque about the centre (m³), each per pressure of the light, where the Sun is along a unit vector, all in body axes.
    /// (F29)
    #[must_use]
    pub fn at<T: Scalar>(&self, sun: [T; 3]) -> [[T; 3]; 2] {
        let mut sums = [T::from(0.0); 6];
        let mut coefficients = self.coefficients.iter();
        each_harmonic(self.degree, sun, |_, value| {
            if let Some(each) = coefficients.next() {
                for (sum, coefficient) in sums.iter_mut().zip(each) {
                    *sum = *sum + value.scaled(*coefficient);
                }
            }
        });
        let [fx, fy, fz, mx, my, mz] = sums;
        [[fx, fy, fz], [mx, my, mz]]
    }

    /// Force and torque per pressure, the torque about another point (m, file's frame).
    #[must_use]
    pub fn about<T: Scalar>(&self, point: [f64; 3], sun: [T; 3]) -> [[T; 3]; 2] {
        let [force, torque] = self.at(sun);
        let arm: [T; 3] = std::array::from_fn(|axis| T::from(self.center[axis] - point[axis]));
        let moved = cross(arm, force);
        [force, std::array::from_fn(|axis| torque[axis] + moved[axis])]
    }
}
