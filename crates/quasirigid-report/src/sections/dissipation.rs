use std::collections::BTreeMap;

use maud::{Markup, html};

use super::table::{first, table};
use crate::number::percent;

/// Dissipators shown.
const MAX_DISSIPATORS: usize = 12;

/// Shares of the dissipators: a bar for each, the largest first; nothing where there are none.
pub fn bars(caption: &str, shares: &BTreeMap<String, f64>) -> Markup {
    let mut parts: Vec<(&str, f64)> = shares.iter().map(|(name, share)| (name.as_str(), *share)).collect();
    parts.sort_by(|a, b| b.1.total_cmp(&a.1));
    if parts.len() < 2 {
        return html! {};
    }
    let (shown, more) = first(&parts, MAX_DISSIPATORS);
    html! {
        div.shares {
            (table(caption, &["Dissipator", "Share", ""], html! {
                @for (name, share) in shown {
                    tr { th scope="row" { (name) } td { (percent(*share)) } td { (bar(*share)) } }
                }
            }))
            @if let Some(more) = more { p.absent { (more) } }
        }
    }
}

pub fn bar(share: f64) -> Markup {
    let width = if share.is_finite() { 100.0 * share.clamp(0.0, 1.0) } else { 0.0 };
    html! { span.bar style={ "width:" (format!("{width:.2}")) "%" } {} }
}
