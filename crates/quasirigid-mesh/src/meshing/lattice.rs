//! Body-centred cubic lattice and its tetrahedra.

/// Body-centred cubic lattice: corners and middles of cubes of side 1 between the origin and `cubes`. Coordinates are
/// doubled: corners have even ones, middles odd ones.
pub(super) struct Lattice {
    cubes: [usize; 3],
}

/// Length of the edges between neighbouring corners, or neighbouring middles.
pub(super) const LONG_EDGE: f64 = 1.0;
/// Length of the edges between a middle and the corners of its cube, √¾.
pub(super) const SHORT_EDGE: f64 = 0.866_025_403_784_438_6;

impl Lattice {
    pub fn new(cubes: [usize; 3]) -> Self {
        Self { cubes }
    }

    /// Upper bound of the indices of points.
    pub fn size(&self) -> usize {
        2 * self.cubes.iter().map(|cubes| cubes + 1).product::<usize>()
    }

    pub fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        let [across, deep] = [self.cubes[0] + 1, self.cubes[1] + 1];
        2 * ((z / 2 * deep + y / 2) * across + x / 2) + x % 2
    }

    /// Doubled coordinates of a point; None for indices that no point has.
    pub fn point(&self, index: usize) -> Option<[usize; 3]> {
        let [across, deep] = [self.cubes[0] + 1, self.cubes[1] + 1];
        let (cube, odd) = (index / 2, index % 2);
        let point = [cube % across, cube / across % deep, cube / across / deep].map(|x| 2 * x + odd);
        self.has(point).then_some(point)
    }

    pub fn place(point: [usize; 3]) -> [f64; 3] {
        point.map(|x| 0.5 * x as f64)
    }

    /// Whether the number of cubes to a point from the origin, along the axes, is even. Ends of a long edge differ in it.
    pub fn is_even(&self, index: usize) -> bool {
        self.point(index).is_some_and(|point| point.iter().map(|x| x / 2).sum::<usize>().is_multiple_of(2))
    }

    /// Points at the other ends of the edges of a point, with the lengths of the edges.
    pub fn neighbours(&self, point: [usize; 3]) -> impl Iterator<Item = (usize, f64)> {
        let step = move |k: usize| {
            let ahead = k.is_multiple_of(2);
            let moved = |axis: usize| if ahead { point[axis] + 2 } else { point[axis].wrapping_sub(2) };
            (std::array::from_fn(|axis| if axis == k / 2 { moved(axis) } else { point[axis] }), LONG_EDGE)
        };
        let slant = move |k: usize| {
            let ahead = |axis: usize| k >> axis & 1 == 0;
            let moved = |axis| if ahead(axis) { point[axis] + 1 } else { point[axis].wrapping_sub(1) };
            (std::array::from_fn(moved), SHORT_EDGE)
        };
        let all = (0..6).map(step).chain((0..8).map(slant));
        all.filter(|(point, _)| self.has(*point)).map(|(point, length)| (self.index(point), length))
    }

    /// All tetrahedra, all of one shape: two middles of cubes that share a face, then two corners of that face. Both
    /// pairs are the ends of long edges, the other four edges are short.
    pub fn tetrahedra(&self) -> impl Iterator<Item = [usize; 4]> {
        let middles = (0..self.size()).step_by(2).filter_map(|index| self.point(index + 1));
        middles.flat_map(move |middle| (0..3).flat_map(move |axis| self.around(middle, axis)))
    }

    /// The four tetrahedra between the middle of a cube and that of the next along an axis.
    fn around(&self, middle: [usize; 3], axis: usize) -> impl Iterator<Item = [usize; 4]> {
        let moved = |steps: [usize; 3]| -> [usize; 3] {
            // Steps are from −1, along the axis and the two that follow it.
            std::array::from_fn(|k| middle[k] + steps[(k + 3 - axis) % 3] - 1)
        };
        let next = moved([3, 1, 1]);
        let face = [[0, 0], [2, 0], [2, 2], [0, 2]].map(|[u, v]| self.index(moved([2, u, v])));
        let pair = [self.index(middle), self.index(next)];
        let count = if self.has(next) { 4 } else { 0 };
        (0..count).map(move |k| [pair[0], pair[1], face[k], face[(k + 1) % 4]])
    }

    fn has(&self, point: [usize; 3]) -> bool {
        (0..3).all(|axis| point[axis] <= 2 * self.cubes[axis])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasirigid_math::vec3::{add, norm, scale};

    const LATTICE: Lattice = Lattice { cubes: [3, 4, 2] };

    fn length(a: usize, b: usize) -> f64 {
        let [a, b] = [a, b].map(|index| Lattice::place(LATTICE.point(index).unwrap()));
        norm(add(a, scale(-1.0, b)))
    }

    #[test]
    fn points_and_indices_correspond() {
        let points: Vec<_> = (0..LATTICE.size()).filter_map(|index| LATTICE.point(index)).collect();
        assert_eq!(points.len(), 4 * 5 * 3 + 3 * 4 * 2);
        for point in points {
            assert_eq!(LATTICE.point(LATTICE.index(point)), Some(point));
            assert!(point.iter().all(|x| x % 2 == point[0] % 2));
        }
    }

    #[test]
    fn edges_have_their_lengths_and_long_ones_ends_of_both_kinds() {
        for index in 0..LATTICE.size() {
            let Some(point) = LATTICE.point(index) else { continue };
            let neighbours: Vec<_> = LATTICE.neighbours(point).collect();
            let inner = (0..3).all(|axis| (2..=2 * LATTICE.cubes[axis] - 2).contains(&point[axis]));
            assert!(neighbours.len() == 14 || !inner);
            for (other, expected) in neighbours {
                assert!((length(index, other) - expected).abs() < 1e-15);
                assert!(expected == SHORT_EDGE || LATTICE.is_even(index) != LATTICE.is_even(other));
            }
        }
    }

    #[test]
    fn tetrahedra_have_two_long_edges_and_four_short_ones() {
        let cells: Vec<_> = LATTICE.tetrahedra().collect();
        assert_eq!(cells.len(), 4 * (2 * 4 * 2 + 3 * 3 * 2 + 3 * 4));
        for [a, b, c, d] in cells {
            assert_eq!([length(a, b), length(c, d)], [LONG_EDGE; 2]);
            for [p, q] in [[a, c], [a, d], [b, c], [b, d]] {
                assert!((length(p, q) - SHORT_EDGE).abs() < 1e-15);
            }
        }
    }
}
