//! Maps of flat shapes to round ones: the hexagon to a disc, the icosahedron to a ball.

use std::f64::consts::PI;

use super::fineness::Fineness;
use super::simplices::Simplices;

/// Image of a point of a regular polygon or polyhedron with corners at unit distance in the disc or ball around it:
///
/// ```text
/// x = p (1 − s + s ρ/|p|),     s = ρ²
/// ```
///
/// with ρ from 0 in the middle to 1 all over the wall, linear between. Smooth on the triangle or tetrahedron between
/// the middle and a face, with slopes and curvatures that are continuous in the middle.
pub(super) fn rounded<const D: usize>(flat: [f64; D], rho: f64) -> [f64; D] {
    let length = flat.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length == 0.0 {
        return flat;
    }
    let share = rho * rho;
    let stretch = (1.0 - share) + share * rho / length;
    flat.map(|x| stretch * x)
}

/// Triangles of a hexagon, `across` from the middle to the wall; points are x, y and ρ.
pub(super) fn hexagon(across: usize, fineness: Fineness) -> Simplices<3, 3> {
    let corner = |k: usize| {
        let (sin, cos) = (k as f64 * PI / 3.0).sin_cos();
        [cos, sin, 1.0]
    };
    let points = [[0.0; 3]].into_iter().chain((0..6).map(corner)).collect();
    let sector = |k: usize| [0, k + 1, (k + 1) % 6 + 1];
    let mut disc = Simplices { points, cells: (0..6).map(sector).collect() }.divided(across);
    graded(&mut disc.points, fineness);
    disc
}

/// Tetrahedra of an icosahedron, `across` from the middle to the wall; points are x, y, z and ρ.
pub(super) fn icosahedral_ball(across: usize, fineness: Fineness) -> Simplices<4, 4> {
    let hull = icosahedron_hull();
    let corner = |[x, y, z]: &[f64; 3]| [*x, *y, *z, 1.0];
    let points = [[0.0; 4]].into_iter().chain(hull.points.iter().map(corner)).collect();
    let sector = |[a, b, c]: &[usize; 3]| [0, a + 1, b + 1, c + 1];
    let mut ball = Simplices { points, cells: hull.cells.iter().map(sector).collect() }.divided(across);
    graded(&mut ball.points, fineness);
    ball
}

/// The twenty faces of an icosahedron with corners at unit distance, in either sense.
#[must_use]
pub fn icosahedron() -> Vec<[[f64; 3]; 3]> {
    let Simplices { points, cells } = icosahedron_hull();
    cells.into_iter().map(|cell| cell.map(|corner| points[corner])).collect()
}

/// The twenty triangles of an icosahedron with corners at unit distance.
pub(super) fn icosahedron_hull() -> Simplices<3, 3> {
    let golden = 0.5 * (1.0 + 5.0_f64.sqrt());
    let [short, long] = [1.0, golden].map(|x| x / (1.0 + golden * golden).sqrt());
    let corner = |k: usize| {
        let [a, b] = [k & 1, k >> 1 & 1].map(|bit| if bit == 0 { 1.0 } else { -1.0 });
        let mut point = [0.0, a * short, b * long];
        point.rotate_right(k / 4);
        point
    };
    let points: Vec<[f64; 3]> = (0..12).map(corner).collect();
    // Neighbours have the cosine 1/√5, others −1/√5 or −1.
    let near = |a: usize, b: usize| (0..3).map(|axis| points[a][axis] * points[b][axis]).sum::<f64>() > 0.0;
    let triples = (0..12).flat_map(|a| (a + 1..12).flat_map(move |b| (b + 1..12).map(move |c| [a, b, c])));
    let cells = triples.filter(|[a, b, c]| near(*a, *b) && near(*b, *c) && near(*c, *a)).collect();
    Simplices { points, cells }
}

/// Moves points, the last coordinate of which is ρ, towards the wall.
fn graded<const N: usize>(points: &mut [[f64; N]], fineness: Fineness) {
    for point in points {
        let rho = point[N - 1];
        if rho > 0.0 {
            let stretch = fineness.towards_wall(rho) / rho;
            *point = point.map(|x| stretch * x);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_icosahedron_has_twenty_equal_triangles() {
        let hull = icosahedron_hull();
        assert_eq!([hull.points.len(), hull.cells.len()], [12, 20]);
        let edge = (2.0 - 2.0 / 5.0_f64.sqrt()).sqrt();
        for [a, b, _] in hull.cells {
            let away = (0..3).map(|axis| (hull.points[a][axis] - hull.points[b][axis]).powi(2)).sum::<f64>();
            assert!((away.sqrt() / edge - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn layers_become_thinner_towards_the_wall() {
        let fineness = Fineness::new(8, 2.0).unwrap();
        let graded = [0.0, 0.4375, 0.75, 0.9375, 1.0];
        let on_layer = |rho: f64| graded.iter().any(|exact| (rho - exact).abs() < 1e-15);
        let (disc, ball) = (hexagon(4, fineness), icosahedral_ball(4, fineness));
        assert!(disc.points.iter().all(|[_, _, rho]| on_layer(*rho)));
        assert!(ball.points.iter().all(|[_, _, _, rho]| on_layer(*rho)));
        // Along the line from the middle to a corner of the hexagon the points are at the distance ρ.
        let along: Vec<f64> =
            disc.points.iter().filter(|[x, y, _]| *x > 0.0 && *y == 0.0).map(|[x, ..]| *x).collect();
        assert!(along.len() == 4 && along.iter().all(|x| on_layer(*x)), "{along:?}");
    }
}
