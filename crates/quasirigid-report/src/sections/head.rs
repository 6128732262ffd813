use maud::{Markup, html};
use quasirigid_io::record::{HistoryRecord, RunRecord};

use super::overview;
use crate::columns::main_history;
use crate::verdict::Verdict;

/// Name, verdict, reason of an early end, and the remarks to read before the numbers.
pub fn section(record: &RunRecord) -> Markup {
    let verdict = Verdict::of_all(&record.validity);
    let (shown, words) = overview::headline(record, verdict);
    html! {
        header {
            p.kind { "Spin of an almost rigid body" }
            h1 { (name(record)) }
            (overview::answer(record, shown))
            div.verdict.(shown.class()) role="status" {
                (shown.icon())
                p {
                    strong { (words) } " " (record.validity.verdict)
                    @if let Some(advice) = overview::advice(record, verdict) { " " (advice) }
                }
            }
            @if let Some(history) = main_history(record).filter(|history| ended_early(history)) {
                div.verdict.marginal {
                    (Verdict::Marginal.icon())
                    p { strong { "Ended early" } " " (history.message) " (" (history.status) ")" }
                }
            }
            @if !record.notes.is_empty() {
                section.notes aria-label="Notes" {
                    h2 { "Notes" }
                    ul { @for note in &record.notes { li { (note) } } }
                }
            }
        }
    }
}

/// Whether the run stopped before its time.
pub fn ended_early(history: &HistoryRecord) -> bool {
    history.status != "finished"
}

fn name(record: &RunRecord) -> &str {
    [&record.model.name, &record.model.file]
        .into_iter()
        .find(|name| !name.is_empty())
        .map_or("Unnamed body", |name| name)
}
