//! Axes: where a value lies on the plot, and the ticks beside it.

use crate::number::{fixed, over_power, power_of_ten};

/// A tick: its place from 0 to 1 and its label.
pub struct Tick {
    /// Place along the axis.
    pub at: f64,
    /// Label, without unit.
    pub label: String,
}

/// A linear or logarithmic axis over a range of values.
///
/// Values are divided by `10ᵖᵒʷᵉʳ`, which the label of the axis names, so that ticks stay short from 10⁻³⁰⁰ to 10³⁰⁰.
/// On a logarithmic axis `low` and `high` are decades.
#[derive(Default)]
pub struct Axis {
    /// Value at 0, over the power.
    pub low: f64,
    /// Value at 1, over the power.
    pub high: f64,
    /// Power of ten taken out of the values.
    pub power: i32,
    /// Whether the axis is logarithmic.
    pub log: bool,
    /// Whether the axis counts: it has ticks at whole numbers alone.
    pub whole: bool,
}

/// Room of a counting axis beside the first and the last number.
const BESIDE: f64 = 0.6;

/// Decades a logarithmic axis shows below the largest value.
const DECADES: f64 = 30.0;

/// A range narrower than this, relative to its values, is drawn as a constant.
const NARROWEST: f64 = 1e-5;
/// Decades below which a logarithmic axis has ticks between the powers of ten.
const FEW_DECADES: f64 = 2.5;
/// Ratio of the largest to the smallest value from which a fitting axis is logarithmic.
const SPREAD: f64 = 30.0;
/// Margin of a fitting axis on both sides, relative to its length.
const MARGIN: f64 = 0.02;
/// Margin of a constant on both sides, relative to its value.
const AROUND_CONSTANT: f64 = 0.1;

impl Axis {
    /// A linear axis over the finite values, widened on both sides by a fraction of its length.
    pub fn linear(values: impl Iterator<Item = f64>, margin: f64) -> Option<Self> {
        let (low, high) = range(values)?;
        let largest = low.abs().max(high.abs());
        if largest < 1e-300 {
            return Some(Self { low: -1.0, high: 1.0, power: 0, log: false, whole: false });
        }
        let exponent = largest.log10().floor() as i32;
        let power = if (-3..5).contains(&exponent) { 0 } else { 3 * exponent.div_euclid(3) };
        let (low, high, largest) =
            (over_power(low, power), over_power(high, power), over_power(largest, power));
        let constant = high - low < NARROWEST * largest;
        let extra = if constant { AROUND_CONSTANT * largest } else { margin * (high - low) };
        Some(Self { low: low - extra, high: high + extra, power, log: false, whole: false })
    }

    /// An axis of whole numbers, with room for the bars of the first and the last, and ticks at whole numbers alone.
    pub fn counting(values: impl Iterator<Item = f64>) -> Option<Self> {
        let (low, high) = range(values)?;
        Some(Self { low: low - BESIDE, high: high + BESIDE, whole: true, ..Self::default() })
    }

    /// A linear axis from zero to a little beyond the largest value.
    pub fn from_zero(values: impl Iterator<Item = f64>) -> Option<Self> {
        let (_, high) = range(values)?;
        Self::linear([0.0, if high > 0.0 { 1.05 * high } else { 1.0 }].into_iter(), 0.0)
    }

    /// A logarithmic axis over the positive values, at most thirty decades, from decade to decade.
    pub fn logarithmic(values: impl Iterator<Item = f64>) -> Option<Self> {
        let (low, high) = range(values.filter(|&value| value > 0.0))?;
        let high = high.log10().ceil();
        let low = low.log10().floor().clamp(high - DECADES, high - 1.0);
        Some(Self { low, high, power: 0, log: true, whole: false })
    }

    /// A logarithmic axis over the positive values, at most thirty decades, without a margin.
    pub fn spanning(values: impl Iterator<Item = f64>) -> Option<Self> {
        let (low, high) = range(values.filter(|&value| value > 0.0))?;
        let high = high.log10();
        Some(Self {
            low: low.log10().clamp(high - DECADES, high - NARROWEST),
            high,
            power: 0,
            log: true,
            whole: false,
        })
    }

    /// An axis on which the finite values are spread: logarithmic for positive values over more than a decade and a half; none unless two
    /// values differ.
    pub fn fitting(values: impl Iterator<Item = f64> + Clone) -> Option<Self> {
        let (low, high) = range(values.clone())?;
        if low > 0.0 && high > SPREAD * low {
            let [low, high] = [low, high].map(f64::log10);
            let extra = MARGIN * (high - low);
            return Some(Self { low: low - extra, high: high + extra, power: 0, log: true, whole: false });
        }
        if high > low { Self::linear(values, MARGIN) } else { None }
    }

    /// Value at a place: the inverse of [`place`](Self::place).
    pub fn value(&self, place: f64) -> f64 {
        let value = self.low + place * (self.high - self.low);
        if self.log { 10f64.powf(value) } else { over_power(value, -self.power) }
    }

    /// Place of a value: 0 at the low end, 1 at the high end; not finite for values that the axis cannot show.
    pub fn place(&self, value: f64) -> f64 {
        let value = if self.log { value.log10() } else { over_power(value, self.power) };
        (value - self.low) / (self.high - self.low)
    }

    /// Some four to seven ticks at round numbers.
    pub fn ticks(&self) -> Vec<Tick> {
        let plain = self.low > f64::MIN_10_EXP.into() && self.high < f64::MAX_10_EXP.into();
        if self.log && plain && self.high - self.low < FEW_DECADES {
            return self.ticks_within_decades();
        }
        let step = if self.log {
            ((self.high - self.low) / 6.0).ceil()
        } else {
            round_step((self.high - self.low) / 6.0).max(if self.whole { 1.0 } else { 0.0 })
        };
        let decimals = (-step.log10().floor()).max(0.0) as usize;
        let tick = |i: i64| {
            let value = i as f64 * step;
            let label = if self.log { decade(value as i32) } else { fixed(value, decimals) };
            Tick { at: (value - self.low) / (self.high - self.low), label }
        };
        let [first, last] = [self.low / step - 1e-9, self.high / step + 1e-9];
        (first.ceil() as i64..=last.floor() as i64).map(tick).collect()
    }

    /// Ticks at 1, 2 and 5 times the powers of ten, for a logarithmic axis over so few decades that these alone would be too few.
    fn ticks_within_decades(&self) -> Vec<Tick> {
        let decades = self.low.floor() as i32..=self.high.floor() as i32;
        let all = decades.flat_map(|power| [1.0, 2.0, 5.0].map(|leading| leading * 10f64.powi(power)));
        let tick = |value: f64| Tick { at: self.place(value), label: crate::number::short(value) };
        all.map(tick).filter(|tick| (0.0..=1.0).contains(&tick.at)).collect()
    }
}

fn decade(exponent: i32) -> String {
    if exponent == 0 { "1".into() } else { power_of_ten(exponent) }
}

fn range(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values.filter(|value| value.is_finite()).fold(None, |range, value| {
        let (low, high) = range.unwrap_or((value, value));
        Some((low.min(value), high.max(value)))
    })
}

/// The next of 1, 2, 5, 10 … times a power of ten.
fn round_step(step: f64) -> f64 {
    let power = 10f64.powf(step.log10().floor());
    let leading = [1.0, 2.0, 5.0].into_iter().find(|leading| leading * power >= step * (1.0 - 1e-9));
    leading.unwrap_or(10.0) * power
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis) -> Vec<String> {
        axis.ticks().into_iter().map(|tick| tick.label).collect()
    }

    #[test]
    fn ticks_are_round_and_inside() {
        let axis = Axis::linear([0.0, 2.0].into_iter(), 0.0).unwrap();
        assert_eq!(labels(&axis), ["0.0", "0.5", "1.0", "1.5", "2.0"]);
        let axis = Axis::linear([-3.1e-7, 4e-7].into_iter(), 0.0).unwrap();
        assert_eq!((axis.power, labels(&axis)), (-9, ["−200", "0", "200", "400"].map(String::from).into()));
        let axis = Axis::logarithmic([0.0, 3e-17, 0.2].into_iter()).unwrap();
        assert_eq!(labels(&axis), ["10⁻¹⁵", "10⁻¹²", "10⁻⁹", "10⁻⁶", "10⁻³", "1"]);
    }

    #[test]
    fn few_decades_have_ticks_between_powers_of_ten() {
        let axis = Axis::fitting([0.2, 7.6].into_iter()).unwrap();
        assert_eq!((axis.log, labels(&axis)), (true, ["0.2", "0.5", "1", "2", "5"].map(String::from).into()));
        let value = axis.value(axis.place(0.7));
        assert!((value / 0.7 - 1.0).abs() < 1e-14, "{value}");
    }

    #[test]
    fn any_range_has_a_few_short_ticks() {
        let ends = [0.0, 5e-324, 1e-300, -1e-7, 1.0, 1.0 + 1e-15, 7e4, 1e300, f64::MAX, -f64::MAX];
        for (low, high) in ends.iter().flat_map(|&low| ends.iter().map(move |&high| (low, high))) {
            let axes =
                [Axis::linear([low, high].into_iter(), 0.05), Axis::logarithmic([low, high].into_iter())];
            for axis in axes.into_iter().flatten() {
                let labels = labels(&axis);
                assert!((2..=11).contains(&labels.len()), "{low:e} {high:e}: {labels:?}");
                assert!(
                    labels.iter().all(|label| label.chars().count() <= 10),
                    "{low:e} {high:e}: {labels:?}"
                );
                assert!(axis.log || axis.place(high).is_finite());
            }
        }
    }
}
