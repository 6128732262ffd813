//! Triangles and tetrahedra in coordinates of any number, divided into smaller ones.

use std::collections::HashMap;

/// Simplices of `K` corners between points of `N` coordinates: triangles, tetrahedra.
pub(super) struct Simplices<const K: usize, const N: usize> {
    pub points: Vec<[f64; N]>,
    pub cells: Vec<[usize; K]>,
}

/// A point between the corners of a simplex: the corners with a share in it, ascending, each with its share.
type Place<const K: usize> = [(usize, usize); K];

impl<const K: usize, const N: usize> Simplices<K, N> {
    /// Divides every edge into `parts` equal ones after Freudenthal `[@freudenthal1942]`. Faces that simplices share
    /// are divided alike; every part lies between two neighbouring planes parallel to each face.
    pub fn divided(&self, parts: usize) -> Self {
        let mut divided = Self { points: Vec::new(), cells: Vec::new() };
        let mut known: HashMap<Place<K>, usize> = HashMap::new();
        let walks = walks(parts);
        for simplex in &self.cells {
            let mut point = |shares: &[usize; K]| {
                let place = place(simplex, shares);
                *known.entry(place).or_insert_with(|| {
                    divided.points.push(self.point(&place, parts));
                    divided.points.len() - 1
                })
            };
            for walk in &walks {
                divided.cells.push(std::array::from_fn(|corner| point(&walk[corner])));
            }
        }
        divided
    }

    fn point(&self, place: &Place<K>, parts: usize) -> [f64; N] {
        std::array::from_fn(|axis| {
            let used = place.iter().filter(|(_, share)| *share > 0);
            used.map(|(corner, share)| *share as f64 * self.points[*corner][axis]).sum::<f64>() / parts as f64
        })
    }
}

impl<const N: usize> Simplices<3, N> {
    /// Columns and rows of squares, each halved; in a closed grid the last column meets the first.
    pub fn grid([columns, rows]: [usize; 2], closed: bool, point: impl Fn(usize, usize) -> [f64; N]) -> Self {
        let across = if closed { columns } else { columns + 1 };
        let index = |column: usize, row: usize| row * across + column % across;
        let halves = |column: usize, row: usize| {
            let [a, b] = [column, column + 1].map(|column| index(column, row));
            let [d, c] = [column, column + 1].map(|column| index(column, row + 1));
            [[a, b, c], [a, c, d]]
        };
        let all = |columns: usize, rows: usize| {
            (0..rows).flat_map(move |row| (0..columns).map(move |column| (column, row)))
        };
        Self {
            points: all(across, rows + 1).map(|(column, row)| point(column, row)).collect(),
            cells: all(columns, rows).flat_map(|(column, row)| halves(column, row)).collect(),
        }
    }
}

fn place<const K: usize>(simplex: &[usize; K], shares: &[usize; K]) -> Place<K> {
    let mut place = std::array::from_fn(|corner| match shares[corner] {
        0 => (usize::MAX, 0),
        share => (simplex[corner], share),
    });
    place.sort_unstable();
    place
}

/// Parts of a simplex, each by the shares, out of `parts`, that its corners have of those of the whole: from one corner to the next, a
/// share goes from one corner of the whole to the following one, each such step once.
fn walks<const K: usize>(parts: usize) -> Vec<[[usize; K]; K]> {
    let mut walks = Vec::new();
    let base = parts + 1;
    for code in 0..base.pow(K as u32 - 1) {
        let mut shares: [usize; K] =
            std::array::from_fn(|corner| code / base.pow(corner.saturating_sub(1) as u32) % base);
        let rest = shares[1..].iter().sum::<usize>();
        if rest < parts {
            shares[0] = parts - rest;
            follow([shares; K], 1, &mut walks);
        }
    }
    walks
}

/// Adds all walks that begin with the first `length` places of one.
fn follow<const K: usize>(walk: [[usize; K]; K], length: usize, walks: &mut Vec<[[usize; K]; K]>) {
    if length == K {
        walks.push(walk);
        return;
    }
    let here = walk[length - 1];
    // A step is behind if the shares beyond it are more than at the start.
    let beyond = |shares: &[usize; K], step: usize| shares[step..].iter().sum::<usize>();
    for step in 1..K {
        if here[step - 1] > 0 && beyond(&here, step) == beyond(&walk[0], step) {
            let mut next = walk;
            next[length] = here;
            next[length][step - 1] -= 1;
            next[length][step] += 1;
            follow(next, length + 1, walks);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasirigid_math::vec3::{add, cross, dot, scale};

    fn volume(points: &[[f64; 3]], [a, b, c, d]: [usize; 4]) -> f64 {
        let [u, v, w] = [b, c, d].map(|corner| add(points[corner], scale(-1.0, points[a])));
        dot(u, cross(v, w)) / 6.0
    }

    #[test]
    fn parts_of_tetrahedra_are_equal_and_share_faces() {
        let points =
            vec![[0.3, 0.1, 0.2], [2.0, 0.0, 0.1], [0.4, 1.5, 0.0], [0.2, 0.3, 1.9], [2.1, 1.8, 1.7]];
        let pair = Simplices { points, cells: vec![[0, 1, 2, 3], [4, 3, 1, 2]] };
        for parts in 1..5 {
            let divided = pair.divided(parts);
            for (whole, part) in pair.cells.iter().zip(divided.cells.chunks(parts.pow(3))) {
                let exact = volume(&pair.points, *whole).abs() / parts.pow(3) as f64;
                for cell in part {
                    assert!((volume(&divided.points, *cell).abs() / exact - 1.0).abs() < 1e-12);
                }
            }
            let count = |n: usize| (n + 1) * (n + 2) * (n + 3) / 6;
            let shared = (parts + 1) * (parts + 2) / 2;
            assert_eq!(divided.points.len(), 2 * count(parts) - shared);
            assert_eq!(divided.cells.len(), 2 * parts.pow(3));
        }
    }

    #[test]
    fn parts_lie_between_planes_parallel_to_the_faces() {
        let points = vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0; 3]];
        let divided = Simplices { points, cells: vec![[0, 1, 2, 3]] }.divided(5);
        for cell in divided.cells {
            let shares = |point: usize| {
                let [x, y, z] = divided.points[point];
                [x, y, z, 1.0 - x - y - z].map(|share| 5.0 * share)
            };
            for corner in 0..4 {
                let heights = cell.map(|point| shares(point)[corner]);
                let low = heights.into_iter().fold(5.0, f64::min).round();
                assert!(heights.iter().all(|x| (x - low).abs() < 1e-12 || (x - low - 1.0).abs() < 1e-12));
            }
        }
    }

    #[test]
    fn a_closed_grid_has_as_many_points_around_as_columns() {
        let open = Simplices::grid([4, 3], false, |i, j| [i as f64, j as f64]);
        let closed = Simplices::grid([4, 3], true, |i, j| [i as f64, j as f64]);
        assert_eq!([open.points.len(), closed.points.len()], [20, 16]);
        assert_eq!([open.cells.len(), closed.cells.len()], [24, 24]);
        assert_eq!(closed.cells[6], [3, 0, 4]);
        assert_eq!(open.points[7], [2.0, 1.0]);
    }
}
