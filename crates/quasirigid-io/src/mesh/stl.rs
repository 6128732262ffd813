//! STL as text or binary: facets whose corners are welded into shared vertices.
//! Corners are equal bit for bit or not at all: a tolerance would close gaps that the surface check has to find.

use std::collections::HashMap;

use super::TriangleMesh;
use super::error::{Fault, MeshProblem, Part, Place, Row};
use super::text::{point, readable};
use crate::text_file::lines;

/// Bytes before the number of facets in a binary file.
const TITLE: usize = 80;
/// Bytes before the first facet.
const HEADER: usize = TITLE + 4;
/// Bytes of a facet: normal, three corners, two bytes of attributes.
const FACET: usize = 12 * 4 + 2;

/// Whether a binary file of this many facets has this size, to the byte.
pub(super) fn has_exact_size(bytes: &[u8]) -> bool {
    announced(bytes).is_some_and(|facets| facets > 0 && bytes.len() as u64 == size(facets))
}

/// Whether the beginning is that of a text: a binary file has a zero in its number of facets.
pub(super) fn is_text(bytes: &[u8]) -> bool {
    !bytes[..bytes.len().min(HEADER)].contains(&0)
}

fn announced(bytes: &[u8]) -> Option<u64> {
    let count: [u8; 4] = bytes.get(TITLE..HEADER)?.try_into().ok()?;
    Some(u32::from_le_bytes(count).into())
}

fn size(facets: u64) -> u64 {
    HEADER as u64 + FACET as u64 * facets
}

/// Corners that become one vertex where all their coordinates are equal.
#[derive(Default)]
struct Welding {
    mesh: TriangleMesh,
    known: HashMap<[u64; 3], usize>,
}

impl Welding {
    fn vertex(&mut self, place: [f64; 3]) -> usize {
        let place = place.map(|x| x + 0.0); // −0 becomes 0
        *self.known.entry(place.map(f64::to_bits)).or_insert_with(|| {
            self.mesh.vertices.push(place);
            self.mesh.vertices.len() - 1
        })
    }
}

/// STL as text.
pub(super) fn read_text(bytes: &[u8]) -> Result<TriangleMesh, Fault> {
    let mut welding = Welding::default();
    let mut corners = Vec::new();
    let (mut last, mut open) = (1, true);
    for (number, line) in lines(&readable(bytes)) {
        last = number;
        let fault = |problem| (Place::Line(number), problem);
        let mut words = line.split_whitespace();
        let word = words.next().unwrap_or_default().to_ascii_lowercase();
        match word.as_str() {
            "vertex" => corners.push(welding.vertex(point(words, Row::StlVertex).map_err(fault)?)),
            "endfacet" => {
                let found = corners.len();
                let triangle = corners.as_slice().try_into();
                welding.mesh.triangles.push(triangle.map_err(|_| fault(MeshProblem::Facet { found }))?);
                corners.clear();
            }
            "solid" => open = true,
            "endsolid" => open = false,
            "facet" | "outer" | "endloop" => {}
            _ => return Err(fault(MeshProblem::Unexpected { found: line.into(), row: Row::Stl })),
        }
        if word == "facet" && !corners.is_empty() {
            return Err(fault(MeshProblem::Unexpected { found: line.into(), row: Row::Stl }));
        }
    }
    if open || !corners.is_empty() {
        return Err((Place::Line(last), MeshProblem::NoEnd));
    }
    Ok(welding.mesh)
}

/// Binary STL.
pub(super) fn read_binary(bytes: &[u8]) -> Result<TriangleMesh, Fault> {
    let end = Place::Byte(bytes.len());
    let part = Part::Faces;
    let Some(facets) = announced(bytes) else {
        return Err((end, MeshProblem::Cut { part, announced: 1, found: 0 }));
    };
    if (bytes.len() as u64) < size(facets) {
        let found = ((bytes.len() - HEADER) / FACET) as u64;
        return Err((end, MeshProblem::Cut { part, announced: facets, found }));
    }
    if bytes.len() as u64 > size(facets) {
        let place = Place::Byte(size(facets) as usize);
        return Err((place, MeshProblem::Surplus { part, announced: facets }));
    }
    let mut welding = Welding::default();
    for (number, facet) in bytes[HEADER..].chunks_exact(FACET).enumerate() {
        let mut triangle = [0; 3];
        for (corner, index) in triangle.iter_mut().enumerate() {
            let mut vertex = [0.0; 3];
            for (axis, x) in vertex.iter_mut().enumerate() {
                let at = 4 * (3 + 3 * corner + axis);
                let value = f32::from_le_bytes([facet[at], facet[at + 1], facet[at + 2], facet[at + 3]]);
                if !value.is_finite() {
                    let place = Place::Byte(HEADER + FACET * number + at);
                    return Err((place, MeshProblem::NotFinite { found: value.to_string().into() }));
                }
                *x = f64::from(value);
            }
            *index = welding.vertex(vertex);
        }
        welding.mesh.triangles.push(triangle);
    }
    Ok(welding.mesh)
}
