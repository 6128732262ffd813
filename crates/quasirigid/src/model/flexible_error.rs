//! Motions of coordinates that meet no stiffness or no friction: a body with one has no equilibrium.

use thiserror::Error;

use super::Coordinate;

/// Components of a null direction below this share of the largest are not named.
const NAMED: f64 = 0.1;
/// Coordinates named in an error, at most.
const MOST_NAMES: usize = 6;

/// Matrices that do not belong to a body with an equilibrium.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum FlexibleError {
    /// Some motion of the coordinates meets no stiffness.
    #[error("{}", mechanism(coordinates))]
    Mechanism {
        /// The coordinates that move, by name.
        coordinates: String,
    },
    /// A cyclic coordinate that nothing brakes.
    #[error("no friction brakes some motion of {coordinates}")]
    Frictionless {
        /// The coordinates that move, by name.
        coordinates: String,
    },
}

impl FlexibleError {
    /// The coordinates that move, by name.
    #[must_use]
    pub fn coordinates(self) -> String {
        match self {
            Self::Mechanism { coordinates } | Self::Frictionless { coordinates } => coordinates,
        }
    }
}

/// The coordinates that move along a direction, by name.
pub(super) fn named(coordinates: &[Coordinate], direction: &[f64]) -> String {
    let moving: Vec<_> = coordinates
        .iter()
        .zip(direction)
        .filter(|(_, amount)| amount.abs() > NAMED)
        .map(|(coordinate, _)| coordinate.name.as_str())
        .collect();
    let mut names = moving[..moving.len().min(MOST_NAMES)].join(", ");
    if moving.len() > MOST_NAMES {
        names.push_str(&format!(" and {} more", moving.len() - MOST_NAMES));
    }
    names
}

/// Words for motions that meet no stiffness, by the names of their coordinates.
pub(crate) fn mechanism(coordinates: &str) -> String {
    format!("a mechanism: no spring resists some motion of {coordinates}")
}
