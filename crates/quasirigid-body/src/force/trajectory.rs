//! Path of a body past a centre of attraction: an ellipse that may precess, a conic by its periapsis, or a table of places.
//! Equations (F10), (F23) and (F26), docs/theory/07-forces.md.

use super::{Conic, Ephemeris, Orbit, OrbitPoint};
use crate::math::scalar::Smooth;

/// Path of a body past a centre of attraction, the origin of the inertial axes.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub enum Trajectory {
    /// Ellipse. (F10)
    Orbit(Orbit),
    /// Conic of any eccentricity by its periapsis. (F23)
    Conic(Conic),
    /// Places at given times. (F26)
    Table(Ephemeris),
}

impl From<Orbit> for Trajectory {
    fn from(orbit: Orbit) -> Self {
        Self::Orbit(orbit)
    }
}

impl From<Conic> for Trajectory {
    fn from(conic: Conic) -> Self {
        Self::Conic(conic)
    }
}

impl From<Ephemeris> for Trajectory {
    fn from(table: Ephemeris) -> Self {
        Self::Table(table)
    }
}

impl Trajectory {
    /// Gravitational parameter of the centre (m³/s²).
    #[must_use]
    pub fn mu(&self) -> f64 {
        match self {
            Self::Orbit(orbit) => orbit.mu,
            Self::Conic(conic) => conic.mu,
            Self::Table(table) => table.mu(),
        }
    }

    /// Place and velocity at a time (s), which may be a series.
    #[must_use]
    pub fn at<T: Smooth>(&self, t: T) -> OrbitPoint<T> {
        match self {
            Self::Orbit(orbit) => orbit.at(t),
            Self::Conic(conic) => conic.at(t),
            Self::Table(table) => table.at(t),
        }
    }

    /// Least distance (m) from the centre; of a table that of its rows.
    #[must_use]
    pub fn nearest(&self) -> f64 {
        match self {
            Self::Orbit(orbit) => orbit.semi_major_axis * (1.0 - orbit.eccentricity),
            Self::Conic(conic) => conic.periapsis_distance,
            Self::Table(table) => table.nearest().0,
        }
    }

    /// First and last time (s) at which the path is known; none of a path that always is.
    #[must_use]
    pub fn span(&self) -> Option<[f64; 2]> {
        match self {
            Self::Orbit(_) | Self::Conic(_) => None,
            Self::Table(table) => Some(table.span()),
        }
    }
}
