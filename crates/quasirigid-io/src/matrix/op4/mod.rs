//! Matrices of the NASTRAN module `OUTPUT4`, as text or binary. (NX Nastran DMAP Programmer's Guide, OUTPUT4, remarks
//! 1–3)
//!
//! Each matrix is a header and its columns; a column is one run of values from a row on, or, where that row is 0,
//! strings of values, each with its own length and row. A column behind the last ends the matrix.

mod binary;
mod text;

pub(super) use binary::byte_order;

use super::MatrixFile;
use super::error::{Fault, MatrixProblem, Place, Row};
use super::listed::{Listed, LocatedProblem, Symmetry};

/// The matrix of this name, or the only one, in a text.
pub(super) fn read_text(bytes: &[u8], name: Option<&str>) -> Result<MatrixFile, Fault> {
    let text = crate::text_file::text::<MatrixProblem>(bytes)?;
    read(&mut text::Text::new(text), name).map_err(|(line, problem)| (Place::Line(line), problem))
}

/// Whether a text begins with the header of a matrix.
pub(super) fn is_text(bytes: &[u8]) -> bool {
    let line = bytes.split(|byte| *byte == b'\n').next().unwrap_or_default();
    std::str::from_utf8(line).is_ok_and(text::is_header)
}

/// The matrix of this name, or the only one, in a binary file.
pub(super) fn read_binary(bytes: &[u8], big_endian: bool, name: Option<&str>) -> Result<MatrixFile, Fault> {
    read(&mut binary::Binary::new(bytes, big_endian), name)
        .map_err(|(byte, problem)| (Place::Byte(byte), problem))
}

/// The columns of a file one after the other, in text or binary.
trait Records {
    /// Whether a column without strings tells its length in numbers: NASTRAN does so in texts, whatever the guide
    /// says.
    const COUNTS_NUMBERS: bool;

    /// The next header, unless the file ends.
    fn header(&mut self) -> Result<Option<Header>, LocatedProblem>;
    /// The number of the next column, its first row or 0, and its number of words.
    fn column(&mut self) -> Result<[i64; 3], LocatedProblem>;
    /// The next integers, as many as stand before a string.
    fn integers<const N: usize>(&mut self) -> Result<[i64; N], LocatedProblem>;
    /// Starts a run: values that follow each other.
    fn run(&mut self);
    /// The next value.
    fn value(&mut self) -> Result<f64, LocatedProblem>;
    /// Ends the column.
    fn end(&mut self) -> Result<(), LocatedProblem>;
    /// Ends the column, whatever it has.
    fn skip(&mut self) -> Result<(), LocatedProblem>;
    /// The line or byte of the value read last.
    fn at(&self) -> usize;
}

/// Header: everything before the columns of a matrix.
struct Header {
    name: String,
    columns: usize,
    rows: usize,
    /// Whether length and row of a string stand in words of their own, which a negative number of rows tells.
    big: bool,
    form: i64,
    /// 1 and 2 are real numbers of single and double precision, 3 and 4 are complex.
    kind: i64,
    /// Whether words have 64 bits.
    long: bool,
    at: usize,
}

/// Rows above which length and row of a string do not fit one word.
const BIG: usize = 65535;

impl Header {
    /// The four integers of a header.
    fn new([columns, rows, form, kind]: [i64; 4], name: &str, at: usize) -> Result<Self, LocatedProblem> {
        if !(1..=4).contains(&kind) {
            return Err((at, MatrixProblem::Type { found: kind.to_string().into() }));
        }
        let size = |count: i64| {
            let found = count.to_string().into();
            usize::try_from(count.unsigned_abs())
                .map_err(|_| (at, MatrixProblem::NotANumber { found, row: Row::Op4Header }))
        };
        if columns < 0 {
            let found = columns.to_string().into();
            return Err((at, MatrixProblem::Unexpected { found, row: Row::Op4Header }));
        }
        let (columns, big, rows) = (size(columns)?, rows < 0, size(rows)?);
        Ok(Self {
            name: name.trim().to_owned(),
            columns,
            rows,
            big: big || rows > BIG,
            form,
            kind,
            long: false,
            at,
        })
    }

    fn complex(&self) -> bool {
        self.kind > 2
    }

    /// Words in a number.
    fn words(&self) -> i64 {
        if self.kind % 2 == 0 && !self.long { 2 } else { 1 }
    }

    /// An empty matrix of the announced size, if form and kind are supported.
    fn listed(&self) -> Result<Listed, LocatedProblem> {
        if self.complex() {
            return Err((self.at, MatrixProblem::Complex));
        }
        if !matches!(self.form, 1 | 2 | 6 | 9) {
            return Err((self.at, MatrixProblem::Form { found: self.form.to_string().into() }));
        }
        Listed::new(self.rows, self.columns).map_err(|problem| (self.at, problem))
    }
}

/// The matrix of this name, or the only one.
fn read(records: &mut impl Records, name: Option<&str>) -> Result<MatrixFile, LocatedProblem> {
    let (mut names, mut found) = (Vec::new(), None);
    while let Some(header) = records.header()? {
        names.push(header.name.clone());
        let wanted = name.is_none_or(|name| name.eq_ignore_ascii_case(&header.name));
        if !wanted || (name.is_none() && found.is_some()) {
            columns(records, &header, |_, _, _, _| Ok(()))?;
        } else if found.is_some() {
            return Err((header.at, MatrixProblem::SameName { name: header.name }));
        } else {
            let mut listed = header.listed();
            columns(records, &header, |row, column, value, at| match &mut listed {
                Ok(listed) => listed.add(row, column, value, at),
                Err(_) => Ok(()),
            })?;
            found = Some(listed);
        }
    }
    let at = records.at();
    match (found, name) {
        (Some(_), None) if names.len() > 1 => Err((at, MatrixProblem::WhichMatrix { names })),
        (Some(listed), _) => listed?.unique(Symmetry::General),
        (None, name) => {
            let name = name.unwrap_or_default().to_owned();
            Err((at, MatrixProblem::NoSuchMatrix { name, names }))
        }
    }
}

/// Adds the values of a matrix: row and column, from 0, and value.
fn columns<R: Records>(
    records: &mut R,
    header: &Header,
    mut add: impl FnMut(usize, usize, f64, usize) -> Result<(), LocatedProblem>,
) -> Result<(), LocatedProblem> {
    let mut next = 1;
    loop {
        let [number, row, words] = records.column()?;
        let column =
            usize::try_from(number).ok().filter(|column| (next..=header.columns + 1).contains(column));
        let column = column.ok_or_else(|| unexpected(records, number, Row::Op4Column))?;
        if column > header.columns {
            return records.skip();
        }
        let mut put = |row, value, at| add(row, column - 1, value, at);
        if row == 0 {
            strings(records, header, words, &mut put)?;
        } else {
            let per_number = if R::COUNTS_NUMBERS { header.words() } else { 1 };
            let numbers = numbers(records, header, words.saturating_mul(per_number))?;
            run(records, header, row, numbers, &mut put)?;
        }
        records.end()?;
        next = column + 1;
    }
}

/// Adds strings of values that take so many words, each with the integers before it.
fn strings(
    records: &mut impl Records,
    header: &Header,
    words: i64,
    put: &mut impl FnMut(usize, f64, usize) -> Result<(), LocatedProblem>,
) -> Result<(), LocatedProblem> {
    let mut left = words;
    while left > 0 {
        let (before, length, row) = if header.big {
            let [length, row] = records.integers()?;
            (2, length.saturating_sub(1), row)
        } else {
            let [both] = records.integers()?;
            (1, (both >> 16) - 1, both & 0xFFFF)
        };
        left = left.saturating_sub(length.saturating_add(before));
        if length < 1 || left < 0 {
            return Err(unexpected(records, length, Row::Op4String));
        }
        run(records, header, row, numbers(records, header, length)?, put)?;
    }
    Ok(())
}

/// Numbers in so many words.
fn numbers(records: &impl Records, header: &Header, words: i64) -> Result<usize, LocatedProblem> {
    let numbers = usize::try_from(words / header.words()).ok().filter(|_| words % header.words() == 0);
    numbers.ok_or_else(|| unexpected(records, words, Row::Op4Values))
}

/// Values in rows that follow each other, from one on.
fn run(
    records: &mut impl Records,
    header: &Header,
    row: i64,
    numbers: usize,
    put: &mut impl FnMut(usize, f64, usize) -> Result<(), LocatedProblem>,
) -> Result<(), LocatedProblem> {
    let first = usize::try_from(row).ok().and_then(|row| row.checked_sub(1));
    let first = first.ok_or_else(|| unexpected(records, row, Row::Op4Column))?;
    // A complex number is two in one row.
    let per_row = if header.complex() { 2 } else { 1 };
    records.run();
    for (row, part) in (first..).flat_map(|row| (0..per_row).map(move |part| (row, part))).take(numbers) {
        let value = records.value()?;
        if part == 0 {
            put(row, value, records.at())?;
        }
    }
    Ok(())
}

fn unexpected(records: &impl Records, found: i64, row: Row) -> LocatedProblem {
    (records.at(), MatrixProblem::Unexpected { found: found.to_string().into(), row })
}
