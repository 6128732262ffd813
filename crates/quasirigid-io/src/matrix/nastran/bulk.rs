//! Bulk data cards of NASTRAN: small, large and free fields, with continuations.
//! Fields are numbered as in the NASTRAN guide and keep their line, so that an error names the line of a continuation. Tabs are
//! refused, since their width in columns is not defined.

use std::iter::Peekable;

use crate::matrix::error::{MatrixProblem, Row};
use crate::matrix::listed::LocatedProblem;
use crate::matrix::text::number;
use crate::text_file::whole;

/// A card with its continuations.
pub(in crate::matrix) struct Card<'a> {
    /// The line on which it begins.
    pub line: usize,
    /// Fields after the name, without the last columns of a line, which name the continuation.
    fields: Vec<Field<'a>>,
}

/// A field of a card, without the blanks around it.
#[derive(Clone, Copy)]
pub(in crate::matrix) struct Field<'a> {
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

/// The cards of a name, in order; continuations follow their card.
pub(in crate::matrix) fn cards<'a>(
    text: &'a str,
    name: &'static str,
) -> impl Iterator<Item = Result<Card<'a>, LocatedProblem>> {
    let mut lines = bulk_lines(text).peekable();
    std::iter::from_fn(move || {
        let (line, content) = lines.find(|(_, content)| is_named(content, name))?;
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
    Ok(Card { line, fields })
}

/// Lines up to `ENDDATA` without comments and without those that become blank.
fn bulk_lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let lines = (1..).zip(text.lines());
    let bare = lines.map(|(line, content)| (line, content.split('$').next().unwrap_or(content).trim_end()));
    bare.filter(|(_, content)| !content.is_empty()).take_while(|(_, content)| !is_named(content, "ENDDATA"))
}

/// The first field of a line.
fn first_field(content: &str) -> &str {
    let end = content.find(',').or_else(|| content.char_indices().nth(8).map(|(at, _)| at));
    content[..end.unwrap_or(content.len())].trim()
}

fn is_named(content: &str, name: &str) -> bool {
    let word = first_field(content).split(['*', '\t']).next().unwrap_or_default();
    word.trim_end().eq_ignore_ascii_case(name)
}

fn continues(content: &str) -> bool {
    let first = first_field(content);
    first.is_empty() || first.starts_with(['+', '*', '\t'])
}

/// Adds the fields of a line: eight of 8 columns or four of 16, which a star in the first field tells, or between
/// commas.
fn add_fields<'a>(line: usize, content: &'a str, fields: &mut Vec<Field<'a>>) -> Result<(), LocatedProblem> {
    if content.contains('\t') {
        return Err((line, MatrixProblem::Tab));
    }
    if !content.is_ascii() {
        return Err((line, MatrixProblem::Unexpected { found: content.into(), row: Row::Card }));
    }
    let (count, width) = if first_field(content).contains('*') { (4, 16) } else { (8, 8) };
    let texts: Vec<&str> = if content.contains(',') {
        content.split(',').skip(1).collect()
    } else {
        let cell = |k: usize| content.get(8 + width * k..content.len().min(8 + width * (k + 1)));
        (0..count).map(|k| cell(k).unwrap_or_default()).collect()
    };
    // One field more names the continuation.
    if texts.len() > count + 1 {
        return Err((line, MatrixProblem::Values { found: texts.len() + 1, row: Row::Card }));
    }
    let padded = texts.into_iter().chain(std::iter::repeat("")).take(count);
    fields.extend(padded.map(|text| Field { text: text.trim(), line }));
    Ok(())
}

/// A number that labels or counts something.
pub(in crate::matrix) fn integer(field: Field, row: Row) -> Result<u64, LocatedProblem> {
    whole(field.text, row).map_err(|problem| (field.line, problem))
}

/// A real number, which has a decimal point: a number without one was meant for another field.
pub(in crate::matrix) fn real(field: Field) -> Result<f64, LocatedProblem> {
    let value = if field.text.contains('.') {
        number(field.text, Row::NastranReal)
    } else {
        Err(MatrixProblem::NotANumber { found: field.text.into(), row: Row::NastranReal })
    };
    value.map_err(|problem| (field.line, problem))
}
