//! Wavefront OBJ, and the tables of shape models that have its rows: `v` and `f`, perhaps with their numbers before them.

use std::borrow::Cow;

use super::TriangleMesh;
use super::draft::{Draft, number_of_corner};
use super::error::{Fault, MeshProblem, Part, Place, Row};
use super::text::{point, readable};
use crate::text_file::last_line;

/// Wavefront OBJ: vertices and faces.
pub(super) fn read(bytes: &[u8]) -> Result<TriangleMesh, Fault> {
    let text = readable(bytes);
    let (mut draft, mut corners, mut announced) = (Draft::new(), Vec::new(), Vec::new());
    let mut counts_back = false;
    for (line, statement) in statements(&text) {
        let mut words = statement.split_whitespace();
        let done = match words.next() {
            Some("v" | "V") => point(words, Row::ObjVertex).map(|vertex| draft.vertices.push(vertex)),
            Some("f" | "F" | "fo") => {
                corners.clear();
                words
                    .try_for_each(|word| {
                        counts_back |= word.starts_with('-');
                        corners.push(corner(word, draft.vertices.len())?);
                        Ok(())
                    })
                    .map(|()| draft.polygon(&corners, line))
            }
            Some(word) if draft.vertices.is_empty() && announced.is_empty() => {
                // The counts of a table.
                announced.extend([word].into_iter().chain(words).map_while(|word| word.parse::<u64>().ok()));
                Ok(())
            }
            _ => Ok(()),
        };
        done.map_err(|problem| (Place::Line(line), problem))?;
    }
    let found = [(Part::Vertices, draft.vertices.len() as u64), (Part::Faces, draft.faces())];
    for (announced, (part, found)) in announced.into_iter().zip(found) {
        let end = Place::Line(last_line(&text));
        match found.cmp(&announced) {
            std::cmp::Ordering::Less => return Err((end, MeshProblem::Cut { part, announced, found })),
            std::cmp::Ordering::Greater => return Err((end, MeshProblem::Surplus { part, announced })),
            std::cmp::Ordering::Equal => {}
        }
    }
    let first = u32::from(counts_back || draft.lowest() != Some(0));
    draft.numbered_from(first);
    draft.finish(first)
}

/// Number of a corner such as `7`, `7/1`, `7//3`, or `-1` for the last vertex so far.
fn corner(word: &str, vertices: usize) -> Result<u32, MeshProblem> {
    let first = word.split('/').next().unwrap_or(word);
    let Some(digits) = first.strip_prefix('-') else {
        let number = number_of_corner(first, Row::ObjFace, vertices, 1);
        return number.map_err(|problem| match problem {
            MeshProblem::NotANumber { row, .. } => MeshProblem::NotANumber { found: word.into(), row },
            other => other,
        });
    };
    let back = number_of_corner(digits, Row::ObjFace, vertices, 1)?;
    let number = vertices.checked_sub(back as usize).filter(|_| back > 0);
    let none = || MeshProblem::NoSuchVertex { found: first.into(), first: 1, vertices };
    number.and_then(|number| u32::try_from(number + 1).ok()).ok_or_else(none)
}

/// Lines without their comments, with the number of the line on which they start; a backslash at its end joins a line to
/// the next.
fn statements(text: &str) -> impl Iterator<Item = (usize, Cow<'_, str>)> {
    let mut lines = (1..).zip(text.lines());
    std::iter::from_fn(move || {
        let (number, line) = lines.next()?;
        let mut whole = Cow::Borrowed(line);
        while whole.ends_with('\\') && !whole.contains('#') {
            let whole = whole.to_mut();
            whole.pop();
            whole.push(' ');
            whole.push_str(lines.next().map_or("", |(_, line)| line));
        }
        if let Some(comment) = whole.find('#') {
            whole = whole[..comment].to_owned().into();
        }
        Some((number, whole))
    })
}
