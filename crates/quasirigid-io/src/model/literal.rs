//! TOML strings as they are written, with quotes and escapes, against the texts they mean.

use std::ops::Range;

/// The place in a written string of a part of the text that the string means, both in bytes; the closing quote where the
/// part is the end of the text.
pub(super) fn place(literal: &str, part: Range<usize>) -> Option<Range<usize>> {
    let quote = literal.chars().next().filter(|quote| matches!(quote, '"' | '\''))?;
    let many = literal.len() >= 6 && literal.bytes().take(3).all(|byte| byte == quote as u8);
    let width = if many { 3 } else { 1 };
    let inside = literal.get(width..literal.len().checked_sub(width)?)?;
    let first_line = if many { inside.len() - without_newline(inside).len() } else { 0 };
    let reader = Reader { text: inside, escapes: quote == '"' };
    let start = reader.skip(reader.place(first_line, part.start));
    let end = reader.place(first_line, part.end).max(start + reader.width(start));
    Some(start + width..(end + width).min(literal.len()))
}

fn without_newline(text: &str) -> &str {
    text.strip_prefix("\r\n").or_else(|| text.strip_prefix('\n')).unwrap_or(text)
}

/// White space of TOML: not every space that Unicode knows.
const BLANK: [char; 4] = [' ', '\t', '\n', '\r'];

/// Steps through the inside of a written string.
struct Reader<'a> {
    text: &'a str,
    escapes: bool,
}

impl Reader<'_> {
    /// The place at which the byte of the text with this index is written, or the end.
    fn place(&self, from: usize, index: usize) -> usize {
        let (mut at, mut read) = (from, 0);
        while at < self.text.len() && read < index {
            let (written, meant) = self.step(at);
            at += written;
            read += meant;
        }
        at
    }

    /// The first place from here on where something meant is written.
    fn skip(&self, mut at: usize) -> usize {
        while at < self.text.len() && self.step(at).1 == 0 {
            at += self.step(at).0;
        }
        at
    }

    /// Bytes of the character written at a place; one at the end, for the quote.
    fn width(&self, at: usize) -> usize {
        if at < self.text.len() { self.step(at).0 } else { 1 }
    }

    /// Bytes of one character, or of one that is skipped, as written and as meant.
    fn step(&self, at: usize) -> (usize, usize) {
        let rest = &self.text[at..];
        let mut characters = rest.chars();
        let first = characters.next().map_or(1, char::len_utf8);
        if !(self.escapes && rest.starts_with('\\')) {
            return (first, first);
        }
        let digits = match characters.next() {
            Some('u') => 4,
            Some('U') => 8,
            Some('x') => 2,
            Some(' ' | '\t' | '\n' | '\r') => {
                return (rest.len() - rest[1..].trim_start_matches(BLANK).len(), 0);
            }
            other => return (1 + other.map_or(0, char::len_utf8), 1),
        };
        let code = rest.get(2..2 + digits).and_then(|hex| u32::from_str_radix(hex, 16).ok());
        let meant = code.and_then(char::from_u32).map_or(1, char::len_utf8);
        ((2 + digits).min(rest.len()), meant)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;
    use toml::de::DeValue;

    use super::place;

    fn shown(literal: &str, part: std::ops::Range<usize>) -> &str {
        place(literal, part).map_or("none", |place| &literal[place])
    }

    #[test]
    fn escapes_and_newlines_are_counted_as_they_are_written() {
        assert_eq!(shown("\"2*foo + t\"", 2..5), "foo");
        assert_eq!(shown("'2*foo\\t'", 5..6), "\\");
        assert_eq!(shown(r#""a\tb\u0062\U00000063d""#, 4..5), "\\U00000063");
        assert_eq!(shown(r#""\u00e9\"x""#, 3..4), "x");
        assert_eq!(shown("\"\"\"\n2*\\\n   foo\"\"\"", 2..5), "foo");
        assert_eq!(shown("'''\r\nfoo'''", 0..3), "foo");
        assert_eq!(shown("\"\"\"\\\n\u{2000}foo\"\"\"", 0..3), "\u{2000}");
        assert_eq!(shown("\"t +\"", 3..3), "\"");
        assert_eq!(shown("\"\"", 0..0), "\"");
        assert_eq!(place("12", 0..1), None);
        assert_eq!(place("\"", 0..1), None);
    }

    proptest! {
        #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(1978), ..ProptestConfig::default() })]

        /// Every character of a text is found where it is written, whatever stands around it.
        #[test]
        fn every_character_is_found(text in "(\\PC|\n|\t|[\"'\\\\é]){0,20}") {
            let quoted = |quotes: &str| format!("{quotes}{text}{quotes}");
            let windows = quoted("\"\"\"").replace('\n', "\r\n");
            let written = [quoted("\""), quoted("'"), quoted("\"\"\""), quoted("'''"), windows];
            for literal in written.into_iter().chain([toml::Value::from(text.as_str()).to_string(), format!("{text:?}")]) {
                let Ok(value) = DeValue::parse(&literal) else { continue };
                let Some(read) = value.get_ref().as_str() else { continue };
                for (at, character) in read.char_indices() {
                    let found = place(&literal, at..at + character.len_utf8()).expect("a place in a string");
                    let written = literal.get(found).expect("whole characters");
                    prop_assert!(written.starts_with('\\') || written.chars().eq([character]), "{literal}: {written}");
                }
            }
        }
    }
}
