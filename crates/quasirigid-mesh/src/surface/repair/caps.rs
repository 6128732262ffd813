//! Holes closed by caps: the rim of each, cut into triangles in its mean plane. Only small holes, as a cap is a guess at what is missing.

use std::collections::HashMap;
use std::fmt;

use super::super::topology::sides;
use super::Draft;
use quasirigid_math::vec3::{add, cross, dot, minus, norm, scale, unit};

/// Largest share of the surface that caps may have together.
pub const LARGEST_SHARE: f64 = 0.01;
/// Most edges of a rim.
const MOST_EDGES: usize = 2_000;
/// Area of an ear, relative to the square of its longest side, below which it is left to the end.
const FLAT: f64 = 1e-9;

/// Cause for which holes were not closed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Unclosed {
    /// Caps would have this share of the surface.
    Large {
        /// Their area over that of the surface with them.
        share: f64,
    },
    /// A rim touches itself, is too long, or crosses itself as seen along its mean normal.
    Tangled,
}

impl fmt::Display for Unclosed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let limit = 100.0 * LARGEST_SHARE;
        match self {
            Self::Large { share } => {
                write!(
                    f,
                    "caps would be {:.2} % of the surface, and at most {limit} % is closed",
                    100.0 * share
                )
            }
            Self::Tangled => f.write_str("a rim is no simple polygon, which no cap fits"),
        }
    }
}

impl Draft {
    /// Closes all holes, or none of them.
    pub(super) fn close(&mut self) -> Result<(), Unclosed> {
        let rims = self.rims()?;
        if rims.is_empty() {
            return Ok(());
        }
        let mut caps = Vec::new();
        for rim in &rims {
            caps.extend(self.cap(rim).ok_or(Unclosed::Tangled)?);
        }
        let area =
            |triangles: &[[usize; 3]]| triangles.iter().map(|corners| self.area(*corners)).sum::<f64>();
        let (closed, before) = (area(&caps), area(&self.triangles));
        let share = closed / (closed + before);
        if !(share <= LARGEST_SHARE) {
            return Err(Unclosed::Large { share });
        }
        let side = |[from, to]: [usize; 2]| norm(minus(self.vertices[to], self.vertices[from]));
        let around = |rim: &Vec<usize>| -> f64 {
            (0..rim.len()).map(|at| side([rim[at], rim[(at + 1) % rim.len()]])).sum()
        };
        self.repairs.rims = rims.iter().map(around).sum();
        self.repairs.holes = rims.len();
        self.repairs.caps = closed;
        self.repairs.share = share;
        self.triangles.extend(caps);
        Ok(())
    }

    fn area(&self, corners: [usize; 3]) -> f64 {
        let [a, b, c] = corners.map(|corner| self.vertices[corner]);
        0.5 * norm(cross(minus(b, a), minus(c, a)))
    }

    /// Corners of each rim, in the direction of the cap.
    fn rims(&self) -> Result<Vec<Vec<usize>>, Unclosed> {
        let sides = sides(&self.triangles);
        let open = sides.chunk_by(|a, b| a.edge == b.edge).filter(|group| group.len() == 1);
        let mut next: HashMap<usize, usize> = HashMap::new();
        let mut starts = Vec::new();
        for side in open.map(|group| group[0]) {
            let [low, high] = side.edge;
            let [from, to] = if side.ascending { [high, low] } else { [low, high] };
            if next.insert(from, to).is_some() {
                return Err(Unclosed::Tangled);
            }
            starts.push(from);
        }
        let mut rims = Vec::new();
        for start in starts {
            let (mut rim, mut at) = (Vec::new(), start);
            while let Some(to) = next.remove(&at) {
                rim.push(at);
                at = to;
            }
            if rim.is_empty() {
                continue;
            }
            if at != start || rim.len() > MOST_EDGES {
                return Err(Unclosed::Tangled);
            }
            rims.push(rim);
        }
        Ok(rims)
    }

    /// Triangles of a rim by ears, the roundest first; none of one that is no simple polygon in its mean plane.
    fn cap(&self, rim: &[usize]) -> Option<Vec<[usize; 3]>> {
        let places: Vec<[f64; 3]> = rim.iter().map(|corner| self.vertices[*corner]).collect();
        let first = places[0];
        let fans = places.windows(2).map(|pair| cross(minus(pair[0], first), minus(pair[1], first)));
        let normal = fans.fold([0.0; 3], add);
        if !(norm(normal) > 0.0) {
            return None;
        }
        let normal = unit(normal);
        let longest = (0..places.len()).map(|at| minus(places[(at + 1) % places.len()], places[at]));
        let longest = longest.max_by(|a, b| norm(*a).total_cmp(&norm(*b)))?;
        let x = unit(add(longest, scale(-dot(longest, normal), normal)));
        let y = cross(normal, x);
        let flat: Vec<[f64; 2]> =
            places.iter().map(|place| [x, y].map(|axis| dot(axis, minus(*place, first)))).collect();
        let mut left: Vec<usize> = (0..rim.len()).collect();
        let mut cap = Vec::with_capacity(rim.len().saturating_sub(2));
        while left.len() > 3 {
            let ear = (0..left.len())
                .filter_map(|at| Some((at, ear(&flat, &left, at)?)))
                .max_by(|a, b| a.1.total_cmp(&b.1))?;
            let [before, at, after] = around(&left, ear.0);
            cap.push([rim[before], rim[at], rim[after]]);
            left.remove(ear.0);
        }
        cap.push([rim[left[0]], rim[left[1]], rim[left[2]]]);
        Some(cap)
    }
}

/// Corners before, at and after a place of a polygon.
fn around(left: &[usize], at: usize) -> [usize; 3] {
    let count = left.len();
    [left[(at + count - 1) % count], left[at], left[(at + 1) % count]]
}

/// Twice the area of a triangle in the plane.
fn twice([a, b, c]: [[f64; 2]; 3]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Roundness of the ear at a place, twice its area over the square of its longest side; none where it is no ear.
fn ear(flat: &[[f64; 2]], left: &[usize], at: usize) -> Option<f64> {
    let corners = around(left, at);
    let [a, b, c] = corners.map(|corner| flat[corner]);
    let long = [[a, b], [b, c], [c, a]].map(|[p, q]| (p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2));
    let longest = long.into_iter().fold(0.0, f64::max);
    let round = twice([a, b, c]) / longest;
    if !(round > -FLAT) {
        return None;
    }
    let inside = |other: &usize| {
        let p = flat[*other];
        !corners.contains(other)
            && [[a, b], [b, c], [c, a]].iter().all(|[from, to]| twice([*from, *to, p]) >= 0.0)
    };
    // a flat ear has nothing inside; it waits for the end
    if round > FLAT && left.iter().any(inside) { None } else { Some(round) }
}

#[cfg(test)]
mod tests {
    use super::super::{Repairs, Unrepaired, closing, repaired};
    use super::*;
    use crate::surface::ClosedSurface;
    use crate::surface::testing::{ball_triangles, block, turned};

    /// Removes triangles whose corners are all on one side of a plane along x.
    fn opened(surface: &ClosedSurface, from: f64) -> (Vec<[f64; 3]>, Vec<[usize; 3]>) {
        let vertices = surface.vertices().to_vec();
        let far = |corners: &&[usize; 3]| !corners.iter().all(|corner| vertices[*corner][0] > from);
        let triangles = surface.triangles().iter().filter(far).copied().collect();
        (vertices, triangles)
    }

    fn ball(unit: f64) -> ClosedSurface {
        let (vertices, triangles) = ball_triangles(24);
        let place = |[x, y, z]: [f64; 3]| [unit * (2.0 * x + 5.0), unit * (y - 3.0), unit * (z + 1.0)];
        ClosedSurface::new(vertices.into_iter().map(place).collect(), triangles).unwrap()
    }

    /// A ball of 1152 facets without those at one end: volume and inertia of the closed original within a few times what the cap cuts off,
    /// about `π h² R` at the height `h`.
    #[test]
    fn a_small_hole_is_closed_within_the_cut() {
        for unit in [1e-4, 1.0, 1e4] {
            let whole = ball(unit);
            let (vertices, triangles) = opened(&whole, unit * 6.93);
            let removed = whole.triangles().len() - triangles.len();
            assert!(removed > 5, "{removed}");
            assert!(repaired(vertices.clone(), triangles.clone()).is_err());
            let (closed, repairs) = closing(vertices, triangles).unwrap();
            assert_eq!(repairs.holes, 1);
            assert!(repairs.share > 1e-4 && repairs.share < LARGEST_SHARE, "{repairs}");
            let off = closed.volume() / whole.volume() - 1.0;
            assert!(off < 0.0 && off > -2e-3, "{off}");
            let [a, b] = [&closed, &whole].map(|surface| surface.moments(2, whole.centroid(), [unit; 3]));
            for exponents in [[2, 0, 0], [0, 2, 0], [0, 0, 2], [1, 1, 0]] {
                let off = (a.of(exponents) - b.of(exponents)) / b.of([2, 0, 0]);
                assert!(off.abs() < 5e-3, "{exponents:?}: {off}");
            }
        }
    }

    /// A hole in a flat side has its very plane back; words say its size.
    #[test]
    fn a_flat_hole_is_closed_exactly() {
        let whole = block(turned(1.0));
        let triangles = whole.triangles();
        let areas: Vec<f64> = triangles
            .iter()
            .map(|corners| {
                let [a, b, c] = corners.map(|corner| whole.vertices()[corner]);
                0.5 * norm(cross(minus(b, a), minus(c, a)))
            })
            .collect();
        let all: f64 = areas.iter().sum();
        for (index, area) in areas.iter().enumerate() {
            let left: Vec<[usize; 3]> =
                (0..triangles.len()).filter(|other| *other != index).map(|other| triangles[other]).collect();
            match closing(whole.vertices().to_vec(), left) {
                Ok((closed, Repairs { holes, share, .. })) => {
                    assert!(holes == 1 && (share - area / all).abs() < 1e-12);
                    assert!((closed.volume() / whole.volume() - 1.0).abs() < 1e-13);
                }
                Err(Unrepaired { unclosed: Some(Unclosed::Large { share }), .. }) => {
                    assert!(share > LARGEST_SHARE && (share - area / all).abs() < 1e-12, "{share}");
                }
                Err(error) => panic!("{error}"),
            }
        }
    }

    /// An L in a flat side, whose corner points inward, is cut into ears that stay inside.
    #[test]
    fn a_bent_rim_is_cut_inside() {
        let (n, side) = (12, 1.0 / 12.0);
        let index = |i: usize, j: usize| j * (n + 1) + i;
        let mut vertices = Vec::new();
        (0..=n).for_each(|j| (0..=n).for_each(|i| vertices.push([side * i as f64, side * j as f64, 0.0])));
        let mut triangles = Vec::new();
        for (i, j) in (0..n).flat_map(|j| (0..n).map(move |i| (i, j))) {
            if ![(5, 5), (6, 5), (5, 6)].contains(&(i, j)) {
                let [a, b, c, d] = [index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)];
                triangles.extend([[a, c, b], [a, d, c]]);
            }
        }
        let top = vertices.len();
        vertices.push([0.3, 0.4, 0.9]);
        let sides = (0..n).flat_map(|k| {
            [[k, 0, k + 1, 0], [n, k, n, k + 1], [n - k, n, n - k - 1, n], [0, n - k, 0, n - k - 1]]
        });
        triangles.extend(sides.map(|[a, b, c, d]| [index(a, b), index(c, d), top]));
        let (closed, repairs) = closing(vertices, triangles).unwrap();
        // a pyramid on a unit square
        assert!((closed.volume() / 0.3 - 1.0).abs() < 1e-12, "{}", closed.volume());
        assert!((repairs.caps / (3.0 * side * side) - 1.0).abs() < 1e-12, "{repairs}");
        assert!((repairs.rims / (8.0 * side) - 1.0).abs() < 1e-12, "{repairs}");
    }

    #[test]
    fn a_large_hole_and_a_tangled_one_stay_open() {
        let whole = ball(1.0);
        let (vertices, triangles) = opened(&whole, 5.9);
        let error = closing(vertices, triangles).unwrap_err().to_string();
        assert!(error.contains("% of the surface, and at most 1 % is closed"), "{error}");
        // two facets that meet in a corner alone
        let corner = whole.triangles()[0][0];
        let at: Vec<usize> = (0..whole.triangles().len())
            .filter(|index| whole.triangles()[*index].contains(&corner))
            .collect();
        let left = (0..whole.triangles().len()).filter(|index| ![at[0], at[3]].contains(index));
        let left: Vec<[usize; 3]> = left.map(|index| whole.triangles()[index]).collect();
        let error = closing(whole.vertices().to_vec(), left).unwrap_err();
        assert!(matches!(error.unclosed, None | Some(Unclosed::Tangled)), "{error}");
    }
}
