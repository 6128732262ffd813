//! Values of options: words of settings, numbers, times.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use quasirigid_io::model::Named;
use quasirigid_io::units::{Dimension, quantity};

use crate::failure::Failure;

/// Parser of a word of a setting.
pub(crate) fn named<T: Named>() -> impl TypedValueParser<Value = T> {
    let value = |(name, value, help): &(&'static str, T, &'static str)| {
        let former = T::FORMER.iter().filter(|(_, renamed)| renamed == value).map(|(former, _)| *former);
        let possible = PossibleValue::new(*name).aliases(former);
        if help.is_empty() { possible } else { possible.help(*help) }
    };
    PossibleValuesParser::new(T::VALUES.iter().map(value))
        .try_map(|name| T::of(&name).ok_or("no such setting"))
}

/// Reads so many numbers.
pub(super) fn numbers<T: std::str::FromStr, const N: usize>(text: &str) -> Option<[T; N]> {
    let found: Option<Vec<T>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
    <[T; N]>::try_from(found?).ok()
}

/// A time (s) given on the command line.
pub fn seconds(text: &str) -> Result<f64, Failure> {
    match text.parse() {
        Ok(seconds) => Ok(seconds),
        Err(_) => quantity(text, Dimension::TIME)
            .map_err(|cause| Failure::Duration { text: text.to_owned(), cause: Box::new(cause) }),
    }
}

/// A positive time (s) of an option.
pub fn positive_seconds(option: &'static str, text: &str) -> Result<f64, Failure> {
    let read = text.parse().or_else(|_| quantity(text, Dimension::TIME));
    let seconds: f64 =
        read.map_err(|cause| Failure::Time { option, text: text.to_owned(), cause: Box::new(cause) })?;
    positive(option, seconds)
}

/// A positive number of an option.
pub fn positive(option: &'static str, value: f64) -> Result<f64, Failure> {
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err(Failure::NotPositive { option, value }) }
}
