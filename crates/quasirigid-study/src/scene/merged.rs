//! Visual geometry of a body of many elements: those of a kind are one piece, and of many links some are drawn.

use std::borrow::Cow;

use quasirigid::elements::Visual;

/// Most elements that are pieces of their own.
const MOST_PIECES: usize = 64;
/// Most elements of a kind in a piece of many, evenly among all.
const MOST_OF_A_KIND: usize = 3_000;

/// The visual geometry, in as few pieces as a viewer can list.
pub(super) fn merged(visuals: &[Visual]) -> Cow<'_, [Visual]> {
    if visuals.len() <= MOST_PIECES {
        return Cow::Borrowed(visuals);
    }
    let mut kinds: Vec<(&str, Vec<&Visual>)> = Vec::new();
    for visual in visuals {
        match kinds.iter_mut().find(|(kind, _)| *kind == visual.kind) {
            Some((_, of_kind)) => of_kind.push(visual),
            None => kinds.push((visual.kind, vec![visual])),
        }
    }
    kinds.into_iter().map(|(_, of_kind)| joined(&of_kind)).collect::<Vec<_>>().into()
}

fn joined(of_kind: &[&Visual]) -> Visual {
    let step = of_kind.len().div_ceil(MOST_OF_A_KIND);
    let mut all = Visual { name: String::new(), ..of_kind[0].clone() };
    for visual in of_kind.iter().step_by(step).skip(1) {
        let first = all.vertices.len();
        all.vertices.extend(&visual.vertices);
        all.lines.extend(visual.lines.iter().map(|line| line.map(|vertex| first + vertex)));
        all.triangles.extend(visual.triangles.iter().map(|triangle| triangle.map(|vertex| first + vertex)));
        for (coordinate, vectors) in &visual.shapes {
            let place = all.shapes.iter().position(|(other, _)| other == coordinate);
            let place = place.unwrap_or_else(|| {
                all.shapes.push((*coordinate, Vec::new()));
                all.shapes.len() - 1
            });
            all.shapes[place].1.resize(first, [0.0; 3]);
            all.shapes[place].1.extend(vectors);
        }
    }
    let count = all.vertices.len();
    all.shapes.iter_mut().for_each(|(_, vectors)| vectors.resize(count, [0.0; 3]));
    all
}
