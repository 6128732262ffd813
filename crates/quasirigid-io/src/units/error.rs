//! Errors of quantities with units, with advice for each.
//! Advice is apart from the message because a diagnostic shows it on its own line; a unit that is nearly a known one is suggested.

use thiserror::Error;

use super::Dimension;

/// A text that is not a quantity of the dimension asked for.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum UnitError {
    /// Nothing but spaces.
    #[error("an empty text, where {} is needed", dimension.name())]
    Empty {
        /// Dimension that was asked for.
        dimension: Dimension,
    },
    /// The text does not start with a decimal number.
    #[error("{text:?} is not a decimal number with a unit")]
    NotANumber {
        /// The text.
        text: String,
        /// Dimension that was asked for.
        dimension: Dimension,
    },
    /// The number is NaN or infinite.
    #[error("{text:?} is not a finite number")]
    NotFinite {
        /// The text.
        text: String,
    },
    /// The number in SI units is too large or too small for a floating-point number.
    #[error("{text:?} is too large or too small to compute with")]
    OutOfRange {
        /// The text.
        text: String,
    },
    /// A number without a unit.
    #[error("{text:?} is a text without a unit")]
    NoUnit {
        /// The text.
        text: String,
        /// Dimension that was asked for.
        dimension: Dimension,
    },
    /// A symbol that is not a unit.
    #[error("there is no unit {symbol:?}")]
    UnknownUnit {
        /// The symbol.
        symbol: String,
        /// The unit that the symbol probably means.
        suggestion: Option<&'static str>,
    },
    /// The unit measures something else.
    #[error("{text:?} is {found}, but {} is needed", needed.name())]
    WrongDimension {
        /// The text.
        text: String,
        /// Quantity that the unit measures, in words.
        found: String,
        /// Dimension that was asked for.
        needed: Dimension,
    },
    /// Hertz for an angular velocity: it may mean revolutions or radians per second.
    #[error("{text:?} may mean revolutions or radians per second")]
    Hertz {
        /// The text.
        text: String,
    },
    /// A product after a division, as in `N/m s`.
    #[error("in the unit {unit:?} it is not clear what is divided by what")]
    AmbiguousQuotient {
        /// The unit.
        unit: String,
    },
    /// Something in the unit is neither symbol nor operator.
    #[error("the unit {unit:?} cannot be read: {}", obstacle(*found))]
    Syntax {
        /// The unit.
        unit: String,
        /// The character in the way; none at the end.
        found: Option<char>,
    },
    /// A power no unit has.
    #[error("the power {exponent} in a unit is not an integer from -9 to 9")]
    Power {
        /// The exponent as written.
        exponent: String,
    },
    /// Parentheses within parentheses, many times.
    #[error("the parentheses of the unit are nested too deeply")]
    TooDeep,
    /// A text longer than any quantity.
    #[error("a text of {length} bytes is too long for a number with a unit")]
    TooLong {
        /// Length in bytes.
        length: usize,
    },
}

impl UnitError {
    /// Advice: a text to write instead.
    #[must_use]
    pub fn advice(&self) -> String {
        match self {
            Self::Empty { dimension } | Self::NotANumber { dimension, .. } => example(*dimension),
            Self::NotFinite { .. } => "write a finite number".to_owned(),
            Self::OutOfRange { .. } => "check the exponent".to_owned(),
            Self::NoUnit { text, dimension } if dimension.unit().is_empty() => {
                format!("write {text} without the quotes")
            }
            Self::NoUnit { text, dimension } => {
                format!("add the unit, or write {text} without the quotes for {text} {}", dimension.unit())
            }
            Self::UnknownUnit { suggestion: Some(unit), .. } => format!("did you mean \"{unit}\"?"),
            Self::UnknownUnit { suggestion: None, .. } => {
                "units are symbols, for example kg, lb, m, in, s, h, rad, deg, rpm, N, lbf".to_owned()
            }
            Self::WrongDimension { text, needed, .. } if text.contains("lb") && !text.contains("lbf") => {
                format!("lb is the mass, lbf the force; {}", example(*needed))
            }
            Self::WrongDimension { needed, .. } => example(*needed),
            Self::Hertz { .. } => "write rev/s or rad/s".to_owned(),
            Self::AmbiguousQuotient { .. } => {
                "write the quotient last or use parentheses: \"N s/m\" or \"N/(m s)\"".to_owned()
            }
            Self::Syntax { .. } | Self::Power { .. } | Self::TooDeep | Self::TooLong { .. } => {
                "write for example \"N m/rad\", \"kg*m^2\" or \"N/(m s)\"".to_owned()
            }
        }
    }
}

fn example(dimension: Dimension) -> String {
    if dimension.unit().is_empty() {
        "write a number without quotes".to_owned()
    } else {
        format!("write for example \"{}\", or a plain number in {}", dimension.example(), dimension.unit())
    }
}

fn obstacle(found: Option<char>) -> String {
    found.map_or_else(|| "it ends too early".to_owned(), |found| format!("{found:?} is not allowed there"))
}
