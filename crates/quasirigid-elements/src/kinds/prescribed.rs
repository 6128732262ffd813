//! Motion of a part that a drive prescribes: a place that is constant, or a law over time. (T7)

use crate::error::Problem;
use crate::math::expression::Expression;
use crate::number;

/// Place or angle of a part over time.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub enum PrescribedMotion {
    /// Constant: the part is locked there.
    Constant(f64),
    /// Expression of the single variable `t` (s).
    Law(Expression),
}

impl PrescribedMotion {
    /// The place that it never leaves; none of one that changes.
    #[must_use]
    pub fn constant(&self) -> Option<f64> {
        match self {
            Self::Constant(value) => Some(*value),
            Self::Law(law) => (!law.uses(0)).then(|| law.value(&[0.0])),
        }
    }

    /// The place at the start.
    #[must_use]
    pub fn at_start(&self) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Law(law) => law.value(&[0.0]),
        }
    }

    /// The law of one that changes.
    #[must_use]
    pub fn law(&self) -> Option<&Expression> {
        match self {
            Self::Law(law) if law.uses(0) => Some(law),
            _ => None,
        }
    }

    /// Refuses one that has no value at the start.
    pub(crate) fn check(&self) -> Result<(), Problem> {
        number::finite(&[self.at_start()])
    }
}
