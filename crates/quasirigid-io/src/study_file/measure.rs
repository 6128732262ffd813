//! Numbers of a study with one unit in common: the first one's, in which all are computed and handed to the model.

use crate::model::value::Value;
use crate::units::{Dimension, Measure};

/// Numbers in one unit.
pub(super) struct Measures {
    pub(super) numbers: Vec<f64>,
    /// The unit; none of plain numbers, which are in SI units.
    pub(super) unit: Option<String>,
}

/// Reads numbers, all plain or all with units of one dimension; converts them to the unit of the first.
pub(super) fn measures(values: &[Value<'_>]) -> Option<Measures> {
    let first = values.first()?;
    let Some(text) = first.words() else {
        let numbers = values.iter().map(|value| plain(value)).collect::<Vec<_>>();
        return Some(Measures { numbers: numbers.into_iter().collect::<Option<_>>()?, unit: None });
    };
    let unit = measure(first, text)?;
    let converted = values.iter().map(|value| {
        let Some(text) = value.words() else {
            return value.refuse(
                format!("`{}`: a number without a unit beside {text:?}", value.key()),
                "no unit",
                format!("write it in quotes with its unit, such as \"1 {}\"", unit.unit),
            );
        };
        let other = measure(value, text)?;
        other.in_unit_of(&unit).or_else(|| {
            value.refuse(
                format!(
                    "`{}`: {text:?} does not measure the same as the numbers in {}",
                    value.key(),
                    unit.unit
                ),
                "another dimension",
                format!("write all in units such as {}", unit.unit),
            )
        })
    });
    let numbers = converted.collect::<Vec<_>>().into_iter().collect::<Option<Vec<_>>>()?;
    Some(Measures { numbers, unit: Some(unit.unit.to_owned()) })
}

fn plain(value: &Value<'_>) -> Option<f64> {
    if value.words().is_some() {
        return value.refuse(
            format!("`{}`: a number with a unit beside one without", value.key()),
            "a unit",
            "write all with units, or all as plain numbers in SI units",
        );
    }
    value.quantity(Dimension::NUMBER)
}

fn measure<'a>(value: &Value<'_>, text: &'a str) -> Option<Measure<'a>> {
    match Measure::parse(text) {
        Ok(measure) => Some(measure),
        Err(error) => value.refuse(
            format!("`{}`: {error}", value.key()),
            "a number with its unit is needed",
            error.advice(),
        ),
    }
}
