//! Corners of triangles in coordinates near one, so that no unit of length is too small or too large.

use quasirigid_math::vec3::{cross, dot, minus, norm};

/// Corners of a triangle.
pub(super) type Corners = [[f64; 3]; 3];

/// Share of the largest coordinate below which heights are rounding of the coordinates.
const FLAT: f64 = 16.0 * f64::EPSILON;

/// `a · (b × c)`, six times the volume of the tetrahedron on these edges.
#[inline(always)]
pub(super) fn triple(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
    dot(a, cross(b, c))
}

/// Smallest box around points: its lowest and its highest corner.
pub(super) fn bounds(points: impl Iterator<Item = [f64; 3]>) -> [[f64; 3]; 2] {
    points.fold([[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]], |[low, high], point| {
        [
            std::array::from_fn(|axis| low[axis].min(point[axis])),
            std::array::from_fn(|axis| high[axis].max(point[axis])),
        ]
    })
}

/// Corners of all triangles, times the power of two that takes the largest coordinate to between one and two. Exact.
pub(super) fn normalised(vertices: &[[f64; 3]], triangles: &[[usize; 3]]) -> Vec<Corners> {
    let size = |vertex: usize| vertices[vertex].iter().fold(0.0, |size: f64, x| size.max(x.abs()));
    let largest = triangles.iter().flatten().map(|vertex| size(*vertex)).fold(0.0, f64::max);
    let exponent = if largest > 0.0 { libm::ilogb(largest).clamp(-1000, 1000) } else { 0 };
    let unit = 2f64.powi(-exponent);
    let corner = |vertex: usize| vertices[vertex].map(|x| x * unit);
    triangles.iter().map(|corners| corners.map(corner)).collect()
}

/// Whether the corners of a triangle, with coordinates near one, lie on a line to within rounding.
pub(super) fn is_flat([a, b, c]: &Corners) -> bool {
    let edges = [minus(*b, *a), minus(*c, *b), minus(*a, *c)];
    let longest = edges.map(norm).into_iter().fold(0.0, f64::max);
    !(norm(cross(edges[0], edges[1])) > FLAT * longest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn height_is_judged_beside_rounding_of_the_coordinates() {
        let triangle = |height: f64| [[0.5, 1.0, 0.0], [1.5, 1.0, 0.0], [1.0, 1.0, height]];
        assert!(is_flat(&triangle(15.0 * f64::EPSILON)) && !is_flat(&triangle(17.0 * f64::EPSILON)));
        assert!(is_flat(&[[1.0; 3]; 3]) && is_flat(&[[1.0, 1.0, 1.0], [1.2, 1.2, 1.2], [1.5, 1.5, 1.5]]));
    }

    #[test]
    fn any_unit_becomes_one() {
        let vertices = [[3.0, 0.0, 0.0], [0.0, -5.0, 0.0], [0.0, 0.0, 1.0], [900.0, 0.0, 0.0]];
        let triangles = [[0, 1, 2]];
        for exponent in [-1020, -30, 0, 30, 1020] {
            let scaled = vertices.map(|vertex| vertex.map(|x| x * 2f64.powi(exponent)));
            let [a, b, c] = normalised(&scaled, &triangles)[0];
            let shrunk = 2f64.powi((exponent + 2).clamp(-1000, 1000) - exponent);
            assert_eq!([a[0], b[1], c[2]], [3.0, -5.0, 1.0].map(|x| x / shrunk), "{exponent}");
        }
        assert_eq!(normalised(&[[0.0; 3]], &[[0, 0, 0]]), [[[0.0; 3]; 3]]);
    }
}
