//! Head and tables of the page of a study: rows answered, percentiles, rank correlations, refusals.

use maud::{Markup, html};
use quasirigid_io::record::{StudyColumn, StudyInfluence, StudyRecord, StudyRole};

use crate::number::{percent, short, tidy};
use crate::verdict::Verdict;

/// Name of the study and the share of its rows that were answered.
pub fn head(record: &StudyRecord) -> Markup {
    let StudyRecord { rows, answered, .. } = record;
    let missing = rows - answered;
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
                        a href="#refusals" { "the reasons" } " are at the end."
                    }
                }
            }
        }
    }
}

/// Percentiles of every quantity.
pub fn percentiles(record: &StudyRecord) -> Markup {
    let quantities: Vec<&StudyColumn> = of(record, |role| role == StudyRole::Quantity);
    let Some(first) = quantities.iter().find(|column| !column.percentiles.is_empty()) else {
        return html! {};
    };
    html! {
        section aria-label="Percentiles" {
            h2 { "Percentiles" }
            div.scroll {
                table {
                    thead { tr {
                        th { "Quantity" } th { "Rows" }
                        @for (percent, _) in &first.percentiles { th { (tidy(*percent, 4)) " %" } }
                    } }
                    tbody {
                        @for column in quantities.iter().filter(|column| !column.percentiles.is_empty()) {
                            tr {
                                th scope="row" { (named(column)) }
                                td { (column.values.iter().filter(|value| value.is_finite()).count()) }
                                @for (_, value) in &column.percentiles { td { (short(*value)) } }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Rank correlations, the strongest input first for each quantity.
pub fn influences(record: &StudyRecord) -> Markup {
    if record.influences.is_empty() {
        return html! {};
    }
    let mut rows: Vec<&StudyInfluence> = record.influences.iter().collect();
    rows.sort_by(|a, b| {
        let strength = |row: &StudyInfluence| row.rank_correlation.abs();
        a.quantity.cmp(&b.quantity).then(strength(b).total_cmp(&strength(a)))
    });
    html! {
        section aria-label="Inputs that decide" {
            h2 { "Inputs that decide" }
            div.scroll {
                table.influences {
                    thead { tr { th { "Quantity" } th.word { "Input" } th { "Rank correlation" } th { "Rows" } } }
                    tbody {
                        @for row in rows {
                            tr {
                                th scope="row" { (row.quantity) }
                                td.word { (row.input) }
                                td { (tidy(row.rank_correlation, 3)) span.bar style={ "width:" (percent_of(row.rank_correlation)) } {} }
                                td { (row.rows) }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Rows without an answer, by reason.
pub fn refusals(record: &StudyRecord) -> Markup {
    if record.refusals.is_empty() {
        return html! {};
    }
    html! {
        section id="refusals" aria-label="Rows without an answer" {
            h2 { "Rows without an answer" }
            div.scroll {
                table.refusals {
                    thead { tr { th { "Reason" } th.word { "Status" } th { "Rows" } th { "Share" } th { "First" } } }
                    tbody {
                        @for row in &record.refusals {
                            tr {
                                th scope="row" { (row.reason) }
                                td.word { (row.status) }
                                td { (row.rows) }
                                td { (percent(row.rows as f64 / record.rows.max(1) as f64)) }
                                td { (row.first) }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Columns of some origin.
pub fn of(record: &StudyRecord, role: impl Fn(StudyRole) -> bool) -> Vec<&StudyColumn> {
    record.columns.iter().filter(|column| role(column.role)).collect()
}

fn named(column: &StudyColumn) -> String {
    if column.unit.is_empty() || column.unit == "1" {
        column.name.clone()
    } else {
        format!("{} [{}]", column.name, column.unit)
    }
}

fn percent_of(correlation: f64) -> String {
    format!("{:.1}%", 100.0 * correlation.abs().min(1.0))
}
