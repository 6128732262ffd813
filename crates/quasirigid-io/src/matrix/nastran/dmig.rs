//! `DMIG` reader: a header card and column cards become one matrix whose rows are the degrees of freedom that occur.
//! The cards give no sizes, so rows and columns are collected first; for square and symmetric forms their union is both.
//! MSC Nastran Quick Reference Guide, *Bulk Data Entries*, DMIG.

use std::collections::BTreeSet;

use crate::matrix::error::{MatrixProblem, Row};
use crate::matrix::listed::{Listed, LocatedProblem, Symmetry};
use crate::matrix::{Dof, MatrixFile};
use crate::nastran::bulk::{Card, Field, cards, integer, real};
use crate::text_file::last_line;

/// Header card of a matrix.
struct Header {
    name: String,
    line: usize,
    form: Form,
    /// Number of columns, where the card has it.
    columns: Option<u64>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Form {
    Square,
    Rectangular,
    Symmetric,
}

/// A value with its row and its column, and the line on which it stands.
struct Term {
    row: Dof,
    column: Dof,
    value: f64,
    line: usize,
}

/// The matrix of this name, or the only one.
pub(super) fn read(text: &str, name: Option<&str>) -> Result<MatrixFile, LocatedProblem> {
    let header = header(text, name)?;
    let mut terms = Vec::new();
    for card in cards(text, "DMIG") {
        let card = card?;
        if !is_header(&card) && card.field(2).text.eq_ignore_ascii_case(&header.name) {
            column(&card, &mut terms)?;
        }
    }
    header.matrix(&terms)
}

fn is_header(card: &Card) -> bool {
    card.field(3).text == "0"
}

/// The header of the matrix of this name, or of the only one.
fn header(text: &str, name: Option<&str>) -> Result<Header, LocatedProblem> {
    let (mut names, mut chosen): (BTreeSet<String>, Option<Card>) = Default::default();
    for card in cards(text, "DMIG") {
        let card = card?;
        let found = card.field(2).text.to_uppercase();
        names.insert(found.clone());
        if is_header(&card) && name.is_none_or(|name| name.eq_ignore_ascii_case(&found)) {
            match &chosen {
                Some(first) if first.field(2).text.eq_ignore_ascii_case(&found) => {
                    return Err((card.line, MatrixProblem::SameName { name: found }));
                }
                _ => chosen = Some(card),
            }
        }
    }
    let known = |name: &str| names.contains(&name.to_uppercase());
    let end = last_line(text);
    match (chosen, name) {
        (Some(_), None) if names.len() > 1 => Err(MatrixProblem::WhichMatrix { names: owned(names) }),
        (Some(card), _) => return Header::of(&card),
        (None, _) if names.is_empty() => Err(MatrixProblem::NoDmig),
        (None, Some(name)) if !known(name) => {
            Err(MatrixProblem::NoSuchMatrix { name: name.to_owned(), names: owned(names) })
        }
        (None, name) => {
            let name = name.map_or_else(|| owned(names).join(", "), str::to_owned);
            Err(MatrixProblem::NoHeader { name })
        }
    }
    .map_err(|problem| (end, problem))
}

fn owned(names: BTreeSet<String>) -> Vec<String> {
    names.into_iter().collect()
}

impl Header {
    fn of(card: &Card) -> Result<Self, LocatedProblem> {
        let refused = |field: Field, problem| Err((field.line, problem));
        let (form, kind, count) = (card.field(4), card.field(5), card.field(9));
        let form = match form.text {
            "1" => Form::Square,
            "2" | "9" => Form::Rectangular,
            "6" => Form::Symmetric,
            found => return refused(form, MatrixProblem::Form { found: found.into() }),
        };
        match kind.text {
            "1" | "2" => {}
            "3" | "4" => return refused(kind, MatrixProblem::Complex),
            found => return refused(kind, MatrixProblem::Type { found: found.into() }),
        }
        let columns = match count.text {
            "" => None,
            _ => Some(integer(count, Row::DmigHeader)?),
        };
        Ok(Self { name: card.field(2).text.to_uppercase(), line: card.line, form, columns })
    }

    /// The matrix between the degrees of freedom that occur.
    fn matrix(&self, terms: &[Term]) -> Result<MatrixFile, LocatedProblem> {
        let mut rows: BTreeSet<Dof> = terms.iter().map(|term| term.row).collect();
        let mut columns: BTreeSet<Dof> = terms.iter().map(|term| term.column).collect();
        if self.form != Form::Rectangular {
            rows.append(&mut columns);
            columns.clone_from(&rows);
        } else if let Some(announced) = self.columns.filter(|announced| *announced != columns.len() as u64) {
            let (name, found) = (self.name.clone(), columns.len() as u64);
            return Err((self.line, MatrixProblem::DmigColumns { name, announced, found }));
        }
        let (rows, columns): (Vec<_>, Vec<_>) = (rows.into_iter().collect(), columns.into_iter().collect());
        let mut listed = Listed::new(rows.len(), columns.len()).map_err(|problem| (self.line, problem))?;
        for term in terms {
            let [row, column] = [(&rows, term.row), (&columns, term.column)]
                .map(|(dofs, dof)| dofs.partition_point(|other| *other < dof));
            listed.add(row, column, term.value, term.line)?;
        }
        let symmetry = if self.form == Form::Symmetric { Symmetry::Symmetric } else { Symmetry::General };
        let named = |(line, problem)| match problem {
            MatrixProblem::Twice { row, column } => {
                (line, MatrixProblem::DmigTwice { row: rows[row - 1], column: columns[column - 1] })
            }
            problem => (line, problem),
        };
        let matrix = listed.unique(symmetry).map_err(named)?;
        Ok(MatrixFile { labels: Some(rows), ..matrix })
    }
}

/// Adds the terms of a column.
fn column(card: &Card, terms: &mut Vec<Term>) -> Result<(), LocatedProblem> {
    let column = dof(card.field(3), card.field(4))?;
    if !card.field(5).text.is_empty() {
        let found = card.field(5).text.into();
        return Err((card.line, MatrixProblem::Unexpected { found, row: Row::DmigColumn }));
    }
    for term in card.fields_from(6).chunks(4) {
        let &[point, component, value, imaginary] = term else { continue };
        if term.iter().all(|field| field.text.is_empty()) {
            continue;
        }
        if !imaginary.text.is_empty() {
            let found = imaginary.text.into();
            return Err((imaginary.line, MatrixProblem::Unexpected { found, row: Row::DmigColumn }));
        }
        terms.push(Term { row: dof(point, component)?, column, value: real(value)?, line: value.line });
    }
    Ok(())
}

/// A point and its component; scalar points have none.
fn dof(point: Field, component: Field) -> Result<Dof, LocatedProblem> {
    let node = integer(point, Row::DmigColumn)?;
    match component.text {
        "" => Ok(Dof { node, component: 0 }),
        _ => match integer(component, Row::DmigColumn)? {
            component @ 0..=6 => Ok(Dof { node, component: component as u8 }),
            found => Err((component.line, MatrixProblem::Component { found: found.to_string().into() })),
        },
    }
}
