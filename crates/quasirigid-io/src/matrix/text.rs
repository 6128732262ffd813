//! Numbers and entries of matrices, as Fortran and NASTRAN write them.

use super::error::{MatrixProblem, Row};
use crate::text_file::{finite, size};

/// A finite number; also as Fortran writes it, `1.5D-3` or `1.5-103`.
pub(crate) fn number(word: &str, row: Row) -> Result<f64, MatrixProblem> {
    let value = word.parse().or_else(|_| fortran(word).parse::<f64>());
    finite(value.map_err(|_| MatrixProblem::NotANumber { found: word.into(), row })?, word, row)
}

/// The word with an `e` before its exponent.
fn fortran(word: &str) -> String {
    let word = word.replace(['D', 'd'], "e");
    let sign = word.char_indices().skip(1).find(|(_, c)| matches!(c, '+' | '-')).map(|(at, _)| at);
    match sign {
        Some(at) if !word.contains(['e', 'E']) => format!("{}e{}", &word[..at], &word[at..]),
        _ => word,
    }
}

/// Row and column, from 0 though a file counts from 1, and the word of the value.
pub(super) fn entry(line: &str, row: Row) -> Result<(usize, usize, &str), MatrixProblem> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let [i, j, value] = words[..] else {
        return Err(MatrixProblem::Values { found: words.len(), row });
    };
    let index = |word| size(word, row)?.checked_sub(1).ok_or(MatrixProblem::Zero);
    Ok((index(i)?, index(j)?, value))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn exponents_are_those_of_fortran_and_nastran() {
        let read = |word| number(word, Row::MarketEntry).unwrap();
        assert_eq!(
            [read("1.5-3"), read("-1.5+3"), read("+.5D-03"), read("3.+5")],
            [1.5e-3, -1.5e3, 5e-4, 3e5]
        );
        assert_eq!(
            [read("-1.25E-2"), read("1.25d2"), read("1.0-103"), read("-7")],
            [-0.0125, 125.0, 1e-103, -7.0]
        );
        for word in ["1.5e", "", "-", "1-+3", "1.5D3-2", "1..5", "0x10", "1 5"] {
            assert!(
                matches!(number(word, Row::MarketEntry), Err(MatrixProblem::NotANumber { .. })),
                "{word:?}"
            );
        }
        for word in ["NaN", "-inf", "1e999", "1.0+999"] {
            assert!(
                matches!(number(word, Row::MarketEntry), Err(MatrixProblem::NotFinite { .. })),
                "{word:?}"
            );
        }
    }
}
