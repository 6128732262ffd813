use thiserror::Error;

use crate::math::eigen::NoConvergence;

/// Error of modes that were not found.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum ModesError {
    /// The parts are displaced so far that their equations have no positive mass matrix there.
    #[error(
        "the parts bend so far in this steady spin that their equations do not hold there: the kinetic energy is negative for some motion"
    )]
    BeyondRange,
    /// All modes of too many coordinates were asked for.
    #[error(
        "all modes of {coordinates} coordinates take too long to find, more than {most}; ask for the slowest ones alone"
    )]
    TooMany {
        /// Coordinates of the body.
        coordinates: usize,
        /// Most coordinates.
        most: usize,
    },
    /// The eigenvalue solver failed.
    #[error(transparent)]
    Eigenvalues(#[from] NoConvergence),
}
