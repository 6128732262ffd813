//! Harwell–Boeing: a header of four lines or five, then pointers, rows and values by columns, in Fortran formats.
//! Numbers are cut by columns and not at blanks, because adjacent ones have no blank between them. ANSYS writes it by `HBMAT` and `*EXPORT`.
//! Duff, Grimes and Lewis 1992, *Users' guide for the Harwell–Boeing sparse matrix collection*.

use super::MatrixFile;
use super::error::{Fault, MatrixProblem, Place, Row};
use super::listed::{Listed, LocatedProblem, Symmetry};
use super::text::number;
use crate::text_file::{last_line, size, text};

/// Numbers on a line, and characters of each.
#[derive(Clone, Copy)]
struct Layout {
    numbers: usize,
    width: usize,
}

impl Layout {
    /// A format such as `(16I5)`, `(1P,4E20.12)` or `(10(I8))`.
    fn of(format: &str) -> Option<Self> {
        let upper = format.trim().to_ascii_uppercase();
        let inner = upper.strip_prefix('(')?.strip_suffix(')')?.replace(['(', ')', ' '], "");
        let inner = inner.strip_prefix("1P").unwrap_or(&inner).trim_start_matches(',');
        let at = inner.find(|letter: char| letter.is_ascii_alphabetic())?;
        let numbers = if at == 0 { 1 } else { inner[..at].parse().ok()? };
        let width = inner[at + 1..].split(['.', 'E']).next()?.parse().ok()?;
        ((1..=200).contains(&numbers) && (1..=100).contains(&width)).then_some(Self { numbers, width })
    }
}

/// Whether a text begins with the header of such a matrix.
pub(super) fn is_text(bytes: &[u8]) -> bool {
    let mut lines = bytes.split(|byte| *byte == b'\n').skip(2);
    let kind = lines.next().and_then(|line| std::str::from_utf8(line).ok()).and_then(|line| line.get(..3));
    let formats = lines.next().is_some_and(|line| line.starts_with(b"("));
    formats && kind.is_some_and(|kind| kind.is_ascii() && Kind::of(kind).is_some())
}

/// Numbers and symmetry of a matrix.
struct Kind {
    numbers: u8,
    symmetry: Option<Symmetry>,
    assembled: bool,
}

impl Kind {
    fn of(letters: &str) -> Option<Self> {
        let upper = letters.to_ascii_uppercase();
        let [numbers @ (b'R' | b'C' | b'P'), symmetry, assembled @ (b'A' | b'E')] = upper.as_bytes() else {
            return None;
        };
        let symmetry = match symmetry {
            b'U' | b'R' => Some(Symmetry::General),
            b'S' => Some(Symmetry::Symmetric),
            b'Z' => Some(Symmetry::Skew),
            b'H' => None,
            _ => return None,
        };
        Some(Self { numbers: *numbers, symmetry, assembled: *assembled == b'A' })
    }
}

pub(super) fn read(bytes: &[u8]) -> Result<MatrixFile, Fault> {
    let text = text::<MatrixProblem>(bytes)?;
    matrix(text).map_err(|(line, problem)| (Place::Line(line), problem))
}

fn matrix(text: &str) -> Result<MatrixFile, LocatedProblem> {
    let header: Vec<&str> = text.lines().take(4).collect();
    let refused = |line: usize| {
        let found = header.get(line - 1).copied().unwrap_or_default().into();
        (line, MatrixProblem::Unexpected { found, row: Row::HarwellHeader })
    };
    let word = |line: usize, column: usize| -> Result<usize, LocatedProblem> {
        let row = header.get(line - 1).ok_or_else(|| refused(line))?;
        let cell = row
            .get((14 * column).min(row.len())..row.len().min(14 * (column + 1)))
            .unwrap_or_default()
            .trim();
        if cell.is_empty() {
            Ok(0)
        } else {
            size(cell, Row::HarwellHeader).map_err(|problem| (line, problem))
        }
    };
    let kind = header.get(2).and_then(|line| Kind::of(line.get(..3)?)).ok_or_else(|| refused(3))?;
    match kind {
        Kind { numbers: b'C', .. } | Kind { symmetry: None, .. } => return Err((3, MatrixProblem::Complex)),
        Kind { numbers: b'P', .. } => return Err((3, MatrixProblem::Pattern)),
        Kind { assembled: false, .. } => return Err(refused(3)),
        _ => {}
    }
    let [rows, columns, entries] = [word(3, 1)?, word(3, 2)?, word(3, 3)?];
    let formats = header.get(3).copied().unwrap_or_default();
    let format = |from: usize, to: usize| {
        let cell = formats.get(from.min(formats.len())..to.min(formats.len())).unwrap_or_default();
        Layout::of(cell).ok_or_else(|| refused(4))
    };
    let [pointers, indices, values] = [format(0, 16)?, format(16, 32)?, format(32, 52)?];
    let first = if word(2, 4)? > 0 { 6 } else { 5 };
    let mut cells = Cells { lines: text.lines(), line: 0 };
    for _ in 1..first {
        cells.next_line();
    }
    let end = last_line(text);
    let mut whole = Vec::new();
    cells.read(pointers, columns.saturating_add(1), end, |word, line| {
        whole.push(size(word, Row::HarwellIndex).map_err(|problem| (line, problem))?);
        Ok(())
    })?;
    let ascending = whole.first() == Some(&1)
        && whole.is_sorted()
        && whole.last().is_some_and(|last| *last == entries.saturating_add(1));
    if !ascending {
        return Err((
            first,
            MatrixProblem::Unexpected { found: "column pointers".into(), row: Row::HarwellIndex },
        ));
    }
    let mut at = Vec::new();
    cells.read(indices, entries, end, |word, line| {
        let row = size(word, Row::HarwellIndex).map_err(|problem| (line, problem))?;
        at.push((row.checked_sub(1).ok_or((line, MatrixProblem::Zero))?, line));
        Ok(())
    })?;
    let mut listed = Listed::new(rows, columns).map_err(|problem| (3, problem))?;
    let (mut entry, mut column) = (0, 0);
    cells.read(values, entries, end, |word, line| {
        while whole[column + 1] <= entry + 1 {
            column += 1;
        }
        let value = number(word, Row::HarwellValue).map_err(|problem| (line, problem))?;
        listed.add(at[entry].0, column, value, line)?;
        entry += 1;
        Ok(())
    })?;
    listed.unique(kind.symmetry.unwrap_or(Symmetry::General))
}

/// Lines of numbers in columns.
struct Cells<'a> {
    lines: std::str::Lines<'a>,
    line: usize,
}

impl<'a> Cells<'a> {
    fn next_line(&mut self) -> Option<&'a str> {
        self.line += 1;
        self.lines.next()
    }

    /// Reads so many numbers, which start on a line of their own.
    fn read(
        &mut self,
        layout: Layout,
        count: usize,
        end: usize,
        mut take: impl FnMut(&'a str, usize) -> Result<(), LocatedProblem>,
    ) -> Result<(), LocatedProblem> {
        let mut found = 0;
        while found < count {
            let Some(line) = self.next_line() else {
                return Err((end, MatrixProblem::Cut { announced: count as u64, found: found as u64 }));
            };
            let here = (count - found).min(layout.numbers);
            for k in 0..here {
                let from = (k * layout.width).min(line.len());
                let cell = line.get(from..line.len().min(from + layout.width)).unwrap_or_default();
                take(cell.trim(), self.line)?;
            }
            found += here;
        }
        Ok(())
    }
}
