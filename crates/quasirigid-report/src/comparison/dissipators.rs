use std::collections::BTreeSet;

use maud::{Markup, html};

use super::Compared;
use crate::number::percent;
use crate::sections::dissipation::bar;
use crate::sections::overview::shares;
use crate::sections::table::{first, table};

/// Dissipators listed.
const MAX_LISTED: usize = 24;

/// Share of each dissipator in each run.
pub fn section(runs: &[Compared<'_>]) -> Markup {
    let found: Vec<_> = runs.iter().map(|run| shares(run.record, run.shown().0)).collect();
    let names: BTreeSet<&str> =
        found.iter().flatten().flat_map(|(_, shares)| shares.keys().map(String::as_str)).collect();
    let names: Vec<&str> = names.into_iter().collect();
    let (shown, more) = first(&names, MAX_LISTED);
    let headings: Vec<&str> = std::iter::once("").chain(runs.iter().map(|run| run.label)).collect();
    html! {
        @if names.len() > 1 {
            section.comparison.by-share aria-label="Dissipation" {
                h2 { "Dissipation shares" }
                (table("Share of each dissipator", &headings, html! {
                    @for name in shown {
                        tr {
                            th scope="row" { (name) }
                            @for shares in &found {
                                td {
                                    @match shares.and_then(|(_, shares)| shares.get(*name)) {
                                        Some(share) => { (percent(*share)) (bar(*share)) }
                                        None => "–",
                                    }
                                }
                            }
                        }
                    }
                }))
                @if let Some(more) = more { p.absent { (more) } }
            }
        }
    }
}
