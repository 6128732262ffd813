//! Kind of a body, which chooses one word in every sentence about its motion.

use std::borrow::Cow;

use quasirigid_elements::Assembly;
use serde::{Deserialize, Serialize};

use super::named::Named;
use super::table::Table;

/// Kind of a body. It changes no number: it says what the body's field calls the angle between the angular momentum and the axis that it
/// circles, and the motion with that angle.
///
/// ```
/// use quasirigid_io::model::BodyKind;
///
/// assert_eq!(BodyKind::Spacecraft.nutation(), "nutation");
/// assert_eq!(BodyKind::SmallBody.nutation(), "wobble");
/// assert_eq!(BodyKind::SmallBody.mode_name("nutation, second"), "wobble, second");
/// assert_eq!(BodyKind::SmallBody.mode_name("tip along x"), "tip along x");
/// ```
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum BodyKind {
    /// Spacecraft, and every other body that was built.
    #[default]
    Spacecraft,
    /// Asteroid, comet, fragment.
    SmallBody,
}

impl BodyKind {
    /// Noun of the angle and of the motion; the plural has an s.
    #[must_use]
    pub fn nutation(self) -> &'static str {
        match self {
            Self::Spacecraft => "nutation",
            Self::SmallBody => "wobble",
        }
    }

    /// The noun at the beginning of a title.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Spacecraft => "Nutation",
            Self::SmallBody => "Wobble",
        }
    }

    /// Name of a mode in a sentence: that of the nutation by its noun, any other as it is.
    #[must_use]
    pub fn mode_name(self, name: &str) -> Cow<'_, str> {
        match name.strip_prefix(NUTATION) {
            Some(rest) if rest.is_empty() || rest.starts_with(", ") => {
                Cow::Owned(self.nutation().to_owned() + rest)
            }
            _ => Cow::Borrowed(name),
        }
    }

    /// Kind of a body whose file does not give it: a network, an ellipsoid and the inside of a surface are small bodies.
    pub(super) fn inferred(file: &Table<'_>, assembly: &Assembly) -> Self {
        let small =
            !assembly.ellipsoids.is_empty() || !assembly.surfaces.is_empty() || file.get("network").is_some();
        if small { Self::SmallBody } else { Self::Spacecraft }
    }
}

/// Name of the mode of the nutation in records, a contract; a further one of that name has a number behind a comma.
const NUTATION: &str = "nutation";

impl Named for BodyKind {
    const VALUES: &'static [(&'static str, Self, &'static str)] = &[
        ("spacecraft", Self::Spacecraft, "Its angle is called nutation"),
        ("small-body", Self::SmallBody, "Its angle is called wobble"),
    ];
}
