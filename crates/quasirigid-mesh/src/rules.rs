//! Quadrature rules on the reference cells.

use super::Shape;
use quasirigid_math::quadrature::gauss_legendre;

/// A place of a reference cell and its weight.
pub(super) type Weighted = ([f64; 3], f64);

impl Shape {
    /// Places and weights that integrate polynomials of a degree over the reference cell, all within it and positive.
    ///
    /// On triangles and tetrahedra the degree is the whole one, on lines, quadrilaterals and hexahedra that in each
    /// coordinate. Wedges have two: the whole one over the triangle, and that `along` the axis.
    pub(super) fn rule(self, degree: usize, along: usize) -> Vec<Weighted> {
        match self {
            Self::Line2 | Self::Line3 => line(degree).map(|[x, weight]| ([x, 0.0, 0.0], weight)).collect(),
            Self::Triangle3 | Self::Triangle6 => triangle(degree),
            Self::Quad4 | Self::Quad8 | Self::Quad9 => square(degree),
            Self::Tet4 | Self::Tet10 => tetrahedron(degree),
            Self::Wedge6 | Self::Wedge15 => upright(&triangle(degree), along),
            Self::Hex8 | Self::Hex20 | Self::Hex27 => upright(&square(degree), degree),
        }
    }
}

/// Gauss rule on −1 to 1.
fn line(degree: usize) -> impl Iterator<Item = [f64; 2]> {
    gauss_legendre(degree / 2 + 1).into_iter()
}

fn square(degree: usize) -> Vec<Weighted> {
    let along = |[y, outer]: [f64; 2]| line(degree).map(move |[x, inner]| ([x, y, 0.0], inner * outer));
    line(degree).flat_map(along).collect()
}

/// Rule on a plane, repeated along the third axis.
fn upright(plane: &[Weighted], degree: usize) -> Vec<Weighted> {
    let at = |[z, outer]: [f64; 2]| plane.iter().map(move |([x, y, _], inner)| ([*x, *y, z], inner * outer));
    line(degree).flat_map(at).collect()
}

/// The middle, three points, or the seven of Radon; beyond degree 5 the Gauss rule on a square with one side shrunk to a point.
fn triangle(degree: usize) -> Vec<Weighted> {
    let orbit = |share: f64, weight: f64| {
        let far = 1.0 - 2.0 * share;
        [[share, share], [far, share], [share, far]].map(|[x, y]| ([x, y, 0.0], weight))
    };
    let third = 1.0 / 3.0;
    match degree {
        0 | 1 => vec![([third, third, 0.0], 0.5)],
        2 => orbit(1.0 / 6.0, 1.0 / 6.0).to_vec(),
        3..=5 => {
            let root = 15.0_f64.sqrt();
            let near = orbit((6.0 - root) / 21.0, (155.0 - root) / 2400.0);
            let far = orbit((6.0 + root) / 21.0, (155.0 + root) / 2400.0);
            [([third, third, 0.0], 9.0 / 80.0)].into_iter().chain(near).chain(far).collect()
        }
        _ => {
            let shrunk = |([x, y, _], weight): Weighted| {
                let [x, y] = [x, y].map(|x| 0.5 * (1.0 + x));
                ([x * (1.0 - y), y, 0.0], 0.25 * weight * (1.0 - y))
            };
            square(degree + 1).into_iter().map(shrunk).collect()
        }
    }
}

/// The middle, four points, or the fourteen of Walkington `[@walkington2000]`; beyond degree 5 the Gauss rule on a cube with one side
/// shrunk to an edge and the opposite one to a point.
fn tetrahedron(degree: usize) -> Vec<Weighted> {
    match degree {
        0 | 1 => vec![([0.25; 3], 1.0 / 6.0)],
        2 => corners((5.0 - 5.0_f64.sqrt()) / 20.0, 1.0 / 24.0).to_vec(),
        3..=5 => {
            let inner = corners(0.310_885_919_263_300_6, 0.018_781_320_953_002_642);
            let outer = corners(0.092_735_250_310_891_23, 0.012_248_840_519_393_658);
            let share = 0.045_503_704_125_649_65;
            let [near, far] = [share, 0.5 - share];
            let pair = |[x, y, z]: [f64; 3]| [[x, y, z], [0.5 - x, 0.5 - y, 0.5 - z]];
            let edges = [[far, near, near], [near, far, near], [near, near, far]].into_iter().flat_map(pair);
            let edges = edges.map(|at| (at, 0.007_091_003_462_846_911));
            inner.into_iter().chain(outer).chain(edges).collect()
        }
        _ => {
            let shrunk = |(at, weight): Weighted| {
                let [x, y, z] = at.map(|x| 0.5 * (1.0 + x));
                let [wide, high] = [(1.0 - y) * (1.0 - z), 1.0 - z];
                ([x * wide, y * high, z], 0.125 * weight * wide * high)
            };
            upright(&square(degree + 2), degree + 2).into_iter().map(shrunk).collect()
        }
    }
}

/// Four points on the lines from the middle to the corners.
fn corners(share: f64, weight: f64) -> [Weighted; 4] {
    let far = 1.0 - 3.0 * share;
    let at = |corner: usize| std::array::from_fn(|axis| if axis + 1 == corner { far } else { share });
    [0, 1, 2, 3].map(|corner| (at(corner), weight))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn factorial(n: usize) -> f64 {
        (1..=n).map(|k| k as f64).product()
    }

    /// `∫ x^a dx` from −1 to 1.
    fn even(power: usize) -> f64 {
        if power.is_multiple_of(2) { 2.0 / (power + 1) as f64 } else { 0.0 }
    }

    /// `∫ x^a y^b z^c` over the reference cell, `a! b! / (a + b + 2)!` over a triangle.
    fn exact(shape: Shape, [a, b, c]: [usize; 3]) -> f64 {
        let simplex = |powers: &[usize]| {
            powers.iter().map(|power| factorial(*power)).product::<f64>()
                / factorial(powers.iter().sum::<usize>() + powers.len())
        };
        match shape {
            Shape::Triangle3 => simplex(&[a, b]),
            Shape::Tet4 => simplex(&[a, b, c]),
            Shape::Wedge6 => simplex(&[a, b]) * even(c),
            _ => [a, b, c][..shape.dimension()].iter().map(|power| even(*power)).product(),
        }
    }

    /// Whether a monomial is of a degree that the rule integrates exactly.
    fn covered(shape: Shape, [a, b, c]: [usize; 3], degree: usize) -> bool {
        match shape {
            Shape::Line2 => a <= degree && b + c == 0,
            Shape::Triangle3 => a + b <= degree && c == 0,
            Shape::Quad4 => a.max(b) <= degree && c == 0,
            Shape::Tet4 => a + b + c <= degree,
            Shape::Wedge6 => a + b <= degree && c <= degree + 2,
            _ => a.max(b).max(c) <= degree,
        }
    }

    const CELLS: [Shape; 6] =
        [Shape::Line2, Shape::Triangle3, Shape::Quad4, Shape::Tet4, Shape::Wedge6, Shape::Hex8];

    fn sum(rule: &[Weighted], powers: [usize; 3]) -> f64 {
        let value =
            |at: &[f64; 3]| -> f64 { (0..3).map(|axis| at[axis].powi(powers[axis] as i32)).product() };
        rule.iter().map(|(at, weight)| weight * value(at)).sum()
    }

    #[test]
    fn rules_are_exact_up_to_their_degree() {
        for shape in CELLS {
            for degree in 0..9 {
                let rule = shape.rule(degree, degree + 2);
                assert!(rule.iter().all(|(_, weight)| *weight > 0.0));
                for powers in (0..11 * 11 * 11).map(|k| [k % 11, k / 11 % 11, k / 121]) {
                    if covered(shape, powers, degree) {
                        let (sum, exact) = (sum(&rule, powers), exact(shape, powers));
                        // Up to 343 weights, each rounded, with a sum of 8.
                        assert!((sum - exact).abs() < 2e-14, "{shape} {degree} {powers:?}: {sum} {exact}");
                    }
                }
            }
        }
    }

    #[test]
    fn rules_have_no_more_points_than_their_degree_needs() {
        let points = |shape: Shape| [1, 2, 3, 4, 5, 6].map(|degree| shape.rule(degree, degree + 2).len());
        assert_eq!(points(Shape::Line2), [1, 2, 2, 3, 3, 4]);
        assert_eq!(points(Shape::Triangle3), [1, 3, 7, 7, 7, 16]);
        assert_eq!(points(Shape::Tet4), [1, 4, 14, 14, 14, 125]);
        assert_eq!(points(Shape::Hex8), [1, 8, 8, 27, 27, 64]);
        assert_eq!(points(Shape::Wedge6), [2, 9, 21, 28, 28, 80]);
        assert!((sum(&Shape::Tet4.rule(5, 5), [6, 0, 0]) - exact(Shape::Tet4, [6, 0, 0])).abs() > 1e-6);
        assert!(
            (sum(&Shape::Triangle3.rule(5, 5), [6, 0, 0]) - exact(Shape::Triangle3, [6, 0, 0])).abs() > 1e-6
        );
    }
}
