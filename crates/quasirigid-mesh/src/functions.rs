//! Shape functions on the reference cell.

use super::Shape;
use quasirigid_math::scalar::{Jet, Scalar};

/// Greatest number of nodes of a cell.
pub const MAX_NODES: usize = 27;

/// Places of the nodes of a hexahedron, as multiples of the axes; lines and quadrilaterals take theirs from it.
const HEXAHEDRON: [[i8; 3]; MAX_NODES] = [
    [-1, -1, -1],
    [1, -1, -1],
    [1, 1, -1],
    [-1, 1, -1],
    [-1, -1, 1],
    [1, -1, 1],
    [1, 1, 1],
    [-1, 1, 1],
    [0, -1, -1],
    [1, 0, -1],
    [0, 1, -1],
    [-1, 0, -1],
    [0, -1, 1],
    [1, 0, 1],
    [0, 1, 1],
    [-1, 0, 1],
    [-1, -1, 0],
    [1, -1, 0],
    [1, 1, 0],
    [-1, 1, 0],
    [-1, 0, 0],
    [1, 0, 0],
    [0, -1, 0],
    [0, 1, 0],
    [0, 0, -1],
    [0, 0, 1],
    [0, 0, 0],
];
const QUADRILATERAL: [[i8; 3]; 9] =
    [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0], [0, -1, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, 0, 0]];
const LINE: [[i8; 3]; 3] = [[-1, 0, 0], [1, 0, 0], [0, 0, 0]];
/// Corners of a triangle and a tetrahedron.
const SIMPLEX: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// Ends of the edges of a triangle, then of the others of a tetrahedron.
pub(crate) const EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];

impl Shape {
    /// Places of the nodes on the reference cell, in their order.
    ///
    /// Lines, quadrilaterals and hexahedra reach from −1 to 1 along each axis; triangles and tetrahedra have the
    /// origin and the ends of the unit vectors for corners; a wedge is that triangle from −1 to 1. Axes that a shape
    /// lacks stay at zero.
    #[must_use]
    pub fn reference(self) -> Vec<[f64; 3]> {
        let middle = |[i, j]: [usize; 2]| -> [f64; 3] {
            std::array::from_fn(|axis| 0.5 * (SIMPLEX[i][axis] + SIMPLEX[j][axis]))
        };
        let upright = |[x, y, _]: [f64; 3], z: f64| [x, y, z];
        match self {
            Self::Triangle3 | Self::Tet4 => SIMPLEX[..self.nodes()].to_vec(),
            Self::Triangle6 | Self::Tet10 => {
                let corners = SIMPLEX[..self.corners()].iter().copied();
                corners.chain(EDGES.iter().map(|edge| middle(*edge))).take(self.nodes()).collect()
            }
            Self::Wedge6 | Self::Wedge15 => {
                let corners = |z| SIMPLEX[..3].iter().map(move |corner| upright(*corner, z));
                let edges = |z| EDGES[..3].iter().map(move |edge| upright(middle(*edge), z));
                let all = corners(-1.0).chain(corners(1.0)).chain(edges(-1.0)).chain(edges(1.0));
                all.chain(corners(0.0)).take(self.nodes()).collect()
            }
            _ => self.lattice().iter().map(|place| place.map(f64::from)).collect(),
        }
    }

    /// Values of the shape functions at a place of the reference cell, in the order of the nodes; zero beyond them.
    #[must_use]
    pub fn functions(self, at: [f64; 3]) -> [f64; MAX_NODES] {
        self.evaluated(at)
    }

    /// Derivatives of the shape functions along the axes of the reference cell, in the order of the nodes; zero
    /// beyond them.
    #[must_use]
    pub fn gradients(self, at: [f64; 3]) -> [[f64; 3]; MAX_NODES] {
        let slopes = [0, 1, 2].map(|along| {
            let first = |axis| if axis == along { 1.0 } else { 0.0 };
            self.evaluated(std::array::from_fn(|axis| Jet {
                value: at[axis],
                first: first(axis),
                second: 0.0,
            }))
        });
        std::array::from_fn(|node| [0, 1, 2].map(|axis| slopes[axis][node].first))
    }

    /// Places of the nodes of lines, quadrilaterals and hexahedra; of other shapes none.
    fn lattice(self) -> &'static [[i8; 3]] {
        match self.dimension() {
            1 => &LINE[..self.nodes()],
            2 if self.corners() == 4 => &QUADRILATERAL[..self.nodes()],
            3 if self.corners() == 8 => &HEXAHEDRON[..self.nodes()],
            _ => &[],
        }
    }

    fn evaluated<T: Scalar>(self, at: [T; 3]) -> [T; MAX_NODES] {
        let mut values = [T::from(0.0); MAX_NODES];
        let lattice = self.lattice();
        let axes = self.dimension();
        match self {
            Self::Triangle3 | Self::Triangle6 | Self::Tet4 | Self::Tet10 => {
                simplex(&mut values[..self.nodes()], &barycentric(at, axes), self.corners());
            }
            Self::Wedge6 => {
                let shares = barycentric(at, 2);
                (0..6).for_each(|node| values[node] = shares[node % 3] * linear(level(node), at[2]));
            }
            Self::Wedge15 => wedge(&mut values[..15], &barycentric(at, 2), at[2]),
            Self::Quad8 | Self::Hex20 => {
                for (value, place) in values.iter_mut().zip(lattice) {
                    *value = serendipity(&place[..axes], at);
                }
            }
            Self::Line2 | Self::Quad4 | Self::Hex8 => {
                for (value, place) in values.iter_mut().zip(lattice) {
                    *value = product((0..axes).map(|axis| linear(place[axis], at[axis])));
                }
            }
            Self::Line3 | Self::Quad9 | Self::Hex27 => {
                for (value, place) in values.iter_mut().zip(lattice) {
                    *value = product((0..axes).map(|axis| quadratic(place[axis], at[axis])));
                }
            }
        }
        values
    }
}

/// Shares of the corners of a triangle (two axes) or a tetrahedron (three).
fn barycentric<T: Scalar>(at: [T; 3], axes: usize) -> [T; 4] {
    let rest = at[..axes].iter().fold(T::from(1.0), |rest, share| rest - *share);
    [rest, at[0], at[1], at[2]]
}

/// `λ`, or with nodes on the edges `λ(2λ − 1)` at corners and `4 λ_i λ_j` between them.
fn simplex<T: Scalar>(values: &mut [T], shares: &[T; 4], corners: usize) {
    let quadratic = values.len() > corners;
    for corner in 0..corners {
        let share = shares[corner];
        values[corner] = if quadratic { share * (share + share - T::from(1.0)) } else { share };
    }
    for (value, [i, j]) in values[corners..].iter_mut().zip(EDGES) {
        *value = T::from(4.0) * shares[i] * shares[j];
    }
}

/// `½λ(1 ± ζ)(2λ − 2 ± ζ)` at corners, `2 λ_i λ_j (1 ± ζ)` on the edges of the faces, `λ(1 − ζ²)` on upright edges.
fn wedge<T: Scalar>(values: &mut [T], shares: &[T; 4], zeta: T) {
    for node in 0..6 {
        let share = shares[node % 3];
        let bend = share + share - T::from(2.0) + T::from(f64::from(level(node))) * zeta;
        values[node] = share * linear(level(node), zeta) * bend;
        let [i, j] = EDGES[node % 3];
        values[node + 6] = T::from(4.0) * shares[i] * shares[j] * linear(level(node), zeta);
    }
    (0..3).for_each(|node| values[node + 12] = shares[node] * quadratic(0, zeta));
}

/// Side of a wedge that one of its corners, or of the edges of its faces, is on.
fn level(node: usize) -> i8 {
    if node < 3 { -1 } else { 1 }
}

/// `½(1 ± x)`.
fn linear<T: Scalar>(side: i8, x: T) -> T {
    T::from(0.5) * (T::from(1.0) + T::from(f64::from(side)) * x)
}

/// `½x(x ± 1)` at the ends, `1 − x²` in the middle.
fn quadratic<T: Scalar>(side: i8, x: T) -> T {
    if side == 0 { T::from(1.0) - x * x } else { T::from(0.5) * x * (x + T::from(f64::from(side))) }
}

/// The function of a node at a corner or in the middle of an edge, without those of faces and cell.
fn serendipity<T: Scalar>(place: &[i8], at: [T; 3]) -> T {
    let factor = |(side, x): (&i8, &T)| if *side == 0 { quadratic(0, *x) } else { linear(*side, *x) };
    let all = product(place.iter().zip(&at).map(factor));
    if place.contains(&0) {
        return all;
    }
    let reach = place
        .iter()
        .zip(at)
        .fold(T::from(1.0 - place.len() as f64), |reach, (side, x)| reach + T::from(f64::from(*side)) * x);
    all * reach
}

fn product<T: Scalar>(factors: impl Iterator<Item = T>) -> T {
    factors.fold(T::from(1.0), |product, factor| product * factor)
}

#[cfg(test)]
pub(crate) mod tests {
    use proptest::prelude::*;

    use super::*;

    pub const SHAPES: [Shape; 14] = [
        Shape::Line2,
        Shape::Line3,
        Shape::Triangle3,
        Shape::Triangle6,
        Shape::Quad4,
        Shape::Quad8,
        Shape::Quad9,
        Shape::Tet4,
        Shape::Tet10,
        Shape::Wedge6,
        Shape::Wedge15,
        Shape::Hex8,
        Shape::Hex20,
        Shape::Hex27,
    ];

    /// Monomials that a shape must represent: all of its degree.
    fn field(shape: Shape, [x, y, z]: [f64; 3]) -> f64 {
        let linear = 0.3 - 1.1 * x + 0.7 * y + 1.9 * z;
        if shape.nodes() == shape.corners() {
            linear
        } else {
            linear + x * (x - 0.4 * y) + y * (z - 2.0 * y) - z * (z + x)
        }
    }

    #[test]
    fn a_function_is_one_at_its_node_and_zero_at_the_others() {
        for shape in SHAPES {
            for (a, place) in shape.reference().into_iter().enumerate() {
                let values = shape.functions(place);
                for (b, value) in values.into_iter().enumerate() {
                    let exact = if a == b { 1.0 } else { 0.0 };
                    assert!((value - exact).abs() < 1e-15, "{shape}: function {b} at node {a} is {value}");
                }
            }
        }
    }

    #[test]
    fn middle_nodes_lie_between_corners_as_documented() {
        let middle = |shape: Shape, node: usize, ends: &[usize]| {
            let places = shape.reference();
            for axis in 0..3 {
                let mean = ends.iter().map(|end| places[*end][axis]).sum::<f64>() / ends.len() as f64;
                assert!((places[node][axis] - mean).abs() < 1e-15, "{shape}: node {node}");
            }
        };
        for (edge, ends) in [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]].iter().enumerate() {
            middle(Shape::Tet10, 4 + edge, ends);
        }
        let wedge = [[0, 1], [1, 2], [2, 0], [3, 4], [4, 5], [5, 3], [0, 3], [1, 4], [2, 5]];
        wedge.iter().enumerate().for_each(|(edge, ends)| middle(Shape::Wedge15, 6 + edge, ends));
        let lower = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6]];
        let upper = [[6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]];
        for (edge, ends) in lower.iter().chain(&upper).enumerate() {
            middle(Shape::Hex20, 8 + edge, ends);
        }
        let faces = [[0, 3, 4, 7], [1, 2, 5, 6], [0, 1, 4, 5], [2, 3, 6, 7], [0, 1, 2, 3], [4, 5, 6, 7]];
        faces.iter().enumerate().for_each(|(face, ends)| middle(Shape::Hex27, 20 + face, ends));
    }

    proptest! {
        #[test]
        fn fields_of_the_degree_of_a_shape_are_exact(x in -1.0..1.0, y in -1.0..1.0, z in -1.0..1.0) {
            for shape in SHAPES {
                let at = [x, y, z].map(|x: f64| x * 0.9);
                let at = std::array::from_fn(|axis| if axis < shape.dimension() { at[axis] } else { 0.0 });
                let (values, slopes) = (shape.functions(at), shape.gradients(at));
                let nodal: Vec<f64> = shape.reference().into_iter().map(|place| field(shape, place)).collect();
                let sum: f64 = nodal.iter().zip(values).map(|(u, value)| u * value).sum();
                prop_assert!((sum - field(shape, at)).abs() < 1e-13, "{}: {}", shape, sum);
                prop_assert!((values.iter().sum::<f64>() - 1.0).abs() < 1e-14);
                for axis in 0..shape.dimension() {
                    // Central differences of quadratic and cubic functions with a step of 1e-5 are right to 1e-10.
                    let step = |side: f64| std::array::from_fn(|i| at[i] + if i == axis { 1e-5 * side } else { 0.0 });
                    let [above, below] = [1.0, -1.0].map(|side| shape.functions(step(side)));
                    for node in 0..MAX_NODES {
                        let difference = (above[node] - below[node]) / 2e-5;
                        prop_assert!((slopes[node][axis] - difference).abs() < 1e-8, "{}: function {}", shape, node);
                    }
                }
            }
        }
    }
}
