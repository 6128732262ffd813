use thiserror::Error;

use crate::math::submanifold::ExpansionError;
use crate::modes::{EquilibriumError, ModesError};

/// Error of reduced equations about a steady spin that were not found.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SubmanifoldError {
    /// There is no steady spin to expand about.
    #[error(transparent)]
    Equilibrium(#[from] EquilibriumError),
    /// The steady spin of the linear balance does not lead to one of the full equations.
    #[error("no steady spin of the full equations was found near the axis [{:.4}, {:.4}, {:.4}]: along curved paths the centrifugal load may have no balance there", axis[0], axis[1], axis[2])]
    NoBalance {
        /// Axis, body axes.
        axis: [f64; 3],
    },
    /// The modes about the steady spin failed.
    #[error(transparent)]
    Modes(#[from] ModesError),
    /// The degree is out of range.
    #[error("degree {degree} is out of range for reduced equations about a spin; choose 1 to {highest}")]
    Degree {
        /// Degree asked for.
        degree: usize,
        /// Highest degree.
        highest: usize,
    },
    /// No mode about the spin is a nutation.
    #[error(
        "in no mode about this spin does the angular momentum circle in the body: the reduced equations about a spin have nothing to follow (a sphere, or an overdamped motion)"
    )]
    NoNutation,
    /// A part has no equations of motion.
    #[error(
        "{what} has no equations of motion of its own, only a response at each frequency; reduced equations about a spin need dashpots in its place"
    )]
    NoEquations {
        /// Part, or its material.
        what: String,
    },
    /// External moments or a driven support act.
    #[error(
        "reduced equations about a spin are for a body without external moments and with wheels of constant speed: {what}"
    )]
    External {
        /// What acts.
        what: &'static str,
    },
    /// The eigenvalue iteration of a master did not converge.
    #[error("the mode at {frequency:.4} rad/s did not converge as a master of the reduced equations")]
    Master {
        /// Frequency (rad/s).
        frequency: f64,
    },
    /// A mode left out resonates with the masters.
    #[error(transparent)]
    Expansion(#[from] ExpansionError),
    /// The body has too many coordinates.
    #[error(
        "a body of {coordinates} internal coordinates is beyond the reduced equations about a spin, which take up to {most}; keep fewer modes of its structures"
    )]
    TooLarge {
        /// Number of coordinates.
        coordinates: usize,
        /// Limit.
        most: usize,
    },
}
