//! Numbers that are known from elsewhere, with their deviation or their range: `evolve.time = 12 h +- 1 h`, `spring.1.damping = 0.02..0.2`.

use std::fmt;
use std::path::Path;
use std::str::FromStr;

use thiserror::Error;

use crate::text_file::{self, FileError, Place, ReadProblem, Unread, bytes_of, no_text_table, unread_table};
use crate::units::{Measure, number_in};
use crate::visible::Excerpt;

/// Largest file that is read (bytes).
const MAX_FILE: u64 = 1024 * 1024;
/// Signs between a value and its deviation.
pub(crate) const SIGNS: [&str; 3] = ["+-", "+/-", "±"];

/// A number with a unit, if one is written.
#[derive(Clone, Debug, PartialEq)]
pub struct Amount {
    /// The number.
    pub number: f64,
    /// Its unit as written; none of a plain number.
    pub unit: Option<String>,
}

/// A name whose number is known with a standard deviation.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// The name.
    pub name: String,
    /// The value.
    pub value: Amount,
    /// Its standard deviation, positive.
    pub sigma: Amount,
}

/// A name whose number lies in a range.
#[derive(Clone, Debug, PartialEq)]
pub struct Limits {
    /// The name.
    pub name: String,
    /// Least value; none if there is none.
    pub low: Option<Amount>,
    /// Greatest value; none if there is none.
    pub high: Option<Amount>,
}

/// A text that gives no number with its deviation or its range.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{0}")]
pub struct EstimateError(String);

/// A file that gives no numbers with deviations, with the place and the problem.
pub type EstimateFileError = FileError<EstimateError>;

impl EstimateError {
    pub(crate) fn new(problem: String) -> Self {
        Self(problem)
    }
}

impl ReadProblem for EstimateError {
    fn unread(unread: Unread, limit: u64) -> Self {
        Self(unread_table(unread, limit))
    }

    fn not_text(byte: u8) -> Self {
        Self(no_text_table(byte))
    }
}

impl Amount {
    /// The number in a unit, in which a plain number is; none where the two measure different things.
    #[must_use]
    pub fn in_unit(&self, unit: &str) -> Option<f64> {
        match &self.unit {
            None => Some(self.number),
            Some(own) if own == unit => Some(self.number),
            Some(own) => number_in(&format!("{} {own}", self.number), unit),
        }
    }

    /// The number in SI units, in which a plain number is; none of hertz, which may be revolutions.
    #[must_use]
    pub fn in_si(&self) -> Option<f64> {
        match &self.unit {
            None => Some(self.number),
            Some(_) => Measure::parse(&self.to_string()).ok()?.in_si(),
        }
    }

    pub(crate) fn read(text: &str) -> Result<Self, EstimateError> {
        let text = text.trim();
        if let Some(number) = text.parse::<f64>().ok().filter(|number| number.is_finite()) {
            return Ok(Self { number, unit: None });
        }
        let found = Measure::parse(text);
        let found = found.map_err(|_| {
            EstimateError(format!("{:?} is no number, alone or with a unit", Excerpt::from(text)))
        })?;
        Ok(Self { number: found.number, unit: Some(found.unit.to_owned()) })
    }
}

impl fmt::Display for Amount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.unit {
            None => write!(f, "{}", self.number),
            Some(unit) => write!(f, "{} {unit}", self.number),
        }
    }
}

impl FromStr for Estimate {
    type Err = EstimateError;

    fn from_str(text: &str) -> Result<Self, EstimateError> {
        let (name, known) = named(text, "evolve.time = 12 h +- 1 h")?;
        let sign = SIGNS.iter().find_map(|sign| known.split_once(sign));
        let (value, sigma) = sign.ok_or_else(|| {
            EstimateError(format!("{name} has no deviation: write {known} +- its deviation"))
        })?;
        let value = if value.trim().parse::<f64>().is_ok() {
            Amount { unit: percentless(sigma)?, ..Amount::read(value)? }
        } else {
            Amount::read(value)?
        };
        let sigma = deviation(&value, sigma)?;
        if sigma.unit.is_none() && value.unit.is_some() {
            let unit = value.unit.as_deref().unwrap_or_default();
            return Err(EstimateError(format!(
                "the deviation of {name} has no unit: write {sigma} {unit}, or {sigma} % if it is a share of the value"
            )));
        }
        if sigma.number > 0.0 && sigma.number.is_finite() {
            return Ok(Self { name, value, sigma });
        }
        Err(EstimateError(format!("the deviation of {name} is {sigma}, but must be positive")))
    }
}

/// Unit of a deviation, which is also that of a plain value before it; none of a share.
fn percentless(sigma: &str) -> Result<Option<String>, EstimateError> {
    if sigma.trim().ends_with('%') { Ok(None) } else { Ok(Amount::read(sigma)?.unit) }
}

/// Deviation of a value, perhaps as a share of it in per cent.
fn deviation(value: &Amount, text: &str) -> Result<Amount, EstimateError> {
    let Some(share) = text.trim().strip_suffix('%') else { return Amount::read(text) };
    let share = Amount::read(share)?;
    Ok(Amount { number: 0.01 * share.number * value.number.abs(), unit: value.unit.clone() })
}

impl FromStr for Limits {
    type Err = EstimateError;

    fn from_str(text: &str) -> Result<Self, EstimateError> {
        let (name, range) = named(text, "spring.1.damping = 0.02..0.2")?;
        let Some((low, high)) = range.split_once("..") else {
            return Err(EstimateError(format!(
                "{name} has no range: write {name} = LOW..HIGH, LOW.. or ..HIGH"
            )));
        };
        let end = |text: &str| (!text.trim().is_empty()).then(|| Amount::read(text)).transpose();
        let (mut low, high) = (end(low)?, end(high)?);
        if let (Some(Amount { unit: unit @ None, .. }), Some(high)) = (&mut low, &high) {
            unit.clone_from(&high.unit);
        }
        if low.is_none() && high.is_none() {
            return Err(EstimateError(format!("the range of {name} has no end")));
        }
        Ok(Self { name, low, high })
    }
}

/// Name and text of an assignment.
fn named<'a>(text: &'a str, example: &str) -> Result<(String, &'a str), EstimateError> {
    let parts = text.rsplit_once('=').map(|(name, value)| (name.trim(), value.trim()));
    match parts {
        Some((name, value)) if !name.is_empty() && !value.is_empty() => Ok((name.to_owned(), value)),
        _ => Err(EstimateError(format!("{:?} is no statement such as {example}", Excerpt::from(text)))),
    }
}

/// Reads one number with its deviation from each line; what follows a `#` is a remark.
///
/// # Errors
/// [`EstimateFileError`] says what is wrong and where.
pub fn read_estimates(file: &Path) -> Result<Vec<Estimate>, EstimateFileError> {
    let bytes = bytes_of(file, MAX_FILE)?;
    of_bytes(&bytes).map_err(FileError::new(file))
}

fn of_bytes(bytes: &[u8]) -> Result<Vec<Estimate>, text_file::Fault<EstimateError>> {
    let lines = text_file::lines(text_file::text(bytes)?);
    let said = lines.map(|(line, text)| (line, text.split('#').next().unwrap_or_default().trim()));
    let read = |(line, text): (usize, &str)| text.parse().map_err(|problem| (Place::Line(line), problem));
    let found = said.filter(|(_, text)| !text.is_empty()).map(read).collect::<Result<Vec<Estimate>, _>>()?;
    if found.is_empty() {
        let problem = "there is nothing in it; write lines such as evolve.time = 12 h +- 1 h";
        return Err((Place::File, EstimateError(problem.to_owned())));
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn amount(number: f64, unit: &str) -> Amount {
        Amount { number, unit: (!unit.is_empty()).then(|| unit.to_owned()) }
    }

    #[test]
    fn numbers_are_read_with_their_deviations() {
        for (text, value, sigma) in [
            ("a.b = 12 h +- 1 h", amount(12.0, "h"), amount(1.0, "h")),
            ("a.b=12 h ± 30 min", amount(12.0, "h"), amount(30.0, "min")),
            ("a.b = 12 +/- 1 h", amount(12.0, "h"), amount(1.0, "h")),
            ("a.b = -1.5e-3 +- 2", amount(-1.5e-3, ""), amount(2.0, "")),
            ("a.b = -40 N/m +- 5 %", amount(-40.0, "N/m"), amount(2.0, "N/m")),
            ("a.b = 40 +- 5%", amount(40.0, ""), amount(2.0, "")),
        ] {
            assert_eq!(text.parse(), Ok(Estimate { name: "a.b".to_owned(), value, sigma }), "{text}");
        }
    }

    #[test]
    fn ranges_may_be_open() {
        let range = |text: &str| {
            let Limits { low, high, .. } = text.parse().unwrap();
            (low, high)
        };
        assert_eq!(range("k = 1..2.5 N/m"), (Some(amount(1.0, "N/m")), Some(amount(2.5, "N/m"))));
        assert_eq!(range("k = -1e3 .."), (Some(amount(-1e3, "")), None));
        assert_eq!(range("k = ..5 kN/m"), (None, Some(amount(5.0, "kN/m"))));
    }

    #[test]
    fn files_hold_a_number_in_each_line() {
        let found =
            of_bytes(b"# rest\n\nmodes.nutation.frequency = 0.2 +- 0.01 # rad/s\nevolve.time = 3 d +- 1 d\n");
        assert_eq!(found.unwrap().len(), 2);
        let (place, problem) = of_bytes(b"a = 1 +- 1\nevolve.time = 3 d\n").unwrap_err();
        assert_eq!((place, problem.to_string().contains("has no deviation")), (Place::Line(2), true));
    }

    #[test]
    fn what_is_no_estimate_is_told() {
        for (text, told) in [
            ("evolve.time", "is no statement such as"),
            ("= 3 +- 1", "is no statement such as"),
            ("a = 3", "has no deviation"),
            ("a = 3 h +- 1", "write 1 h, or 1 % if"),
            ("a = 3 +- 0", "must be positive"),
            ("a = 3 +- -1 h", "must be positive"),
            ("a = x +- 1", "is no number"),
            ("a = nan +- 1", "is no number"),
            ("a = 0 +- 5 %", "must be positive"),
        ] {
            let found = text.parse::<Estimate>().unwrap_err().to_string();
            assert!(found.contains(told), "{text}: {found}");
        }
        for text in ["a = 3", "a = ..", "a = x..y"] {
            assert!(text.parse::<Limits>().is_err(), "{text}");
        }
    }

    #[test]
    fn amounts_are_in_the_unit_asked_for() {
        assert_eq!(amount(2.0, "h").in_unit("s"), Some(7200.0));
        assert_eq!(amount(2.0, "").in_unit("s"), Some(2.0));
        assert_eq!(amount(2.0, "h").in_unit("kg"), None);
        assert_eq!(amount(2.0, "h").in_unit(""), None);
        assert_eq!(amount(2.0, "kN/m").in_si(), Some(2000.0));
        assert_eq!(amount(2.0, "Hz").in_si(), None);
    }
}
