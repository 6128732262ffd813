//! Texts for a terminal of 80 columns.

use textwrap::{Options, WordSeparator, WordSplitter};

/// Columns that texts keep to.
const WIDTH: usize = 79;

/// A space at which no line is broken, printed as any other.
pub const FIRM: char = '\u{a0}';

/// A paragraph, broken at spaces only, so that paths and options stay whole.
pub fn paragraph(text: &str, first: &str, rest: &str) -> String {
    textwrap::fill(text, options(WIDTH).initial_indent(first).subsequent_indent(rest)).replace(FIRM, " ")
}

/// A message whose own line breaks stay.
pub fn message(text: &str) -> String {
    text.lines().map(|line| paragraph(line, "", "")).collect::<Vec<_>>().join("\n")
}

/// A paragraph that starts behind something on the same line.
pub fn paragraph_after(text: &str, columns: usize) -> String {
    paragraph(text, &" ".repeat(columns), "").trim_start().to_owned()
}

/// A paragraph for a box that is narrower by this number of columns.
pub fn narrowed(text: &str, columns: usize) -> String {
    textwrap::fill(text, options(WIDTH - columns))
}

fn options(width: usize) -> Options<'static> {
    Options::new(width)
        .break_words(false)
        .word_separator(WordSeparator::AsciiSpace)
        .word_splitter(WordSplitter::NoHyphenation)
}
