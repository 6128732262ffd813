//! Coordinates in lines of text.

use std::borrow::Cow;

use super::error::{MeshProblem, Row};
use crate::text_file::{finite, number};

/// Three finite numbers, the first of these words.
pub(super) fn point<'a>(words: impl Iterator<Item = &'a str>, row: Row) -> Result<[f64; 3], MeshProblem> {
    let (mut point, mut found) = ([0.0; 3], 0);
    for (word, x) in words.zip(&mut point) {
        *x = finite(number(word, row)?, word, row)?;
        found += 1;
    }
    if found == 3 { Ok(point) } else { Err(MeshProblem::Values { found, row }) }
}

/// A text whose names and comments may be in any encoding, without a byte order mark: no number holds what is not UTF-8.
pub(super) fn readable(bytes: &[u8]) -> Cow<'_, str> {
    String::from_utf8_lossy(bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes))
}

/// Words of the lines that hold any, by blanks and commas, without comments; with the numbers of the lines.
pub(super) fn rows(text: &str) -> impl Iterator<Item = (usize, Vec<&str>)> {
    (1..).zip(text.lines().map(words)).filter(|(_, words)| !words.is_empty())
}

fn words(line: &str) -> Vec<&str> {
    let line = line.trim_start();
    if line.starts_with(['!', ';', '%', '*']) || line.starts_with("//") || line.starts_with("/*") {
        return Vec::new();
    }
    let line = line.split('#').next().unwrap_or_default();
    line.split(|c: char| c.is_whitespace() || c == ',').filter(|word| !word.is_empty()).collect()
}
