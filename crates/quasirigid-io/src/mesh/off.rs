//! OFF of Geomview: counts, vertices, polygons; normals, colours and texture after them are ignored.

use super::TriangleMesh;
use super::draft::{Draft, number_of_corner};
use super::error::{Fault, MeshProblem, Part, Place, Row};
use super::text::{point, readable, rows};
use crate::text_file::{last_line, whole};

/// Whether a word is the first of an OFF file; letters before `OFF` announce values beside the coordinates, and the first count may follow
/// without a blank.
pub(super) fn is_header(word: &[u8]) -> bool {
    let digits = word.iter().rev().take_while(|byte| byte.is_ascii_digit()).count();
    word[..word.len() - digits]
        .strip_suffix(b"OFF")
        .is_some_and(|before| before.iter().all(|byte| b"STCN4n".contains(byte)))
}

/// OFF as text.
pub(super) fn read(bytes: &[u8]) -> Result<TriangleMesh, Fault> {
    let text = readable(bytes);
    let end = Place::Line(last_line(&text));
    let mut rows = rows(&text);
    let mut next = |part: Part, announced: u64, found: u64| {
        rows.next().ok_or((end.clone(), MeshProblem::Cut { part, announced, found }))
    };
    let (line, mut header) = next(Part::Vertices, 1, 0)?;
    let kind = header[0].trim_end_matches(|digit: char| digit.is_ascii_digit());
    if kind.len() < header[0].len() {
        let count = &header[0][kind.len()..];
        header.splice(..1, [kind, count]);
    }
    if kind.contains(['4', 'n']) || header.get(1).is_some_and(|word| word.eq_ignore_ascii_case("binary")) {
        let found = header.join(" ").as_str().into();
        return Err((Place::Line(line), MeshProblem::Unexpected { found, row: Row::OffHeader }));
    }
    let (line, counts) =
        if header.len() > 1 { (line, header[1..].to_vec()) } else { next(Part::Vertices, 1, 0)? };
    let fault = |line: usize| move |problem| (Place::Line(line), problem);
    let [vertices, faces, ..] = counts.as_slice() else {
        return Err(fault(line)(MeshProblem::Values { found: counts.len(), row: Row::OffHeader }));
    };
    let [vertices, faces] = [vertices, faces].map(|word| whole(word, Row::OffHeader).map_err(fault(line)));
    let (vertices, faces) = (vertices?, faces?);

    let mut draft = Draft::new();
    for index in 0..vertices {
        let (line, words) = next(Part::Vertices, vertices, index)?;
        draft.vertices.push(point(words.into_iter(), Row::OffVertex).map_err(fault(line))?);
    }
    let mut corners = Vec::new();
    for index in 0..faces {
        let (line, words) = next(Part::Faces, faces, index)?;
        let count = whole(words[0], Row::OffFace).map_err(fault(line))?;
        let listed = usize::try_from(count).ok().and_then(|count| words[1..].get(..count));
        let listed = listed.ok_or(MeshProblem::Values { found: words.len(), row: Row::OffFace });
        corners.clear();
        for word in listed.map_err(fault(line))? {
            corners.push(number_of_corner(word, Row::OffFace, draft.vertices.len(), 0).map_err(fault(line))?);
        }
        draft.polygon(&corners, line);
    }
    draft.finish(0)
}
