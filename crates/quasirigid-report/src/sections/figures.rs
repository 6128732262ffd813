//! Figures of a history: spin, energy, nutation, difference between systems, and the sphere of the angular momentum.

use maud::{Markup, html};
use quasirigid_io::record::RunRecord;

use crate::columns::main_history;
use crate::figures::history::{difference, energy, first_revolutions, nutation, spin};
use crate::sphere;

/// Spin, energy, nutation and the sphere of the angular momentum.
pub fn section(record: &RunRecord) -> Markup {
    html! {
        section aria-label="Figures" {
            h2 { "How it went" }
            @match main_history(record) {
                None => p.absent { "No history to draw." },
                Some(history) => {
                    (spin(history).draw())
                    @if let Some(beginning) = first_revolutions(history) { (beginning.draw()) }
                    (energy(history).draw())
                    (nutation(record, history).draw())
                    @if let Some(difference) = difference(record) { (difference.draw()) }
                    (sphere::figure(&record.body, history))
                }
            }
        }
    }
}
