use serde::{Deserialize, Serialize};

use super::{Column, number};

/// The rotation over many turns, averaged over its wobble.
///
/// The columns are `t`, `D_over_I3`, `circled_axis` (1 of least, 3 of greatest inertia), `nutation_min` and
/// `nutation_max` (angle between the momentum and that axis), `energy`, `momentum`, `polhode_period`,
/// `precession_period`, `power`, that of the reduced equations beside it, `polynomial_power`, and `turns`.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct EvolutionRecord {
    /// The answer, in one or two sentences.
    pub sentence: String,
    /// How the mean power was computed, in words.
    pub method: String,
    /// `finished` (the time or the target reached), `interrupted`, or how a torque ended the evolution before: `held` (at the
    /// separatrix), `rest`, `spun-up`, `step-limit`, `failed`.
    pub status: String,
    /// How it ended, in a sentence.
    #[serde(default)]
    pub message: String,
    /// Angular momentum `|K|` at the start (N·m·s).
    #[serde(with = "number")]
    pub momentum: f64,
    /// Mode at the start: `short-axis` or `long-axis`.
    pub mode_start: String,
    /// Mode at the end.
    pub mode_end: String,
    /// `D/I₃ = |K|²/2EI₃` at the start.
    #[serde(with = "number")]
    pub ratio_start: f64,
    /// The same at the end.
    #[serde(with = "number")]
    pub ratio_end: f64,
    /// Time from the start to the end (s), located whatever the rows; infinite where the end is never reached.
    #[serde(with = "number")]
    pub time: f64,
    /// Least and greatest of that time (s) over the ranges of the materials; none where they have no ranges.
    #[serde(with = "number")]
    pub time_range: Option<[f64; 2]>,
    /// Turns about the angular momentum.
    #[serde(with = "number")]
    pub turns: f64,
    /// Mean power dissipated at the start (W).
    #[serde(with = "number")]
    pub power: f64,
    /// Time from the start to the separatrix (s); none when it is not passed.
    #[serde(with = "number")]
    pub separatrix_time: Option<f64>,
    /// Time spent within 1 % of the separatrix (s); none when it does not come so near.
    #[serde(with = "number")]
    pub lingering: Option<f64>,
    /// Time in which a small wobble about the axis of greatest inertia decays by e (s).
    #[serde(with = "number")]
    pub damping_time: f64,
    /// Time in which a small wobble about the axis of least inertia grows by e (s).
    #[serde(with = "number")]
    pub growth_time: f64,
    /// The strongest harmonics at the start, in the order of their numbers.
    pub harmonics: Vec<HarmonicRecord>,
    /// Resonances on the way, the strongest first.
    pub resonances: Vec<CrossingRecord>,
    /// Rows of the evolution, one array per column. The values are kept in a CSV file of their own.
    pub columns: Vec<Column>,
}

/// A harmonic of the polhode.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct HarmonicRecord {
    /// Its number, from 1.
    pub number: usize,
    /// Its frequency (rad/s).
    #[serde(with = "number")]
    pub frequency: f64,
    /// Its share in the mean power.
    #[serde(with = "number")]
    pub share: f64,
}

/// A place on the way where a harmonic has the frequency of a vibration.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct CrossingRecord {
    /// Number of the harmonic.
    pub harmonic: usize,
    /// Frequency of both (rad/s).
    #[serde(with = "number")]
    pub frequency: f64,
    /// Coordinate with the largest share in the vibration.
    pub coordinate: String,
    /// `D/I₃` there.
    #[serde(with = "number")]
    pub ratio: f64,
    /// Mode of the rotation there: `short-axis` or `long-axis`.
    pub mode: String,
    /// Share of the harmonic in the mean power there.
    #[serde(with = "number")]
    pub share: f64,
}
