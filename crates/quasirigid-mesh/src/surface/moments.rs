//! Moments of a closed surface: integrals of all monomials over the body inside, by the divergence theorem.
//! No mesh of the volume is needed and Gauss rules are exact; terms are summed with a compensation, so many triangles cost no digits.
//! Equation (G9), docs/theory/11-materials.md.

use super::ClosedSurface;
use super::geometry::triple;
use quasirigid_math::polynomial::monomial::{count, index};
use quasirigid_math::quadrature::gauss_legendre;
use quasirigid_math::simd::{Arithmetic, Rounding, Task, dispatch};
use quasirigid_math::vec3::minus;

/// Points of a triangle in one vector operation.
const LANES: usize = 8;
/// Numbers at these points.
type Lanes = [f64; LANES];

/// Moments: integrals of all monomials `x^i y^j z^k` up to a degree over the body inside a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Moments {
    /// Values by degree, then in the order of [`monomial`](quasirigid_math::polynomial::monomial).
    values: Vec<Vec<f64>>,
}

impl Moments {
    /// Highest degree.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.values.len() - 1
    }

    /// `∫ x^i y^j z^k dV`.
    ///
    /// # Panics
    /// If `i + j + k` is above the degree.
    #[inline]
    #[must_use]
    pub fn of(&self, exponents: [usize; 3]) -> f64 {
        self.values[exponents.iter().sum::<usize>()][index(exponents)]
    }
}

impl ClosedSurface {
    /// Integrals of all monomials up to a degree, in coordinates that count from `origin` and are divided by `scale`:
    ///
    /// ```text
    /// ∫ ξ^i η^j ζ^k dξ dη dζ,     ξ = (x − x₀)/s_x,  η = (y − y₀)/s_y,  ζ = (z − z₀)/s_z
    /// ```
    ///
    /// By the divergence theorem the integral of a homogeneous polynomial of degree d is one over the surface,
    /// `∫ p dV = 1/(d+3) ∮ p (r·n) dS`, and on each triangle Gauss's rule is exact. Positive scales near half the
    /// extents keep all numbers near one. Rounding is about `10⁻¹⁵` of `∫ |ξ^i η^j ζ^k|` for an origin within the body;
    /// from far outside, the terms of its near and its far side cancel.
    #[must_use]
    pub fn moments(&self, degree: usize, origin: [f64; 3], scale: [f64; 3]) -> Moments {
        let sums = dispatch(Rounding::Fastest, Integration { surface: self, degree, origin, scale });
        let mut values: Vec<Vec<f64>> = (0..=degree).map(|degree| vec![0.0; count(degree)]).collect();
        for ([i, j, k], [sum, rest]) in monomials(degree).zip(sums) {
            values[i + j + k][index([i, j, k])] = (sum + rest) / (i + j + k + 3) as f64;
        }
        Moments { values }
    }
}

/// Exponents of all monomials up to a degree, in the order of integration.
fn monomials(degree: usize) -> impl Iterator<Item = [usize; 3]> {
    (0..=degree)
        .flat_map(move |i| (0..=degree - i).flat_map(move |j| (0..=degree - i - j).map(move |k| [i, j, k])))
}

/// Points `u`, `v` and weights of a rule on the triangle `u, v ≥ 0`, `u + v ≤ 1` that is exact for polynomials of a degree: the Gauss rule
/// on the square `u = s`, `v = t(1−s)`. Filled up with points of no weight.
fn triangle_rule(degree: usize) -> Vec<[Lanes; 3]> {
    let half = |[node, weight]: [f64; 2]| [0.5 * (1.0 + node), 0.5 * weight];
    // The area element 1 − s adds a degree in s.
    let (along, across) = (gauss_legendre((degree + 3) / 2), gauss_legendre(degree / 2 + 1));
    let mut points = Vec::with_capacity(along.len() * across.len());
    for [s, in_s] in along.into_iter().map(half) {
        points.extend(
            across.iter().copied().map(half).map(|[t, in_t]| [s, t * (1.0 - s), in_s * in_t * (1.0 - s)]),
        );
    }
    let lanes = |part: &[[f64; 3]]| {
        [0, 1, 2].map(|i| std::array::from_fn(|lane| part.get(lane).map_or(0.0, |p| p[i])))
    };
    points.chunks(LANES).map(lanes).collect()
}

/// Surface integral `∮ p (r·n) dS` for every monomial, each as a sum and its rounding error.
struct Integration<'a> {
    surface: &'a ClosedSurface,
    degree: usize,
    origin: [f64; 3],
    scale: [f64; 3],
}

impl Task for Integration<'_> {
    type Output = Vec<[f64; 2]>;

    #[inline(always)]
    fn run<A: Arithmetic>(self) -> Vec<[f64; 2]> {
        let rule = triangle_rule(self.degree);
        let mut sums = vec![[0.0; 2]; monomials(self.degree).count()];
        // At every point of a triangle: y, the powers of z, x^i and x^i y^j with the weight.
        let mut y = vec![[0.0; LANES]; rule.len()];
        let mut z_powers = vec![vec![[1.0; LANES]; rule.len()]; self.degree + 1];
        let [mut x, mut x_power, mut product] = [y.clone(), y.clone(), y.clone()];
        for corners in &self.surface.triangles {
            let [a, b, c] = corners.map(|corner| self.surface.vertices[corner]);
            let [from, u, v] = [minus(a, self.origin), minus(b, a), minus(c, a)].map(|r| self.scaled(r));
            let flux = triple(from, u, v); // r·n dS = flux du dv, the same all over the triangle
            let at = |axis: usize, [s, t, _]: &[Lanes; 3]| -> Lanes {
                std::array::from_fn(|i| A::mul_add(t[i], v[axis], A::mul_add(s[i], u[axis], from[axis])))
            };
            for (point, node) in rule.iter().enumerate() {
                x[point] = at(0, node);
                y[point] = at(1, node);
                x_power[point] = times_lanes([flux; LANES], node[2]);
                let z = at(2, node);
                for k in 1..=self.degree {
                    z_powers[k][point] = times_lanes(z_powers[k - 1][point], z);
                }
            }
            let mut sums = sums.iter_mut();
            for i in 0..=self.degree {
                product.copy_from_slice(&x_power);
                for j in 0..=self.degree - i {
                    for (z_power, sum) in z_powers[..=self.degree - i - j].iter().zip(&mut sums) {
                        add(sum, inner::<A>(&product, z_power));
                    }
                    multiply(&mut product, &y);
                }
                multiply(&mut x_power, &x);
            }
        }
        sums
    }
}

impl Integration<'_> {
    fn scaled(&self, r: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|axis| r[axis] / self.scale[axis])
    }
}

#[inline(always)]
fn times_lanes(a: Lanes, b: Lanes) -> Lanes {
    std::array::from_fn(|i| a[i] * b[i])
}

#[inline(always)]
fn multiply(product: &mut [Lanes], factors: &[Lanes]) {
    for (product, factor) in product.iter_mut().zip(factors) {
        *product = times_lanes(*product, *factor);
    }
}

#[inline(always)]
fn inner<A: Arithmetic>(a: &[Lanes], b: &[Lanes]) -> f64 {
    let mut sum = [0.0; LANES];
    for (a, b) in a.iter().zip(b) {
        sum = std::array::from_fn(|i| A::mul_add(a[i], b[i], sum[i]));
    }
    let [p, q, r, s, t, u, v, w] = sum;
    ((p + t) + (q + u)) + ((r + v) + (s + w))
}

/// Adds to a sum and keeps the rounding error, so that many triangles are as exact as few.
#[inline(always)]
fn add([sum, rest]: &mut [f64; 2], term: f64) {
    let total = *sum + term;
    let back = total - *sum;
    *rest += (*sum - (total - back)) + (term - back);
    *sum = total;
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `∫ u^i v^j = i! j! / (i+j+2)!` over the triangle.
    #[test]
    fn the_rule_is_exact_up_to_its_degree() {
        let factorial = |n: usize| (1..=n).map(|k| k as f64).product::<f64>();
        for degree in 0..=20 {
            let rule = triangle_rule(degree);
            for [i, j, _] in monomials(degree).filter(|[_, _, k]| *k == 0) {
                let sum: f64 = (0..LANES)
                    .flat_map(|lane| rule.iter().map(move |[u, v, w]| [u[lane], v[lane], w[lane]]))
                    .map(|[u, v, w]| w * u.powi(i as i32) * v.powi(j as i32))
                    .sum();
                let exact = factorial(i) * factorial(j) / factorial(i + j + 2);
                assert!((sum / exact - 1.0).abs() < 1e-13, "{degree}: {i} {j} {sum:e} {exact:e}");
            }
        }
    }

    #[test]
    fn rounding_is_kept() {
        let mut sum = [0.0; 2];
        [1.0, 1e100, 1.0, -1e100].into_iter().for_each(|term| add(&mut sum, term));
        assert_eq!(sum[0] + sum[1], 2.0);
    }
}
