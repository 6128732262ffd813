//! Errors of a flexible body: motions without stiffness or without friction, with which a body has no equilibrium.

use thiserror::Error;

use super::Coordinate;

/// Size from which a component of a null direction is named.
const NAMED: f64 = 0.1;
/// Limit of the number of coordinates named in an error.
const MOST_NAMES: usize = 6;

/// Error of matrices that belong to no body with an equilibrium.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum FlexibleError {
    /// A motion of the coordinates meets no stiffness.
    #[error("{}", mechanism(coordinates))]
    Mechanism {
        /// Names of the coordinates that move.
        coordinates: String,
    },
    /// A motion of the cyclic coordinates meets no friction.
    #[error("no damping acts on some motion of {coordinates}")]
    Frictionless {
        /// Names of the coordinates that move.
        coordinates: String,
    },
}

impl FlexibleError {
    /// Names of the coordinates that move.
    #[must_use]
    pub fn coordinates(self) -> String {
        match self {
            Self::Mechanism { coordinates } | Self::Frictionless { coordinates } => coordinates,
        }
    }
}

/// Names of the coordinates that move along a direction.
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

/// Message for motions without stiffness, with the names of their coordinates.
pub fn mechanism(coordinates: &str) -> String {
    format!("a mechanism: no spring resists some motion of {coordinates}")
}
