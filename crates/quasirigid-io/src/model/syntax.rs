//! TOML syntax: the tree of tables of a text, with the parser's errors as diagnostics.
//! A number with a unit but without quotes is the commonest mistake and gets its own help; overlong dotted keys are refused before
//! parsing, because the parser recurses into each part.

use std::ops::Range;

use toml::de::{DeTable, Error};

use super::Diagnostic;
use super::diagnostic::Problems;

/// Most parts of a dotted key. The format has keys of two parts; the parser would follow millions, one call deeper
/// for each.
const LONGEST_KEY: usize = 16;
/// The tree of tables in a TOML text, if the text is TOML.
pub(crate) fn tree<'a>(text: &'a str, problems: &Problems<'_>) -> Option<DeTable<'a>> {
    if let Some(span) = overlong_key(text) {
        let message = format!("a key with more than {LONGEST_KEY} parts");
        let help = "the longest keys of a model have two, as in carrier.mass";
        problems.report(Diagnostic::new(span, message, "this key").help(help));
        return None;
    }
    let (tree, errors) = DeTable::parse_recoverable(text);
    for error in errors.iter().take_while(|_| !problems.full()) {
        problems.report(diagnostic(text, error));
    }
    errors.is_empty().then(|| tree.into_inner())
}

fn diagnostic(text: &str, error: &Error) -> Diagnostic {
    let span = error.span().unwrap_or(text.len()..text.len());
    let diagnostic = Diagnostic::new(span.clone(), format!("not valid TOML: {}", error.message()), "here");
    match unquoted(text, span) {
        Some(value) => diagnostic.help(format!("a number with its unit stands in quotes: \"{value}\"")),
        None => diagnostic,
    }
}

/// The value of a line such as `mass = 12 kg`, the commonest mistake.
fn unquoted(text: &str, span: Range<usize>) -> Option<&str> {
    let at = text.floor_char_boundary(span.start);
    let start = text[..at].rfind('\n').map_or(0, |newline| newline + 1);
    let line = text[start..].lines().next()?;
    let (_, value) = line.split_once('=')?;
    let value = value.split('#').next()?.trim();
    let number = value.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c));
    let unit = value.contains(char::is_alphabetic) && !value.contains(['"', '\'', ',']);
    (number && unit).then_some(value)
}

/// The place of a dotted key with too many parts: one with that many dots and no other separator, outside comments
/// and texts.
fn overlong_key(text: &str) -> Option<Range<usize>> {
    let bytes = text.as_bytes();
    let (mut at, mut start, mut dots) = (0, 0, 0);
    while let Some(byte) = bytes.get(at) {
        let next = match byte {
            b'#' => at + bytes[at..].iter().take_while(|byte| **byte != b'\n').count(),
            b'"' | b'\'' => end_of_text(bytes, at),
            _ => at + 1,
        };
        match byte {
            b'=' | b',' | b'[' | b'{' | b'\n' => (start, dots) = (next, 0),
            b'.' => dots += 1,
            _ => {}
        }
        if dots >= LONGEST_KEY {
            return Some(start..next);
        }
        at = next;
    }
    None
}

/// The end of the TOML string that starts at `start`, on one line or on many.
fn end_of_text(bytes: &[u8], start: usize) -> usize {
    let quote = bytes[start];
    let many = bytes[start..].starts_with(&[quote; 3]);
    let mut at = start + if many { 3 } else { 1 };
    while let Some(byte) = bytes.get(at) {
        match byte {
            b'\\' if quote == b'"' => at += 2,
            b'\n' if !many => return at,
            byte if *byte == quote && !many => return at + 1,
            byte if *byte == quote && bytes[at..].starts_with(&[quote; 3]) => return at + 3,
            _ => at += 1,
        }
    }
    bytes.len()
}
