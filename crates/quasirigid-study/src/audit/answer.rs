//! Answer of an audit: its numbers as they are told to machines, and whether they keep the limits that were asked for.

use quasirigid::model::Mode;
use quasirigid_io::record::InputsRecord;
use serde::Serialize;

use super::drift::{Drift, Interval};
use super::measure::{Measured, UnitSource};
use super::model::OfModel;
use super::order::OrderObject;
use super::trend::Trend;

/// Audit of a history; the first paragraph of a field is the reference of `--json` in the guide.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Audit {
    /// Result in a few sentences, the verdict first.
    pub sentence: String,
    /// Change of the angular momentum from the first row to the last, relative.
    pub momentum_drift: f64,
    /// Change of the energy from the first row to the last, relative.
    pub energy_drift: f64,
    /// Largest change of the angular momentum from the first row to any, relative.
    pub momentum_excursion: f64,
    /// Largest change of the energy from the first row to any, relative.
    pub energy_excursion: f64,
    /// e-folding time (s) of the small wobble that the body does not have, negative where it grows; `null` where nothing is above the digits.
    pub invented_time_constant: Option<f64>,
    /// Standard error of the seen time constant (s), or `null`.
    pub time_constant_error: Option<f64>,
    /// Longest time constant (s) that the digits and the length of the history could show; `null` where there is no wobble.
    pub longest_time_constant: Option<f64>,
    /// e-folding time (s) of the small wobble in the history, or `null`.
    pub seen_time_constant: Option<f64>,
    /// That of the model (s); `null` where it has no dissipation, or is not known.
    pub model_time_constant: Option<f64>,
    /// Share of the seen rate that the model explains; `null` where it is not known.
    pub explained: Option<f64>,
    /// Interval (s) in which energy or angular momentum changed fastest; `null` where neither changed.
    pub worst_interval: Option<[f64; 2]>,
    /// Mode of rotation, `short-axis` or `long-axis`; `null` of a body without wobble.
    pub mode: Option<&'static str>,
    /// Wobble (rad) at the start and the end, mean of an interval; `null` where none is above the digits.
    pub wobble: Option<[f64; 2]>,
    /// Time (s) of the first row beyond the separatrix, or `null`.
    pub crossing: Option<f64>,
    /// Intervals of the history.
    pub dissipation: Vec<IntervalObject>,
    /// Most that rounding of the file makes.
    pub rounding: RoundingObject,
    /// Units of the file.
    pub units: UnitsObject,
    /// Attitude of the file, or `null`.
    pub attitude: Option<AttitudeObject>,
    /// Order of the integrator, of several histories.
    pub order: Option<OrderObject>,
    /// Noun of the angle, for people.
    #[serde(skip)]
    pub(super) nutation: &'static str,
    /// Name of the file.
    pub file: String,
    /// Number of rows.
    pub rows: usize,
    /// Time (s) from the first row to the last.
    pub duration: f64,
    /// Revolutions in that time.
    pub turns: f64,
    /// Whether the limits that were asked for are kept; `null` without any.
    pub within_limits: Option<bool>,
    /// Whether the history is one of a free rigid body with this inertia, or of the model.
    pub holds: bool,
    /// Notes to read before the numbers.
    pub notes: Vec<String>,
    /// What went in.
    pub inputs: InputsRecord,
}

/// Interval of a history.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct IntervalObject {
    /// First and last time (s).
    pub interval: [f64; 2],
    /// Mean wobble (rad), or `null`.
    pub wobble: Option<f64>,
    /// Rate of the energy over the energy (1/s).
    pub relative_power: Option<f64>,
    /// e-folding time (s) of the wobble, negative where it grows; `null` where the interval shows none.
    pub time_constant: Option<f64>,
}

/// Rounding of a file, of two rows together.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RoundingObject {
    /// Of the rates in words.
    pub digits: String,
    /// Of the angular momentum, relative.
    pub momentum: f64,
    /// Of the energy, relative.
    pub energy: f64,
}

/// Units of a file.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct UnitsObject {
    /// Of the rates.
    pub rates: String,
    /// Of the times.
    pub times: String,
    /// Where they were found: `heading`, `motion` or `assumed`.
    pub source: &'static str,
    /// Factor that fits Euler's equations to the numbers, of the units over those of SI after what the heading says; `null` where the rates hardly change.
    pub factor: Option<f64>,
    /// Share of the change of the rates that Euler's equations leave unexplained, or `null`.
    pub misfit: Option<f64>,
}

/// Attitude of a file.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AttitudeObject {
    /// Convention in words.
    pub convention: String,
    /// Share of the rotation that the rates leave unexplained.
    pub misfit: f64,
    /// Angle (rad) of the angular momentum in inertial axes between the first row and the last.
    pub direction_drift: f64,
    /// The largest angle (rad) from the first row to any.
    pub direction_excursion: f64,
}

/// Time constant of an amplitude: positive where it decays. (J3)
pub fn time_constant(trend: Option<&Trend>) -> Option<f64> {
    trend.filter(|trend| trend.is_seen()).map(|trend| -trend.slope.recip())
}

/// Name of a mode.
pub fn mode_name(mode: Mode) -> &'static str {
    match mode {
        Mode::ShortAxis => "short-axis",
        Mode::LongAxis => "long-axis",
    }
}

impl IntervalObject {
    /// The numbers of an interval.
    pub fn of(interval: &Interval) -> Self {
        Self {
            interval: interval.times,
            wobble: interval.wobble,
            relative_power: interval.power.map(|power| power.slope),
            time_constant: time_constant(interval.wobble_trend.as_ref()),
        }
    }
}

impl UnitsObject {
    /// The units of a history.
    pub fn of(measured: &Measured) -> Self {
        let told =
            |heading: &Option<String>, found: &str| heading.clone().unwrap_or_else(|| found.to_owned());
        Self {
            rates: told(&measured.file.rate_unit, measured.units.rates),
            times: told(&measured.file.time_unit, measured.units.times),
            source: match measured.source {
                UnitSource::Heading => "heading",
                UnitSource::Motion if measured.fit.is_some() || measured.attitude.is_some() => "motion",
                UnitSource::Motion | UnitSource::Assumed => "assumed",
            },
            factor: measured.fit.map(|fit| fit.factor),
            misfit: measured.fit.map(|fit| fit.misfit),
        }
    }
}

/// Share of a rate that a model explains, and the rate (1/s) that it does not; the second is none where it may be error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Explained {
    /// Share, if it is known.
    pub share: Option<f64>,
    /// Rate that is left (1/s).
    pub left: Option<f64>,
}

/// Relative error of the rate of a model for a small wobble, beside the square of the wobble.
const MODEL: f64 = 0.02;
/// Standard errors within which a rate is none.
const ERRORS: f64 = 3.0;

impl Explained {
    /// Of a trend of the amplitude, beside the rate of a model.
    pub fn of(drift: &Drift, model: Option<&OfModel>) -> Self {
        let seen = drift.wobble_trend.as_ref().filter(|trend| trend.is_seen());
        let rate = seen.map(|trend| -trend.slope);
        match (model, seen, rate) {
            (Some(OfModel::Rate(of_model)), Some(trend), Some(rate)) => {
                let wobble = drift.wobble().map_or(0.0, |[first, last]| first.max(last));
                let doubt = ERRORS * trend.error + (MODEL + wobble.sin().powi(2)) * of_model.abs();
                Self {
                    share: Some(of_model / rate),
                    left: Some(rate - of_model).filter(|left| left.abs() > doubt),
                }
            }
            _ => Self { share: None, left: rate },
        }
    }
}
