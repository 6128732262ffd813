//! Settings of the secular evolution: start, target, duration, power and method, from `[run] evolve` and from the command line.
//! A target is written as a share of `I₃` or as an angle; both are parsed here, so that file and command line accept the same texts.
//! Methods and their criteria: (Q1) to (Q9), docs/theory/16-methods.md.

use std::f64::consts::FRAC_PI_2;
use std::str::FromStr;

use thiserror::Error;

use super::key::{self, Keys, Shape, any, integer, key, words};
use super::partial::partial;
use super::settings::{MAX_ROWS, optional};
use super::value::Value;
use crate::units::{Dimension, UnitError, quantity};

pub(super) const EVOLVE: Keys = Keys {
    known: &[
        key(
            "start",
            any(&[Shape::Number, Shape::Text]).or("that of the model"),
            "D/I3, or the nutation (wobble) about the axis of greatest inertia",
        ),
        key(
            "until",
            any(&[Shape::Number, Shape::Text]).or("1 % of the energy above the steady spin"),
            "as `start`",
        ),
        key("duration", key::quantity("s").or("none"), "longest time"),
        key("samples", integer(2, MAX_ROWS as u64).or("201"), "rows"),
        key("power", words(&["polynomial", "harmonics"]).or("as materials need"), "source of the mean power"),
        key(
            "method",
            words(&[
                "average",
                "levels",
                "periodic-motions",
                "micro-runs",
                "full",
                "modal-rates",
                "spin-manifold",
            ])
            .or("the one that holds"),
            "",
        ),
    ],
};

partial! {
    /// Settings of the secular evolution, as far as a source gives them.
    PartialEvolve {
        /// Rotation state at which the evolution starts.
        start: Target,
        /// Rotation state at which the evolution ends.
        until: Target,
        /// Longest time that is followed (s).
        duration: f64,
        /// Number of rows of the history.
        samples: usize,
        /// Source of the power of an average.
        power: Power,
        /// Method; none leaves the choice to the criteria.
        method: EvolveMethod,
    }
}

/// Method of the secular evolution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EvolveMethod {
    /// Averaged along the polhode of the frozen body.
    Average,
    /// The mean power of periodic motions of the full system.
    PeriodicMotions,
    /// The mean power measured by short runs of the full system.
    MicroRuns,
    /// The full system from start to end.
    Full,
    /// Averaged along level curves of the slow energy.
    Levels,
    /// The average at the rates that the modes at the poles have.
    ModalRates,
    /// The reduced equations about the spin from start to end.
    SpinManifold,
}

/// Source of the mean power.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Power {
    /// From the power of the reduced equations.
    Polynomial,
    /// From the response of every elastic mode and material to the harmonics of the polhode.
    Harmonics,
}

/// A rotation state, by the distance from the rotation about the axis of greatest inertia.
///
/// ```
/// use quasirigid_io::model::Target;
///
/// assert_eq!("98% of I3".parse(), Ok(Target::Ratio(0.98)));
/// assert_eq!("0.98".parse(), Ok(Target::Ratio(0.98)));
/// assert_eq!("5 deg".parse(), Ok(Target::Wobble(5f64.to_radians())));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// Ratio `D/I₃` of the dynamic to the greatest moment of inertia, between 0 and 1.
    Ratio(f64),
    /// Greatest angle (rad) between the angular momentum and the axis of greatest inertia, above 0 and below a right
    /// angle.
    Wobble(f64),
}

/// A text that is not a [`Target`].
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum TargetError {
    /// Neither a part of `I₃` nor an angle.
    #[error("{text:?} is neither a part of I3 nor an angle")]
    Neither {
        /// The text.
        text: String,
    },
    /// A quantity that is not an angle.
    #[error(transparent)]
    Unit(UnitError),
    /// A part of `I₃` that no state has.
    #[error("the ratio D/I3 is {ratio}, but must be between 0 and 1")]
    Ratio {
        /// The ratio.
        ratio: f64,
    },
    /// An angle that is zero, negative, or not below a right angle.
    #[error("the angle is {wobble} rad, but must be between 0 and 90 deg")]
    Wobble {
        /// The angle (rad).
        wobble: f64,
    },
}

impl TargetError {
    /// Advice: a text to write instead.
    #[must_use]
    pub fn advice(&self) -> String {
        match self {
            Self::Unit(error @ UnitError::UnknownUnit { suggestion: Some(_), .. }) => error.advice(),
            _ => ADVICE.to_owned(),
        }
    }
}

const ADVICE: &str = "write for example \"98% of I3\", 0.98 or \"5 deg\"";

impl Target {
    fn ratio(ratio: f64) -> Result<Self, TargetError> {
        let inside = ratio > 0.0 && ratio < 1.0;
        if inside { Ok(Self::Ratio(ratio)) } else { Err(TargetError::Ratio { ratio }) }
    }

    fn wobble(wobble: f64) -> Result<Self, TargetError> {
        let inside = wobble > 0.0 && wobble < FRAC_PI_2;
        if inside { Ok(Self::Wobble(wobble)) } else { Err(TargetError::Wobble { wobble }) }
    }
}

impl FromStr for Target {
    type Err = TargetError;

    /// Reads `98% of I3`, the plain number `0.98`, or an angle with its unit.
    fn from_str(text: &str) -> Result<Self, TargetError> {
        let text = text.trim();
        let neither = || TargetError::Neither { text: text.to_owned() };
        if let Ok(ratio) = text.parse() {
            return Self::ratio(ratio);
        }
        if let Some((percent, of)) = text.split_once('%') {
            let percent: f64 = percent.trim_end().parse().map_err(|_| neither())?;
            let of_I3 = of.split_whitespace().eq(["of", "I3"]);
            return if of_I3 { Self::ratio(percent / 100.0) } else { Err(neither()) };
        }
        let wobble = quantity(text, Dimension::ANGLE).map_err(|error| match error {
            UnitError::Empty { .. } | UnitError::NotANumber { .. } => neither(),
            error => TargetError::Unit(error),
        })?;
        Self::wobble(wobble)
    }
}

/// Reads `evolve`.
pub(super) fn evolve(value: &Value<'_>) -> Option<PartialEvolve> {
    let table = value.table("`evolve`", &EVOLVE)?;
    let start = optional(table.get("start"), |value| target(&value));
    let until = optional(table.get("until"), |value| target(&value));
    let duration = optional(table.get("duration"), |value| value.positive(Dimension::TIME));
    let samples = optional(table.get("samples"), |value| value.integer(2..=MAX_ROWS));
    let power = optional(table.get("power"), |value| value.named());
    let method = optional(table.get("method"), |value| value.named());
    Some(PartialEvolve {
        start: start?,
        until: until?,
        duration: duration?,
        samples: samples?,
        power: power?,
        method: method?,
    })
}

fn target(value: &Value<'_>) -> Option<Target> {
    let target = match value.words() {
        Some(text) => text.parse(),
        None if value.is_number() => Target::ratio(value.quantity(Dimension::NUMBER)?),
        None => return value.mismatch("a part of I3 or an angle", ADVICE),
    };
    match target {
        Ok(target) => Some(target),
        Err(error) => value.refuse(format!("`{}`: {error}", value.key()), "no such state", error.advice()),
    }
}
