use maud::{Markup, html};
use quasirigid_io::record::{Column, HistoryRecord, RunRecord};

use super::table::{facts, table};
use crate::columns::ends;
use crate::number::{short, tidy};

/// Program and model that made these numbers, and the integration of each history.
pub fn section(record: &RunRecord) -> Markup {
    html! {
        section aria-label="Record" {
            h2 { "The record" }
            (facts("Origin", &[
                ("Made by", html! { "quasirigid " (record.version) }),
                ("Model file", html! { (record.model.file) }),
                ("SHA-256 of the model", html! { code { (record.model.sha256) } }),
            ]))
            @for history in &record.histories {
                (integration(history))
                (columns(&format!("history-{}.csv", history.system), &history.columns, history.rows()))
            }
            @if let Some(evolution) = &record.evolution { (columns("evolution.csv", &evolution.columns, 0)) }
        }
    }
}

fn integration(history: &HistoryRecord) -> Markup {
    let joules = |value: f64| html! { (short(value)) " J" };
    facts(
        &format!("System: {}", history.system),
        &[
            ("Equations", html! { (history.form) }),
            ("Method", html! { (history.method) }),
            ("Status", html! { (history.status) @if !history.message.is_empty() { ": " (history.message) } }),
            ("Relative tolerance", html! { (short(history.tolerance)) }),
            ("Steps", steps(history)),
            ("Revolutions", html! { (tidy(history.revolutions, 6)) }),
            ("Energy at the start", joules(history.energy)),
            ("Energy dissipated", joules(history.dissipated)),
            ("Work of external forces", joules(history.work)),
            ("Numerical drift of energy", joules(history.energy_drift)),
            ("Numerical drift of |K|, relative", html! { (short(history.momentum_drift)) }),
        ],
    )
}

fn steps(history: &HistoryRecord) -> Markup {
    html! {
        (history.steps) " accepted, " (history.rejected) " rejected"
    }
}

/// Summary of a table of so many rows, or of as many as are there.
fn columns(file: &str, columns: &[Column], rows: u64) -> Markup {
    let rows = columns.first().map_or(0, |column| rows.max(column.values.len() as u64));
    if rows == 0 {
        return html! { p.absent { "No rows in " (file) "." } };
    }
    let caption = format!("Columns of {file}, {rows} rows");
    let rows = html! {
        @for column in columns {
            tr {
                th scope="row" { (column.name) }
                td.word { "[" (column.unit) "]" }
                @for value in summary(column) { td { (value) } }
            }
        }
    };
    let headings = ["Column", "Unit", "First", "Last", "Least", "Greatest"];
    html! { div.columns { (table(&caption, &headings, rows)) } }
}

/// First, last, least and greatest of the finite values.
fn summary(column: &Column) -> [String; 4] {
    let finite = || column.values.iter().copied().filter(|value| value.is_finite());
    let Some((first, last)) = ends(column.values.iter().copied()) else {
        return [(); 4].map(|()| "undefined".into());
    };
    [first, last, finite().fold(first, f64::min), finite().fold(first, f64::max)].map(short)
}
