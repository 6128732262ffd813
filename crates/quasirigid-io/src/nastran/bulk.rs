//! Bulk data cards of NASTRAN: small, large and free fields, with continuations.
//! Fields are numbered as in the NASTRAN guide and keep their line, so that an error names the line of a continuation. A tab ends at the
//! next column of eight, as NASTRAN expands it.

use std::iter::Peekable;

use crate::matrix::error::{MatrixProblem, Row};
use crate::matrix::listed::LocatedProblem;
use crate::matrix::text::number;
use crate::text_file::whole;

/// A card with its continuations.
pub(crate) struct Card<'a> {
    /// Name, as the file spells it, without the star of large fields.
    pub name: &'a str,
    /// The line on which it begins.
    pub line: usize,
    /// Fields after the name, without the last columns of a line, which name the continuation.
    fields: Vec<Field<'a>>,
}

/// A field of a card, without the blanks around it.
#[derive(Clone, Copy)]
pub(crate) struct Field<'a> {
    pub text: &'a str,
    pub line: usize,
}

impl<'a> Card<'a> {
    /// A field, as the guide of NASTRAN counts them: 2 follows the name. One that is not there is blank.
    pub fn field(&self, number: usize) -> Field<'a> {
        let blank = Field { text: "", line: self.line };
        number.checked_sub(2).and_then(|index| self.fields.get(index)).copied().unwrap_or(blank)
    }

    /// Fields from this number on, counted as if the card were one line.
    pub fn fields_from(&self, number: usize) -> &[Field<'a>] {
        number.checked_sub(2).and_then(|index| self.fields.get(index..)).unwrap_or(&[])
    }
}

/// The cards of a name in a text without includes, in order; continuations follow their card.
pub(crate) fn cards<'a>(
    text: &'a str,
    name: &'static str,
) -> impl Iterator<Item = Result<Card<'a>, LocatedProblem>> {
    cards_of(bulk_lines((1..).zip(text.lines())), move |found| found.eq_ignore_ascii_case(name))
}

/// The cards whose names are wanted, from lines with their numbers; continuations follow their card.
pub(crate) fn cards_of<'a>(
    lines: impl Iterator<Item = (usize, &'a str)>,
    wanted: impl Fn(&str) -> bool,
) -> impl Iterator<Item = Result<Card<'a>, LocatedProblem>> {
    let mut lines = lines.peekable();
    std::iter::from_fn(move || {
        let (line, content) = lines.find(|(_, content)| !continues(content) && wanted(name_of(content)))?;
        Some(card(line, content, &mut lines))
    })
}

/// A card that begins on this line and continues on the next ones.
fn card<'a>(
    line: usize,
    first: &'a str,
    lines: &mut Peekable<impl Iterator<Item = (usize, &'a str)>>,
) -> Result<Card<'a>, LocatedProblem> {
    let mut fields = Vec::new();
    add_fields(line, first, &mut fields)?;
    while let Some((line, content)) = lines.next_if(|(_, content)| continues(content)) {
        add_fields(line, content, &mut fields)?;
    }
    Ok(Card { name: name_of(first), line, fields })
}

/// Lines up to `ENDDATA` without comments and without those that become blank.
pub(crate) fn bulk_lines<'a>(
    lines: impl Iterator<Item = (usize, &'a str)>,
) -> impl Iterator<Item = (usize, &'a str)> {
    let bare = lines.map(|(line, content)| (line, content.split('$').next().unwrap_or(content).trim_end()));
    bare.filter(|(_, content)| !content.is_empty())
        .take_while(|(_, content)| !name_of(content).eq_ignore_ascii_case("ENDDATA"))
}

/// The first field of a line.
fn first_field(content: &str) -> &str {
    let comma = content.find(',');
    let eighth = content.char_indices().nth(8).map(|(at, _)| at);
    let tab = content.find('\t').filter(|at| eighth.is_none_or(|eighth| *at < eighth));
    let end = comma.or(tab).or(eighth);
    content[..end.unwrap_or(content.len())].trim()
}

/// Name of the card that begins on a line, without the star of large fields.
fn name_of(content: &str) -> &str {
    first_field(content).split('*').next().unwrap_or_default().trim_end()
}

fn continues(content: &str) -> bool {
    let first = first_field(content);
    first.is_empty() || first.starts_with(['+', '*'])
}

/// Adds the fields of a line: eight of 8 columns or four of 16, which a star in the first field tells, or between
/// commas.
fn add_fields<'a>(line: usize, content: &'a str, fields: &mut Vec<Field<'a>>) -> Result<(), LocatedProblem> {
    if !content.is_ascii() {
        return Err((line, MatrixProblem::Unexpected { found: content.into(), row: Row::Card }));
    }
    let (count, width) = if first_field(content).contains('*') { (4, 16) } else { (8, 8) };
    let texts: Vec<&str> = if content.contains(',') {
        content.split(',').skip(1).collect()
    } else {
        cells(content, width).take(count).collect()
    };
    // One field more names the continuation.
    if texts.iter().skip(count + 1).any(|text| !text.trim().is_empty()) {
        return Err((line, MatrixProblem::Values { found: texts.len() + 1, row: Row::Card }));
    }
    let padded = texts.into_iter().chain(std::iter::repeat("")).take(count);
    fields.extend(padded.map(|text| Field { text: text.trim(), line }));
    Ok(())
}

/// The text in columns of a width after the first eight; a tab fills its columns up to the next multiple of eight.
fn cells(content: &str, width: usize) -> impl Iterator<Item = &str> {
    let mut bytes = content.bytes().enumerate().peekable();
    let (mut column, mut border) = (0, 8);
    let mut next = move || {
        while let Some((at, byte)) = bytes.peek().copied() {
            if column >= border {
                border += width;
                return Some(at);
            }
            column = if byte == b'\t' { (column / 8 + 1) * 8 } else { column + 1 };
            bytes.next();
        }
        None
    };
    let mut start = next();
    std::iter::from_fn(move || {
        let from = start?;
        start = next();
        content.get(from..start.unwrap_or(content.len()))
    })
}

/// A number that labels or counts something.
pub(crate) fn integer(field: Field, row: Row) -> Result<u64, LocatedProblem> {
    whole(field.text, row).map_err(|problem| (field.line, problem))
}

/// A label, which a blank field replaces by another.
pub(crate) fn integer_or(field: Field, other: u64, row: Row) -> Result<u64, LocatedProblem> {
    if field.text.is_empty() { Ok(other) } else { integer(field, row) }
}

/// A real number, zero in a blank field.
pub(crate) fn real_or_zero(field: Field) -> Result<f64, LocatedProblem> {
    real_or(field, 0.0)
}

/// A real number, which a blank field replaces by another.
pub(crate) fn real_or(field: Field, other: f64) -> Result<f64, LocatedProblem> {
    if field.text.is_empty() { Ok(other) } else { real(field) }
}

/// A real number, which has a decimal point or an exponent: a number without one was meant for another field.
pub(crate) fn real(field: Field) -> Result<f64, LocatedProblem> {
    let value = if field.text.contains(['.', 'e', 'E', 'd', 'D']) {
        number(field.text, Row::NastranReal)
    } else {
        Err(MatrixProblem::NotANumber { found: field.text.into(), row: Row::NastranReal })
    };
    value.map_err(|problem| (field.line, problem))
}
