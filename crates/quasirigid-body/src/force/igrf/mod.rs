//! Main field of the Earth after the International Geomagnetic Reference Field, which turns with the Earth.
//! Coefficients between two epochs are joined by straight lines, as the field is defined; during a run they stay those of its start.
//! Equation (F21), docs/theory/07-forces.md.

mod rated;
mod synthesis;
mod table;

use super::{Orbit, OrbitPoint};
use crate::math::scalar::Smooth;
use crate::math::vec3::{add, cross, scale};
use rated::Rated;

/// Main field of the Earth, IGRF-14. (F21)
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EarthField {
    /// Decimal year of the coefficients, 1900 to 2030.
    pub year: f64,
    /// Highest degree, 1 to 13.
    pub degree: usize,
    /// Right ascension of Greenwich at time zero (rad): the sidereal time there.
    pub sidereal: f64,
}

impl EarthField {
    /// First and last year of the coefficients.
    pub const YEARS: [f64; 2] = [1900.0, 2030.0];
    /// Highest degree of the coefficients.
    pub const MAX_DEGREE: usize = 13;
    /// Rate (rad/s) at which the Earth turns.
    pub const RATE: f64 = 7.292_115_855_3e-5;
    /// Least distance (m) from the centre of the Earth at which the field is that of what lies below: the polar radius.
    pub const LEAST_RADIUS: f64 = 6.356_752e6;
    /// Radius (m) that the coefficients go with.
    const RADIUS: f64 = 6.3712e6;

    /// Field (T) at a place (m) from the centre of the Earth, both along axes that turn with it: to Greenwich, across, to the north pole.
    #[must_use]
    pub fn in_earth_axes<T: Smooth>(&self, place: [T; 3]) -> [T; 3] {
        let place = scale(T::from(1.0 / Self::RADIUS), place);
        let [x, y, z] = place;
        let per_square = T::from(1.0) / (x * x + y * y + z * z);
        synthesis::field(&table::coefficients(self.year), self.degree, place, [per_square, per_square.sqrt()])
    }

    /// Field (T) and its rate (T/s), inertial axes, at a time (s) and a moving place on an orbit; `turn` is how far (rad) the Earth has
    /// turned since time zero.
    pub(super) fn with_rate<T: Smooth>(&self, turn: T, passage: &OrbitPoint<T>) -> [[T; 3]; 2] {
        let (sin, cos) = (turn + T::from(self.sidereal)).sin_cos();
        let inertial = |[x, y, z]: [T; 3]| [cos * x - sin * y, sin * x + cos * y, z];
        let earthly = |[x, y, z]: [T; 3]| [cos * x + sin * y, cos * y - sin * x, z];
        let spin = [T::from(0.0), T::from(0.0), T::from(Self::RATE)];
        let per_radius = T::from(1.0 / Self::RADIUS);
        let place = scale(per_radius, earthly(passage.place));
        let carried = cross(spin, passage.place).map(|entry| -entry);
        let velocity = scale(per_radius, earthly(add(passage.velocity, carried)));
        let moving = [0, 1, 2].map(|axis| Rated(place[axis], velocity[axis]));
        let [x, y, z] = moving;
        let per_square = (x * x + y * y + z * z).reciprocal();
        let coefficients = table::coefficients(self.year);
        let found = synthesis::field(&coefficients, self.degree, moving, [per_square, per_square.sqrt()]);
        let (field, own) = (found.map(|part| part.0), found.map(|part| part.1));
        [inertial(field), inertial(add(own, cross(spin, field)))]
    }

    /// Field (T) and its rate (T/s) at a time (s) along an orbit, inertial axes.
    pub(super) fn along<T: Smooth>(&self, t: T, orbit: &Orbit) -> [[T; 3]; 2] {
        self.with_rate(T::from(Self::RATE) * t, &orbit.at(t))
    }
}
