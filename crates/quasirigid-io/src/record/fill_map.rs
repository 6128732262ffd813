use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::number;

/// Map of the time constants of a body over the fill of its tanks and its spin.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct FillMapRecord {
    /// Title of the model.
    pub name: String,
    /// Worst fill and its slosh in words.
    pub sentence: String,
    /// Whether all points are answered and the worst holds.
    pub holds: bool,
    /// Tanks that are filled alike.
    pub tanks: Vec<String>,
    /// Points by spin, then fill.
    pub points: Vec<FillPointRecord>,
    /// Worst point of each spin.
    ///
    /// The nutation grows fastest there, or decays slowest; between the points of the map, too. Spins without an answer are left out.
    pub worst: Vec<FillPointRecord>,
    /// Minima of the nutation's time constant over the fill.
    pub dips: Vec<FillPointRecord>,
}

/// Body at a fill and a spin.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct FillPointRecord {
    /// Spin (rad/s).
    #[serde(with = "number")]
    pub spin: f64,
    /// Fill of each tank.
    #[serde(with = "number")]
    pub fill: f64,
    /// Liquid in them (kg).
    #[serde(with = "number")]
    pub liquid_mass: f64,
    /// `answered`, `doubtful` or `refused`.
    pub status: String,
    /// Reason of doubt or refusal.
    pub reason: Option<String>,
    /// The nutation.
    pub nutation: Option<FillMotionRecord>,
    /// Nutation rate with the liquid held (rad/s).
    #[serde(with = "number")]
    pub rigid_rate: Option<f64>,
    /// Shares, of the nutation.
    #[serde(with = "number")]
    pub dissipation: BTreeMap<String, f64>,
    /// Other motion growing fastest or decaying slowest.
    pub slowest: Option<FillMotionRecord>,
    /// Slosh nearest to the nutation.
    pub nearest: Option<NearestSloshRecord>,
}

/// Small motion at a point of the map.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct FillMotionRecord {
    /// Name of the mode.
    pub name: String,
    /// Frequency in body axes (rad/s).
    #[serde(with = "number")]
    pub frequency: f64,
    /// Decay rate (1/s).
    #[serde(with = "number")]
    pub decay_rate: f64,
    /// e-folding time (s).
    #[serde(with = "number")]
    pub time_constant: Option<f64>,
}

/// Slosh near the rate of the nutation.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct NearestSloshRecord {
    /// Name of the tank.
    pub tank: String,
    /// Number, from 1.
    pub mode: usize,
    /// Frequency with the body held in its spin (rad/s).
    #[serde(with = "number")]
    pub frequency: f64,
    /// That frequency over `rigid_rate`.
    #[serde(with = "number")]
    pub ratio: f64,
}

impl FillPointRecord {
    /// Status of a point that is known.
    pub const ANSWERED: &str = "answered";
    /// Status of a point that may not hold.
    pub const DOUBTFUL: &str = "doubtful";
    /// Status of a point without an answer.
    pub const REFUSED: &str = "refused";

    /// Decay rate of the nutation (1/s), if there is one.
    #[must_use]
    pub fn decay_rate(&self) -> Option<f64> {
        self.nutation.as_ref().map(|nutation| nutation.decay_rate)
    }
}
