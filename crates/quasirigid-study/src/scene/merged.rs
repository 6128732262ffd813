//! Pieces of a scene: elements one by one, or all of a kind together where a body has many.

use quasirigid::elements::Visual;

use super::kept::Kept;

/// Most elements that are pieces of their own.
const MOST_PIECES: usize = 64;

/// The elements of each piece.
pub(super) fn pieces_of(visuals: &[Visual]) -> Vec<Vec<&Visual>> {
    if visuals.len() <= MOST_PIECES {
        return visuals.iter().map(|visual| vec![visual]).collect();
    }
    let mut kinds: Vec<Vec<&Visual>> = Vec::new();
    for visual in visuals {
        match kinds.iter_mut().find(|of_kind| of_kind[0].kind == visual.kind) {
            Some(of_kind) => of_kind.push(visual),
            None => kinds.push(vec![visual]),
        }
    }
    kinds
}

/// Elements as one, displaced by the coordinates that are kept.
pub(super) fn joined(elements: &[&Visual], kept: &Kept) -> Visual {
    let first = elements[0];
    let name = if elements.len() == 1 { first.name.clone() } else { String::new() };
    let count = elements.iter().map(|visual| visual.vertices.len()).sum();
    let mut all = Visual {
        name,
        vertices: Vec::new(),
        lines: Vec::new(),
        triangles: Vec::new(),
        shapes: Vec::new(),
        ..first.clone()
    };
    for visual in elements {
        let start = all.vertices.len();
        all.vertices.extend(&visual.vertices);
        all.lines.extend(visual.lines.iter().map(|line| line.map(|vertex| start + vertex)));
        all.triangles.extend(visual.triangles.iter().map(|triangle| triangle.map(|vertex| start + vertex)));
        for (coordinate, vectors) in
            visual.shapes.iter().filter(|(coordinate, _)| kept.place(*coordinate).is_some())
        {
            let place = all.shapes.iter().position(|(other, _)| other == coordinate);
            let place = place.unwrap_or_else(|| {
                all.shapes.push((*coordinate, vec![[0.0; 3]; count]));
                all.shapes.len() - 1
            });
            all.shapes[place].1[start..start + vectors.len()].copy_from_slice(vectors);
        }
    }
    all
}
