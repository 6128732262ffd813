//! Inputs of a result: the files that were read, the values after units and defaults, and the body that they gave.
//! Two results with equal inputs of one version of the program are equal; what differs is told by `quasirigid diff`.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::{InputFileRecord, number};

/// Inputs of a result.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub struct InputsRecord {
    /// Of `quasirigid`.
    pub version: String,
    /// Files that were read, the model first.
    pub files: Vec<InputFileRecord>,
    /// Values of the model, in SI units.
    pub values: Vec<ValueRecord>,
    /// Values not listed, of a long model.
    pub values_left_out: u64,
    /// Body that they give, or `null`.
    pub body: Option<DerivedBodyRecord>,
    /// What is to be read before every answer from them, what may not hold first.
    #[serde(default)]
    pub notes: Vec<String>,
}

/// Value of a key of the model.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct ValueRecord {
    /// Path.
    pub key: String,
    /// After conversion; of a default that is no number, in words.
    pub value: Value,
    /// Unit; empty for pure numbers and texts.
    pub unit: String,
    /// Whether the file leaves it out.
    pub default: bool,
}

/// Body that the inputs give.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub struct DerivedBodyRecord {
    /// Mass (kg).
    #[serde(with = "number")]
    pub mass: f64,
    /// Extent along the axes of the file (m), or `null`.
    #[serde(with = "number")]
    pub size: Option<[f64; 3]>,
    /// Principal moments (kg·m²).
    #[serde(with = "number")]
    pub principal_moments: [f64; 3],
    /// Volume of its solids (m³), or `null`.
    #[serde(with = "number")]
    pub volume: Option<f64>,
    /// Density of solid parts of one density (kg/m³), or `null`.
    #[serde(with = "number")]
    pub density: Option<f64>,
    /// `μ` (Pa), or `null`.
    #[serde(with = "number")]
    pub shear: Option<f64>,
    /// `Q`, or `null`.
    #[serde(with = "number")]
    pub quality_factor: Option<f64>,
    /// `μQ` (Pa), or `null`.
    #[serde(rename = "mu_Q", with = "number")]
    pub mu_Q: Option<f64>,
    /// Solid parts.
    pub solids: Vec<SolidRecord>,
}

/// Solid part of a body.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct SolidRecord {
    /// Name.
    pub name: String,
    /// Volume (m³).
    #[serde(with = "number")]
    pub volume: f64,
    /// Density (kg/m³).
    #[serde(with = "number")]
    pub density: f64,
    /// `μ` (Pa).
    #[serde(with = "number")]
    pub shear: f64,
    /// Poisson's ratio.
    #[serde(with = "number")]
    pub poisson: f64,
    /// `Q`, or `null`.
    #[serde(with = "number")]
    pub quality_factor: Option<f64>,
}
