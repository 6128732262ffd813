use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::number;

/// A steady spin with the small motions about it, or the reason for its absence.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct SteadySpinRecord {
    /// Result, instability first, in one or two sentences.
    pub sentence: String,
    /// Axis: `least`, `middle` or `greatest` inertia, `asked`, `under forces`, `at rest`.
    ///
    /// Axis near which the spin was looked for. With momentum wheels also `greatest, opposite sense`, `least, opposite sense`, and where wheels
    /// turn the spin away from the axes `least energy` and `greatest energy`, with `locally` before them of a lesser extreme.
    pub axis: String,
    /// Angular velocity (rad/s), body axes; `null` if there is no such spin.
    #[serde(with = "number")]
    pub spin: Option<[f64; 3]>,
    /// Angular momentum (N·m·s), body axes.
    #[serde(with = "number")]
    #[serde(rename = "momentum")]
    pub angular_momentum: Option<[f64; 3]>,
    /// Energy (J).
    #[serde(with = "number")]
    pub energy: Option<f64>,
    /// Displacements of the elastic coordinates, by name (m, rad).
    #[serde(with = "number")]
    pub displacements: BTreeMap<String, f64>,
    /// Whether no small motion grows, as far as is known.
    pub stable: bool,
    /// Modes: the nutation first, then by frequency, overdamped ones last.
    pub modes: Vec<ModeRecord>,
    /// Of a body of many coordinates: which modes these are.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slowest: Option<SlowModesRecord>,
}

/// Slowest modes of a body of many coordinates.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct SlowModesRecord {
    /// Rate (rad/s) up to which modes were looked for.
    ///
    /// Of their eigenvalues.
    #[serde(with = "number")]
    pub rate: f64,
    /// How many eigenvalues below it were counted and not found; `null` where they were not counted.
    pub missing: Option<usize>,
    /// Whether no motion grows, found or not, since the energy is least in the spin.
    pub positive_energy: bool,
}

/// Overdamped modes up to which each is listed.
const LISTED_OVERDAMPED: usize = 2;

/// Modes of a spin for people: those listed, and many overdamped ones folded.
#[derive(Clone, Debug)]
pub struct ModeList<'a> {
    /// Modes listed, overdamped ones last.
    pub listed: Vec<&'a ModeRecord>,
    /// Overdamped modes that are not listed; empty where they are few.
    pub folded: Vec<&'a ModeRecord>,
}

impl SteadySpinRecord {
    /// Modes for people: structural ones first, overdamped ones folded where there are more than a few.
    #[must_use]
    pub fn mode_list(&self) -> ModeList<'_> {
        let (overdamped, mut listed): (Vec<_>, Vec<_>) = self.modes.iter().partition(|mode| mode.overdamped);
        if overdamped.len() > LISTED_OVERDAMPED {
            return ModeList { listed, folded: overdamped };
        }
        listed.extend(overdamped);
        ModeList { listed, folded: Vec::new() }
    }
}

impl ModeList<'_> {
    /// Least and greatest time (s) in which the folded modes fall by e.
    #[must_use]
    pub fn folded_times(&self) -> [f64; 2] {
        let times = self.folded.iter().filter_map(|mode| mode.time_constant);
        times.fold([f64::INFINITY, 0.0], |[least, most], time| [least.min(time), most.max(time)])
    }
}

/// Campbell diagram: modes of the body at many spins, one entry in each list for a mode at a spin.
#[derive(Clone, Debug, Default, Deserialize, PartialEq, Serialize)]
pub struct CampbellRecord {
    /// Axis about which the body spins: `least` or `greatest` inertia.
    pub axis: String,
    /// Spin of the run (rad/s).
    #[serde(with = "number")]
    pub spin: f64,
    /// Spins (rad/s).
    #[serde(with = "number")]
    pub spins: Vec<f64>,
    /// Frequencies in body axes (rad/s).
    #[serde(with = "number")]
    pub frequencies: Vec<f64>,
    /// Decay rates (1/s), negative for modes that grow.
    #[serde(with = "number")]
    pub decay_rates: Vec<f64>,
}

/// A mode of a spinning body.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct ModeRecord {
    /// `nutation`, or the coordinate that moves most.
    ///
    /// Later ones of a name are counted: `"tip" x, second`.
    pub name: String,
    /// Whether the mode is the nutation.
    pub nutation: bool,
    /// Whether the mode has no rate beyond rounding.
    ///
    /// It neither oscillates nor decays nor grows.
    #[serde(default)]
    pub neutral: bool,
    /// Whether the mode is an internal motion that hardly oscillates.
    #[serde(default)]
    pub overdamped: bool,
    /// Decay rate (1/s), negative for a mode that grows.
    #[serde(with = "number")]
    pub decay_rate: f64,
    /// Bound on the rate of decay or growth (1/s), where rounding hides it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rate_bound: Option<f64>,
    /// Frequency in body axes (rad/s).
    #[serde(with = "number")]
    pub frequency: f64,
    /// e-folding time (s), negative where it grows; `null` where it does neither.
    #[serde(with = "number")]
    pub time_constant: Option<f64>,
    /// Damping ratio.
    #[serde(with = "number")]
    pub damping_ratio: f64,
    /// Rates seen from outside, frequency less and plus the spin (rad/s).
    #[serde(with = "number")]
    pub seen_from_outside: [f64; 2],
    /// Shares of the kinetic energy, by part.
    #[serde(with = "number")]
    pub moves: BTreeMap<String, f64>,
    /// Shares of the dissipation, negative if a force gives energy.
    ///
    /// By spring, hinge, part, material, rotor, cavity or force.
    #[serde(with = "number")]
    pub dissipation: BTreeMap<String, f64>,
}

/// Where a steady spin is, by its axis in a record, in words that follow "about".
#[must_use]
pub fn place_of_spin(axis: &str) -> String {
    match axis {
        "asked" => "the axis asked for".into(),
        "under forces" => "the steady state under the forces".into(),
        "at rest" => "the state of rest".into(),
        of_energy if axis.ends_with("energy") => format!("the steady spin of {of_energy}"),
        _ => match axis.split_once(", ") {
            Some((axis, sense)) => format!("the axis of {axis} inertia in the {sense}"),
            None => format!("the axis of {axis} inertia"),
        },
    }
}
