//! Head and tables of the page of a study: rows answered, percentiles, rank correlations, refusals.

use maud::{Markup, html};
use quasirigid_io::record::{CorrelationRecord, QuantityRecord, SweepRecord};

use crate::number::{percent, short, tidy};
use crate::verdict::Verdict;

/// Name of the study and the share of its rows that were answered.
pub fn head(record: &SweepRecord) -> Markup {
    let answered = record.status.get("answered").copied().unwrap_or_default();
    let (rows, missing) = (record.rows, record.rows.saturating_sub(answered));
    let verdict = match (missing, answered) {
        (0, _) => Verdict::Holds,
        (_, 0) => Verdict::Fails,
        _ => Verdict::Marginal,
    };
    html! {
        header {
            p.kind { "Study" }
            h1 { (record.name) }
            div.verdict.(verdict.class()) {
                (verdict.icon())
                p {
                    strong { (answered) " of " (rows) " rows are answered." }
                    @if missing > 0 {
                        " " (missing) @if missing == 1 { " row has" } @else { " rows have" } " no number here; "
                        a href="#reasons" { "the reasons" } " are at the end."
                    }
                }
            }
        }
    }
}

/// Percentiles of every numeric quantity.
pub fn percentiles(record: &SweepRecord) -> Markup {
    let told = |quantity: &&QuantityRecord| !quantity.percentiles.is_empty();
    let Some(first) = record.quantities.iter().find(told) else { return html! {} };
    html! {
        section aria-label="Percentiles" {
            h2 { "Percentiles" }
            div.scroll {
                table {
                    thead { tr {
                        th { "Quantity" } th { "Rows" }
                        @for percentile in &first.percentiles { th { (tidy(percentile.percent, 4)) " %" } }
                    } }
                    tbody {
                        @for quantity in record.quantities.iter().filter(told) {
                            tr {
                                th scope="row" { (with_unit(&quantity.name, &quantity.unit)) }
                                td { (quantity.count) }
                                @for percentile in &quantity.percentiles { td { (short(percentile.value)) } }
                            }
                        }
                    }
                }
            }
            (counts(record))
        }
    }
}

/// Rows with each truth value or text.
fn counts(record: &SweepRecord) -> Markup {
    html! {
        @for quantity in record.quantities.iter().filter(|quantity| !quantity.counts.is_empty()) {
            p { (quantity.name) ": " @for (i, (word, rows)) in quantity.counts.iter().enumerate() { @if i > 0 { ", " } (word) " in " (rows) } " rows." }
        }
    }
}

/// Rank correlations, the strongest input first for each quantity.
pub fn influences(record: &SweepRecord) -> Markup {
    let known: Vec<(&CorrelationRecord, f64)> =
        record.correlations.iter().filter_map(|row| Some((row, row.rho?))).collect();
    html! {
        @if !known.is_empty() {
            section aria-label="Inputs that decide" {
                h2 { "Inputs that decide" }
                div.scroll {
                    table.influences {
                        thead { tr { th { "Quantity" } th.word { "Input" } th { "Rank correlation" } th { "Rows" } } }
                        tbody {
                            @for (row, rho) in known {
                                tr {
                                    th scope="row" { (row.quantity) }
                                    td.word { (row.input) }
                                    td { (tidy(rho, 3)) span.bar style={ "width:" (width(rho)) } {} }
                                    td { (row.rows) }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Rows without an answer, by reason.
pub fn reasons(record: &SweepRecord) -> Markup {
    html! {
        @if !record.reasons.is_empty() {
            section id="reasons" aria-label="Rows without an answer" {
                h2 { "Rows without an answer" }
                div.scroll {
                    table.reasons {
                        thead { tr { th { "Reason" } th.word { "Status" } th { "Rows" } th { "Share" } th { "First" } } }
                        tbody {
                            @for row in &record.reasons {
                                tr {
                                    th scope="row" { (row.example) }
                                    td.word { (row.status) }
                                    td { (row.count) }
                                    td { (percent(row.count as f64 / record.rows.max(1) as f64)) }
                                    td { (row.first_row) }
                                }
                            }
                        }
                    }
                }
                p.absent { "Reasons that differ in numbers alone are one; that of their first row is shown." }
            }
        }
    }
}

/// A name with its unit.
pub fn with_unit(name: &str, unit: &str) -> String {
    if unit.is_empty() || unit == "1" { name.to_owned() } else { format!("{name} [{unit}]") }
}

fn width(correlation: f64) -> String {
    format!("{:.1}%", 100.0 * correlation.abs().min(1.0))
}
