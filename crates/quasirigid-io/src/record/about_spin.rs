use serde::{Deserialize, Serialize};

use super::{Column, number};

/// Reduced equations about the steady spin with the angular momentum of the start: their range, and the motion along their manifold.
///
/// The columns are those of the backbone: `amplitude` and `nutation` (rad), `decay_rate` (1/s), negative for growth, `frequency` (rad/s),
/// `power` (W), `defect`, and the share of each dissipator, named after it. They reach beyond the range.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct AboutSpinRecord {
    /// The verdict, in a sentence.
    pub sentence: String,
    /// Whether the equations hold at the start.
    pub holds: bool,
    /// Axis of the steady spin: `least` or `greatest` inertia.
    pub axis: String,
    /// Angular velocity of the steady spin (rad/s), body axes.
    #[serde(with = "number")]
    pub spin: [f64; 3],
    /// Angular momentum (N·m·s), body axes.
    #[serde(with = "number")]
    pub angular_momentum: [f64; 3],
    /// Degree in the amplitude.
    pub degree: usize,
    /// `normal-form` or `graph`.
    pub style: String,
    /// Modes that the equations follow, the nutation first.
    pub masters: Vec<MasterRecord>,
    /// Nutation (rad) up to which the equations hold.
    #[serde(with = "number")]
    pub range: f64,
    /// Share of motion and dissipation that they leave at most within the range.
    #[serde(with = "number")]
    pub share: f64,
    /// Nutation of the start (rad); none where the start circles another axis.
    #[serde(with = "number")]
    pub start: Option<f64>,
    /// Resonances with modes that the equations leave out, in sentences.
    pub resonances: Vec<String>,
    /// Names of the dissipators, whose shares are the last columns.
    pub dissipators: Vec<String>,
    /// Columns of the backbone.
    pub columns: Vec<Column>,
}

/// Mode that reduced equations about a spin follow.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct MasterRecord {
    /// `nutation`, or the coordinate that moves most.
    pub name: String,
    /// Decay rate (1/s), negative for a mode that grows.
    #[serde(with = "number")]
    pub decay_rate: f64,
    /// Frequency in body axes (rad/s).
    #[serde(with = "number")]
    pub frequency: f64,
}
