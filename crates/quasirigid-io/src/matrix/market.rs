//! Matrix Market: a header, the size, then either `row column value` or the values column by column. (Boisvert, Pozo
//! and Remington 1996, *The Matrix Market Exchange Formats*, NISTIR 5935)

use super::MatrixFile;
use super::error::{Fault, MatrixProblem, Place, Row};
use super::listed::{Listed, Symmetry};
use super::text::{entry, number};
use crate::text_file::{last_line, lines, size, text};

/// Header: the first line of the file.
struct Header {
    coordinate: bool,
    integer: bool,
    symmetry: Symmetry,
}

pub(super) fn read(bytes: &[u8]) -> Result<MatrixFile, Fault> {
    let text = text::<MatrixProblem>(bytes)?;
    let end = last_line(text);
    let mut lines = lines(text);
    let (line, first) = lines.next().unwrap_or((end, ""));
    let header = Header::of(first).map_err(|problem| (Place::Line(line), problem))?;
    let mut lines = lines.filter(|(_, line)| !line.starts_with('%'));
    let (line, sizes) = lines.next().unwrap_or((end, ""));
    let (mut listed, announced) = header.sizes(sizes).map_err(|problem| (Place::Line(line), problem))?;
    let found = header.entries(&mut listed, announced, lines)?;
    if found < announced {
        return Err((Place::Line(end), MatrixProblem::Cut { announced, found }));
    }
    listed.unique(header.symmetry).map_err(|(line, problem)| (Place::Line(line), problem))
}

impl Header {
    fn of(line: &str) -> Result<Self, MatrixProblem> {
        let lower = line.to_lowercase();
        let words: Vec<&str> = lower.split_whitespace().collect();
        let unknown = || MatrixProblem::Unexpected { found: line.into(), row: Row::MarketHeader };
        let [_, "matrix", layout, field, symmetry] = words[..] else { return Err(unknown()) };
        let (coordinate, integer) = match (layout, field) {
            ("coordinate" | "array", "complex") => return Err(MatrixProblem::Complex),
            ("coordinate" | "array", "pattern") => return Err(MatrixProblem::Pattern),
            ("coordinate", "real" | "integer") => (true, field == "integer"),
            ("array", "real" | "integer") => (false, field == "integer"),
            _ => return Err(unknown()),
        };
        let symmetry = match symmetry {
            "general" => Symmetry::General,
            "symmetric" => Symmetry::Symmetric,
            "skew-symmetric" => Symmetry::Skew,
            _ => return Err(unknown()),
        };
        Ok(Self { coordinate, integer, symmetry })
    }

    /// An empty matrix, and how many lines fill it.
    fn sizes(&self, line: &str) -> Result<(Listed, u64), MatrixProblem> {
        let row = if self.coordinate { Row::MarketSizes } else { Row::MarketArraySizes };
        let sizes: Vec<usize> =
            line.split_whitespace().map(|word| size(word, row)).collect::<Result<_, _>>()?;
        let (rows, columns, entries) = match (sizes[..].as_ref(), self.coordinate) {
            (&[rows, columns, entries], true) => (rows, columns, entries as u64),
            (&[rows, columns], false) => (rows, columns, self.in_array(rows as u64, columns as u64)),
            _ => return Err(MatrixProblem::Values { found: sizes.len(), row }),
        };
        if rows != columns && self.symmetry != Symmetry::General {
            return Err(MatrixProblem::NotSquare { rows, columns });
        }
        Ok((Listed::new(rows, columns)?, entries))
    }

    /// Values in an array, of which symmetric matrices have the lower triangle only.
    fn in_array(&self, rows: u64, columns: u64) -> u64 {
        match self.symmetry {
            Symmetry::General => rows.saturating_mul(columns),
            Symmetry::Symmetric => rows.saturating_mul(rows.saturating_add(1)) / 2,
            Symmetry::Skew => rows.saturating_mul(rows.saturating_sub(1)) / 2,
        }
    }

    /// Adds the entries on these lines and counts them.
    fn entries<'a>(
        &self,
        listed: &mut Listed,
        announced: u64,
        lines: impl Iterator<Item = (usize, &'a str)>,
    ) -> Result<u64, Fault> {
        let (mut found, mut row, mut column) = (0, self.first(0), 0);
        for (line, words) in lines {
            let refused = |problem| (Place::Line(line), problem);
            if found == announced {
                return Err(refused(MatrixProblem::Surplus { announced }));
            }
            let (i, j, value) = if self.coordinate {
                self.coordinate(words).map_err(refused)?
            } else {
                (row, column, self.array_value(words).map_err(refused)?)
            };
            listed.add(i, j, value, line).map_err(|(_, problem)| refused(problem))?;
            (found, row) = (found + 1, row + 1);
            if row == listed.rows() {
                (row, column) = (self.first(column + 1), column + 1);
            }
        }
        Ok(found)
    }

    /// The first row of a column of an array.
    fn first(&self, column: usize) -> usize {
        match self.symmetry {
            Symmetry::General => 0,
            Symmetry::Symmetric => column,
            Symmetry::Skew => column + 1,
        }
    }

    /// Row and column, from 0, and value.
    fn coordinate(&self, line: &str) -> Result<(usize, usize, f64), MatrixProblem> {
        let (row, column, word) = entry(line, Row::MarketEntry)?;
        Ok((row, column, self.value(word, Row::MarketEntry)?))
    }

    fn array_value(&self, line: &str) -> Result<f64, MatrixProblem> {
        match line.split_whitespace().count() {
            1 => self.value(line, Row::MarketValue),
            found => Err(MatrixProblem::Values { found, row: Row::MarketValue }),
        }
    }

    fn value(&self, word: &str, row: Row) -> Result<f64, MatrixProblem> {
        match word.parse::<i64>() {
            Err(_) if self.integer => {
                Err(MatrixProblem::NotANumber { found: word.into(), row: Row::MarketInteger })
            }
            _ => number(word, row),
        }
    }
}
