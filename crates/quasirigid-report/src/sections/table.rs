//! Tables that scroll sideways when the screen is narrow.

use maud::{Markup, html};

/// A table with a row of headings.
pub fn table(caption: &str, headings: &[&str], rows: Markup) -> Markup {
    html! {
        div.scroll {
            table {
                caption { (caption) }
                thead { tr { @for heading in headings { th scope="col" { (heading) } } } }
                tbody { (rows) }
            }
        }
    }
}

/// A table of names and values.
pub fn facts(caption: &str, facts: &[(&str, Markup)]) -> Markup {
    html! {
        div.scroll {
            table.facts {
                caption { (caption) }
                tbody { @for (name, value) in facts { tr { th scope="row" { (name) } td { (value) } } } }
            }
        }
    }
}

/// The first of many, and the number of further ones in the record.
pub fn first<T>(items: &[T], most: usize) -> (&[T], Option<String>) {
    let shown = &items[..items.len().min(most)];
    let more = items.len() - shown.len();
    (shown, (more > 0).then(|| format!("and {more} more in record.json")))
}
