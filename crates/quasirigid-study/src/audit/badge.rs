//! Badge of an audit for the page of a project, in the form that the endpoint of shields.io takes.

use serde_json::{Value, json};

use super::Audit;
use crate::words::time;

impl Audit {
    /// The badge: what is invented, green where nothing is or the limits are kept.
    #[must_use]
    pub fn badge(&self) -> Value {
        let message = match self.invented_time_constant {
            _ if !self.holds => "does not fit".to_owned(),
            None if self.within_limits == Some(false) => "above the limit".to_owned(),
            None => "none above digits".to_owned(),
            Some(constant) if constant < 0.0 => format!("grows e-fold in {}", time(-constant)),
            Some(constant) => format!("e-fold in {}", time(constant)),
        };
        let fine = self.within_limits.unwrap_or(self.invented_time_constant.is_none());
        let color = match (self.holds, fine) {
            (false, _) => "lightgrey",
            (true, true) => "brightgreen",
            (true, false) => "red",
        };
        json!({ "schemaVersion": 1, "label": "invented damping", "message": message, "color": color })
    }
}
