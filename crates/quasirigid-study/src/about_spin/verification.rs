//! Verification of the reduced equations about a spin against the full system: plan, run, JSON and text.

use std::fmt::{self, Write};

use quasirigid::verification::{SpinVerification, VerificationError, verify_about_spin};
use quasirigid_io::model::BodyKind;
use quasirigid_io::visible::one_line;
use serde_json::{Value, json};

use super::{Planned, planned};
use crate::error::StudyError;
use crate::layout::paragraph;
use crate::motion::Motion;
use crate::settings::{PartialSpinVerify, SpinManifoldSettings};
use crate::study::Study;
use crate::watch::Watch;
use crate::words::{significant, time};

const STAGE: &str = "verifying";

impl Study {
    /// Verifies the reduced equations about the spin of a study; none if the watch ended it. (W14)
    ///
    /// # Errors
    /// [`StudyError`] for an invalid start, and where there are no such equations.
    pub fn verify_about_spin(
        &self,
        asked: &PartialSpinVerify,
        watch: &mut dyn Watch,
    ) -> Result<Option<SpinVerification>, StudyError> {
        self.left_alone("verify")?;
        self.without_slugs("verify")?;
        let settings = SpinManifoldSettings::resolve(asked.spin_manifold.clone(), None, self)?;
        let Planned { plan: about, .. } = planned(&Motion::new(self, self.initial()?), &settings)?;
        let plan = asked.resolve(about);
        match verify_about_spin(&self.body, &plan, &mut |share| watch.at(STAGE, share)) {
            Err(VerificationError::Interrupted) => Ok(None),
            found => Ok(Some(found?)),
        }
    }
}

/// The verification as JSON.
#[must_use]
pub fn verification_json(found: &SpinVerification) -> Value {
    let rows = found.rows.iter().map(|row| {
        let of = |value: fn(&quasirigid::verification::Difference) -> f64| -> Vec<f64> {
            row.differences.iter().map(value).collect()
        };
        json!({
            "p": row.degree,
            "order": row.order,
            "expected": row.degree + 1,
            "reached": row.reached(),
            "amplitudes": found.amplitudes,
            "errors": of(|difference| difference.omega),
            "attitude": of(|difference| difference.attitude),
        })
    });
    let orders: Vec<Value> = rows.collect();
    json!({ "about": "spin", "reached": found.reached(), "duration": found.duration, "orders": orders })
}

/// The differences and their orders, for a terminal of 80 columns.
#[must_use]
pub fn verification_text(name: &str, kind: BodyKind, found: &SpinVerification) -> String {
    let mut text = String::new();
    write(&mut text, &one_line(name), kind, found).expect("a string takes any text");
    text
}

/// Columns that fit a terminal.
const COLUMNS: usize = 5;

fn write(out: &mut String, name: &str, kind: BodyKind, found: &SpinVerification) -> fmt::Result {
    let title = format!(
        "{name}: the full system against the reduced equations about the spin over {}, from points of the spin manifold at \
         {}s of {} degrees and its halves.",
        time(found.duration),
        kind.nutation(),
        significant(found.amplitudes[0].to_degrees(), 3)
    );
    writeln!(out, "{}", paragraph(&title, "", "  "))?;
    writeln!(out, "\n  Largest difference in spin, relative to the spin")?;
    write!(out, "   p")?;
    for amplitude in found.amplitudes.iter().take(COLUMNS) {
        write!(out, " {:>9}", format!("{} deg", significant(amplitude.to_degrees(), 2)))?;
    }
    writeln!(out, "   order (expected)")?;
    for row in &found.rows {
        write!(out, "  {:>2}", row.degree)?;
        for difference in row.differences.iter().take(COLUMNS) {
            write!(out, " {:>9.2e}", difference.omega)?;
        }
        let order = row.order.map_or("below rounding".into(), |order| format!("{order:.3}"));
        let missed = if row.reached() { "" } else { " NOT REACHED" };
        writeln!(out, "   {order} ({}){missed}", row.degree + 1)?;
    }
    let verdict = if found.reached() { "Every order is reached." } else { "NOT EVERY ORDER IS REACHED." };
    writeln!(out, "\n{verdict}")
}
