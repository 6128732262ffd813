//! Distributions from which keys are drawn, as they are written: uniform, log-uniform, normal and log-normal, the last two truncated on
//! request. Their quantiles are computed where the draws are made.

use super::grid::ENDS;
use super::measure::{Measures, measures};
use crate::model::key::{Key, Keys, NUMBER, key, quantity, table};
use crate::model::table::Table;
use crate::model::value::Value;
use crate::units::Dimension;

/// Distribution of a number.
#[derive(Clone, Debug, PartialEq)]
pub enum Distribution {
    /// Equal probability between two ends.
    Uniform([f64; 2]),
    /// Equal probability of the logarithm between two positive ends.
    LogUniform([f64; 2]),
    /// Normal distribution, truncated to a range that may be infinite.
    Normal {
        /// Mean before truncation.
        mean: f64,
        /// Standard deviation before truncation.
        deviation: f64,
        /// Least and greatest value.
        range: [f64; 2],
    },
    /// Distribution whose logarithm is normal, truncated to a range that may be infinite.
    LogNormal {
        /// Median before truncation.
        median: f64,
        /// Standard deviation of the natural logarithm before truncation.
        sigma: f64,
        /// Least and greatest value.
        range: [f64; 2],
    },
}

/// Distribution with the unit of its numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// Distribution of the number in the unit.
    pub distribution: Distribution,
    /// Unit of the number; none for plain numbers, in SI units.
    pub unit: Option<String>,
}

pub(super) const UNIFORM: Keys = Keys { known: &[key("uniform", ENDS, "equal probability between them")] };
pub(super) const LOG_UNIFORM: Keys =
    Keys { known: &[key("log-uniform", ENDS, "equal probability of the logarithm")] };
pub(super) const NORMAL: Keys = Keys { known: &[key("normal", table(&NORMAL_KEYS), "")] };
pub(super) const LOG_NORMAL: Keys = Keys { known: &[key("log-normal", table(&LOG_NORMAL_KEYS), "")] };

const MIN: Key = key("min", quantity("any unit").or("none"), "truncated below");
const MAX: Key = key("max", quantity("any unit").or("none"), "truncated above");
const NORMAL_KEYS: Keys = Keys {
    known: &[
        key("mean", quantity("any unit"), ""),
        key("deviation", quantity("any unit"), "standard"),
        MIN,
        MAX,
    ],
};
const LOG_NORMAL_KEYS: Keys = Keys {
    known: &[
        key("median", quantity("any unit"), ""),
        key("decades", NUMBER, "powers of ten in one standard deviation"),
        key("sigma", NUMBER, "instead, of the natural logarithm"),
        MIN,
        MAX,
    ],
};

/// Reads `uniform = [least, greatest]`, or the same with `log-uniform`.
pub(super) fn uniform(value: &Value<'_>, logarithmic: bool) -> Option<Drawn> {
    let [least, greatest] = value.array("numbers", Some)?;
    let Measures { numbers, unit } = measures(&[least, greatest])?;
    let ends = [numbers[0], numbers[1]];
    if !(ends[0] < ends[1] && (ends[1] - ends[0]).is_finite()) {
        return impossible(value, "the first number must be below the second", "write [least, greatest]");
    }
    if logarithmic && !(ends[0] > 0.0) {
        return impossible(
            value,
            "a logarithm needs numbers above zero",
            "write two positive numbers, or take `uniform`",
        );
    }
    let distribution = if logarithmic { Distribution::LogUniform(ends) } else { Distribution::Uniform(ends) };
    Some(Drawn { distribution, unit })
}

/// Reads `normal = { mean, deviation, min, max }`.
pub(super) fn normal(value: &Value<'_>) -> Option<Drawn> {
    let table = value.table("`normal`", &NORMAL_KEYS)?;
    let mean = table.required("mean", "mean = 1.0");
    let deviation = table.required("deviation", "deviation = 0.1");
    let (mean, deviation) = (mean?, deviation?);
    let (given, range, unit) = truncated(&table, &[mean, deviation])?;
    let distribution = Distribution::Normal { mean: given[0], deviation: given[1], range };
    if !(given[1] > 0.0) {
        return impossible(&deviation, "a standard deviation must be above zero", "write a positive number");
    }
    possible(value, range, [given[0], given[1]])?;
    Some(Drawn { distribution, unit })
}

/// Reads `log-normal = { median, decades or sigma, min, max }`.
pub(super) fn log_normal(value: &Value<'_>) -> Option<Drawn> {
    let table = value.table("`log-normal`", &LOG_NORMAL_KEYS)?;
    let median = table.required("median", "median = 100.0");
    let sigma = match (table.get("decades"), table.get("sigma")) {
        (Some(decades), None) => {
            decades.positive(Dimension::NUMBER).map(|decades| decades * std::f64::consts::LN_10)
        }
        (None, Some(sigma)) => sigma.positive(Dimension::NUMBER),
        (Some(_), Some(sigma)) => impossible(
            &sigma,
            "the width is given twice",
            "write `decades`, or `sigma` of the natural logarithm",
        ),
        (None, None) => {
            table.required("decades", "decades = 0.5, the standard deviation in powers of ten");
            None
        }
    };
    let median = median?;
    let (given, range, unit) = truncated(&table, &[median])?;
    if !(given[0] > 0.0) {
        return impossible(
            &median,
            "the median of a log-normal distribution must be above zero",
            "write a positive number",
        );
    }
    let sigma = sigma?;
    possible(
        value,
        range.map(|end| if end > 0.0 { end.ln() } else { f64::NEG_INFINITY }),
        [given[0].ln(), sigma],
    )?;
    Some(Drawn { distribution: Distribution::LogNormal { median: given[0], sigma, range }, unit })
}

/// Numbers, the range to which a distribution is truncated, and their unit.
fn truncated(table: &Table<'_>, given: &[Value<'_>]) -> Option<(Vec<f64>, [f64; 2], Option<String>)> {
    let (min, max) = (table.get("min"), table.get("max"));
    let all: Vec<Value<'_>> = given.iter().copied().chain(min).chain(max).collect();
    let Measures { mut numbers, unit } = measures(&all)?;
    let mut rest = numbers.split_off(given.len()).into_iter();
    let least = min.and_then(|_| rest.next()).unwrap_or(f64::NEG_INFINITY);
    let greatest = max.and_then(|_| rest.next()).unwrap_or(f64::INFINITY);
    Some((numbers, [least, greatest], unit))
}

/// Standard deviations from the middle beyond which no draw is to be expected from a truncated distribution.
const FAR_DEVIATIONS: f64 = 30.0;

/// Refuses a range that is empty, or so far from the middle that a normal distribution has nothing there.
fn possible(value: &Value<'_>, [least, greatest]: [f64; 2], [middle, deviation]: [f64; 2]) -> Option<()> {
    if !(least < greatest) {
        return impossible(value, "`min` must be below `max`", "write the least and the greatest value");
    }
    if least > middle + FAR_DEVIATIONS * deviation || greatest < middle - FAR_DEVIATIONS * deviation {
        return impossible(
            value,
            "the range from `min` to `max` lies more than 30 standard deviations from the middle",
            "write a range in which the distribution has values",
        );
    }
    Some(())
}

fn impossible<T>(value: &Value<'_>, reason: &str, help: &str) -> Option<T> {
    value.refuse(format!("no such distribution: {reason}"), "impossible", help)
}
