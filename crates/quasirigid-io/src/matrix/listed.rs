//! Coordinate list (COO) of matrix entries in the order of a file, made into a sorted matrix without repetitions.
//! Entries keep their line or byte, so that a place given twice is reported where the second value stands; memory is asked for
//! before the list grows, because a file may announce any size.

use quasirigid_math::memory;

use super::MatrixFile;
use super::error::MatrixProblem;

/// Symmetry that a file uses to leave out one triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Symmetry {
    /// Both triangles are given.
    General,
    /// `A_ji = A_ij`.
    Symmetric,
    /// `A_ji = -A_ij`.
    Skew,
}

/// Entries in the order of a file.
pub(crate) struct Listed {
    rows: usize,
    columns: usize,
    entries: Vec<Entry>,
}

#[derive(Clone, Copy)]
struct Entry {
    row: usize,
    column: usize,
    value: f64,
    /// Line or byte.
    at: usize,
}

/// A line or byte, and the problem there.
pub(crate) type LocatedProblem = (usize, MatrixProblem);

impl Listed {
    /// No entries yet.
    pub fn new(rows: usize, columns: usize) -> Result<Self, MatrixProblem> {
        if rows == 0 || columns == 0 {
            return Err(MatrixProblem::Void { rows, columns });
        }
        Ok(Self { rows, columns, entries: Vec::new() })
    }

    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Adds an entry that stands on a line or byte; rows and columns count from 0.
    pub fn add(&mut self, row: usize, column: usize, value: f64, at: usize) -> Result<(), LocatedProblem> {
        if row >= self.rows || column >= self.columns {
            let (rows, columns) = (self.rows, self.columns);
            let (row, column) = (row.saturating_add(1), column.saturating_add(1));
            return Err((at, MatrixProblem::Outside { row, column, rows, columns }));
        }
        let count = self.entries.len();
        if count == self.entries.capacity() {
            let bytes = 2 * (size_of::<Entry>() + size_of::<(usize, usize, f64)>());
            memory::ask((count * bytes) as f64).map_err(|cause| (at, MatrixProblem::Memory(cause)))?;
        }
        self.entries.push(Entry { row, column, value, at });
        Ok(())
    }

    /// Adds the half that the file leaves out.
    fn mirror(&mut self, symmetry: Symmetry) -> Result<(), LocatedProblem> {
        let sign = match symmetry {
            Symmetry::General => return Ok(()),
            Symmetry::Symmetric => 1.0,
            Symmetry::Skew => -1.0,
        };
        for index in 0..self.entries.len() {
            let Entry { row, column, value, at } = self.entries[index];
            if row != column {
                self.add(column, row, sign * value, at)?;
            } else if sign < 0.0 && value != 0.0 {
                return Err((at, MatrixProblem::SkewDiagonal { row: row + 1 }));
            }
        }
        Ok(())
    }

    fn sort(&mut self) {
        self.entries.sort_unstable_by_key(|entry| (entry.row, entry.column, entry.at));
    }

    /// The matrix, in which no place may be given twice; a file that leaves out one triangle has a square one.
    pub fn unique(mut self, symmetry: Symmetry) -> Result<MatrixFile, LocatedProblem> {
        self.mirror(symmetry)?;
        self.sort();
        let twice = |pair: &&[Entry]| (pair[0].row, pair[0].column) == (pair[1].row, pair[1].column);
        if let Some(pair) = self.entries.windows(2).filter(twice).min_by_key(|pair| pair[1].at) {
            let Entry { row, column, at, .. } = pair[1];
            return Err((at, MatrixProblem::Twice { row: row + 1, column: column + 1 }));
        }
        Ok(self.matrix())
    }

    /// The matrix, in which the values of one place add up.
    pub fn sum(mut self) -> MatrixFile {
        self.sort();
        self.entries.dedup_by(|next, sum| {
            let same = (next.row, next.column) == (sum.row, sum.column);
            if same {
                sum.value += next.value;
            }
            same
        });
        self.matrix()
    }

    fn matrix(self) -> MatrixFile {
        let nonzero = self.entries.into_iter().filter(|entry| entry.value != 0.0);
        let entries = nonzero.map(|entry| (entry.row, entry.column, entry.value)).collect();
        MatrixFile { rows: self.rows, columns: self.columns, entries, labels: None }
    }
}
