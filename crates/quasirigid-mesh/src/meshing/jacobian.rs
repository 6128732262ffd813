//! Validity of a curved tetrahedron.

use std::sync::OnceLock;

use crate::{Rule, Shape};
use quasirigid_math::vec3::{add, cross, dot, scale};

/// Least Jacobian of a quadratic tetrahedron at its nodes and quadrature points, over that of the straight one with its corners: 1 if the
/// cell is straight, below 0 if it folds.
pub(super) fn least_jacobian(nodes: &[[f64; 3]; 10]) -> f64 {
    let straight = six_volumes([nodes[0], nodes[1], nodes[2], nodes[3]]);
    let at = |gradients: &[[f64; 3]; 10]| {
        let mut tangents = [[0.0; 3]; 3];
        for (node, gradient) in nodes.iter().zip(gradients) {
            for axis in 0..3 {
                tangents[axis] = add(tangents[axis], scale(gradient[axis], *node));
            }
        }
        let [a, b, c] = tangents;
        dot(a, cross(b, c)) / straight
    };
    // Unlike f64::min, this keeps NaN.
    probes().iter().map(at).fold(f64::INFINITY, |least, x| if x >= least { least } else { x })
}

/// Six times the volume of the tetrahedron with some corners, negative if it is inside out.
pub(super) fn six_volumes([a, b, c, d]: [[f64; 3]; 4]) -> f64 {
    let from = scale(-1.0, a);
    dot(add(b, from), cross(add(c, from), add(d, from)))
}

/// Derivatives of the shape functions at the nodes and at the quadrature points.
fn probes() -> &'static [[[f64; 3]; 10]] {
    static KEPT: OnceLock<Vec<[[f64; 3]; 10]>> = OnceLock::new();
    KEPT.get_or_init(|| {
        let shape = Shape::Tet10;
        let inner = [Rule::Slopes, Rule::Products].into_iter().flat_map(|rule| shape.samples(rule));
        let places = shape.reference().into_iter().chain(inner.map(|sample| sample.at));
        let gradients = |at| {
            let gradients = shape.gradients(at);
            std::array::from_fn(|node| gradients[node])
        };
        places.map(gradients).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_middle_node_at_a_quarter_of_its_edge_takes_the_jacobian_to_zero() {
        let least = |share: f64, unit: f64| {
            let mut nodes: [[f64; 3]; 10] = Shape::Tet10.reference().try_into().unwrap();
            nodes[4][0] = share;
            least_jacobian(&nodes.map(|node| node.map(|x| unit * x + 3.0 * unit)))
        };
        for unit in [1e-3, 1.0, 1e3] {
            assert!((least(0.5, unit) - 1.0).abs() < 1e-13);
            assert!(least(0.25, unit).abs() < 1e-13);
            assert!((least(0.2, unit) + 0.2).abs() < 1e-13);
        }
        assert!(least(f64::NAN, 1.0).is_nan());
    }
}
