//! Record of a study of many bodies: what was varied, what was asked, and the statistics of the answers.
//! A report reads this and the tables beside it, and nothing else; numbers that JSON cannot write are `null`.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{InputFileRecord, number};

/// Summary of a study of many bodies: `summary.json` of its folder.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct SweepRecord {
    /// Version of the program.
    pub version: String,
    /// Name of the study.
    pub name: String,
    /// SHA-256 of everything that the results depend on: study, model, table, version.
    pub sha256: String,
    /// Files that the results depend on; empty in summaries of versions before this field.
    #[serde(default)]
    pub files: Vec<InputFileRecord>,
    /// What was made of the table of bodies, where that is not plain.
    #[serde(default)]
    pub notes: Vec<String>,
    /// Text of the study.
    pub study: String,
    /// Text of the model that is varied.
    pub model: String,
    /// Number of rows.
    pub rows: u64,
    /// Rows by status: `answered`, `refused`, `invalid`, `failed`.
    pub status: BTreeMap<String, u64>,
    /// Inputs, in the order of the columns.
    pub inputs: Vec<InputRecord>,
    /// Quantities, in the order of the columns.
    pub quantities: Vec<QuantityRecord>,
    /// Rank correlations of numeric inputs with numeric quantities, the strongest first for each quantity.
    pub correlations: Vec<CorrelationRecord>,
    /// Reasons of the rows that are not answered, numbers in them masked, the most frequent first.
    pub reasons: Vec<ReasonRecord>,
}

/// Input of a study.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct InputRecord {
    /// Name of the column.
    pub name: String,
    /// Key of the model that it gives; empty of columns that no model reads, and in summaries of versions before this field.
    #[serde(default)]
    pub key: String,
    /// Unit of the numbers; empty for plain ones, in SI units.
    pub unit: String,
    /// Origin of the values: `grid`, `list`, `distribution`, `table` or `carried` (a column that no model reads).
    pub kind: String,
    /// Points of a grid of numbers; empty otherwise.
    #[serde(with = "number")]
    pub points: Vec<f64>,
    /// Whether the points of the grid are in geometric progression.
    pub geometric: bool,
}

/// Statistics of a quantity.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct QuantityRecord {
    /// Name of the column.
    pub name: String,
    /// Unit of the numbers.
    pub unit: String,
    /// Kind of the values: `number`, `boolean` or `text`.
    pub kind: String,
    /// Rows with a value.
    pub count: u64,
    /// Rows without one.
    pub nulls: u64,
    /// Values that are infinite, among `count`.
    pub infinite: u64,
    /// Percentiles of the values, infinite ones included.
    pub percentiles: Vec<PercentileRecord>,
    /// Mean of the finite values; none without any, and none of time constants of both signs.
    #[serde(with = "number")]
    pub mean: Option<f64>,
    /// First finite value: the least, or of time constants of both signs the fastest decay.
    #[serde(with = "number")]
    pub min: Option<f64>,
    /// Last finite value: the greatest, or of time constants of both signs the fastest growth.
    #[serde(with = "number")]
    pub max: Option<f64>,
    /// Number of rows with each truth value or text, the 50 most frequent; empty for numbers.
    pub counts: BTreeMap<String, u64>,
}

/// Percentile of a quantity.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct PercentileRecord {
    /// Percent of the values below.
    pub percent: f64,
    /// Value; infinite where JSON has `null`.
    #[serde(with = "number::unbounded")]
    pub value: f64,
}

/// Rank correlation after Spearman.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct CorrelationRecord {
    /// Input.
    pub input: String,
    /// Quantity.
    pub quantity: String,
    /// Coefficient, from -1 to 1; none where one of the two does not vary.
    #[serde(with = "number")]
    pub rho: Option<f64>,
    /// Rows with both values.
    pub rows: u64,
    /// Probability of a coefficient as large as this without any dependence; none below 4 rows.
    #[serde(with = "number")]
    pub p: Option<f64>,
}

/// Reason for which rows are not answered.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct ReasonRecord {
    /// Status of the rows.
    pub status: String,
    /// Reason, with `#` in place of numbers.
    pub reason: String,
    /// Number of rows.
    pub count: u64,
    /// First of the rows.
    pub first_row: u64,
    /// Reason of that row, with its numbers.
    pub example: String,
}

/// Uncertainty of an evolution: intervals of its time and its revolutions over draws of the uncertain keys of the model.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct UncertaintyRecord {
    /// Number of draws.
    pub samples: u64,
    /// Draws that were answered; the intervals are over these.
    pub answered: u64,
    /// Intervals of `time` (s) and `turns`.
    pub intervals: Vec<IntervalRecord>,
    /// Rank correlations of the uncertain keys with `time`, the strongest first.
    pub correlations: Vec<CorrelationRecord>,
    /// Reasons of the draws that were not answered.
    pub reasons: Vec<ReasonRecord>,
}

/// Intervals of a quantity between percentiles of equal distance from the median.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct IntervalRecord {
    /// Name of the quantity.
    pub name: String,
    /// Unit of the quantity; empty for pure numbers.
    pub unit: String,
    /// Median.
    #[serde(with = "number::unbounded")]
    pub median: f64,
    /// Percentiles 16 and 84.
    #[serde(with = "number::unbounded")]
    pub interval_68: [f64; 2],
    /// Percentiles 2.5 and 97.5.
    #[serde(with = "number::unbounded")]
    pub interval_95: [f64; 2],
}

/// Numbers of one column of a study, for its page: those of all rows, or of rows evenly chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepColumn {
    /// Name of the input or of the quantity.
    pub name: String,
    /// Values, one per row that is kept; not a number where there is none.
    pub values: Vec<f64>,
}

/// Percentile of ascending numbers, linear between neighbors (R's type 7); none without numbers.
#[must_use]
pub fn percentile(sorted: &[f64], percent: f64) -> Option<f64> {
    let place = percent / 100.0 * (sorted.len().checked_sub(1)?) as f64;
    let (below, above) = (sorted[place.floor() as usize], sorted[place.ceil() as usize]);
    Some(if below == above { below } else { below + (above - below) * place.fract() })
}

/// Whether the values of a quantity are ordered by their rates: time constants of which some are negative, times of growth.
#[must_use]
pub fn by_rate(quantity: &str, values: &[f64]) -> bool {
    quantity.ends_with("time_constant") && values.iter().any(|value| *value < 0.0)
}

/// Rate of growth `−1/τ` (1/s) of a time constant `τ`: negative of a motion that decays, zero of one that stays.
#[must_use]
pub fn growth_rate(time_constant: f64) -> f64 {
    if time_constant.is_infinite() { 0.0 } else { -time_constant.recip() }
}

/// Values of a quantity in their order: of numbers upwards, and of time constants of both signs by the rate of growth, from the fastest decay
/// over what stays to the fastest growth. Upwards the slowest growth would stand before the fastest, and both before every decay.
#[derive(Clone, Debug)]
pub struct Ordered {
    /// Values, or rates of growth.
    sorted: Vec<f64>,
    by_rate: bool,
}

impl Ordered {
    /// The values of a quantity of this name.
    #[must_use]
    pub fn new(quantity: &str, mut values: Vec<f64>) -> Self {
        let by_rate = by_rate(quantity, &values);
        if by_rate {
            values.iter_mut().for_each(|value| *value = growth_rate(*value));
        }
        values.sort_by(f64::total_cmp);
        Self { sorted: values, by_rate }
    }

    /// Number of values.
    #[must_use]
    pub fn len(&self) -> usize {
        self.sorted.len()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.sorted.is_empty()
    }

    /// The values in their order.
    pub fn values(&self) -> impl Iterator<Item = f64> {
        self.sorted.iter().map(|value| self.value(*value))
    }

    /// Percentile of the values; between time constants of both signs, linear in the rate.
    #[must_use]
    pub fn percentile(&self, percent: f64) -> Option<f64> {
        percentile(&self.sorted, percent).map(|value| self.value(value))
    }

    fn value(&self, sorted: f64) -> f64 {
        match (self.by_rate, sorted) {
            (false, value) => value,
            (true, 0.0) => f64::INFINITY,
            (true, rate) => -rate.recip(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_are_linear_between_neighbours() {
        assert_eq!(percentile(&[1.0, 2.0, 4.0], 50.0), Some(2.0));
        assert_eq!(percentile(&[1.0, 2.0, 4.0], 75.0), Some(3.0));
        assert_eq!(percentile(&[1.0, f64::INFINITY], 100.0), Some(f64::INFINITY));
        assert_eq!(percentile(&[f64::INFINITY, f64::INFINITY], 30.0), Some(f64::INFINITY));
        assert_eq!(percentile(&[], 50.0), None);
    }

    /// Of motions that decay in 10 s and 1000 s, one that stays, and two that grow, the middle one stays: by the number of seconds the
    /// slowest growth would be the lowest and the slow decay the middle.
    #[test]
    fn signed_time_constants_are_ordered_from_decay_to_growth() {
        let times = vec![-1000.0, 1000.0, f64::INFINITY, -10.0, 10.0];
        let ordered = Ordered::new("modes.nutation.time_constant", times.clone());
        let upright: Vec<f64> = ordered.values().map(|time| (time * 1e6).round() / 1e6).collect();
        assert_eq!(upright, [10.0, 1000.0, f64::INFINITY, -1000.0, -10.0]);
        assert_eq!(ordered.percentile(50.0), Some(f64::INFINITY));
        let near_last = ordered.percentile(87.5).unwrap_or_default();
        assert!((near_last + 1.0 / (0.5 * (0.1 + 0.001))).abs() < 1e-12, "{near_last}");
        let numbers = Ordered::new("evolve.energy", times);
        assert_eq!(numbers.percentile(0.0), Some(-1000.0));
        let decays = Ordered::new("modes.nutation.time_constant", vec![2.0, 1.0]);
        assert_eq!(decays.percentile(50.0), Some(1.5), "decays alone are numbers like others");
    }
}
