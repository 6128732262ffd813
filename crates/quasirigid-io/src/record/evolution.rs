//! Record of the secular evolution: its answer, its times and powers, its harmonics and resonances, and its rows.
//! Fields added by later versions have defaults, so that older records read; JSON writes unknown and infinite numbers alike as `null`,
//! and `not_known` tells them apart.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{Column, number};

/// The rotation over many revolutions, averaged over its wobble.
///
/// The columns are `t`, `D_over_I3`, `circled_axis` (1 of least, 3 of greatest inertia), `nutation_min` and
/// `nutation_max` (angle between the angular momentum and that axis), `energy`, `momentum`, `polhode_period`,
/// `precession_period`, `power`, that of the reduced equations beside it, `polynomial_power`, and `turns`. A body with momentum wheels
/// circles a steady spin about no principal axis: its `circled_axis` is 0, and `D_over_I3` is not known.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct EvolutionRecord {
    /// Answer, in one or two sentences.
    pub sentence: String,
    /// Method: `average`, `levels`, `modes`, `manifold`, `micro-runs`, `direct`, `none`.
    ///
    /// `average` along the polhode, `levels` of the slow energy, `modes` at the poles, reduced equations
    /// about the spin (`manifold`), `micro-runs` of the full system,
    /// `direct` integration of it, or `none` where no method holds.
    #[serde(default)]
    pub road: String,
    /// Reason for the method, and limits of its validity.
    #[serde(default)]
    pub verdict: String,
    /// Source of the power, in words.
    pub method: String,
    /// Status: how it ended; `refused` or `does-not-hold` without result.
    ///
    /// `finished` (the time or the target reached), `interrupted`, `refused` (no method holds), `does-not-hold` (the method asked for does
    /// not), or an early end by a torque: `held` (at the separatrix), `rest`, `spun-up`, `slowed`, `step-limit`, `failed`.
    pub status: String,
    /// End of the evolution, in a sentence.
    #[serde(default)]
    pub message: String,
    /// Angular momentum `|K|` at the start (N·m·s).
    #[serde(with = "number")]
    #[serde(rename = "momentum")]
    pub angular_momentum: f64,
    /// Mode at the start: `short-axis`, `long-axis`, or `steady-spin` with momentum wheels.
    ///
    /// A body with momentum wheels circles no principal axis.
    pub mode_start: String,
    /// Mode at the end.
    pub mode_end: String,
    /// `D/I₃ = |K|²/2EI₃` at the start.
    #[serde(with = "number")]
    pub ratio_start: f64,
    /// `D/I₃` at the end.
    #[serde(with = "number")]
    pub ratio_end: f64,
    /// Rotation at the start as observers describe it, or `null`.
    ///
    /// None in records of versions before this field.
    #[serde(default)]
    pub start: Option<ObservedRecord>,
    /// Rotation at the end as observers describe it, or `null`.
    #[serde(default)]
    pub end: Option<ObservedRecord>,
    /// Time from start to end (s), `null` if never reached.
    ///
    /// Located whatever the rows; infinite where the end is never reached.
    #[serde(with = "number::unbounded")]
    pub time: f64,
    /// Relative error of `time`, or `null`.
    ///
    /// An estimate; none if not known.
    #[serde(with = "number", default)]
    pub time_error: Option<f64>,
    /// Least and greatest `time` over the ranges of the materials (s), or `null`.
    ///
    /// None where materials have no ranges.
    #[serde(with = "number::unbounded")]
    pub time_range: Option<[f64; 2]>,
    /// Revolutions about the angular momentum.
    #[serde(with = "number::unbounded")]
    #[serde(rename = "turns")]
    pub revolutions: f64,
    /// Mean power at the start (W).
    #[serde(with = "number")]
    pub power: f64,
    /// Shares in `power`.
    ///
    /// Empty in records of versions before this field.
    #[serde(with = "number", default)]
    pub dissipation: BTreeMap<String, f64>,
    /// Time to the separatrix (s), or `null`.
    ///
    /// From the start; none when the separatrix is not passed.
    #[serde(with = "number")]
    pub separatrix_time: Option<f64>,
    /// Time within 1 % of it (s), or `null`.
    ///
    /// None when the evolution does not come so near to the separatrix.
    #[serde(with = "number")]
    pub lingering: Option<f64>,
    /// e-folding time (s) of a small wobble about the axis of greatest inertia.
    ///
    /// Or about the steady spin that attracts.
    #[serde(with = "number::unbounded")]
    pub damping_time: f64,
    /// e-folding time (s) of growth about the axis of least inertia.
    ///
    /// Time in which a small wobble about the axis of least inertia grows by e.
    #[serde(with = "number::unbounded")]
    pub growth_time: f64,
    /// Times and `turns` that are `null` though not infinite.
    ///
    /// Of `time`, `turns`, `damping_time` and `growth_time`: JSON has `null` for unknown and infinite alike.
    #[serde(default)]
    pub not_known: Vec<String>,
    /// Published estimates of `damping_time`, (A11).
    ///
    /// For a homogeneous body of one quality factor; empty otherwise.
    #[serde(default)]
    pub estimates: Vec<EstimateRecord>,
    /// Homogeneous body, as read, or `null`.
    ///
    /// The body and its material; none of other bodies, and in records of versions before this field.
    #[serde(default)]
    pub homogeneous: Option<HomogeneousRecord>,
    /// Strongest harmonics at the start, by number.
    pub harmonics: Vec<HarmonicRecord>,
    /// Resonances on the way, strongest first.
    pub resonances: Vec<CrossingRecord>,
    /// Harmonic within a tenth of a vibration at an end, or `null`.
    ///
    /// The nearest that a harmonic comes to a vibration at either end.
    #[serde(default)]
    pub approach: Option<ApproachRecord>,
    /// Rows of the evolution, one array per column. The values are kept in a CSV file of their own.
    pub columns: Vec<Column>,
}

impl EvolutionRecord {
    /// Lists in `not_known` the numbers that are NaN.
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

    /// The numbers that may be infinite or unknown.
    fn unbounded(&mut self) -> [(&'static str, &mut f64); 4] {
        [
            ("time", &mut self.time),
            ("turns", &mut self.revolutions),
            ("damping_time", &mut self.damping_time),
            ("growth_time", &mut self.growth_time),
        ]
    }
}

/// A rotation as observers describe it.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct ObservedRecord {
    /// Period `P_ψ` about the long axis (s), `null` in a steady spin.
    ///
    /// Period of the rotation about the long axis, in body axes; infinite in a steady spin.
    #[serde(with = "number::unbounded")]
    pub rotation_period: f64,
    /// Period `P_φ` of the precession (s).
    ///
    /// Mean period in which the long axis goes round the angular momentum.
    #[serde(with = "number::unbounded")]
    pub precession_period: f64,
    /// Least angle from the axis circled (rad).
    ///
    /// Least angle between the angular momentum and the axis that the angular momentum circles.
    #[serde(with = "number")]
    pub nutation_least: f64,
    /// Greatest angle from it (rad).
    ///
    /// Greatest angle between the two.
    #[serde(with = "number")]
    pub nutation_greatest: f64,
    /// Energy ratio, `E/E₀ = I₃/D`.
    ///
    /// Energy over the least that this angular momentum allows.
    #[serde(with = "number")]
    pub energy_ratio: f64,
}

/// A homogeneous body and its material, as the model was read.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub struct HomogeneousRecord {
    /// Mass (kg).
    #[serde(with = "number")]
    pub mass: f64,
    /// Radius of the ball of equal volume (m).
    #[serde(with = "number")]
    pub radius: f64,
    /// Density (kg/m³).
    #[serde(with = "number")]
    pub density: f64,
    /// Shear modulus (Pa).
    #[serde(with = "number")]
    pub shear: f64,
    /// Quality factor, or `null`.
    ///
    /// None of another rheology.
    #[serde(with = "number", default)]
    pub quality: Option<f64>,
}

/// A published estimate of the time in which a wobble is damped.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct EstimateRecord {
    /// Author and year.
    pub source: String,
    /// Least time of the estimate (s).
    #[serde(with = "number::unbounded")]
    pub least: f64,
    /// Greatest time of the estimate (s).
    #[serde(with = "number::unbounded")]
    pub greatest: f64,
}

/// A harmonic of the polhode.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct HarmonicRecord {
    /// Number, from 1.
    pub number: usize,
    /// Frequency (rad/s).
    #[serde(with = "number")]
    pub frequency: f64,
    /// Share of the mean power.
    #[serde(with = "number")]
    pub share: f64,
    /// Parts of that share by dissipator.
    ///
    /// Empty in records of versions before this field.
    #[serde(with = "number", default)]
    pub dissipation: BTreeMap<String, f64>,
}

/// A place on the way where a harmonic has the frequency of a vibration.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct CrossingRecord {
    /// Number of the harmonic.
    pub harmonic: usize,
    /// Frequency of harmonic and vibration (rad/s).
    #[serde(with = "number")]
    pub frequency: f64,
    /// Coordinate that moves most.
    pub coordinate: String,
    /// `D/I₃`.
    #[serde(with = "number")]
    pub ratio: f64,
    /// Mode: `short-axis` or `long-axis`.
    pub mode: String,
    /// Share of the mean power.
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
    /// Coordinate that moves most.
    pub coordinate: String,
    /// Ratio of frequencies less one.
    #[serde(with = "number")]
    pub distance: f64,
    /// `D/I₃`.
    #[serde(with = "number")]
    pub ratio: f64,
}
