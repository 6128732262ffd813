//! Plate tables: vertices, then faces, with or without their numbers before each row and their counts before all.
//! Numbers of rows are compared with their turn, since a file cut or edited in the middle would otherwise give another surface in silence.

use super::TriangleMesh;
use super::draft::{Draft, number_of_corner};
use super::error::{Fault, MeshProblem, Part, Place, Row};
use super::text::{point, readable, rows};
use crate::text_file::{last_line, whole};

/// Plate tables: vertices, then faces.
pub(super) fn read(bytes: &[u8]) -> Result<TriangleMesh, Fault> {
    let text = readable(bytes);
    let mut table = Table { rows: rows(&text).peekable(), last: last_line(&text) };
    let counts = table.counts(rows(&text).count() as u64)?;
    let mut draft = Draft::new();
    let mut faces = counts.and_then(|(_, faces)| faces);
    let numbered = match counts {
        Some((vertices, _)) => table.vertices(vertices, &mut draft)?,
        None => table.vertices_to_the_end(&mut draft)?,
    };
    if counts.is_some() && faces.is_none() {
        faces = table.count_of_faces()?;
    }
    table.faces(faces, numbered, &mut draft)?;
    let first = u32::from(draft.lowest() != Some(0) && numbered != Some(0));
    draft.numbered_from(first);
    draft.finish(first)
}

/// The rows of a table.
struct Table<I: Iterator> {
    rows: std::iter::Peekable<I>,
    /// Number of the last line.
    last: usize,
}

impl<'a, I: Iterator<Item = (usize, Vec<&'a str>)>> Table<I> {
    /// The next row and its line, which holds one of the parts announced.
    fn next(&mut self, part: Part, announced: u64, found: u64) -> Result<(usize, Vec<&'a str>), Fault> {
        let end = (Place::Line(self.last), MeshProblem::Cut { part, announced, found });
        self.rows.next().ok_or(end)
    }

    /// Numbers of vertices and perhaps of faces in the first row, or in the first two; none if the table starts with its vertices.
    fn counts(&mut self, all: u64) -> Result<Option<(u64, Option<u64>)>, Fault> {
        let Some((line, words)) = self.rows.peek() else { return Ok(None) };
        let (line, words) = (*line, words.clone());
        let integers = || words.iter().map(|word| word.parse::<u64>().ok()).collect::<Option<Vec<u64>>>();
        let faulty = |problem| (Place::Line(line), problem);
        match (words.len(), integers().as_deref()) {
            // The third number is that of the edges.
            (3, Some([vertices, faces, _]))
                if vertices.checked_add(*faces).is_some_and(|rows| rows + 1 == all) =>
            {
                self.rows.next();
                Ok(Some((*vertices, Some(*faces))))
            }
            (3, Some(_)) if self.rows.peek().is_some_and(|_| all < 3) => {
                Err(faulty(MeshProblem::Values { found: 3, row: Row::PlateCounts }))
            }
            (1 | 2, _) => {
                self.rows.next();
                let vertices = whole(words[0], Row::PlateCounts).map_err(faulty)?;
                let faces =
                    words.get(1).map(|word| whole(word, Row::PlateCounts)).transpose().map_err(faulty)?;
                match self.rows.peek() {
                    Some((line, words)) if faces.is_none() && words.len() == 1 => {
                        let faces = whole(words[0], Row::PlateCount);
                        let faces = faces.map_err(|problem| (Place::Line(*line), problem))?;
                        self.rows.next();
                        Ok(Some((vertices, Some(faces))))
                    }
                    _ => Ok(Some((vertices, faces))),
                }
            }
            _ => Ok(None),
        }
    }

    /// So many vertices; the number of the first, if they are numbered.
    fn vertices(&mut self, count: u64, draft: &mut Draft) -> Result<Option<u64>, Fault> {
        let mut numbered = None;
        for index in 0..count {
            let (line, words) = self.next(Part::Vertices, count, index)?;
            if index == 0 {
                numbered = first_number(&words, line)?;
            }
            let vertex = values(&words, numbered.map(|first| first + index), Row::PlateVertex)
                .and_then(|words| point(words.iter().copied(), Row::PlateVertex));
            draft.vertices.push(vertex.map_err(|problem| (Place::Line(line), problem))?);
        }
        Ok(numbered)
    }

    /// Vertices up to the faces: where the numbers of the rows start again, or where rows of whole numbers begin.
    fn vertices_to_the_end(&mut self, draft: &mut Draft) -> Result<Option<u64>, Fault> {
        let (line, words) = self.next(Part::Vertices, 1, 0)?;
        let numbered = first_number(&words, line)?;
        let all_whole =
            |words: &[&str]| words.iter().all(|word| word.bytes().all(|byte| byte.is_ascii_digit()));
        if numbered.is_none() && all_whole(&words) {
            // Nothing tells vertices from faces.
            return Err((
                Place::Line(line),
                MeshProblem::Values { found: words.len(), row: Row::PlateCounts },
            ));
        }
        let (mut line, mut words) = (line, words);
        loop {
            let number = numbered.map(|first| first + draft.vertices.len() as u64);
            let vertex = values(&words, number, Row::PlateVertex)
                .and_then(|words| point(words.iter().copied(), Row::PlateVertex));
            draft.vertices.push(vertex.map_err(|problem| (Place::Line(line), problem))?);
            let faces = self.rows.peek().is_none_or(|(_, words)| match numbered {
                Some(first) => words.first().and_then(|word| word.parse().ok()) == Some(first),
                None => all_whole(words),
            });
            if faces {
                return Ok(numbered);
            }
            (line, words) = self.next(Part::Vertices, 1, 0)?;
        }
    }

    /// The number of faces in a row of its own; none where the faces follow at once.
    fn count_of_faces(&mut self) -> Result<Option<u64>, Fault> {
        match self.rows.peek() {
            Some((_, words)) if words.len() >= 3 => Ok(None),
            _ => {
                let (line, words) = self.next(Part::Faces, 1, 0)?;
                let problem = match words.as_slice() {
                    [word] => whole(word, Row::PlateCount),
                    words => Err(MeshProblem::Values { found: words.len(), row: Row::PlateCount }),
                };
                problem.map(Some).map_err(|problem| (Place::Line(line), problem))
            }
        }
    }

    /// The faces, so many of them or all that are left.
    fn faces(&mut self, count: Option<u64>, numbered: Option<u64>, draft: &mut Draft) -> Result<(), Fault> {
        let mut form = None;
        let mut corners = Vec::new();
        for index in 0..count.unwrap_or(u64::MAX) {
            if count.is_none() && self.rows.peek().is_none() {
                break;
            }
            let (line, mut words) = self.next(Part::Faces, count.unwrap_or_default(), index)?;
            let fault = |problem| (Place::Line(line), problem);
            let form = *form.get_or_insert_with(|| FaceForm::of(&words, numbered));
            if form == FaceForm::CountAbove {
                words.extend(self.next(Part::Faces, count.unwrap_or_default(), index)?.1);
            }
            corners.clear();
            for word in form.corners(&words, index).map_err(fault)? {
                let number = number_of_corner(word, Row::PlateFace, draft.vertices.len(), 1);
                corners.push(number.map_err(fault)?);
            }
            draft.polygon(&corners, line);
        }
        match self.rows.next() {
            Some((line, _)) => {
                let announced = count.unwrap_or_default();
                Err((Place::Line(line), MeshProblem::Surplus { part: Part::Faces, announced }))
            }
            None => Ok(()),
        }
    }
}

/// Form of the rows of faces.
#[derive(Clone, Copy, PartialEq, Eq)]
enum FaceForm {
    /// Three corners.
    Plain,
    /// The number of the face, then three corners; the number of the first face.
    Numbered(u64),
    /// The number of corners, then the corners.
    Counted,
    /// The number of corners in a line of its own, then the corners.
    CountAbove,
}

impl FaceForm {
    /// Form of the first row; vertices are numbered from a number.
    fn of(words: &[&str], numbered: Option<u64>) -> Self {
        let first = words.first().and_then(|word| word.parse::<u64>().ok());
        match (words.len(), first) {
            (1, Some(3..)) => Self::CountAbove,
            (4, Some(number @ 0..=1)) => Self::Numbered(number),
            (4.., Some(count)) if numbered.is_none() && count + 1 == words.len() as u64 => Self::Counted,
            (4, _) => Self::Numbered(numbered.unwrap_or(1)),
            _ => Self::Plain,
        }
    }

    /// Corners of the face of an index.
    fn corners<'w, 'a>(self, words: &'w [&'a str], index: u64) -> Result<&'w [&'a str], MeshProblem> {
        match self {
            Self::Plain => values(words, None, Row::PlateFace),
            Self::Numbered(first) => values(words, Some(first + index), Row::PlateFace),
            Self::Counted | Self::CountAbove => {
                let count = whole(words[0], Row::PlateFace)?;
                if count != words.len() as u64 - 1 {
                    return Err(MeshProblem::Values { found: words.len(), row: Row::PlateFace });
                }
                Ok(&words[1..])
            }
        }
    }
}

/// The number of the first vertex; none if it has none.
fn first_number(words: &[&str], line: usize) -> Result<Option<u64>, Fault> {
    match words {
        [_, _, _] => Ok(None),
        [number, _, _, _] => match number.parse() {
            Ok(first @ 0..=1) => Ok(Some(first)),
            _ => Err((Place::Line(line), MeshProblem::Numbering { found: (*number).into(), expected: 1 })),
        },
        _ => Err((Place::Line(line), MeshProblem::Values { found: words.len(), row: Row::PlateVertex })),
    }
}

/// The three values of a row, which has its number before them if one is expected.
fn values<'w, 'a>(words: &'w [&'a str], number: Option<u64>, row: Row) -> Result<&'w [&'a str], MeshProblem> {
    match (words, number) {
        ([_, _, _], None) => Ok(words),
        ([found, values @ ..], Some(expected)) if values.len() == 3 => {
            if whole(found, row)? == expected {
                Ok(values)
            } else {
                Err(MeshProblem::Numbering { found: (*found).into(), expected })
            }
        }
        _ => Err(MeshProblem::Values { found: words.len(), row }),
    }
}
