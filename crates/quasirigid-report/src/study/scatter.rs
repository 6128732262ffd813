//! Scatter of any two columns of a study, chosen in the page; its script draws from the data that the page holds.
//! At most some thousand rows are kept, evenly chosen, so that the page stays small for a study of any size.

use maud::{Markup, PreEscaped, html};
use quasirigid_io::record::{SweepColumn, SweepRecord};

/// Most rows in the page.
const MAX_ROWS: usize = 4000;

/// The scatter with its two choices.
pub fn section(record: &SweepRecord, columns: &[SweepColumn]) -> Markup {
    let columns: Vec<&SweepColumn> =
        columns.iter().filter(|column| column.values.iter().any(|value| value.is_finite())).collect();
    if columns.len() < 2 {
        return html! {};
    }
    let rows = columns[0].values.len();
    let kept: Vec<usize> = (0..rows.min(MAX_ROWS)).map(|i| i * rows / rows.min(MAX_ROWS)).collect();
    html! {
        section aria-label="Scatter" {
            h2 { "Any two columns" }
            p.choices {
                label { "Across " (select("scatter-x", &columns, 0)) }
                label { "Up " (select("scatter-y", &columns, columns.len() - 1)) }
            }
            figure { div.chart.still { svg.plot id="scatter" role="img" aria-label="Scatter of the two columns" {} } }
            p.absent { (kept.len()) " of " (record.rows) " rows are in this page." noscript { " The scatter needs scripts." } }
            script type="application/json" id="rows" { (PreEscaped(data(record, &columns, &kept))) }
        }
    }
}

fn select(id: &str, columns: &[&SweepColumn], chosen: usize) -> Markup {
    html! {
        select id=(id) {
            @for (i, column) in columns.iter().enumerate() { option value=(i) selected[i == chosen] { (column.name) } }
        }
    }
}

/// Names, units and rows as JSON; what could end the script is escaped.
fn data(record: &SweepRecord, columns: &[&SweepColumn], kept: &[usize]) -> String {
    let number = |value: f64| if value.is_finite() { format!("{value:.6e}") } else { "null".to_owned() };
    let one = |column: &&SweepColumn| {
        let values: Vec<String> = kept.iter().map(|row| number(column.values[*row])).collect();
        let [name, unit] = [&column.name, unit(record, &column.name)].map(text_literal);
        format!("{{\"name\":{name},\"unit\":{unit},\"values\":[{}]}}", values.join(","))
    };
    format!("[{}]", columns.iter().map(one).collect::<Vec<_>>().join(","))
}

/// Unit of a column; empty if there is none.
fn unit<'a>(record: &'a SweepRecord, name: &str) -> &'a str {
    let inputs = record.inputs.iter().map(|input| (&input.name, &input.unit));
    let mut all = inputs.chain(record.quantities.iter().map(|quantity| (&quantity.name, &quantity.unit)));
    all.find(|(known, _)| *known == name).map_or("", |(_, unit)| unit)
}

/// A text as a JSON string in which no character of markup stands.
fn text_literal(text: &str) -> String {
    let escaped = |letter: char| match letter {
        '"' | '\\' | '<' | '>' | '&' | '\u{2028}' | '\u{2029}' | '\0'..='\u{1f}' => {
            format!("\\u{:04x}", letter as u32)
        }
        _ => letter.to_string(),
    };
    format!("\"{}\"", text.chars().map(escaped).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_name_ends_the_script() {
        assert_eq!(text_literal("a</script>\"\\\n"), "\"a\\u003c/script\\u003e\\u0022\\u005c\\u000a\"");
    }
}
