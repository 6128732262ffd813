//! Size, orientation and stretch of cells.

use super::{Mesh, Rule, Shape};
use quasirigid_math::vec3::{add, cross, dot, norm, scale};

impl Mesh {
    /// Volume of the solids among some cells, by their indices; faces and lines have none.
    #[must_use]
    pub fn volume(&self, cells: &[usize]) -> f64 {
        let cells = cells.iter().map(|cell| &self.cells[*cell]);
        let solids = cells.filter(|cell| cell.shape.dimension() == 3);
        solids
            .map(|cell| {
                cell.shape.volume(&cell.nodes.iter().map(|node| self.nodes[*node]).collect::<Vec<_>>())
            })
            .sum()
    }
}

impl Shape {
    /// Volume of a solid cell, negative if it is inside out, from the places of its nodes.
    #[must_use]
    pub fn volume(self, nodes: &[[f64; 3]]) -> f64 {
        let part = |sample: &super::CellSample| {
            let [a, b, c] = tangents(nodes, &sample.gradients);
            sample.weight * dot(a, cross(b, c))
        };
        self.samples(Rule::Products).iter().map(part).sum()
    }
}

/// Derivatives of the place along the axes of the reference cell: `∂x/∂ξ_k = Σ x_a ∂N_a/∂ξ_k`, the columns of the
/// Jacobian.
pub(super) fn tangents(nodes: &[[f64; 3]], gradients: &[[f64; 3]]) -> [[f64; 3]; 3] {
    let mut tangents = [[0.0; 3]; 3];
    for (node, gradient) in nodes.iter().zip(gradients) {
        for axis in 0..3 {
            tangents[axis] = add(tangents[axis], scale(gradient[axis], *node));
        }
    }
    tangents
}

/// Thickness of a cell at a place relative to its length there, from its tangents: of the parallelepiped between them the least height over
/// the longest side, negative if the cell is inside out. Of a face the like in its plane, seen along a `normal`; of a line the cosine of
/// its angle to that direction.
pub(super) fn thickness(dimension: usize, tangents: [[f64; 3]; 3], normal: [f64; 3]) -> f64 {
    let longest = tangents[..dimension].iter().fold(0.0, |longest: f64, tangent| longest.max(norm(*tangent)));
    let [a, b, c] = tangents.map(|tangent| scale(1.0 / longest, tangent));
    let thickness = match dimension {
        1 => dot(a, normal) / norm(normal),
        2 => dot(cross(a, b), normal) / norm(normal),
        _ => dot(a, cross(b, c)) / norm(cross(a, b)).max(norm(cross(b, c))).max(norm(cross(c, a))),
    };
    // Without any length or area there is no thickness either.
    if thickness.is_finite() { thickness } else { 0.0 }
}

/// Normal of a face or direction of a line at a place.
pub(super) fn normal(dimension: usize, [a, b, _]: [[f64; 3]; 3]) -> [f64; 3] {
    if dimension == 1 { a } else { cross(a, b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A rotated, stretched and shifted place: volumes grow by the determinant 1.7·0.6·2.3 of the stretch.
    fn moved([x, y, z]: [f64; 3]) -> [f64; 3] {
        let [x, y, z] = [1.7 * x, 0.6 * y, 2.3 * z];
        let (sin, cos) = 0.7_f64.sin_cos();
        let [x, y] = [cos * x - sin * y, sin * x + cos * y];
        [3.0 + x, cos * y - sin * z - 5.0, sin * y + cos * z + 11.0]
    }

    #[test]
    fn volumes_follow_the_stretch_of_the_reference_cell() {
        for (shape, reference) in [
            (Shape::Tet4, 1.0 / 6.0),
            (Shape::Tet10, 1.0 / 6.0),
            (Shape::Wedge6, 1.0),
            (Shape::Wedge15, 1.0),
            (Shape::Hex8, 8.0),
            (Shape::Hex20, 8.0),
            (Shape::Hex27, 8.0),
        ] {
            let nodes: Vec<[f64; 3]> = shape.reference().into_iter().map(moved).collect();
            let exact = reference * 1.7 * 0.6 * 2.3;
            assert!((shape.volume(&nodes) / exact - 1.0).abs() < 1e-13, "{shape}");
        }
    }

    #[test]
    fn a_truncated_pyramid_has_its_volume() {
        // Height 3 between squares of sides 2 and 1: 3 (4 + 2 + 1) / 3.
        let top = |[x, y, z]: [f64; 3]| if z > 0.0 { [0.5 * x + 0.2, 0.5 * y, 3.0] } else { [x, y, 0.0] };
        let nodes: Vec<[f64; 3]> = Shape::Hex8.reference().into_iter().map(top).collect();
        assert!((Shape::Hex8.volume(&nodes) - 7.0).abs() < 1e-14);
    }
}
