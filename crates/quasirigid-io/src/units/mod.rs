//! Numbers with units: `"750 rpm"`, `"22 in"`, `"12.5 lbf/in"`, `"0.565 N m/rad"`.
//!
//! A unit is a product of symbols. A space, `*` or `·` multiplies, `/` divides by the next factor alone, `^` or `**`
//! raises to an integer power, and parentheses group. SI prefixes stand before SI symbols.

mod dimension;
mod error;
mod expression;
mod symbols;

pub use dimension::Dimension;
pub use error::UnitError;

use std::f64::consts::TAU;

use expression::Expression;

/// Longest text that is read; no unit that means something comes near it.
const LONGEST_TEXT: usize = 200;

/// The SI value of a number with its unit.
///
/// ```
/// use quasirigid_io::units::{Dimension, quantity};
///
/// assert_eq!(quantity("22 in", Dimension::LENGTH)?, 0.5588);
/// # Ok::<(), quasirigid_io::units::UnitError>(())
/// ```
///
/// The radian may be left out where the dimension has it: `"N m"` is a rotational stiffness as well as `"N m/rad"`.
///
/// # Errors
/// [`UnitError`] says what is wrong with the text, and its [`advice`](UnitError::advice) what to write.
pub fn quantity(text: &str, dimension: Dimension) -> Result<f64, UnitError> {
    if text.len() > LONGEST_TEXT {
        return Err(UnitError::TooLong { length: text.len() });
    }
    let (number, unit) = split(text.trim(), dimension)?;
    let expression = Expression::parse(unit)?;
    if expression.hertz && dimension == Dimension::ANGULAR_VELOCITY {
        return Err(UnitError::Hertz { text: text.to_owned() });
    }
    if !dimension.accepts(expression.exponents) {
        return Err(UnitError::WrongDimension {
            text: text.to_owned(),
            found: Dimension::describe(expression.exponents),
            needed: dimension,
        });
    }
    let turns = expression.hertz && dimension == Dimension::FREQUENCY && !expression.has_angle();
    let value = expression.in_si(number) * if turns { TAU } else { 1.0 };
    if value.is_finite() && (value != 0.0 || number == 0.0) {
        Ok(value)
    } else {
        Err(UnitError::OutOfRange { text: text.to_owned() })
    }
}

/// Number with a unit of any dimension, for values that are handed on with their unit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Measure<'a> {
    /// The number in the unit.
    pub(crate) number: f64,
    /// The unit as written.
    pub(crate) unit: &'a str,
    expression: Expression,
}

/// The number of a text with a unit, in another unit of the same dimension.
#[must_use]
pub fn number_in(text: &str, unit: &str) -> Option<f64> {
    let one = format!("1 {unit}");
    let (measure, unit) = (Measure::parse(text).ok()?, Measure::parse(&one).ok()?);
    measure.in_unit_of(&unit)
}

impl<'a> Measure<'a> {
    /// Reads a number with a unit that exists.
    pub(crate) fn parse(text: &'a str) -> Result<Self, UnitError> {
        if text.len() > LONGEST_TEXT {
            return Err(UnitError::TooLong { length: text.len() });
        }
        let (number, unit) = split(text.trim(), Dimension::NUMBER)?;
        Ok(Self { number, unit, expression: Expression::parse(unit)? })
    }

    /// The number in SI units; none of hertz, which are two things.
    pub(crate) fn in_si(&self) -> Option<f64> {
        (!self.expression.hertz).then(|| self.expression.in_si(self.number))
    }

    /// The number in the unit of another measure; none where the two measure different things.
    pub(crate) fn in_unit_of(&self, other: &Self) -> Option<f64> {
        let (own, theirs) = (&self.expression, &other.expression);
        if self.unit == other.unit {
            return Some(self.number);
        }
        let alike = own.exponents == theirs.exponents && own.hertz == theirs.hertz;
        alike.then(|| own.in_si(self.number) / theirs.in_si(1.0))
    }
}

/// The number at the start of a text, and the unit after it.
fn split(text: &str, dimension: Dimension) -> Result<(f64, &str), UnitError> {
    if text.is_empty() {
        return Err(UnitError::Empty { dimension });
    }
    let (digits, unit) = text.split_at(number_length(text));
    let Ok(number) = digits.parse::<f64>() else {
        let word = text.trim_start_matches(['+', '-']).to_lowercase();
        return Err(if word.starts_with("nan") || word.starts_with("inf") {
            UnitError::NotFinite { text: text.to_owned() }
        } else {
            UnitError::NotANumber { text: text.to_owned(), dimension }
        });
    };
    if !number.is_finite() {
        return Err(UnitError::OutOfRange { text: text.to_owned() });
    }
    match unit.trim() {
        "" => Err(UnitError::NoUnit { text: text.to_owned(), dimension }),
        unit if unit.starts_with([',', '_', '\'']) => {
            Err(UnitError::NotANumber { text: text.to_owned(), dimension })
        }
        unit => Ok((number, unit)),
    }
}

/// Length of the decimal number a text starts with: sign, digits with a point, and an exponent if it has digits.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |from: usize| bytes.iter().skip(from).take_while(|byte| byte.is_ascii_digit()).count();
    let sign = |at: usize| usize::from(matches!(bytes.get(at), Some(b'+' | b'-')));
    let mut end = sign(0);
    end += digits(end);
    if bytes.get(end) == Some(&b'.') {
        end += 1 + digits(end + 1);
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let exponent = end + 1 + sign(end + 1);
        if digits(exponent) > 0 {
            end = exponent + digits(exponent);
        }
    }
    end
}

#[cfg(test)]
mod tests;
