//! A preprocessor of mdBook. The forge reads formulas between dollars and links to any file of the repository; mdBook knows neither, so
//! formulas become what its MathJax looks for, and a link out of `docs` one to the forge.

use std::io::{self, Read};

use serde_json::Value;

use super::{SOURCE, SUMMARY, is_outward, resolved};
use crate::markdown::{Kind, pieces, targets};

/// Reads the book from the standard input and writes it, changed, to the standard output.
///
/// # Errors
/// An input that is not `[context, book]` in JSON.
pub fn preprocess() -> io::Result<()> {
    let mut input = String::new();
    io::stdin().read_to_string(&mut input)?;
    let (context, mut book): (Value, Value) = serde_json::from_str(&input)?;
    let repository = context["config"]["output"]["html"]["git-repository-url"].as_str().unwrap_or_default();
    change(&mut book, repository);
    println!("{book}");
    Ok(())
}

/// Changes every chapter of a value, which has a path and a content, whatever the version of mdBook calls the lists of chapters.
fn change(value: &mut Value, repository: &str) {
    let file = value["source_path"].as_str().map(|path| format!("{SOURCE}/{path}"));
    match value {
        Value::Array(values) => values.iter_mut().for_each(|value| change(value, repository)),
        Value::Object(fields) => {
            if let (Some(file), Some(Value::String(content))) = (file, fields.get_mut("content")) {
                *content = for_mdbook(content, &file, repository);
            }
            fields.values_mut().for_each(|value| change(value, repository));
        }
        _ => {}
    }
}

fn for_mdbook(markdown: &str, file: &str, repository: &str) -> String {
    let pieces = pieces(markdown);
    let changed = pieces.iter().map(|piece| match piece.kind {
        Kind::Prose => with_links(piece.text, file, repository),
        Kind::Code => format!("{0}{1}{0}", if piece.text.contains('`') { "``" } else { "`" }, piece.text),
        Kind::Block => piece.text.to_owned(),
        Kind::Inline => literal(&format!(r"\({}\)", piece.text)),
        Kind::Display => {
            let lines = piece.text.lines().map(str::trim).filter(|line| !line.is_empty());
            literal(&format!("\\[{}\\]", lines.collect::<Vec<_>>().join("\n"))) + "\n"
        }
    });
    changed.collect()
}

/// Prose whose links out of the book lead to the forge.
fn with_links(prose: &str, file: &str, repository: &str) -> String {
    let mut text = prose.to_owned();
    for range in targets(prose).into_iter().rev() {
        let target = &prose[range.clone()];
        let path = resolved(file, target);
        let is_page = path.starts_with(SOURCE) && path != SUMMARY;
        if !is_outward(target) && !is_page {
            let anchor = target.find('#').map_or("", |at| &target[at..]);
            text.replace_range(range, &format!("{repository}/blob/HEAD/{path}{anchor}"));
        }
    }
    text
}

/// A text that Markdown leaves as it is: each of its punctuation marks is escaped.
fn literal(text: &str) -> String {
    let mark = |c: char| if c.is_ascii_punctuation() { "\\" } else { "" };
    text.chars().flat_map(|c| mark(c).chars().chain([c])).collect()
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn formulas_and_links_out_of_the_book_are_changed_in_every_chapter() {
        let inner = json!({"source_path": "guide/b.md", "content": "[c](../../data/d.csv#e), [f](../a.md), [s](../SUMMARY.md)"});
        let outer = json!({"source_path": "a.md", "content": "`$x$` $a_b$\n```math\n c \\\\\n\n d\n```\n", "sub_items": [{"Chapter": inner}]});
        let mut book = json!({"items": [{"Chapter": outer}, "Separator"]});
        change(&mut book, "https://forge");
        let outer = &book["items"][0]["Chapter"];
        assert_eq!(outer["content"], "`$x$` \\\\\\(a\\_b\\\\\\)\n\\\\\\[c \\\\\\\\\nd\\\\\\]\n");
        assert_eq!(
            outer["sub_items"][0]["Chapter"]["content"],
            "[c](https://forge/blob/HEAD/data/d.csv#e), [f](../a.md), [s](https://forge/blob/HEAD/docs/SUMMARY.md)"
        );
    }
}
