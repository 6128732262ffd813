//! Errors of steady states under forces: reasons why there is none, or why none was found.
//! Each variant is a distinct cause that a user can act on; the texts say which force or support it is.
//! The causes are those of the table and the text after (M6), docs/theory/15-modes.md.

use thiserror::Error;

use crate::math::eigen::NoConvergence;

/// Error of a steady state that does not exist or was not found.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SteadyError {
    /// A force is not constant in axes that rotate with the body.
    #[error("{what} changes with time in axes that turn with the body{}: no steady state", part.as_ref().map_or_else(String::new, |part| format!(" ({part})")))]
    Changes {
        /// Force or support, in words.
        what: String,
        /// Part of it that changes most, in words, where a part was found to change.
        part: Option<String>,
    },
    /// The rate of an orbit changes along its path.
    #[error(
        "the orbit of the force {name:?} is eccentric ({eccentricity}): its rate changes along it, and there is no steady state"
    )]
    Eccentric {
        /// Name of the force.
        name: String,
        /// Eccentricity.
        eccentricity: f64,
    },
    /// The speed of a momentum wheel changes.
    #[error("a momentum wheel changes its speed: no steady state")]
    Wheel,
    /// Forces rotate about different axes or at different rates.
    #[error("{one} and {other} turn differently: no steady state")]
    Apart {
        /// First force, in words.
        one: String,
        /// Second force, in words.
        other: String,
    },
    /// A force depends on the place of a free body.
    #[error(
        "the force {name:?} depends on where the free body is, and its path is not followed here: no steady state"
    )]
    Placed {
        /// Name of the force.
        name: String,
    },
    /// A formula has no value or no derivative.
    #[error("the force {name:?} has no value, or no derivative, at the state that is tried")]
    NotANumber {
        /// Name of the force.
        name: String,
    },
    /// The moment about the axis is not balanced.
    #[error(
        "the forces have a moment of {moment:.4e} N·m about the axis that the body turns about, at {rate:.4e} rad/s: its rate changes, and no rate was found where it does not"
    )]
    Driven {
        /// Moment (N·m).
        moment: f64,
        /// Rate (rad/s).
        rate: f64,
    },
    /// No force depends on the attitude, and the moments balance at no angular velocity.
    #[error(
        "no angular velocity was found at which the moments on the body balance: they spin it up or down, or turn its axis away"
    )]
    Unbalanced,
    /// The iteration does not converge.
    #[error(
        "no steady state was found near the attitude and the angular velocity of the start: a body that spins about an axis of its own while the vertical turns in it has none in its axes, unless the spin is that of a momentum wheel"
    )]
    NotFound,
    /// No steady state in which the loads restore the coordinates that no spring restores. (I13)
    #[error(
        "no spring restores {coordinates}, and no steady state was found near the start in which the spin or a force does; place the appendage where it hangs, or give its hinge a `stiffness`"
    )]
    Unrestored {
        /// Names of the coordinates.
        coordinates: String,
    },
    /// An angular velocity is asked for where the forces set it.
    #[error("{what} sets the rate and the axis: an angular velocity cannot be asked for")]
    Set {
        /// Force or support, in words.
        what: String,
    },
    /// The body has too many coordinates.
    #[error(
        "{coordinates} coordinates are too many for the modes of a body under forces, which take up to {most}"
    )]
    TooMany {
        /// Coordinates of the body.
        coordinates: usize,
        /// Limit of their number.
        most: usize,
    },
    /// The parts are displaced so far that their equations have no positive mass matrix there.
    #[error(
        "the parts bend so far in this steady state that their equations do not hold there: the kinetic energy is negative for some motion"
    )]
    BeyondRange,
    /// The eigenvalue solver failed.
    #[error(transparent)]
    Eigenvalues(#[from] NoConvergence),
}
