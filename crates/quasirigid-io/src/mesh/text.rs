//! Lines of text and the numbers in them.

use super::error::{Fault, MeshProblem, Place, Row};

/// The bytes of a file as text, without a byte order mark.
pub(super) fn text(bytes: &[u8]) -> Result<&str, Fault> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let end = error.valid_up_to();
        (Place::Line(line_at(bytes, end)), MeshProblem::NotText { byte: bytes[end] })
    })?;
    Ok(text.strip_prefix('\u{feff}').unwrap_or(text))
}

/// The line of a byte, from 1.
fn line_at(bytes: &[u8], at: usize) -> usize {
    1 + bytes[..at].iter().filter(|byte| **byte == b'\n').count()
}

/// Lines that are not blank, with their numbers from 1.
pub(super) fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    (1..).zip(text.lines().map(str::trim)).filter(|(_, line)| !line.is_empty())
}

/// A number; also with the exponent that Fortran writes, `1.5D-3`.
pub(super) fn number(word: &str, row: Row) -> Result<f64, MeshProblem> {
    let fortran = |_| word.replace(['D', 'd'], "e").parse();
    word.parse().or_else(fortran).map_err(|_| MeshProblem::NotANumber { found: word.to_owned(), row })
}

/// A number that counts something.
pub(super) fn whole(word: &str, row: Row) -> Result<u64, MeshProblem> {
    word.parse().map_err(|_| MeshProblem::NotANumber { found: word.to_owned(), row })
}

/// A finite number.
pub(super) fn coordinate(word: &str, row: Row) -> Result<f64, MeshProblem> {
    let value = number(word, row)?;
    if value.is_finite() { Ok(value) } else { Err(MeshProblem::NotFinite { found: word.to_owned() }) }
}

/// Three finite numbers, the first of these words.
pub(super) fn point<'a>(words: impl Iterator<Item = &'a str>, row: Row) -> Result<[f64; 3], MeshProblem> {
    let (mut point, mut found) = ([0.0; 3], 0);
    for (word, x) in words.zip(&mut point) {
        *x = coordinate(word, row)?;
        found += 1;
    }
    if found == 3 { Ok(point) } else { Err(MeshProblem::Values { found, row }) }
}
