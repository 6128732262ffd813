//! Tetrahedra of a fitted lattice, cut off at the surface.

use std::collections::HashMap;

use super::fit::{Fit, Side};
use super::jacobian::six_volumes;
use super::lattice::Lattice;
use super::simplices::Simplices;

/// A corner of a tetrahedron, twice, or the cut between two: the first inside, the second outside.
type Place = [usize; 2];

/// Inside parts of all tetrahedra with a corner inside, as cells of positive volume.
pub(super) fn cells(lattice: &Lattice, fit: &Fit) -> Simplices<4, 3> {
    let (mut points, mut cells) = (Vec::new(), Vec::new());
    let mut known: HashMap<[usize; 2], usize> = HashMap::new();
    for corners in lattice.tetrahedra() {
        for places in stencil(corners.map(|corner| fit.sides[corner]), corners.map(|k| lattice.is_even(k))) {
            let mut cell = places.map(|place| {
                let [a, b] = place.map(|k| corners[k]);
                *known.entry([a, b]).or_insert_with(|| {
                    points.push(fit.place(a, b));
                    points.len() - 1
                })
            });
            if six_volumes(cell.map(|corner| points[corner])) < 0.0 {
                cell.swap(2, 3);
            }
            cells.push(cell);
        }
    }
    Simplices { points, cells }
}

/// Cells within a tetrahedron, from the sides of its corners, after `[@labelle2007]`: neighbours at a four-sided face that cuts leave agree
/// about its diagonal.
fn stencil(sides: [Side; 4], even: [bool; 4]) -> Vec<[Place; 4]> {
    let of = |side: Side| (0..4).filter(move |k| sides[*k] == side);
    let at = |k: usize| [k, k];
    let mut inside = [0; 4];
    let count = of(Side::Inside).zip(&mut inside).map(|(k, place)| *place = k).count();
    let mut outside = of(Side::Outside);
    let (Some(m), next) = (outside.next(), outside.next()) else {
        return if count > 0 { vec![[0, 1, 2, 3].map(at)] } else { Vec::new() };
    };
    let [p, q, ..] = inside;
    match (count, next) {
        (0, _) => Vec::new(),
        (1, _) => vec![[0, 1, 2, 3].map(|k| if sides[k] == Side::Outside { [p, k] } else { at(k) })],
        (2, None) => {
            let [p, q] = diagonal([p, q], m, even);
            let on = 6 - p - q - m;
            vec![[at(p), at(q), [q, m], at(on)], [at(p), [q, m], [p, m], at(on)]]
        }
        (2, Some(n)) if opposite(p) == q => {
            let [p, q] = diagonal([p, q], m, even);
            vec![
                [at(p), at(q), [q, m], [q, n]],
                [at(p), [p, m], [q, m], [q, n]],
                [at(p), [p, m], [q, n], [p, n]],
            ]
        }
        (2, Some(_)) => {
            let [m, n] = [opposite(p), opposite(q)];
            vec![
                [at(p), at(q), [p, m], [q, n]],
                [at(q), [p, m], [q, m], [q, n]],
                [at(p), [p, m], [p, n], [q, n]],
            ]
        }
        _ => {
            let tip = opposite(m);
            let first = if m < 2 { 2 } else { 0 };
            let [p, q] = diagonal([first, first + 1], m, even);
            vec![
                [at(p), at(q), at(tip), [tip, m]],
                [at(p), at(q), [q, m], [tip, m]],
                [at(p), [q, m], [p, m], [tip, m]],
            ]
        }
    }
}

/// Order of two corners inside, next to one outside: first the one from which a diagonal leaves for the cut of the other. That is the
/// corner of the long edge if one of the two edges cut there is long, else the order follows from the place in the lattice.
fn diagonal([p, q]: [usize; 2], outside: usize, even: [bool; 4]) -> [usize; 2] {
    let first = if opposite(outside) == p {
        q
    } else if opposite(outside) == q || even[p] {
        p
    } else {
        q
    };
    if first == p { [p, q] } else { [q, p] }
}

/// Other end of the long edge of a corner.
fn opposite(corner: usize) -> usize {
    corner ^ 1
}

#[cfg(test)]
mod tests {
    use super::super::quadratic::Quadratic;
    use super::super::testing::{angles_deg, wall};
    use super::*;
    use crate::surface::testing::cube;
    use crate::surface::{ClosedSurface, Proximity};
    use quasirigid_math::vec3::{add, cross, dot, scale};

    /// A tetrahedron from the digits of a number, in a box of side 6, none if it is flat.
    fn tetrahedron(number: u64) -> Option<ClosedSurface> {
        let mut state = number;
        let mut digit = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            1.0 + 6.0 * (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let corners: [[f64; 3]; 4] = std::array::from_fn(|_| [0; 3].map(|_| digit()));
        let [u, v, w] = [1, 2, 3].map(|k| add(corners[k], scale(-1.0, corners[0])));
        let [a, b] = if dot(u, cross(v, w)) > 0.0 { [2, 3] } else { [3, 2] };
        ClosedSurface::new(corners.to_vec(), vec![[0, b, a], [0, 1, b], [0, a, 1], [1, a, b]]).ok()
    }

    /// Smallest and largest angle of the cells, in degrees, after asking that they fit and that corners on the wall are
    /// on the surface.
    fn angles_of_filling(surface: &ClosedSurface) -> [f64; 2] {
        let (lattice, surface) = (Lattice::new([8; 3]), Proximity::new(surface, |at| at));
        let Simplices { points, cells } = cells(&lattice, &Fit::new(&lattice, &surface));
        let quadratic = Quadratic::new(&cells, points.len());
        let middles = quadratic.edges.iter().map(|[a, b]| scale(0.5, add(points[*a], points[*b])));
        let places: Vec<[f64; 3]> = points.iter().copied().chain(middles).collect();
        let mesh = quadratic.mesh(places);
        for node in wall(&mesh).iter().flat_map(|face| &face[..3]) {
            assert!(surface.nearest(mesh.nodes[*node]).distance.abs() < 1e-12);
        }
        angles_deg(&mesh)
    }

    /// Shapes with sharp edges, thinner than a cell in places. The bounds are those that the authors prove.
    #[test]
    fn cells_fit_and_have_bounded_angles_whatever_the_surface() {
        for surface in (0..100).filter_map(tetrahedron) {
            let [least, most] = angles_of_filling(&surface);
            assert!(least > 10.78 && most < 164.75, "{least} {most}");
        }
    }

    /// Only there are both cuts next to a long edge too far from its ends to draw them.
    #[test]
    fn cells_fit_between_walls_halfway_between_long_edges() {
        for (low, high) in [(1.25, 3.25), (1.75, 4.75), (2.25, 3.75), (1.75, 5.25)] {
            for axis in 0..3 {
                let place = |mut at: [f64; 3]| {
                    at = at.map(|x| 1.4 + 3.3 * x);
                    at[axis] = if at[axis] < 2.0 { low } else { high };
                    at
                };
                let [least, most] = angles_of_filling(&cube(place));
                assert!(least > 10.78 && most < 164.75, "{least} {most}");
            }
        }
    }

    #[test]
    fn stencils_fill_what_is_inside() {
        // Cuts in the middles of the edges of a tetrahedron of volume 1: it is cut into four corners of volume 1/8 and
        // a rest of 1/2 that a plane through four cuts halves.
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]];
        let place = |[a, b]: Place| scale(0.5, add(corners[a], corners[b]));
        for code in 0..81_usize {
            let sides = [1, 3, 9, 27].map(|power| [Side::Inside, Side::On, Side::Outside][code / power % 3]);
            let count = |side: Side| sides.iter().filter(|other| **other == side).count();
            let exact = match [Side::Inside, Side::On, Side::Outside].map(count) {
                [0, _, _] => 0.0,
                [_, _, 0] => 1.0,
                [1, _, outside] => 0.5_f64.powi(outside as i32),
                [2, 1, 1] => 0.75,
                [2, 0, 2] => 0.5,
                _ => 0.875,
            };
            for even in [[true, false, true, false], [false, true, false, true], [true, false, false, true]] {
                let cells = stencil(sides, even);
                let volume: f64 = cells.iter().map(|cell| six_volumes(cell.map(place)).abs() / 6.0).sum();
                assert!((volume - exact).abs() < 1e-15, "{sides:?}: {volume} {exact}");
            }
        }
    }
}
