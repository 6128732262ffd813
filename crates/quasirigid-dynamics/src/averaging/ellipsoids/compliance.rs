//! Static compliance of homogeneous ellipsoids on the six products of the angular velocity, in lanes.
//! The centrifugal load of the squares deforms an ellipsoid in twelve shapes, `ξ e` and its products with squares of the coordinates, which
//! make a system of twelve equations; the shears have a closed form.
//! Equations (G13) and (G14), docs/theory/11-materials.md.

use std::f64::consts::PI;

use crate::math::lanes::Lanes;
use crate::math::simd::Arithmetic;

/// Shapes that the squares excite: for each axis the stretch and its products with three squares.
const SHAPES: usize = 12;

/// Static compliance of ellipsoids on the products of the angular velocity, axes in the order of the semi-axes. (G13), (G14)
#[derive(Clone, Copy, Debug)]
pub(super) struct Compliance {
    /// On the squares.
    pub squares: [[Lanes; 3]; 3],
    /// On the products yz, zx, xy.
    pub products: [Lanes; 3],
}

/// Ellipsoids in lanes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Solids {
    /// Semi-axes (m).
    pub semi_axes: [Lanes; 3],
    /// Density (kg/m³).
    pub density: Lanes,
    /// Shear modulus (Pa).
    pub shear: Lanes,
    /// Poisson's ratio.
    pub poisson: Lanes,
}

/// Means over an ellipsoid of `1, ξ², η², ζ²` with each other.
const MEANS: [[f64; 4]; 4] = [
    [1.0, 1.0 / 5.0, 1.0 / 5.0, 1.0 / 5.0],
    [1.0 / 5.0, 3.0 / 35.0, 1.0 / 35.0, 1.0 / 35.0],
    [1.0 / 5.0, 1.0 / 35.0, 3.0 / 35.0, 1.0 / 35.0],
    [1.0 / 5.0, 1.0 / 35.0, 1.0 / 35.0, 3.0 / 35.0],
];

impl Solids {
    /// Mass (kg).
    #[inline(always)]
    pub fn mass(&self) -> Lanes {
        let [a, b, c] = self.semi_axes;
        self.density * Lanes::splat(4.0 * PI / 3.0) * a * b * c
    }

    /// Moments of inertia (kg·m²) about the semi-axes.
    #[inline(always)]
    pub fn moments(&self) -> [Lanes; 3] {
        let fifth = self.mass() * Lanes::splat(0.2);
        let [a, b, c] = self.semi_axes;
        [fifth * (b * b + c * c), fifth * (c * c + a * a), fifth * (a * a + b * b)]
    }

    #[inline(always)]
    pub fn compliance<R: Arithmetic>(&self) -> Compliance {
        Compliance { squares: self.on_squares::<R>(), products: self.on_products() }
    }

    /// Compliance on the squares: the load `(s − ωᵢ²)xᵢ` on each axis with the sum `s` of the squares. (G13)
    #[inline(always)]
    fn on_squares<R: Arithmetic>(&self) -> [[Lanes; 3]; 3] {
        let zero = Lanes::splat(0.0);
        let factor = self.stiffness::<R>();
        let mut loads = [[zero; 3]; SHAPES];
        for axis in 0..3 {
            let square = self.semi_axes[axis] * self.semi_axes[axis];
            loads[4 * axis][axis] = square * Lanes::splat(1.0 / 5.0);
            for other in 1..4 {
                loads[4 * axis + other][axis] = square * Lanes::splat(1.0 / 35.0);
            }
        }
        let solved = substituted::<R>(&factor, loads);
        let mut on_loads = [[zero; 3]; 3];
        for (i, row) in on_loads.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                for shape in solved {
                    *entry = shape[i].mul_add::<R>(shape[j], *entry);
                }
            }
        }
        let scale = self.mass() * self.density / self.shear;
        let mut sums = [zero; 3];
        let mut all = zero;
        for i in 0..3 {
            sums[i] = on_loads[i][0] + on_loads[i][1] + on_loads[i][2];
            all = all + sums[i];
        }
        let mut squares = [[zero; 3]; 3];
        for i in 0..3 {
            for j in 0..3 {
                squares[i][j] = scale * (all - sums[i] - sums[j] + on_loads[i][j]);
            }
        }
        squares
    }

    /// Cholesky factor of the stiffness of the shapes over the shear modulus and the volume. (G13)
    #[inline(always)]
    fn stiffness<R: Arithmetic>(&self) -> [[Lanes; SHAPES]; SHAPES] {
        let zero = Lanes::splat(0.0);
        let two = Lanes::splat(2.0);
        let lame = two * self.poisson / (Lanes::splat(1.0) - two * self.poisson);
        let mut stiffness = [[zero; SHAPES]; SHAPES];
        for i in 0..3 {
            for j in 0..3 {
                let modulus = if i == j { lame + two } else { lame };
                for k in 0..4 {
                    for l in 0..4 {
                        stiffness[4 * i + k][4 * j + l] = modulus * Lanes::splat(MEANS[k][l]);
                    }
                }
            }
        }
        for (i, j) in [(0, 1), (0, 2), (1, 2)] {
            let ratio = self.semi_axes[i] / self.semi_axes[j];
            let (first, second) = (4 * i + 1 + j, 4 * j + 1 + i);
            let shear = Lanes::splat(4.0 / 35.0);
            stiffness[first][first] = stiffness[first][first] + shear * ratio * ratio;
            stiffness[second][second] = stiffness[second][second] + shear / (ratio * ratio);
            stiffness[first][second] = stiffness[first][second] + shear;
            stiffness[second][first] = stiffness[second][first] + shear;
        }
        factored::<R>(stiffness)
    }

    /// Compliance on the products, whose shears are exact in closed form. (G14)
    #[inline(always)]
    fn on_products(&self) -> [Lanes; 3] {
        let [a, b, c] = self.semi_axes;
        [self.on_product(a, b, c), self.on_product(b, c, a), self.on_product(c, a, b)]
    }

    /// Compliance on the product of the angular velocities about the semi-axes `b` and `c`.
    #[inline(always)]
    fn on_product(&self, a: Lanes, b: Lanes, c: Lanes) -> Lanes {
        let number = Lanes::splat;
        let lateral = number(1.0) + self.poisson;
        let (aa, bb, cc) = (a * a, b * b, c * c);
        let sum = bb + cc;
        let above =
            number(4.0) * aa * aa + number(2.0) * lateral * aa * sum + number(5.0) * lateral * bb * cc;
        let below = number(2.0) * aa * aa + lateral * aa * sum + number(3.0) * lateral * bb * cc;
        let size = number(16.0 * PI / 105.0) * self.density * self.density / self.shear;
        size * a * b * c * bb * bb * cc * cc / (sum * sum) * above / below
    }
}

/// Cholesky factor of a symmetric positive definite matrix, in its lower half.
#[inline(always)]
fn factored<R: Arithmetic>(mut matrix: [[Lanes; SHAPES]; SHAPES]) -> [[Lanes; SHAPES]; SHAPES] {
    let minus = Lanes::splat(-1.0);
    for j in 0..SHAPES {
        for k in 0..j {
            let factor = matrix[j][k] * minus;
            for i in j..SHAPES {
                matrix[i][j] = matrix[i][k].mul_add::<R>(factor, matrix[i][j]);
            }
        }
        let inverse = Lanes::splat(1.0) / matrix[j][j].sqrt();
        for i in j..SHAPES {
            matrix[i][j] = matrix[i][j] * inverse;
        }
    }
    matrix
}

/// Forward substitution in a Cholesky factor, of three right-hand sides.
#[inline(always)]
fn substituted<R: Arithmetic>(
    factor: &[[Lanes; SHAPES]; SHAPES],
    mut sides: [[Lanes; 3]; SHAPES],
) -> [[Lanes; 3]; SHAPES] {
    let minus = Lanes::splat(-1.0);
    for i in 0..SHAPES {
        for k in 0..i {
            let entry = factor[i][k] * minus;
            for side in 0..3 {
                sides[i][side] = sides[k][side].mul_add::<R>(entry, sides[i][side]);
            }
        }
        let inverse = Lanes::splat(1.0) / factor[i][i];
        for side in 0..3 {
            sides[i][side] = sides[i][side] * inverse;
        }
    }
    sides
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::lanes::LANES;
    use crate::math::simd::Unfused;

    const TABLE: &str = include_str!("../../../../../data/published/ellipsoid/compliance.csv");

    fn of(axes: [f64; 3], poisson: f64) -> Compliance {
        let one = Lanes::splat(1.0);
        let (semi_axes, poisson) = (axes.map(Lanes::splat), Lanes::splat(poisson));
        Solids { semi_axes, density: one, shear: one, poisson }.compliance::<Unfused>()
    }

    /// Independent values of ellipsoids of unit density and shear modulus, from a solution for their exact displacements.
    #[test]
    fn compliance_has_the_known_values() {
        for row in TABLE.lines().skip(1) {
            let row: Vec<f64> = row.split(',').map(|field| field.parse().unwrap()).collect();
            let found = of([row[0], row[1], row[2]], row[3]);
            let entries = |lane: usize| {
                let s = found.squares.map(|row| row.map(|entry| entry.0[lane]));
                let [yz, zx, xy] = found.products.map(|entry| entry.0[lane]);
                [s[0][0], s[1][1], s[2][2], s[1][2], s[2][0], s[0][1], yz, zx, xy]
            };
            for (i, known) in row[7..].iter().enumerate() {
                for lane in 0..LANES {
                    assert!(
                        (entries(lane)[i] - known).abs() < 2e-11 * row[9],
                        "{i} {row:?}: {}",
                        entries(lane)[i]
                    );
                }
            }
        }
    }

    /// About the axis of a body of revolution `S₁₁ − S₁₂` is half the compliance on the product.
    #[test]
    fn spheroids_have_their_identity() {
        let found = of([1.3, 1.3, 0.4], 0.31);
        let gap = found.squares[0][0].0[3] - found.squares[0][1].0[3] - 0.5 * found.products[2].0[3];
        assert!(gap.abs() < 1e-14 * found.products[2].0[3], "{gap:e}");
    }
}
