//! Record of a run: numbers and words enough to remake its report years later.
//!
//! On disk a record is a folder: `record.json` holds everything but the rows of the histories and of the evolution, `history-<system>` with
//! the ending of its format holds the rows of one history, `evolution` those of the evolution, `backbone` those of the reduced equations about the spin, and `scene.json` what
//! a viewer draws. Every
//! finite number reads back bit for bit. One that is not finite is `null` in JSON, which reads back as infinity where the field can be
//! infinite, else as NaN or none; in CSV it is `NaN`, `inf` or `-inf`.

mod about_spin;
mod error;
mod evolution;
mod fill_map;
mod folder;
mod inputs;
mod modes;
mod number;
mod scene;
mod scene_check;
mod sweep;
mod table;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::model::BodyKind;

pub use about_spin::{AboutSpinRecord, MasterRecord};
pub use error::RecordError;
pub use evolution::{
    ApproachRecord, CrossingRecord, EstimateRecord, EvolutionRecord, HarmonicRecord, HomogeneousRecord,
    ObservedRecord,
};
pub use fill_map::{FillMapRecord, FillMotionRecord, FillPointRecord, NearestSloshRecord};
pub use folder::{ROW_LOG, UNFINISHED, history_file};
pub use inputs::{DerivedBodyRecord, InputsRecord, SolidRecord, ValueRecord};
pub use modes::{CampbellRecord, ModeList, ModeRecord, SlowModesRecord, SteadySpinRecord, place_of_spin};
pub use scene::{
    CoordinateRecord, EquationsRecord, FieldRecord, LimitRecord, Packed, PieceRecord, PrincipalRecord,
    RotorAxisRecord, SCENE_VERSION, SceneRecord, ShapeRecord, StartRecord, TermRecord, TrackRecord,
    VectorsRecord,
};
pub use sweep::{
    CorrelationRecord, InputRecord, IntervalRecord, Ordered, PercentileRecord, QuantityRecord, ReasonRecord,
    SweepColumn, SweepRecord, UncertaintyRecord, by_rate, growth_rate, percentile,
};
pub(crate) use table::{Array, Rows, write_arrays};
pub use table::{Extremes, MOST_ROWS, RowLog, RowTable, TableFormat, history_csv, log_csv};

/// Version of the layout of a record's folder: its files, their keys and columns. A reader refuses later ones; a key that is new and may be
/// missing makes no new version.
pub const RECORD_FORMAT: u32 = 1;

/// Everything a run computed, in SI units.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct RunRecord {
    /// Version of the layout of the folder; [`RECORD_FORMAT`] of records before this field, whose layout it is.
    #[serde(default = "first_format")]
    pub format: u32,
    /// Version of `quasirigid` that made the record.
    pub version: String,
    /// The model of the record.
    pub model: ModelRecord,
    /// Inputs: files, values after units and defaults, and the body that they give; none in records of versions before this field.
    #[serde(default)]
    pub inputs: Option<InputsRecord>,
    /// Remarks the user should read before the numbers.
    pub notes: Vec<String>,
    /// The frozen body `S*` and its coordinates.
    pub body: BodyRecord,
    /// Liquids in cavities.
    #[serde(default)]
    pub liquids: Vec<LiquidRecord>,
    /// Validity of the reduced equations.
    pub validity: ValidityRecord,
    /// Steady spins with the angular momentum of the start, each with the small motions about it.
    #[serde(default)]
    pub steady_spins: Vec<SteadySpinRecord>,
    /// Modes over the spin, about the axis next to the start.
    #[serde(default)]
    pub campbell: Option<CampbellRecord>,
    /// Reduced equations about the steady spin, where the model asks for them or those about rest fail.
    #[serde(default)]
    pub about_spin: Option<AboutSpinRecord>,
    /// The reduced equations at the initial spin.
    pub reduction: ReductionRecord,
    /// Spin histories, one per system propagated; the first is the main one.
    pub histories: Vec<HistoryRecord>,
    /// The reduced equations against the full ones, where the model asks for it.
    #[serde(default)]
    pub verification: Option<VerificationRecord>,
    /// The rotation over many revolutions, where the model asks for it.
    #[serde(default)]
    pub evolution: Option<EvolutionRecord>,
    /// What a viewer draws. Kept in a file of its own; none in records of versions before this field.
    #[serde(skip)]
    pub scene: Option<SceneRecord>,
}

fn first_format() -> u32 {
    1
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
    /// Files that the text names: shapes, meshes, matrices, tables. Empty in records of versions before this field.
    #[serde(default)]
    pub files: Vec<InputFileRecord>,
}

/// A file that a model names.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct InputFileRecord {
    /// Name in the text of the model.
    pub name: String,
    /// Length (bytes).
    pub bytes: u64,
    /// SHA-256 of the contents, in hexadecimal.
    pub sha256: String,
}

/// The frozen body `S*`.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct BodyRecord {
    /// Mass (kg).
    #[serde(with = "number")]
    pub mass: f64,
    /// Centre of mass (m), in the file's frame.
    #[serde(with = "number")]
    pub center_of_mass: [f64; 3],
    /// Pole (m), in the file's frame.
    #[serde(with = "number")]
    pub pole: [f64; 3],
    /// `free`, `fixed-point` or `prescribed`.
    pub support: String,
    /// Kind of the body, `spacecraft` or `small-body`; a spacecraft in records of versions before this field.
    #[serde(default)]
    pub kind: BodyKind,
    /// Inertia tensor about the pole (kg·m²), in the file's axes.
    #[serde(with = "number")]
    pub inertia: [[f64; 3]; 3],
    /// Principal moments (kg·m²), ascending.
    #[serde(with = "number")]
    pub principal_moments: [f64; 3],
    /// Unit vectors of the principal axes, in the order of the moments.
    #[serde(with = "number")]
    pub principal_axes: [[f64; 3]; 3],
    /// Names of the internal coordinates.
    pub coordinates: Vec<String>,
    /// Resolution of the shape of a solid inside a surface; none of other bodies.
    #[serde(default)]
    pub resolution: Option<ResolutionRecord>,
}

/// Resolution of the shape of a solid inside a surface.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct ResolutionRecord {
    /// Degree of polynomials, or `null`.
    ///
    /// Degree of the polynomials of the displacement; none of finite elements.
    pub degree: Option<usize>,
    /// Finite elements, or `null`.
    pub cells: Option<usize>,
    /// Relative error of the dissipation; `null` where nothing bounds it.
    #[serde(with = "number")]
    pub error: Option<f64>,
    /// Resolution in a sentence.
    pub sentence: String,
}

/// File of a shape, as it was read.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct ShapeFileRecord {
    /// Name of the body or cavity.
    pub name: String,
    /// Its file.
    pub file: String,
    /// Length of a unit of the file (m).
    pub unit: f64,
    /// Who says so; empty where metres were assumed.
    pub unit_from: String,
    /// Vertices of the file.
    pub vertices: usize,
    /// Triangles of the file.
    pub triangles: usize,
    /// Sides of the box around it (m).
    pub size: [f64; 3],
    /// Volume (m³).
    pub volume: f64,
    /// Mass (kg), or `null`.
    pub mass: Option<f64>,
    /// Density (kg/m³), or `null`.
    pub density: Option<f64>,
    /// Repairs in words; empty without any.
    pub repaired: String,
    /// Repairs.
    pub repairs: Vec<RepairRecord>,
    /// Distance (m) within which corners were merged.
    pub merged_within: f64,
    /// Choices that the file left open, and parts of it left out.
    pub remarks: Vec<String>,
    /// Doubts about its size.
    pub warnings: Vec<String>,
}

/// Repair of a surface.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct RepairRecord {
    /// In words.
    pub repair: String,
    /// Number.
    pub count: usize,
}

/// A liquid in a cavity, at the initial spin.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct LiquidRecord {
    /// Name of the cavity.
    pub name: String,
    /// Mass (kg).
    #[serde(with = "number")]
    pub mass: f64,
    /// Radius (m) of a ball that follows as slowly.
    #[serde(with = "number")]
    pub radius: f64,
    /// Kinematic viscosity (m²/s).
    #[serde(with = "number")]
    pub viscosity: f64,
    /// Reynolds number of the spin.
    #[serde(with = "number")]
    pub reynolds: f64,
    /// Tensor of the slow flow (m⁷), in the file's axes.
    #[serde(with = "number")]
    pub P: [[f64; 3]; 3],
    /// Relative error of `P` about each axis of the cavity; `null` where exact.
    #[serde(with = "number")]
    pub errors: Option<[f64; 3]>,
    /// Inertia tensor (kg·m²) of an ideal liquid, in the file's axes, or `null`.
    ///
    /// That of the rigid body which is equivalent to the liquid; none where the liquid is viscous throughout.
    #[serde(with = "number")]
    pub equivalent_inertia: Option<[[f64; 3]; 3]>,
}

/// Validity of the reduced equations.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct ValidityRecord {
    /// Whether no criterion fails.
    pub valid: bool,
    /// The verdict in one sentence.
    pub verdict: String,
    /// Verdict of the criteria of the equations, without the one on the duration of vibrations: `holds`, `marginal` or `fails`; empty in
    /// records of versions before this field.
    #[serde(default)]
    pub overall: String,
    /// Longest period of free vibration (s).
    #[serde(with = "number::unbounded")]
    pub T1: f64,
    /// Time in which the slowest free vibration decays by e (s); none for a vibration that does not decay.
    #[serde(with = "number")]
    pub T2: Option<f64>,
    /// Time of the spin, `1/|ω|` (s).
    #[serde(with = "number::unbounded")]
    pub T3: f64,
    /// Undamped natural frequencies (rad/s), ascending.
    #[serde(with = "number")]
    pub frequencies: Vec<f64>,
    /// Decay rates of the free vibrations (1/s), ascending.
    #[serde(with = "number")]
    pub decay_rates: Vec<f64>,
    /// Times in which internal rotors and liquids come to rest with the attitude fixed (s), descending.
    #[serde(with = "number::unbounded", default)]
    pub relaxations: Vec<f64>,
    /// Every criterion with its number.
    pub criteria: Vec<CriterionRecord>,
}

/// One criterion of validity.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct CriterionRecord {
    /// Quantity, in words.
    pub name: String,
    /// Quantity, in symbols.
    pub symbol: String,
    /// Value.
    #[serde(with = "number::unbounded")]
    pub value: f64,
    /// Limit below which it holds.
    #[serde(with = "number")]
    pub limit: f64,
    /// Verdict.
    pub verdict: String,
    /// Meaning.
    ///
    /// In one sentence.
    pub sentence: String,
}

/// The reduced equations at the initial spin.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct ReductionRecord {
    /// Order `p`.
    pub order: usize,
    /// Order at which the terms are smallest at this spin.
    pub optimal_order: usize,
    /// Residual of the invariance equation relative to the load on the internal coordinates.
    #[serde(with = "number")]
    pub residual: f64,
    /// Size of each degree of `ω̇` at this spin.
    pub degrees: Vec<DegreeRecord>,
    /// Mean power dissipated at the initial spin (W).
    #[serde(with = "number")]
    pub power: f64,
    /// Shares of the dissipators in `power`, by name; empty in records of versions before this field.
    #[serde(with = "number", default)]
    pub dissipation: BTreeMap<String, f64>,
}

/// Size of one degree of the reduced equations.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct DegreeRecord {
    /// Degree in `ω`.
    pub degree: usize,
    /// Largest `|f_d|` over directions of the spin (rad/s²).
    #[serde(with = "number")]
    pub size: f64,
    /// Size relative to degree two.
    #[serde(with = "number")]
    pub relative: f64,
}

/// A spin history.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct HistoryRecord {
    /// `full`, `reduced` or `rigid`.
    pub system: String,
    /// Equations integrated, in words.
    pub form: String,
    /// Integrator, in words.
    pub method: String,
    /// `finished`, or why the run ended early.
    pub status: String,
    /// Meaning of the status, in one sentence.
    pub message: String,
    /// Relative tolerance of the integrator.
    #[serde(with = "number")]
    pub tolerance: f64,
    /// Steps accepted.
    pub steps: u64,
    /// Steps rejected.
    pub rejected: u64,
    /// Revolutions made, `∫|ω| dt / 2π`.
    #[serde(with = "number")]
    #[serde(rename = "turns")]
    pub revolutions: f64,
    /// Energy at the start (J).
    #[serde(with = "number")]
    pub energy: f64,
    /// Energy taken by the dashpots (J).
    #[serde(with = "number")]
    pub dissipated: f64,
    /// Shares of the dissipators in that energy, by name; empty in records of versions before this field, and of a
    /// reduced body under forces.
    #[serde(with = "number", default)]
    pub dissipation: BTreeMap<String, f64>,
    /// Work of the external forces (J).
    #[serde(with = "number")]
    pub work: f64,
    /// Change of energy made by the integrator alone (J).
    #[serde(with = "number")]
    pub energy_drift: f64,
    /// Energy (J) of vibrations that forces excite, and of terms of the series, which the reduced equations leave out of the dissipated energy:
    /// an estimate; zero of other systems and in records of versions before this field.
    #[serde(with = "number", default)]
    pub left_out: f64,
    /// Largest change of the external forces by displacements, beside the elastic forces that resist these; zero of other systems than the
    /// reduced one and in records of versions before this field.
    #[serde(with = "number", default)]
    pub load_ratio: f64,
    /// Error of the angular velocity of reduced equations by vibrations that forces excite; none where it is small.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ringing: Option<RingingRecord>,
    /// Change of `|K|` made by the integrator alone, relative.
    #[serde(with = "number")]
    pub momentum_drift: f64,
    /// Rows of the table on disk; zero in records of versions before this field.
    #[serde(default)]
    pub rows: u64,
    /// Rows of the history, one array per column, or of a long one the rows with the extremes of each interval. The values are kept in
    /// the table of each history.
    pub columns: Vec<Column>,
    /// Every row of a long history, as the run that made the record logged it.
    #[serde(skip)]
    pub log: Option<RowTable>,
}

/// When and by how much an angular velocity may be off by vibrations.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RingingRecord {
    /// First time (s) at which it is above the share that is told.
    pub from: f64,
    /// Last such time (s).
    pub to: f64,
    /// Largest error (rad/s).
    pub omega: f64,
    /// That relative to the largest angular velocity of the run.
    pub share: f64,
}

impl HistoryRecord {
    /// Takes the energies and drifts of a history in work from its rows.
    fn sum_up(&mut self) {
        let of = |name: &str| self.columns.iter().find(|column| column.name == name);
        let first = |name: &str| of(name).and_then(|column| column.values.first().copied());
        let last = |name: &str| of(name).and_then(|column| column.values.last().copied()).unwrap_or(f64::NAN);
        self.energy = first("energy").unwrap_or(f64::NAN);
        [self.dissipated, self.work] = ["dissipated", "work"].map(last);
        [self.energy_drift, self.momentum_drift] = ["energy_drift", "momentum_drift"].map(last);
    }

    /// Whether the columns hold every row, not the extremes alone.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.columns.first().is_none_or(|column| column.values.len() as u64 >= self.rows)
    }

    /// Rows of the history, of which the columns hold all or the extremes.
    #[must_use]
    pub fn rows(&self) -> u64 {
        let held = self.columns.first().map_or(0, |column| column.values.len());
        self.rows.max(held as u64)
    }
}

/// A column of a history or of the evolution.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub struct Column {
    /// Name, as in the header of the CSV file.
    pub name: String,
    /// SI unit.
    pub unit: String,
    /// Values, one per row. Kept in the CSV file.
    #[serde(skip)]
    pub values: Vec<f64>,
}

/// The reduced equations against the full ones as the body is stiffened.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct VerificationRecord {
    /// Whether every order was reached.
    pub reached: bool,
    /// Revolutions followed.
    ///
    /// At the initial spin.
    #[serde(with = "number")]
    pub rotations: f64,
    /// Duration of these (s).
    #[serde(with = "number")]
    pub duration: f64,
    /// One entry per order.
    pub orders: Vec<OrderRecord>,
    /// Comparison of the mean power, or `null`.
    ///
    /// Mean power of the average against that of the full system, where there is an average.
    #[serde(default)]
    pub average: Option<AverageRecord>,
    /// Reason for its absence.
    ///
    /// Reason for a missing comparison with the average, in words.
    #[serde(default)]
    pub average_left_out: Option<String>,
}

/// The average against the full system as the body is stiffened.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct AverageRecord {
    /// Factors `ε` of stiffness `C/ε²` and damping `B/ε`, from 1 down.
    ///
    /// The first, 1, is the model itself.
    #[serde(with = "number")]
    pub epsilons: Vec<f64>,
    /// Relative difference at each `ε`.
    #[serde(with = "number")]
    pub errors: Vec<f64>,
    /// Measured exponent of `ε`, or `null` within the error of measurement.
    #[serde(with = "number")]
    pub order: Option<f64>,
    /// Expected exponent.
    pub expected: usize,
    /// Whether the order is reached.
    pub reached: bool,
}

/// Comparison of one order of the reduced equations with the full system.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct OrderRecord {
    /// Order.
    pub p: usize,
    /// Form: `momentum` or `paper`.
    ///
    /// Form of the reduced equations.
    #[serde(default = "angular_momentum_form")]
    pub form: String,
    /// Measured exponent of `ε`, or `null` within rounding.
    #[serde(with = "number")]
    pub order: Option<f64>,
    /// Expected exponent, `p + 1`.
    ///
    /// Expected exponent.
    pub expected: usize,
    /// Whether the order is reached.
    pub reached: bool,
    /// Factors `ε` of stiffness `C/ε²` and damping `B/ε`, from 1 down.
    ///
    /// The first, 1, is the model itself.
    #[serde(with = "number")]
    pub epsilons: Vec<f64>,
    /// Largest difference in spin at each `ε`, relative.
    #[serde(with = "number")]
    pub errors: Vec<f64>,
    /// Largest difference in attitude at each `ε` (rad).
    #[serde(with = "number")]
    pub attitude: Vec<f64>,
    /// Largest difference in the energy dissipated at each `ε` (J).
    #[serde(with = "number")]
    pub dissipated: Vec<f64>,
    /// Energy dissipated (J), in the full history.
    #[serde(with = "number")]
    pub dissipation: Vec<f64>,
}

/// Default form, for records of versions before this field.
fn angular_momentum_form() -> String {
    "momentum".into()
}
