//! Record of an evolution without an answer, and the blank of one with an answer.

use std::collections::BTreeMap;

use quasirigid_io::record::EvolutionRecord;

/// Record of an evolution that no method leads along: a message, the angular momentum (N·m·s), and the mode of the start.
pub fn unanswered(message: &str, angular_momentum: f64, mode: &str) -> EvolutionRecord {
    EvolutionRecord {
        sentence: format!("NO ANSWER: {message}."),
        road: "none".into(),
        verdict: String::new(),
        method: "none: no method holds here".into(),
        status: "refused".into(),
        message: format!("No answer: {message}."),
        angular_momentum,
        mode_start: mode.into(),
        mode_end: mode.into(),
        ratio_start: f64::NAN,
        ratio_end: f64::NAN,
        start: None,
        end: None,
        time: f64::NAN,
        time_error: None,
        time_range: None,
        revolutions: f64::NAN,
        power: f64::NAN,
        dissipation: BTreeMap::new(),
        separatrix_time: None,
        lingering: None,
        damping_time: f64::NAN,
        growth_time: f64::NAN,
        not_known: Vec::new(),
        estimates: Vec::new(),
        homogeneous: None,
        harmonics: Vec::new(),
        resonances: Vec::new(),
        approach: None,
        columns: Vec::new(),
    }
}
