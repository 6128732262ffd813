//! Errors of laws of scattering.

use thiserror::Error;

/// A law that gives no brightness.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum PhotometryError {
    /// A parameter out of its range.
    #[error("{name} of the law of scattering is {value}; give {range}")]
    Parameter {
        /// Name of the parameter.
        name: &'static str,
        /// Value given.
        value: f64,
        /// What it may be, in words.
        range: &'static str,
    },
    /// A phase angle for which a phase function was not made.
    #[error("the phase angle is {:.4} degrees, and {law} holds up to {most} degrees; take a law without it, or leave such times out", alpha.to_degrees())]
    PhaseRange {
        /// Name of the phase function.
        law: &'static str,
        /// Phase angle (rad).
        alpha: f64,
        /// Greatest one (degrees).
        most: f64,
    },
    /// A phase function that is negative or no number at a phase angle.
    #[error("at the phase angle of {:.4} degrees the phase function is {value}, not positive; its slope is too steep there", alpha.to_degrees())]
    NoLight {
        /// Phase angle (rad).
        alpha: f64,
        /// Value of the phase function.
        value: f64,
    },
    /// Hapke's law, which has a phase function of its own.
    #[error("Hapke's law has a phase function and an albedo of its own; leave the other ones out")]
    OwnPhase,
}
