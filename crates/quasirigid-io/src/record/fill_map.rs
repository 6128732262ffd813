use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::number;

/// Map of the time constants of a body over the fill of its tanks and its spin.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct FillMapRecord {
    /// Title of the model.
    pub name: String,
    /// The worst fill and the slosh that meets the nutation there, in words.
    pub sentence: String,
    /// Whether every point is answered, and the worst one holds.
    pub holds: bool,
    /// Tanks whose fill is varied, all alike.
    pub tanks: Vec<String>,
    /// Points of the map, by spin, then by fill.
    pub points: Vec<FillPointRecord>,
    /// Worst point of each spin.
    ///
    /// The nutation grows fastest there, or decays slowest; between the points of the map, too. Spins without an answer are left out.
    pub worst: Vec<FillPointRecord>,
    /// Points at which the time constant of the nutation is least between fills on both sides.
    pub dips: Vec<FillPointRecord>,
}

/// Body at a fill and a spin.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct FillPointRecord {
    /// Spin (rad/s).
    #[serde(with = "number")]
    pub spin: f64,
    /// Fill of each tank that is varied.
    #[serde(with = "number")]
    pub fill: f64,
    /// Mass of the liquid in them (kg).
    #[serde(with = "number")]
    pub liquid_mass: f64,
    /// `answered`, `doubtful` or `refused`.
    pub status: String,
    /// Reason of the doubt or the refusal, or `null`.
    pub reason: Option<String>,
    /// The nutation, or `null` where there is none.
    pub nutation: Option<FillMotionRecord>,
    /// Rate of the nutation in the body with the liquid held (rad/s); `null` where it does not oscillate.
    #[serde(with = "number")]
    pub rigid_rate: Option<f64>,
    /// Shares of the dissipation of the nutation.
    #[serde(with = "number")]
    pub dissipation: BTreeMap<String, f64>,
    /// Other motion that grows fastest, or decays slowest; `null` where there is none.
    pub slowest: Option<FillMotionRecord>,
    /// Slosh whose frequency is nearest to the rate of the nutation, or `null`.
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
    /// Decay rate (1/s), negative where it grows.
    #[serde(with = "number")]
    pub decay_rate: f64,
    /// e-folding time (s), negative where it grows; `null` where it does neither.
    #[serde(with = "number")]
    pub time_constant: Option<f64>,
}

/// Slosh near the rate of the nutation.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct NearestSloshRecord {
    /// Name of the tank.
    pub tank: String,
    /// Number of the mode, from 1.
    pub mode: usize,
    /// Frequency in body axes with the body held in its spin (rad/s).
    #[serde(with = "number")]
    pub frequency: f64,
    /// That frequency over the rate of the nutation with the liquid held.
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
