//! Coordinates in lines of text.

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
