//! Rows of a VOTable some at a time.

use std::ops::Range;

use roxmltree::{Document, Node};

use super::all;

const NAME: &str = "TABLEDATA";
/// Bytes of a piece at least.
const PIECE: usize = 1 << 16;

/// Where the rows of the first `TABLEDATA` stand in the text; none where that does not show without a parser.
pub(super) fn place(text: &str) -> Option<Range<usize>> {
    let name = text.find(NAME)?;
    prefix(text, name)?;
    let start = name + text[name..].find('>')? + 1;
    let end = start + text[start..].find(NAME)?;
    let end = start + text[start..end].rfind("</")?;
    (!text[..start].ends_with("/>")).then_some(start..end)
}

/// The prefix of a name, with its colon.
fn prefix(text: &str, name: usize) -> Option<&str> {
    let open = text[..name].rfind('<')?;
    let prefix = &text[open + 1..name];
    (prefix.is_empty()
        || prefix.ends_with(':') && prefix.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b':'))
    .then_some(prefix)
}

/// Gives every row with its place in the text.
pub(super) fn each(
    text: &str,
    rows: Range<usize>,
    add: &mut impl FnMut(Node<'_, '_>, usize),
) -> Result<(), String> {
    let prefix = text[..rows.start].rfind(NAME).and_then(|name| prefix(text, name)).unwrap_or_default();
    let space = prefix.trim_end_matches(':');
    let open = if space.is_empty() { "<rows>".to_owned() } else { format!("<rows xmlns:{space}=\"rows\">") };
    let end_of_row = format!("</{prefix}TR>");
    let mut start = rows.start;
    while start < rows.end {
        let least = (start + PIECE).min(rows.end);
        let least = (least..=rows.end).find(|place| text.is_char_boundary(*place)).unwrap_or(rows.end);
        let end = text[least..rows.end]
            .find(&end_of_row)
            .map_or(rows.end, |place| least + place + end_of_row.len());
        let piece = [&open, &text[start..end], "</rows>"].concat();
        let document = Document::parse(&piece).map_err(|cause| cause.to_string())?;
        all(document.root(), "TR").for_each(|row| add(row, row.range().start - open.len() + start));
        start = end;
    }
    Ok(())
}
