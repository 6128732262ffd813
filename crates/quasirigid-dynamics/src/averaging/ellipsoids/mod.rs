//! Secular evolution of many homogeneous ellipsoids at once, each with its own shape, material and rotation.
//! Equations (A6), docs/theory/10-torque-free.md; (G13) to (G15), docs/theory/11-materials.md; (Q12), docs/theory/16-methods.md.

mod compliance;
mod criteria;
mod passage;
mod power;

use std::fmt;

use thiserror::Error;

pub use passage::{EllipsoidPassage, ellipsoid_passages};

/// A homogeneous elastic ellipsoid that wobbles, and the state up to which it is followed.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WobblingEllipsoid {
    /// Semi-axes (m), in any order.
    pub semi_axes: [f64; 3],
    /// Density (kg/m³).
    pub density: f64,
    /// Shear modulus (Pa).
    pub shear: f64,
    /// Poisson's ratio, above −1 and below ½.
    pub poisson: f64,
    /// Law of the loss.
    pub loss: EllipsoidLoss,
    /// Effective spin `|K|/I₃` (rad/s): the rate at which the body ends about its axis of greatest inertia.
    pub spin: f64,
    /// Wobble at the start.
    pub from: Wobble,
    /// Wobble at the end.
    pub until: Wobble,
}

/// Law of the loss of a material of unit modulus.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EllipsoidLoss {
    /// Quality factor `Q` at every frequency.
    QualityFactor(f64),
    /// Kelvin–Voigt material with the time `η/μ` (s).
    KelvinVoigt(f64),
}

/// State of rotation at a given `|K|`.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wobble {
    /// Greatest angle (rad) between the angular momentum and the axis of greatest inertia.
    Nutation(f64),
    /// `D/I₃ = |K|²/2EI₃`, from `I₁/I₃` to 1.
    Ratio(f64),
}

impl fmt::Display for Wobble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nutation(angle) => write!(f, "a wobble of {angle} rad"),
            Self::Ratio(ratio) => write!(f, "D/I3 = {ratio}"),
        }
    }
}

/// An ellipsoid that is not followed.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum EllipsoidRefusal {
    /// A number that has to be positive and finite is not.
    #[error("{name} is {value}; give a finite number above zero")]
    NotPositive {
        /// Name of the number.
        name: &'static str,
        /// The number.
        value: f64,
    },
    /// A quality factor below 1.
    #[error("the quality factor is {value}; give one of at least 1")]
    Quality {
        /// Factor asked for.
        value: f64,
    },
    /// Poisson's ratio out of range.
    #[error("Poisson's ratio {value} is out of range; give one above -1 and below 1/2")]
    Poisson {
        /// Ratio asked for.
        value: f64,
    },
    /// No rotation has this state.
    #[error(
        "{wobble} is not a rotation state of this body, whose D/I3 runs from {least} to 1; the angle of wobble runs from 0 to pi/2"
    )]
    NoState {
        /// State asked for.
        wobble: Wobble,
        /// `I₁/I₃`.
        least: f64,
    },
    /// The two greatest moments are equal, so that no axis of greatest inertia is circled.
    #[error(
        "the two greatest moments are equal: the body has no axis of greatest inertia of its own for a wobble"
    )]
    NoShortAxis,
    /// Moments of inertia, power or time outside of the range of double precision.
    #[error(
        "the moments of inertia, the power or the time leave the range of double precision; choose other units"
    )]
    OutOfRange,
    /// The end lies before the start.
    #[error("the wobble at the end is the larger one; dissipation leads from wide wobbles to narrow ones")]
    Behind,
    /// The average does not hold.
    #[error(
        "the average does not hold: its error may be {percent} %; {cause}; the command evolve has other methods"
    )]
    DoesNotHold {
        /// Bound of the relative error (percent).
        percent: f64,
        /// Largest criterion, in words.
        cause: &'static str,
    },
}
