//! Plate tables of the Planetary Data System: numbered vertices, then numbered triangles.
//! Every number is compared with its turn, since a file cut or edited in the middle would otherwise give another surface in silence.

use super::TriangleMesh;
use super::error::{Fault, MeshProblem, Part, Place, Row};
use super::text::point;
use crate::text_file::{lines, text, whole};

/// Plate tables: numbered vertices, then numbered triangles.
pub(super) fn read(bytes: &[u8]) -> Result<TriangleMesh, Fault> {
    let text = text::<MeshProblem>(bytes)?;
    let mut table = Table { lines: lines(text), last: text.lines().count() };
    let (line, counts) = table.next(Part::Vertices, 1, 0)?;
    let first = match counts.as_slice() {
        [vertices] => (whole(vertices, Row::PlateCounts), None),
        [vertices, faces] => (whole(vertices, Row::PlateCounts), Some(whole(faces, Row::PlateCounts))),
        values => (Err(MeshProblem::Values { found: values.len(), row: Row::PlateCounts }), None),
    };
    let vertices = first.0.map_err(|problem| (Place::Line(line), problem))?;
    let faces = first.1.transpose().map_err(|problem| (Place::Line(line), problem))?;

    let mut mesh = TriangleMesh::default();
    for number in 0..vertices {
        let (line, words) = table.next(Part::Vertices, vertices, number)?;
        let vertex = numbered(&words, number + 1, Row::PlateVertex)
            .and_then(|words| point(words.into_iter(), Row::PlateVertex))
            .map_err(|problem| (Place::Line(line), problem))?;
        mesh.vertices.push(vertex);
    }
    let faces = match faces {
        Some(faces) => faces,
        None => {
            let (line, words) = table.next(Part::Faces, 1, 0)?;
            let [word] = words.as_slice() else {
                let problem = MeshProblem::Values { found: words.len(), row: Row::PlateCount };
                return Err((Place::Line(line), problem));
            };
            whole(word, Row::PlateCount).map_err(|problem| (Place::Line(line), problem))?
        }
    };
    for number in 0..faces {
        let (line, words) = table.next(Part::Faces, faces, number)?;
        let triangle = numbered(&words, number + 1, Row::PlateFace)
            .and_then(|words| triangle(words, mesh.vertices.len()))
            .map_err(|problem| (Place::Line(line), problem))?;
        mesh.triangles.push(triangle);
    }
    match table.lines.next() {
        Some((line, _)) => {
            Err((Place::Line(line), MeshProblem::Surplus { part: Part::Faces, announced: faces }))
        }
        None => Ok(mesh),
    }
}

/// The lines of a table.
struct Table<I> {
    lines: I,
    /// Number of the last line.
    last: usize,
}

impl<'a, I: Iterator<Item = (usize, &'a str)>> Table<I> {
    /// Values of the next line, by blanks or commas, with its number; the line holds one of the parts announced.
    fn next(&mut self, part: Part, announced: u64, found: u64) -> Result<(usize, Vec<&'a str>), Fault> {
        let end = (Place::Line(self.last), MeshProblem::Cut { part, announced, found });
        let (number, line) = self.lines.next().ok_or(end)?;
        let values = line.split(|c: char| c.is_whitespace() || c == ',').filter(|value| !value.is_empty());
        Ok((number, values.collect()))
    }
}

/// The three values of a row that has its number before them.
fn numbered<'a>(words: &[&'a str], expected: u64, row: Row) -> Result<[&'a str; 3], MeshProblem> {
    let [number, a, b, c] = words else {
        return Err(MeshProblem::Values { found: words.len(), row });
    };
    if whole(number, row)? == expected {
        Ok([a, b, c])
    } else {
        Err(MeshProblem::Numbering { found: (*number).into(), expected })
    }
}

fn triangle(words: [&str; 3], vertices: usize) -> Result<[usize; 3], MeshProblem> {
    let mut triangle = [0; 3];
    for (word, corner) in words.into_iter().zip(&mut triangle) {
        let number = whole(word, Row::PlateFace)?;
        let index = usize::try_from(number).ok().and_then(|number| number.checked_sub(1));
        let no_such = || MeshProblem::NoSuchVertex { found: word.into(), first: 1, vertices };
        *corner = index.filter(|index| *index < vertices).ok_or_else(no_such)?;
    }
    Ok(triangle)
}
