//! Texts for a terminal of 80 columns.

use textwrap::{Options, WordSeparator, WordSplitter};

/// Columns that texts keep to.
const WIDTH: usize = 79;

/// A paragraph, broken at spaces only, so that paths and options stay whole.
pub fn paragraph(text: &str, first: &str, rest: &str) -> String {
    let options = Options::new(WIDTH)
        .initial_indent(first)
        .subsequent_indent(rest)
        .break_words(false)
        .word_separator(WordSeparator::AsciiSpace)
        .word_splitter(WordSplitter::NoHyphenation);
    textwrap::fill(text, options)
}

/// A message whose own line breaks stay.
pub fn message(text: &str) -> String {
    text.lines().map(|line| paragraph(line, "", "")).collect::<Vec<_>>().join("\n")
}
