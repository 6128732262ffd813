use thiserror::Error;

use crate::math::eigen::NoConvergence;

/// No steady state, or none that is found.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SteadyError {
    /// A force that is not constant in axes that turn with the body.
    #[error("{what} changes with time in axes that turn with the body: no steady state")]
    Changes {
        /// The force or the support, in words.
        what: String,
    },
    /// An orbit whose rate changes along it.
    #[error(
        "the orbit of the force {name:?} is eccentric ({eccentricity}): its rate changes along it, and there is no steady state"
    )]
    Eccentric {
        /// Name of the force.
        name: String,
        /// Eccentricity.
        eccentricity: f64,
    },
    /// A momentum wheel whose speed changes.
    #[error("a momentum wheel changes its speed: no steady state")]
    Wheel,
    /// Forces that turn about different axes or at different rates.
    #[error("{one} and {other} turn differently: no steady state")]
    Apart {
        /// One of them, in words.
        one: String,
        /// The other.
        other: String,
    },
    /// A force that depends on where a free body is.
    #[error(
        "the force {name:?} depends on where the free body is, and its path is not followed here: no steady state"
    )]
    Placed {
        /// Name of the force.
        name: String,
    },
    /// A formula that has no value or no derivative.
    #[error("the force {name:?} has no value, or no derivative, at the state that is tried")]
    NotANumber {
        /// Name of the force.
        name: String,
    },
    /// Moments about the axis that nothing balances.
    #[error(
        "the forces have a moment of {moment:.4e} N·m about the axis that the body turns about, at {rate:.4e} rad/s: its rate changes, and no rate was found where it does not"
    )]
    Driven {
        /// The moment (N·m).
        moment: f64,
        /// The rate (rad/s).
        rate: f64,
    },
    /// No force knows the attitude, and the moments balance nowhere.
    #[error(
        "no angular velocity was found at which the moments on the body balance: they spin it up or down, or turn its axis away"
    )]
    Unbalanced,
    /// The iteration leads nowhere.
    #[error(
        "no steady state was found near the attitude and the angular velocity of the start: a body that spins about an axis of its own while the vertical turns in it has none in its axes, unless the spin is that of a momentum wheel"
    )]
    NotFound,
    /// A spin is asked for where the forces set it.
    #[error("{what} sets the rate and the axis: an angular velocity cannot be asked for")]
    Set {
        /// The force or the support, in words.
        what: String,
    },
    /// More coordinates than are followed.
    #[error(
        "{coordinates} coordinates are too many for the modes of a body under forces, which take up to {most}"
    )]
    TooMany {
        /// Coordinates of the body.
        coordinates: usize,
        /// The most that is taken.
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
