//! Compiled symmetric tensors on a sphere about the origin, as they act across the radius.
//! A tensor `T` and `T + K sᵀ + s Kᵀ` are the same there, whatever the vector `s`. It is chosen so that each diagonal entry is free of its own
//! variable, and by `x² + y² + z² = r²` of squares of the last: six rows of the full degree become three, and three of 2d + 1 coefficients.
//! Equation (P10), docs/theory/05-propagation.md.

use super::Series;
use super::kernel::Number;
use super::sphere::{SphereKernel, SphereMap, load};
use crate::lanes::Lanes;
use crate::simd::Arithmetic;

/// A symmetric tensor, from which kernels on spheres are compiled.
#[derive(Clone, Debug, PartialEq)]
pub struct TangentMap {
    /// Rows xx, yy, zz.
    diagonal: SphereMap,
    /// Rows yz, zx, xy, with the same degree.
    others: SphereMap,
}

impl TangentMap {
    /// Tensor with the rows xx, yy, zz, yz, zx, xy of a series.
    #[must_use]
    pub fn new(map: &Series) -> Self {
        let degree = (0..=map.degree()).rev().find(|d| map.part(*d).amax() > 0.0).unwrap_or(0);
        let [diagonal, others] =
            [[0, 1, 2], [3, 4, 5]].map(|rows| SphereMap::of_degree(&map.picked(&rows), degree));
        Self { diagonal, others }
    }

    /// Kernel on the sphere of this squared radius.
    #[must_use]
    pub fn on_sphere(&self, radius_squared: f64) -> TangentKernel<f64> {
        let mut tensor = self.clone();
        (0..3).for_each(|axis| tensor.clear(axis, radius_squared));
        let degree = self.diagonal.degree();
        let mut powers = |last: usize, highest: usize| -> Vec<[f64; 4]> {
            let term = |power: usize| {
                let mut rows = [0.0; 4];
                for axis in 0..3 {
                    rows[axis] = tensor.diagonal.coefficient_mut(turned([0, power, last], axis))[axis];
                }
                rows
            };
            (0..=highest).rev().map(term).collect()
        };
        let even = powers(0, degree);
        let odd = degree.checked_sub(1).map(|highest| powers(1, highest)).unwrap_or_default();
        TangentKernel { even, odd, others: tensor.others.on_sphere(radius_squared) }
    }

    /// Frees a diagonal entry of its own variable and of squares of the last one in the cycle of axes.
    fn clear(&mut self, axis: usize, radius_squared: f64) {
        let degree = self.diagonal.degree();
        for i in (1..=degree).rev() {
            for j in 0..=degree - i {
                for k in 0..=degree - i - j {
                    let term = self.take(axis, [i, j, k]);
                    self.shift(axis, [i - 1, j, k], -0.5 * term);
                }
            }
        }
        for k in (2..=degree).rev() {
            for j in 0..=degree - k {
                let term = self.take(axis, [0, j, k]);
                *self.diagonal(axis, [0, j, k - 2]) += radius_squared * term;
                *self.diagonal(axis, [0, j + 2, k - 2]) -= term;
                self.shift(axis, [1, j, k - 2], 0.5 * term);
            }
        }
    }

    /// Adds to the other entries of the axis what a term of the component of `s` along it brings there.
    fn shift(&mut self, axis: usize, [i, j, k]: [usize; 3], factor: f64) {
        let [next, last] = [(axis + 1) % 3, (axis + 2) % 3];
        self.others.coefficient_mut(turned([i, j + 1, k], axis))[last] += factor;
        self.others.coefficient_mut(turned([i, j, k + 1], axis))[next] += factor;
    }

    fn take(&mut self, axis: usize, monomial: [usize; 3]) -> f64 {
        std::mem::take(self.diagonal(axis, monomial))
    }

    /// Coefficient of a diagonal entry, powers of its own variable first.
    fn diagonal(&mut self, axis: usize, monomial: [usize; 3]) -> &mut f64 {
        &mut self.diagonal.coefficient_mut(turned(monomial, axis))[axis]
    }
}

/// Powers of x, y, z from those of the variable of an axis and of the two that follow it in their cycle.
fn turned(powers: [usize; 3], axis: usize) -> [usize; 3] {
    std::array::from_fn(|variable| powers[(variable + 3 - axis) % 3])
}

/// A symmetric tensor across the radius of one sphere, or of one for each lane.
#[derive(Clone, Debug, PartialEq)]
pub struct TangentKernel<N: Number> {
    /// Diagonal entries: coefficients of falling powers of the next variable.
    even: Vec<N::Rows<3>>,
    /// Those that the variable after it multiplies.
    odd: Vec<N::Rows<3>>,
    /// Entries yz, zx, xy.
    others: SphereKernel<N, 3>,
}

impl TangentKernel<Lanes> {
    /// The same kernel in every lane.
    #[must_use]
    pub fn splat(kernel: &TangentKernel<f64>) -> Self {
        let splat = |of: &[[f64; 4]]| of.iter().map(|of| Lanes::coefficients(*of)).collect();
        Self {
            even: splat(&kernel.even),
            odd: splat(&kernel.odd),
            others: SphereKernel::<Lanes, 3>::splat(&kernel.others),
        }
    }

    /// Puts the kernel of another sphere, compiled from the same tensor, into a lane.
    pub fn load(&mut self, lane: usize, kernel: &TangentKernel<f64>) {
        load(&mut self.even, lane, &kernel.even);
        load(&mut self.odd, lane, &kernel.odd);
        self.others.load(lane, &kernel.others);
    }
}

impl<N: Number> TangentKernel<N> {
    /// A tensor xx, yy, zz, yz, zx, xy that acts across the radius as the tensor does, at a point of the sphere.
    #[inline(always)]
    #[must_use]
    pub fn value<A: Arithmetic>(&self, [x, y, z]: [N; 3]) -> [N; 6] {
        let (next, last) = (N::rows([y, z, x]), N::rows([z, x, y]));
        let mut diagonal = horner::<A, N>(&self.even, next);
        if !self.odd.is_empty() {
            diagonal = N::next_each::<A, 3>(horner::<A, N>(&self.odd, next), last, diagonal);
        }
        let [[xx, yy, zz], [yz, zx, xy]] = [N::array(diagonal), self.others.value::<A>([x, y, z])];
        [xx, yy, zz, yz, zx, xy]
    }
}

/// Polynomial in one variable for each row.
#[inline(always)]
fn horner<A: Arithmetic, N: Number>(c: &[N::Rows<3>], x: N::Rows<3>) -> N::Rows<3> {
    let mut sum = c[0];
    for term in &c[1..] {
        sum = N::next_each::<A, 3>(sum, x, *term);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::super::sphere::tests::{dense, points};
    use super::*;
    use crate::simd::Unfused;
    use crate::sym3::smooth_times;
    use crate::vec3::{cross, dot, norm};

    #[test]
    fn tensors_act_as_given_across_the_radius() {
        for (degree, radius) in (0..13).flat_map(|degree| [1.0, 2e-6, 7e5].map(|radius| (degree, radius))) {
            let map = dense(degree, 6, radius);
            let kernel = TangentMap::new(&map).on_sphere(radius * radius);
            for K in points(radius) {
                let (given, found) = (map.tensor(K), kernel.value::<Unfused>(K));
                let u = cross(K, [0.3, -0.4, 1.2]);
                let w = cross(K, u);
                for (a, b) in [(u, u), (u, w), (w, w)] {
                    let gap = dot(a, smooth_times(found, b)) - dot(a, smooth_times(given, b));
                    // sums of (d + 1)² terms, some of which binomials of d enlarge
                    let rounding =
                        f64::EPSILON * 2f64.powi(degree as i32) * ((degree + 1) * (degree + 1)) as f64;
                    assert!(
                        gap.abs() < 4.0 * rounding * norm(a) * norm(b),
                        "degree {degree}, {K:?}: {gap:e}"
                    );
                }
            }
        }
    }

    #[test]
    fn lanes_have_the_bits_of_their_own_spheres() {
        for degree in [0, 2, 6] {
            let map = TangentMap::new(&dense(degree, 6, 1.0));
            let kernels: [TangentKernel<f64>; 8] =
                std::array::from_fn(|lane| map.on_sphere(1.0 + 0.1 * lane as f64));
            let mut together = TangentKernel::<Lanes>::splat(&kernels[0]);
            kernels.iter().enumerate().for_each(|(lane, kernel)| together.load(lane, kernel));
            let K = points(1.0)[0];
            let found = together.value::<Unfused>(K.map(Lanes::splat));
            for (lane, kernel) in kernels.iter().enumerate() {
                assert_eq!(found.map(|entry| entry.0[lane]), kernel.value::<Unfused>(K));
            }
        }
    }
}
