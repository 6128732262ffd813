//! Real modes in the files that NASTRAN prints (`.f06`) and punches (`.pch`): tables of eigenvalues, eigenvectors point by point.
//! A print repeats its headings on each page; the modes of the first subcase count, until their numbers begin again.
//! MSC Nastran 2005 Quick Reference Guide, DISPLACEMENT (PRINT, PUNCH); Getting Started, *Eigenvalue summary*.

use super::modes::{Modes, Shape};
use crate::matrix::Dof;
use crate::matrix::error::{MatrixProblem, Row};
use crate::matrix::listed::LocatedProblem;
use crate::matrix::text::number;

const EIGENVALUES: &str = "R E A L   E I G E N V A L U E S";
/// The eigenvalues with those of residual vectors, which replace those before.
const AUGMENTED: &str = "AFTER AUGMENTATION";
const EIGENVECTOR: &str = "R E A L   E I G E N V E C T O R   N O .";
/// Beginnings of punched lines: the title of a table of eigenvectors, and the eigenvalue of each.
const PUNCHED: [&str; 2] = ["$EIGENVECTOR", "$EIGENVALUE ="];
const CONTINUED: &str = "-CONT-";
/// Columns of a punched line before its number.
const COLUMNS: usize = 72;

/// Whether a file has modes.
pub(crate) fn has_modes(bytes: &[u8]) -> bool {
    let has = |word: &str| bytes.windows(word.len()).any(|part| part == word.as_bytes());
    [EIGENVALUES, EIGENVECTOR, PUNCHED[1]].iter().any(|word| has(word))
}

/// The modes of a print file or a punch file.
///
/// # Errors
/// A line of a table that cannot be read.
pub(crate) fn modes(bytes: &[u8]) -> Result<Modes, LocatedProblem> {
    let text = String::from_utf8_lossy(bytes);
    if text.lines().any(|line| line.starts_with(PUNCHED[1])) {
        return punched(&text);
    }
    printed(&text)
}

/// Tables that the lines of a print belong to.
#[derive(PartialEq)]
enum Table {
    None,
    Eigenvalues,
    Eigenvector,
}

fn printed(text: &str) -> Result<Modes, LocatedProblem> {
    let (mut modes, mut table) = (Modes::default(), Table::None);
    // whether the first subcase has ended
    let (mut over, mut augmented) = ([false; 2], false);
    for (line, content) in (1..).zip(text.lines()) {
        if content.contains(EIGENVALUES) {
            table = Table::Eigenvalues;
        } else if content.contains(AUGMENTED) && !augmented {
            (augmented, over[0]) = (true, false);
            modes.frequencies.clear();
        } else if let Some((_, mode)) = content.split_once(EIGENVECTOR) {
            let mode: usize = mode.trim().parse().unwrap_or(0);
            over[1] |= mode < modes.shapes.len();
            if mode > modes.shapes.len() && !over[1] {
                modes.shapes.push(Shape::default());
            }
            table = Table::Eigenvector;
        } else if content.starts_with('1') {
            // a new page
            table = Table::None;
        }
        let words: Vec<&str> = content.split_whitespace().collect();
        match (&table, words.as_slice()) {
            (Table::Eigenvalues, [mode, order, _, angular, _, _, _]) => {
                let (Ok(mode), Ok(_)) = (mode.parse::<usize>(), order.parse::<usize>()) else { continue };
                over[0] |= mode <= modes.frequencies.len();
                if !over[0] {
                    modes.frequencies.push(value(angular, line)?);
                }
            }
            (Table::Eigenvector, [point, "G", components @ ..]) if !over[1] && components.len() == 6 => {
                if let Some(shape) = modes.shapes.last_mut() {
                    add(shape, point, components, line)?;
                }
            }
            _ => {}
        }
    }
    Ok(modes)
}

/// Lines of a point and its displacements, each with a second one of its rotations.
fn punched(text: &str) -> Result<Modes, LocatedProblem> {
    let mut modes = Modes::default();
    let (mut of_vectors, mut over) = (false, false);
    let mut lines = (1..).zip(text.lines()).peekable();
    while let Some((line, content)) = lines.next() {
        if let Some(rest) = content.strip_prefix(PUNCHED[1]) {
            let mut words = rest.split_whitespace();
            let eigenvalue = value(words.next().unwrap_or_default(), line)?;
            let mode: Option<usize> =
                words.skip_while(|word| *word != "=").nth(1).and_then(|mode| mode.parse().ok());
            over |= mode.is_some_and(|mode| mode <= modes.frequencies.len());
            if of_vectors && !over {
                // a rigid mode may have an eigenvalue a little below zero
                modes.frequencies.push(eigenvalue.max(0.0).sqrt());
                modes.shapes.push(Shape::default());
            }
        } else if content.starts_with('$') {
            let title = !content.contains('=') && !content.starts_with("$REAL");
            of_vectors = if title { content.starts_with(PUNCHED[0]) } else { of_vectors };
        } else if let (true, Some(shape)) = (of_vectors && !over, modes.shapes.last_mut()) {
            let first: Vec<&str> = columns(content).split_whitespace().collect();
            let more = lines.next_if(|(_, next)| next.starts_with(CONTINUED)).map(|(_, next)| columns(next));
            let rest = more.unwrap_or_default().split_whitespace().skip(1);
            let [point, "G", translations @ ..] = first.as_slice() else { continue };
            let components: Vec<&str> = translations.iter().copied().chain(rest).collect();
            add(shape, point, &components, line)?;
        }
    }
    Ok(modes)
}

fn columns(content: &str) -> &str {
    content.get(..COLUMNS).unwrap_or(content)
}

/// Adds the six components of a point to a shape.
fn add(shape: &mut Shape, point: &str, components: &[&str], line: usize) -> Result<(), LocatedProblem> {
    let wrong = || (line, MatrixProblem::Values { found: components.len() + 2, row: Row::Mode });
    let node: u64 = point.parse().map_err(|_| wrong())?;
    if components.len() != 6 {
        return Err(wrong());
    }
    for (component, word) in (1..).zip(components) {
        shape.values.push((Dof { node, component }, value(word, line)?));
    }
    Ok(())
}

fn value(word: &str, line: usize) -> Result<f64, LocatedProblem> {
    number(word, Row::Mode).map_err(|problem| (line, problem))
}
