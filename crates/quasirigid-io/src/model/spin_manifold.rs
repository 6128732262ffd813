//! Settings of the reduced equations about a steady spin, from `[run] spin_manifold` and from the command line.
//! Masters are written as a word or as frequencies; both are parsed here, so that file and command line accept the same.
//! Masters and styles: (W5), (W9), docs/theory/18-submanifolds.md.

use std::str::FromStr;

use quasirigid_body::MAX_DEGREE;
use thiserror::Error;

use super::key::{Keys, Shape, any, integer, key, words};
use super::partial::partial;
use super::settings::optional;
use super::value::Value;
use crate::units::Dimension;

pub(super) const SPIN_MANIFOLD: Keys = Keys {
    known: &[
        key("degree", integer(1, MAX_DEGREE as u64).or("5"), "in the amplitude"),
        key(
            "masters",
            any(&[Shape::Words(&["automatic", "nutation"]), Shape::List(&Shape::Number)])
                .in_unit("rad/s")
                .or("`\"automatic\"`"),
            "modes that they follow beside the nutation",
        ),
        key("style", words(&["normal-form", "graph"]).or("`\"normal-form\"`"), ""),
    ],
};

/// Most frequencies of masters beside the nutation.
const MAX_MASTERS: usize = 3;

partial! {
    /// Settings of the reduced equations about a steady spin, as far as a source gives them.
    PartialSpinManifold {
        /// Highest degree in the amplitude.
        degree: usize,
        /// Modes that the equations follow.
        masters: ManifoldMasters,
        /// Style of the parametrisation.
        style: ManifoldStyle,
    }
}

/// Modes that the reduced equations about a spin follow.
///
/// ```
/// use quasirigid_io::model::ManifoldMasters;
///
/// assert_eq!("nutation".parse(), Ok(ManifoldMasters::Nutation));
/// assert_eq!("6.3,12".parse(), Ok(ManifoldMasters::With(vec![6.3, 12.0])));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum ManifoldMasters {
    /// The nutation, with the modes near it or near a resonance.
    Automatic,
    /// The nutation alone.
    Nutation,
    /// The nutation and the modes at these frequencies (rad/s).
    With(Vec<f64>),
}

/// Style of the parametrisation of the reduced equations about a spin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ManifoldStyle {
    /// Amplitudes separate from phases.
    NormalForm,
    /// Every monomial of the motion is kept.
    Graph,
}

/// A text that names no [`ManifoldMasters`].
#[derive(Clone, Debug, Error, PartialEq)]
#[error(
    "{text:?} names no masters; give automatic, nutation, or up to {MAX_MASTERS} frequencies (rad/s) such as 6.3,12"
)]
pub struct MastersError {
    /// The text.
    text: String,
}

impl FromStr for ManifoldMasters {
    type Err = MastersError;

    /// Reads `automatic`, `nutation`, or frequencies (rad/s) separated by commas.
    fn from_str(text: &str) -> Result<Self, MastersError> {
        let unknown = || MastersError { text: text.to_owned() };
        match text.trim() {
            "automatic" => Ok(Self::Automatic),
            "nutation" => Ok(Self::Nutation),
            list => {
                let read = |item: &str| item.trim().parse().map_err(|_| unknown());
                let frequencies: Vec<f64> = list.split(',').map(read).collect::<Result<_, _>>()?;
                Self::of(frequencies).map_err(|_| unknown())
            }
        }
    }
}

impl ManifoldMasters {
    /// Masters at frequencies (rad/s).
    ///
    /// # Errors
    /// [`MastersError`] where they cannot be frequencies, or are none or too many.
    pub fn of(frequencies: Vec<f64>) -> Result<Self, MastersError> {
        let fit = (1..=MAX_MASTERS).contains(&frequencies.len())
            && frequencies.iter().all(|frequency| *frequency >= 0.0 && frequency.is_finite());
        if fit { Ok(Self::With(frequencies)) } else { Err(MastersError { text: format!("{frequencies:?}") }) }
    }
}

/// Reads `spin_manifold`.
pub(super) fn spin_manifold(value: &Value<'_>) -> Option<PartialSpinManifold> {
    let table = value.table("`spin_manifold`", &SPIN_MANIFOLD)?;
    let degree = optional(table.get("degree"), |value| value.integer(1..=MAX_DEGREE));
    let masters = optional(table.get("masters"), |value| masters(&value));
    let style = optional(table.get("style"), |value| value.named());
    Some(PartialSpinManifold { degree: degree?, masters: masters?, style: style? })
}

fn masters(value: &Value<'_>) -> Option<ManifoldMasters> {
    let help = "write for example masters = \"nutation\", or frequencies: masters = [6.3, 12.0]";
    if let Some(text) = value.words() {
        return match text.parse() {
            Ok(masters) => Some(masters),
            Err(error) => {
                let message = format!("`masters`: {error}");
                value.refuse(message, "no such masters", help)
            }
        };
    }
    let Some(items) = value.items() else {
        return value.mismatch("a word or a list of frequencies", help);
    };
    let mut frequencies = Vec::new();
    for item in items {
        frequencies.push(item.quantity(Dimension::FREQUENCY)?);
    }
    let found = ManifoldMasters::of(frequencies);
    found.ok().or_else(|| {
        let message = format!(
            "`masters` has 1 to {MAX_MASTERS} frequencies of modes beside the nutation, none negative"
        );
        value.refuse(message, "not these", help)
    })
}
