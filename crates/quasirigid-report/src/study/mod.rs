//! Page of a study: how many rows were answered, percentiles, the inputs that decide, figures and refusals.
//! Like the report of a run it is one file that asks the network for nothing; a study of any size makes a page of bounded size.

mod figures;
mod population;
mod scatter;
mod tables;

use maud::{PreEscaped, html};
use quasirigid_io::record::{SweepColumn, SweepRecord};

use crate::page::document;

const CHARTS: &str = include_str!("../assets/study.css");
const SCRIPT: &str = include_str!("../assets/scatter.js");

/// The page of a study: one HTML file that needs no other.
///
/// The share of answered rows comes first, then percentiles, the inputs that decide, a figure of each quantity, a scatter of any two
/// columns, and the reasons of the rows without an answer.
///
/// All columns have the same rows; a column of the record that is not among them has no figure.
pub fn study_page(record: &SweepRecord, columns: &[SweepColumn]) -> String {
    let body = html! {
        main {
            (tables::head(record))
            (tables::percentiles(record))
            (tables::influences(record))
            (population::section(record, columns))
            (figures::section(record, columns))
            (scatter::section(record, columns))
            (tables::reasons(record))
            section aria-label="Study" {
                h2 { "Study" }
                pre { code { (record.study) } }
                p.absent { "quasirigid " (record.version) }
            }
        }
        script { (PreEscaped(SCRIPT)) }
    };
    document(&format!("{} · quasirigid study", record.name), &record.version, &[CHARTS], &body)
}
