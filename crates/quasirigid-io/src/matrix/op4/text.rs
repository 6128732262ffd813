//! Text `OUTPUT4`: integers of eight columns, and values in the Fortran format that the header of the matrix gives.
//! Values are cut by columns and not at blanks, because adjacent negative numbers have no blank between them.
//! Format: NX Nastran DMAP Programmer's Guide, OUTPUT4.

use super::{Header, Records};
use crate::matrix::error::{MatrixProblem, Row};
use crate::matrix::listed::LocatedProblem;
use crate::matrix::text::number;

/// Lines of numbers in columns of fixed width.
pub(super) struct Text<'a> {
    lines: std::iter::Enumerate<std::str::Lines<'a>>,
    line: usize,
    /// Layout of the values of this matrix.
    layout: Layout,
    /// The line of values that is being read.
    values: &'a str,
    /// Number of values taken from the line.
    taken: usize,
}

/// Layout of a line: number of values, and characters of each.
#[derive(Clone, Copy)]
struct Layout {
    values: usize,
    width: usize,
}

/// Width of an integer.
const INTEGER: usize = 8;

/// Whether a line is the header of a matrix.
pub(super) fn is_header(line: &str) -> bool {
    integers::<4>(line.get(..4 * INTEGER).unwrap_or_default()).is_some() && Layout::of(line).is_some()
}

impl<'a> Text<'a> {
    pub fn new(text: &'a str) -> Self {
        let layout = Layout { values: 1, width: 1 };
        Self { lines: text.lines().enumerate(), line: 0, layout, values: "", taken: 0 }
    }

    fn next_line(&mut self) -> Option<&'a str> {
        let (index, line) = self.lines.next()?;
        self.line = index + 1;
        Some(line.trim_end())
    }

    /// The next line, which must be there.
    fn line(&mut self) -> Result<&'a str, LocatedProblem> {
        self.next_line().ok_or((self.line, MatrixProblem::CutMatrix))
    }

    fn unexpected(&self, line: &str, row: Row) -> LocatedProblem {
        (self.line, MatrixProblem::Unexpected { found: line.into(), row })
    }
}

impl Records for Text<'_> {
    const COUNTS_NUMBERS: bool = true;

    fn header(&mut self) -> Result<Option<Header>, LocatedProblem> {
        let Some(line) = std::iter::from_fn(|| self.next_line()).find(|line| !line.is_empty()) else {
            return Ok(None);
        };
        let refused = || self.unexpected(line, Row::Op4Header);
        let sizes = integers(line.get(..4 * INTEGER).unwrap_or_default()).ok_or_else(refused)?;
        self.layout = Layout::of(line).ok_or_else(refused)?;
        let name = line.get(4 * INTEGER..5 * INTEGER).unwrap_or_default();
        Header::new(sizes, name, self.line).map(Some)
    }

    fn column(&mut self) -> Result<[i64; 3], LocatedProblem> {
        let line = self.line()?;
        integers(line).ok_or_else(|| self.unexpected(line, Row::Op4Column))
    }

    fn integers<const N: usize>(&mut self) -> Result<[i64; N], LocatedProblem> {
        let line = self.line()?;
        // A word with both length and row may be wider than eight columns.
        let wide = || line.trim().parse().ok().filter(|_| N == 1).map(|word| [word; N]);
        integers(line).or_else(wide).ok_or_else(|| self.unexpected(line, Row::Op4String))
    }

    fn run(&mut self) {
        (self.values, self.taken) = ("", self.layout.values);
    }

    fn value(&mut self) -> Result<f64, LocatedProblem> {
        if self.taken == self.layout.values {
            (self.values, self.taken) = (self.line()?, 0);
            if self.values.len() > self.layout.values * self.layout.width {
                return Err(self.unexpected(self.values, Row::Op4Values));
            }
        }
        let start = self.taken * self.layout.width;
        let cell = self.values.get(start..self.values.len().min(start + self.layout.width));
        let word = cell.ok_or_else(|| self.unexpected(self.values, Row::Op4Values))?.trim();
        self.taken += 1;
        number(word, Row::Op4Values).map_err(|problem| (self.line, problem))
    }

    fn end(&mut self) -> Result<(), LocatedProblem> {
        Ok(())
    }

    fn skip(&mut self) -> Result<(), LocatedProblem> {
        self.line().map(|_| ())
    }

    fn at(&self) -> usize {
        self.line
    }
}

impl Layout {
    /// A Fortran format such as `1P,3E23.16` at the end of a header.
    fn of(header: &str) -> Option<Self> {
        let format = header.get(5 * INTEGER..)?.trim().trim_start_matches('(').to_ascii_uppercase();
        let format = format.strip_prefix("1P").unwrap_or(&format).trim_start_matches(',');
        let (values, width) = format.split_once(['E', 'D'])?;
        let (values, width) = (values.parse().ok()?, width.split('.').next()?.parse().ok()?);
        ((1..=100).contains(&values) && (1..=100).contains(&width)).then_some(Self { values, width })
    }
}

/// Integers of 8 characters each, and nothing behind them.
fn integers<const N: usize>(line: &str) -> Option<[i64; N]> {
    let mut integers = [0; N];
    for (k, integer) in integers.iter_mut().enumerate() {
        let end = if k + 1 == N { line.len() } else { INTEGER * (k + 1) };
        *integer = line.get(INTEGER * k..end)?.trim().parse().ok()?;
    }
    (line.len() <= INTEGER * N).then_some(integers)
}
