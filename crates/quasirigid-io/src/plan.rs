//! Plans of measurements: sensors with their deviations, and manoeuvres that the same body may fly.

use std::str::FromStr;

use crate::estimate::{Amount, EstimateError, SIGNS};
use crate::model::{KeyPath, KeyValue};
use crate::visible::Excerpt;

/// Deviation of a sensor.
#[derive(Clone, Debug, PartialEq)]
pub enum Deviation {
    /// In a unit.
    Amount(Amount),
    /// Share of the value, from 0 to 1.
    Share(f64),
}

/// What a sensor gives, each with the same deviation: columns of a history, or an answer of a command.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensor {
    /// Names of columns, or the path of an answer.
    pub names: Vec<String>,
    /// Standard deviation of each value, positive.
    pub sigma: Deviation,
}

/// Changes of the model that make another motion of the same body.
#[derive(Clone, Debug, PartialEq)]
pub struct Manoeuvre {
    /// The changes as written.
    pub text: String,
    /// Keys and their values.
    pub changes: Vec<(KeyPath, KeyValue)>,
}

impl FromStr for Sensor {
    type Err = EstimateError;

    fn from_str(text: &str) -> Result<Self, EstimateError> {
        let parts = SIGNS.iter().find_map(|sign| text.split_once(sign));
        let (names, sigma) = parts.ok_or_else(|| {
            EstimateError::new(format!(
                "{:?} is no sensor such as wx,wy,wz +- 0.5 mrad/s",
                Excerpt::from(text)
            ))
        })?;
        let names: Vec<String> =
            names.split(',').map(str::trim).filter(|name| !name.is_empty()).map(str::to_owned).collect();
        if names.is_empty() {
            return Err(EstimateError::new(format!(
                "{:?} names no column and no answer",
                Excerpt::from(text)
            )));
        }
        let share = sigma.trim().strip_suffix('%');
        let amount = Amount::read(share.unwrap_or(sigma))?;
        if !(amount.number > 0.0) {
            return Err(EstimateError::new(format!("the deviation {amount} must be positive")));
        }
        let sigma = match share {
            Some(_) => Deviation::Share(0.01 * amount.number),
            None => Deviation::Amount(amount),
        };
        Ok(Self { names, sigma })
    }
}

impl FromStr for Manoeuvre {
    type Err = EstimateError;

    fn from_str(text: &str) -> Result<Self, EstimateError> {
        let parts = text.split(';').filter(|part| !part.trim().is_empty());
        let changes: Vec<(KeyPath, KeyValue)> = parts.map(change).collect::<Result<_, _>>()?;
        if changes.is_empty() {
            return Err(EstimateError::new("a manoeuvre changes nothing".to_owned()));
        }
        Ok(Self { text: text.trim().to_owned(), changes })
    }
}

/// A key and its value: a number, a list as TOML writes it, or a text such as a number with its unit.
fn change(text: &str) -> Result<(KeyPath, KeyValue), EstimateError> {
    let parts = text.split_once('=').map(|(key, value)| (key.trim(), value.trim()));
    let Some((key, value)) = parts.filter(|(key, value)| !key.is_empty() && !value.is_empty()) else {
        return Err(EstimateError::new(format!(
            "{:?} is no change such as initial.angular_velocity.3 = 2 rad/s",
            Excerpt::from(text)
        )));
    };
    let path = key.parse::<KeyPath>().map_err(|error| EstimateError::new(error.to_string()))?;
    let read = value.parse::<toml::Value>().ok().and_then(|value| key_value(&value));
    Ok((path, read.unwrap_or_else(|| KeyValue::Text(value.to_owned()))))
}

fn key_value(value: &toml::Value) -> Option<KeyValue> {
    Some(match value {
        toml::Value::String(text) => KeyValue::Text(text.clone()),
        toml::Value::Integer(integer) => KeyValue::Integer(*integer),
        toml::Value::Float(number) => KeyValue::Number(*number),
        toml::Value::Boolean(boolean) => KeyValue::Bool(*boolean),
        toml::Value::Array(items) => KeyValue::List(items.iter().map(key_value).collect::<Option<_>>()?),
        toml::Value::Table(entries) => {
            let entry = |(name, value): (&String, &toml::Value)| Some((name.clone(), key_value(value)?));
            KeyValue::Table(entries.iter().map(entry).collect::<Option<_>>()?)
        }
        toml::Value::Datetime(_) => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sensors_have_names_and_one_deviation() {
        let read: Sensor = "wx, wy +- 0.5 mrad/s".parse().unwrap();
        assert_eq!(read.names, ["wx", "wy"]);
        assert_eq!(read.sigma, Deviation::Amount(Amount { number: 0.5, unit: Some("mrad/s".into()) }));
        let read: Sensor = "modes.nutation.frequency ± 2 %".parse().unwrap();
        assert_eq!(read.sigma, Deviation::Share(0.02));
        for text in ["wx", "+- 3", "wx +- 0", "wx +- x", "wx +- -1 %"] {
            assert!(text.parse::<Sensor>().is_err(), "{text}");
        }
    }

    #[test]
    fn manoeuvres_change_keys_to_numbers_lists_and_texts() {
        let text = "initial.angular_velocity = [1, 0.5, 0]; initial.wobble.angle = 5 deg; run.order = 4";
        let read: Manoeuvre = text.parse().unwrap();
        let values: Vec<KeyValue> = read.changes.into_iter().map(|(_, value)| value).collect();
        let list = vec![KeyValue::Integer(1), KeyValue::Number(0.5), KeyValue::Integer(0)];
        assert_eq!(values, [KeyValue::List(list), KeyValue::Text("5 deg".into()), KeyValue::Integer(4)]);
        for text in ["", "carrier.mass", "= 3", "a..b = 3"] {
            assert!(text.parse::<Manoeuvre>().is_err(), "{text}");
        }
    }
}
