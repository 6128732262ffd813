//! Fields of the lines of a keyword: numbers and names between commas.

use crate::matrix::MatrixProblem;
use crate::matrix::error::Row;
use crate::matrix::listed::LocatedProblem;
use crate::matrix::text::number;
use crate::mesh::inp::InpCard;

/// Fields of a line, without the blanks around them.
pub(super) fn fields(line: &str) -> Vec<&str> {
    line.trim_end_matches([',', ' ']).split(',').map(str::trim).collect()
}

/// The number in a field; zero where it is blank.
pub(super) fn real(field: &str, line: usize) -> Result<f64, LocatedProblem> {
    if field.is_empty() { Ok(0.0) } else { number(field, Row::InpCard).map_err(|problem| (line, problem)) }
}

/// All numbers of a line.
pub(super) fn reals((line, text): &(usize, String)) -> Result<Vec<f64>, LocatedProblem> {
    fields(text).into_iter().map(|field| real(field, *line)).collect()
}

/// Numbers of a card from its first lines on, as many as there must be, zeros where fields are blank.
pub(super) fn first(card: &InpCard, count: usize) -> Result<Vec<f64>, LocatedProblem> {
    let mut numbers = Vec::with_capacity(count);
    for line in &card.lines {
        numbers.extend(reals(line)?);
        if numbers.len() >= count {
            break;
        }
        // Eight numbers fill a line.
        if !numbers.len().is_multiple_of(8) {
            break;
        }
    }
    if numbers.is_empty() {
        return Err((card.line, MatrixProblem::Values { found: 0, row: Row::InpCard }));
    }
    numbers.resize(count.max(numbers.len()), 0.0);
    Ok(numbers)
}

/// Degrees of freedom 1 to 6 from a first to a last one.
pub(super) fn range(fields: &[&str], line: usize) -> Result<[bool; 6], LocatedProblem> {
    let number = |at: usize| -> Result<Option<usize>, LocatedProblem> {
        let field = fields.get(at).copied().unwrap_or_default();
        if field.is_empty() {
            return Ok(None);
        }
        let found = || (line, MatrixProblem::Component { found: field.into() });
        let value: usize = field.parse().map_err(|_| found())?;
        if (1..=6).contains(&value) { Ok(Some(value)) } else { Err(found()) }
    };
    let (from, to) = (number(0)?, number(1)?);
    let from = from.unwrap_or(1);
    let to = to.unwrap_or(if fields.is_empty() { 6 } else { from });
    let mut components = [false; 6];
    components[from - 1..to.max(from)].fill(true);
    Ok(components)
}
