//! Units of rates and times that a factor (J2) stands for.

use std::f64::consts::{PI, TAU};

use super::euler::UnitFit;

/// Units of a history, with their SI values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Units {
    /// Unit of the rates.
    pub rates: &'static str,
    /// Unit of the times.
    pub times: &'static str,
    /// SI values of both.
    pub values: [f64; 2],
    /// Further units that the same factor would stand for, in words.
    pub or: Option<&'static str>,
}

const RATES: [(&str, f64); 4] = [("rad/s", 1.0), ("deg/s", PI / 180.0), ("rpm", TAU / 60.0), ("rev/s", TAU)];
const TIMES: [(&str, f64); 2] = [("s", 1.0), ("ms", 1e-3)];
/// Largest deviation of a factor from that of its units, and of the rotation over a stretch of rows (rad), which else would fit by chance.
const TOLERANCE: f64 = 0.03;
const PHASE: f64 = 0.1;
/// Standard errors of the factor within which it agrees, and the largest of them, relative, that still tells units apart.
const ERRORS: f64 = 3.0;
const LARGEST_ERROR: f64 = 0.1;

impl Units {
    /// Radians, and seconds.
    pub const SI: Self = Self { rates: "rad/s", times: "s", values: [1.0, 1.0], or: None };

    /// The units that a file may have that names those that are given.
    pub fn possible(time_known: bool, rates_known: bool) -> Vec<Self> {
        let rates = if rates_known { &RATES[..1] } else { &RATES };
        let times = if time_known { &TIMES[..1] } else { &TIMES };
        let pairs = times.iter().flat_map(|time| rates.iter().map(move |rate| (rate, time)));
        let pairs = pairs.map(|((rates, rate), (times, time))| Self {
            rates,
            times,
            values: [*rate, *time],
            or: (!rates_known && *times == "ms" && *rates == "rad/s")
                .then_some("rates in mrad/s and times in s"),
        });
        pairs.collect()
    }

    /// The units in words.
    pub fn words(&self) -> String {
        format!("{} and {}", self.rates, self.times)
    }

    /// Factor that stands for the units.
    pub fn factor(&self) -> f64 {
        self.values[0] * self.values[1]
    }

    /// Whether a fit has found these units.
    pub fn agree(&self, fit: &UnitFit) -> bool {
        let allowed = if fit.error < LARGEST_ERROR { TOLERANCE.max(ERRORS * fit.error) } else { TOLERANCE };
        let deviation = (fit.factor / self.factor() - 1.0).abs();
        deviation <= allowed && deviation * fit.turn <= PHASE.max(ERRORS * fit.error * fit.turn)
    }
}
