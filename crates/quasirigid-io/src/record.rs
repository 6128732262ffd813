//! What a run leaves behind: numbers and words enough to remake its report years later.

use serde::{Deserialize, Serialize};

/// Everything a run computed, in SI units.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct RunRecord {
    /// Version of `quasirigid` that made the record.
    pub version: String,
    /// The model it was made from.
    pub model: ModelRecord,
    /// Remarks the user should read before the numbers.
    pub notes: Vec<String>,
    /// The frozen body `S*` and its coordinates.
    pub body: BodyRecord,
    /// How far the reduced equations hold.
    pub validity: ValidityRecord,
    /// The reduced equations at the initial spin.
    pub reduction: ReductionRecord,
    /// Spin histories, one per system propagated; the first is the main one.
    pub histories: Vec<HistoryRecord>,
}

/// The model a record was made from.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct ModelRecord {
    /// Name of the body.
    pub name: String,
    /// File name, without its folder.
    pub file: String,
    /// SHA-256 of the file's text, in hexadecimal.
    pub sha256: String,
}

/// The frozen body `S*`.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct BodyRecord {
    /// Mass (kg).
    pub mass: f64,
    /// Centre of mass (m), in the file's frame.
    pub center_of_mass: [f64; 3],
    /// Pole (m), in the file's frame.
    pub pole: [f64; 3],
    /// `free` or `fixed-point`.
    pub support: String,
    /// Inertia tensor about the pole (kg·m²), in the file's axes.
    pub inertia: [[f64; 3]; 3],
    /// Principal moments (kg·m²), ascending.
    pub principal_moments: [f64; 3],
    /// Unit vectors of the principal axes, in the order of the moments.
    pub principal_axes: [[f64; 3]; 3],
    /// Names of the internal coordinates.
    pub coordinates: Vec<String>,
}

/// How far the reduced equations hold.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct ValidityRecord {
    /// Whether every criterion holds.
    pub valid: bool,
    /// The verdict in one sentence.
    pub verdict: String,
    /// Longest period of free vibration (s).
    pub T1: f64,
    /// Time in which the slowest free vibration decays by e (s); none when it does not decay.
    pub T2: Option<f64>,
    /// Time of the spin, `1/|ω|` (s).
    pub T3: f64,
    /// Undamped natural frequencies (rad/s), ascending.
    pub frequencies: Vec<f64>,
    /// Decay rates of the free vibrations (1/s), ascending.
    pub decay_rates: Vec<f64>,
    /// Every criterion with its number.
    pub criteria: Vec<CriterionRecord>,
}

/// One criterion of validity.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct CriterionRecord {
    /// What is compared, in words.
    pub name: String,
    /// What is compared, in symbols.
    pub symbol: String,
    /// Its value.
    pub value: f64,
    /// The value below which it holds.
    pub limit: f64,
    /// `holds`, `marginal` or `fails`.
    pub verdict: String,
    /// What it means, in one sentence.
    pub sentence: String,
}

/// The reduced equations at the initial spin.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct ReductionRecord {
    /// Order `p`.
    pub order: usize,
    /// Order at which the terms are smallest at this spin.
    pub optimal_order: usize,
    /// Residual of the invariance equation relative to the elastic load.
    pub residual: f64,
    /// Size of each degree of `ω̇` at this spin.
    pub degrees: Vec<DegreeRecord>,
    /// Mean power dissipated at the initial spin (W).
    pub power: f64,
}

/// Size of one degree of the reduced equations.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct DegreeRecord {
    /// Degree in `ω`.
    pub degree: usize,
    /// Largest `|f_d|` over directions of the spin (rad/s²).
    pub size: f64,
    /// The same relative to degree two.
    pub relative: f64,
}

/// A spin history.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct HistoryRecord {
    /// `reduced` or `rigid`.
    pub system: String,
    /// Equations integrated, in words.
    pub form: String,
    /// `finished`, or why the run ended early.
    pub status: String,
    /// What the end of the run means, in one sentence.
    pub message: String,
    /// Relative tolerance of the integrator.
    pub tolerance: f64,
    /// Steps accepted.
    pub steps: u64,
    /// Steps rejected.
    pub rejected: u64,
    /// Turns made, `∫|ω| dt / 2π`.
    pub turns: f64,
    /// Energy at the start (J).
    pub energy: f64,
    /// Energy taken by the dashpots (J).
    pub dissipated: f64,
    /// Change of energy made by the integrator alone (J).
    pub energy_drift: f64,
    /// Change of `|K|` made by the integrator alone, relative.
    pub momentum_drift: f64,
    /// Rows of the history, one array per column. Kept in a CSV file of its own.
    #[serde(skip)]
    pub columns: Vec<Column>,
}

/// A column of a history.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub struct Column {
    /// Name, as in the header of the CSV file.
    pub name: String,
    /// SI unit.
    pub unit: String,
    /// Values, one per row.
    pub values: Vec<f64>,
}
