use std::borrow::Cow;

use super::TriangleMesh;
use super::error::{Fault, MeshProblem, Place, Row};
use super::text::point;
use crate::text_file::text;

/// Wavefront OBJ: vertices and faces.
pub(super) fn read(bytes: &[u8]) -> Result<TriangleMesh, Fault> {
    let mut mesh = TriangleMesh::default();
    let mut lines = Vec::new(); // of the triangles: a face may come before its vertices
    for (line, statement) in statements(text::<MeshProblem>(bytes)?) {
        let mut words = statement.split_whitespace();
        let done = match words.next() {
            Some("v") => point(words, Row::ObjVertex).map(|vertex| mesh.vertices.push(vertex)),
            Some("f") => face(&mut mesh, words),
            _ => Ok(()),
        };
        done.map_err(|problem| (Place::Line(line), problem))?;
        lines.resize(mesh.triangles.len(), line);
    }
    let vertices = mesh.vertices.len();
    for (corners, line) in mesh.triangles.iter().zip(lines) {
        if let Some(corner) = corners.iter().find(|corner| **corner >= vertices) {
            let found = (corner + 1).to_string().into();
            return Err((Place::Line(line), MeshProblem::NoSuchVertex { found, first: 1, vertices }));
        }
    }
    Ok(mesh)
}

fn face<'a>(mesh: &mut TriangleMesh, words: impl Iterator<Item = &'a str>) -> Result<(), MeshProblem> {
    let vertices = mesh.vertices.len();
    let corners: Vec<usize> = words.map(|word| corner(word, vertices)).collect::<Result<_, _>>()?;
    mesh.fan(&corners)
}

/// Index of a corner such as `7`, `7/1`, `7//3`, or `-1` for the last vertex so far.
fn corner(word: &str, vertices: usize) -> Result<usize, MeshProblem> {
    let first = word.split('/').next().unwrap_or(word);
    let digits = first.strip_prefix('-').unwrap_or(first);
    if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
        return Err(MeshProblem::NotANumber { found: word.into(), row: Row::ObjFace });
    }
    let index = match first.parse::<i64>() {
        Ok(number) if number > 0 => usize::try_from(number - 1).ok(),
        Ok(number) if number < 0 => {
            usize::try_from(number.unsigned_abs()).ok().and_then(|back| vertices.checked_sub(back))
        }
        _ => None,
    };
    index.ok_or_else(|| MeshProblem::NoSuchVertex { found: first.into(), first: 1, vertices })
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
