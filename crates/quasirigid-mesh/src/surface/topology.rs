//! Connectivity of triangles, whatever their shape.

use super::SurfaceError;

/// Edge with the direction in which one of its triangles passes it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Side {
    /// Ends of the edge, the lower one first.
    pub edge: [usize; 2],
    pub triangle: usize,
    /// Whether the triangle passes the edge from the lower to the higher end.
    pub ascending: bool,
}

impl Side {
    /// Ends of the edge in the direction of the triangle.
    fn directed(&self) -> [usize; 2] {
        let [low, high] = self.edge;
        if self.ascending { [low, high] } else { [high, low] }
    }
}

/// The three edges of a triangle, in its direction.
pub(super) fn edges([a, b, c]: [usize; 3]) -> [[usize; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// Sides of all triangles, those of an edge one after the other.
pub(super) fn sides(triangles: &[[usize; 3]]) -> Vec<Side> {
    let mut sides = Vec::with_capacity(3 * triangles.len());
    for (triangle, corners) in triangles.iter().enumerate() {
        for [from, to] in edges(*corners) {
            sides.push(Side { edge: [from.min(to), from.max(to)], triangle, ascending: from < to });
        }
    }
    sides.sort_unstable();
    sides
}

/// Pairs of triangles that share an edge, in the order of their edges, if every edge has two triangles that pass it in
/// opposite directions.
pub(super) fn neighbours(triangles: &[[usize; 3]]) -> Result<Vec<[usize; 2]>, SurfaceError> {
    let sides = sides(triangles);
    let mut pairs = Vec::with_capacity(sides.len() / 2);
    let (mut open, mut crowded, mut same) = (Vec::new(), Vec::new(), Vec::new());
    for group in sides.chunk_by(|a, b| a.edge == b.edge) {
        match group {
            [_] => open.push(group),
            [a, b] if a.ascending == b.ascending => same.push(group),
            [a, b] => pairs.push([a.triangle, b.triangle]),
            _ => crowded.push(group),
        }
    }
    if let Some(group) = first(&open) {
        let Side { triangle, .. } = group[0];
        return Err(SurfaceError::Open { edge: group[0].directed(), triangle, count: open.len() });
    }
    if let Some(group) = first(&crowded) {
        let triangles = group.iter().map(|side| side.triangle).collect();
        return Err(SurfaceError::NonManifold { edge: group[0].edge, triangles, count: crowded.len() });
    }
    if let Some(group) = first(&same) {
        let triangles = [group[0].triangle, group[1].triangle];
        return Err(SurfaceError::TwiceOriented { edge: group[0].directed(), triangles, count: same.len() });
    }
    Ok(pairs)
}

/// The edge whose first triangle comes first.
fn first<'a>(groups: &[&'a [Side]]) -> Option<&'a [Side]> {
    groups.iter().copied().min_by_key(|group| group[0].triangle)
}
