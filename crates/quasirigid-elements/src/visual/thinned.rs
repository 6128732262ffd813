//! Thinning of triangles: vertices that share a cell of a grid become one, so that a picture of a fine mesh stays small.

use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Most vertices of the picture of an element: enough for its shape on a screen.
pub(crate) const MOST_VERTICES: usize = 2_500;
/// Growth of the cells of the grid while there are too many vertices.
const COARSER: f64 = 1.25;

/// Vertices kept, by their index among the places, and the triangles between them, by their index among those kept.
pub(crate) fn thinned(places: &[[f64; 3]], triangles: &[[usize; 3]]) -> (Vec<usize>, Vec<[usize; 3]>) {
    let used: BTreeSet<usize> = triangles.iter().flatten().copied().collect();
    let mut merged: BTreeMap<usize, usize> = used.iter().map(|vertex| (*vertex, *vertex)).collect();
    let mut side = first_side(places, &used);
    loop {
        let kept: BTreeSet<usize> = merged.values().copied().collect();
        if kept.len() <= MOST_VERTICES {
            return renumbered(kept.into_iter().collect(), &merged, triangles);
        }
        let mut cells: HashMap<[i64; 3], usize> = HashMap::new();
        for (vertex, other) in &mut merged {
            let cell = places[*vertex].map(|entry| (entry / side).floor() as i64);
            *other = *cells.entry(cell).or_insert(*vertex);
        }
        side *= COARSER;
    }
}

/// Side of the cells of a surface of as many cells as vertices are wanted.
fn first_side(places: &[[f64; 3]], used: &BTreeSet<usize>) -> f64 {
    let span = |axis: usize| {
        let along = used.iter().map(|vertex| places[*vertex][axis]);
        along.clone().fold(f64::NEG_INFINITY, f64::max) - along.fold(f64::INFINITY, f64::min)
    };
    let [x, y, z] = [0, 1, 2].map(span);
    (2.0 * (x * y + y * z + z * x) / MOST_VERTICES as f64).sqrt()
}

fn renumbered(
    kept: Vec<usize>,
    merged: &BTreeMap<usize, usize>,
    triangles: &[[usize; 3]],
) -> (Vec<usize>, Vec<[usize; 3]>) {
    let number: HashMap<usize, usize> =
        kept.iter().enumerate().map(|(number, vertex)| (*vertex, number)).collect();
    let moved = triangles.iter().map(|triangle| triangle.map(|vertex| number[&merged[&vertex]]));
    let triangles = moved.filter(|[a, b, c]| a != b && b != c && c != a).collect();
    (kept, triangles)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::visual::shapes::sheet;
    use nalgebra::Vector3;

    /// A fine sheet keeps its size and its side; a coarse one is left as it is.
    #[test]
    fn a_fine_sheet_keeps_its_shape() {
        let (places, triangles) = sheet([150, 100], [false; 2], |u, v| Vector3::new(3.0 * u, 2.0 * v, 0.0));
        let (kept, left) = thinned(&places, &triangles);
        let area: f64 = left
            .iter()
            .map(|triangle| {
                let [a, b, c] = triangle.map(|vertex| Vector3::from(places[kept[vertex]]));
                0.5 * (b - a).cross(&(c - a)).z
            })
            .sum();
        assert!(kept.len() <= MOST_VERTICES && kept.len() > MOST_VERTICES / 3, "{}", kept.len());
        assert!((area - 6.0).abs() < 0.3, "{area}");

        let (places, triangles) = sheet([20, 10], [false; 2], |u, v| Vector3::new(u, v, u * v));
        let (kept, left) = thinned(&places, &triangles);
        assert_eq!((kept.len(), left), (places.len(), triangles));
    }
}
