use std::collections::BTreeMap;

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
    /// The road: `average` along the polhode, `modes` at the poles, `micro-runs` of the full system, `direct` integration of it, or
    /// `none` where no road holds.
    #[serde(default)]
    pub road: String,
    /// Why this road was taken and how far it holds, in a sentence.
    #[serde(default)]
    pub verdict: String,
    /// How the power was computed, in words.
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
    /// The rotation at the start as observers describe it; none in a record of a version that did not tell it.
    #[serde(default)]
    pub start: Option<ObservedRecord>,
    /// The same at the end.
    #[serde(default)]
    pub end: Option<ObservedRecord>,
    /// Time from the start to the end (s), located whatever the rows; infinite where the end is never reached.
    #[serde(with = "number::unbounded")]
    pub time: f64,
    /// Estimate of the relative error of that time; none if it is not known.
    #[serde(with = "number", default)]
    pub time_error: Option<f64>,
    /// Least and greatest of that time (s) over the ranges of the materials; none where they have no ranges.
    #[serde(with = "number::unbounded")]
    pub time_range: Option<[f64; 2]>,
    /// Turns about the angular momentum.
    #[serde(with = "number::unbounded")]
    pub turns: f64,
    /// Mean power dissipated at the start (W).
    #[serde(with = "number")]
    pub power: f64,
    /// Shares of what dissipates in that power, by name; empty in a record of a version that did not know them.
    #[serde(with = "number", default)]
    pub dissipation: BTreeMap<String, f64>,
    /// Time from the start to the separatrix (s); none when it is not passed.
    #[serde(with = "number")]
    pub separatrix_time: Option<f64>,
    /// Time spent within 1 % of the separatrix (s); none when it does not come so near.
    #[serde(with = "number")]
    pub lingering: Option<f64>,
    /// Time in which a small wobble about the axis of greatest inertia decays by e (s).
    #[serde(with = "number::unbounded")]
    pub damping_time: f64,
    /// Time in which a small wobble about the axis of least inertia grows by e (s).
    #[serde(with = "number::unbounded")]
    pub growth_time: f64,
    /// Which of `time`, `turns`, `damping_time` and `growth_time` are not known: in JSON those are `null` as well as infinite ones.
    #[serde(default)]
    pub not_known: Vec<String>,
    /// Published estimates of the first of these times, for a homogeneous body of one quality factor; empty otherwise.
    #[serde(default)]
    pub estimates: Vec<EstimateRecord>,
    /// The strongest harmonics at the start, in the order of their numbers.
    pub harmonics: Vec<HarmonicRecord>,
    /// Resonances on the way, the strongest first.
    pub resonances: Vec<CrossingRecord>,
    /// The nearest that a harmonic comes to a vibration at either end, within a tenth of its frequency; none otherwise.
    #[serde(default)]
    pub approach: Option<ApproachRecord>,
    /// Rows of the evolution, one array per column. The values are kept in a CSV file of their own.
    pub columns: Vec<Column>,
}

impl EvolutionRecord {
    /// Names in `not_known` the numbers that are NaN.
    #[must_use]
    pub fn with_unknown_named(mut self) -> Self {
        let unknown = self.unbounded().into_iter().filter(|(_, value)| value.is_nan());
        self.not_known = unknown.map(|(name, _)| name.to_owned()).collect();
        self
    }

    /// Makes NaN of the numbers that `not_known` names.
    pub(super) fn restore_unknown(&mut self) {
        let unknown = std::mem::take(&mut self.not_known);
        self.unbounded().into_iter().filter(|(name, _)| unknown.iter().any(|each| each == name)).for_each(
            |(_, value)| {
                *value = f64::NAN;
            },
        );
        self.not_known = unknown;
    }

    /// The numbers that may be infinite, or not known.
    fn unbounded(&mut self) -> [(&'static str, &mut f64); 4] {
        [
            ("time", &mut self.time),
            ("turns", &mut self.turns),
            ("damping_time", &mut self.damping_time),
            ("growth_time", &mut self.growth_time),
        ]
    }
}

/// A rotation as observers describe it.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct ObservedRecord {
    /// Period of the rotation about the long axis, in body axes (s); `P_ψ`. Infinite in a steady spin.
    #[serde(with = "number::unbounded")]
    pub rotation_period: f64,
    /// Mean period in which the long axis goes round the angular momentum (s); `P_φ`.
    #[serde(with = "number::unbounded")]
    pub precession_period: f64,
    /// Least angle between the angular momentum and the axis that it circles (rad).
    #[serde(with = "number")]
    pub nutation_least: f64,
    /// Greatest angle (rad).
    #[serde(with = "number")]
    pub nutation_greatest: f64,
    /// Energy over the least that this angular momentum allows; `E/E₀ = I₃/D`.
    #[serde(with = "number")]
    pub energy_ratio: f64,
}

/// A published estimate of the time in which a wobble is damped.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct EstimateRecord {
    /// Who published it, and when.
    pub source: String,
    /// Least time (s) that it gives.
    #[serde(with = "number::unbounded")]
    pub least: f64,
    /// Greatest time (s).
    #[serde(with = "number::unbounded")]
    pub greatest: f64,
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

/// A harmonic beside a vibration that it does not pass.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct ApproachRecord {
    /// Number of the harmonic.
    pub harmonic: usize,
    /// Frequency of the vibration (rad/s).
    #[serde(with = "number")]
    pub frequency: f64,
    /// Coordinate with the largest share in it.
    pub coordinate: String,
    /// Frequency of the harmonic over that of the vibration, less one.
    #[serde(with = "number")]
    pub distance: f64,
    /// `D/I₃` there.
    #[serde(with = "number")]
    pub ratio: f64,
}
