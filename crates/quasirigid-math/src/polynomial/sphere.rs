//! Compiled polynomial maps on a sphere about the origin, where `x² = r² − y² − z²` leaves the powers 0 and 1 of x: a map of degree d has
//! (d + 1)² coefficients there, not (d + 1)(d + 2)(d + 3)/6.
//! Equation (P9), docs/theory/05-propagation.md.

use super::Series;
use super::kernel::Number;
use super::monomial::{count, place};
use crate::lanes::Lanes;
use crate::simd::Arithmetic;

/// A polynomial map of at most four rows, from which kernels on spheres are compiled.
#[derive(Clone, Debug, PartialEq)]
pub struct SphereMap {
    degree: usize,
    /// Coefficients of the monomials, each at its [`place`].
    coefficients: Vec<[f64; 4]>,
}

impl SphereMap {
    /// Map with the rows of a series, at most four.
    #[must_use]
    pub fn new(map: &Series) -> Self {
        let degree = (0..=map.degree()).rev().find(|d| map.part(*d).amax() > 0.0).unwrap_or(0);
        Self::of_degree(map, degree)
    }

    /// Map with the rows of a series to a degree.
    pub(super) fn of_degree(map: &Series, degree: usize) -> Self {
        let mut coefficients = vec![[0.0; 4]; place([0, 0, degree]) + 1];
        for (monomial, row, value) in (0..=degree).flat_map(|d| {
            map.part(d).terms().flat_map(|(monomial, values)| {
                values.into_iter().enumerate().map(move |(row, value)| (monomial, row, value))
            })
        }) {
            coefficients[place(monomial)][row] += value;
        }
        Self { degree, coefficients }
    }

    /// Highest degree.
    pub(super) fn degree(&self) -> usize {
        self.degree
    }

    /// Coefficients of a monomial, to change.
    pub(super) fn coefficient_mut(&mut self, monomial: [usize; 3]) -> &mut [f64; 4] {
        &mut self.coefficients[place(monomial)]
    }

    /// Kernel on the sphere of this squared radius.
    #[must_use]
    pub fn on_sphere<const R: usize>(&self, radius_squared: f64) -> SphereKernel<f64, R> {
        let mut reduced = self.clone();
        for i in (2..=self.degree).rev() {
            for (j, k) in below(self.degree - i) {
                let term = *reduced.coefficient_mut([i, j, k]);
                for (lower, factor) in
                    [([i - 2, j, k], radius_squared), ([i - 2, j + 2, k], -1.0), ([i - 2, j, k + 2], -1.0)]
                {
                    let sum = reduced.coefficient_mut(lower);
                    (0..4).for_each(|row| sum[row] += factor * term[row]);
                }
            }
        }
        let plane =
            |power: usize, degree: usize| below(degree).map(move |(j, k)| [power, j, k]).collect::<Vec<_>>();
        let odd = self.degree.checked_sub(1).map(|degree| plane(1, degree)).unwrap_or_default();
        let terms = plane(0, self.degree).into_iter().chain(odd);
        SphereKernel {
            degree: self.degree,
            coefficients: terms.map(|monomial| *reduced.coefficient_mut(monomial)).collect(),
        }
    }
}

/// Powers of y and z of at most this degree together, in the order of evaluation: falling, those of y first.
fn below(degree: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..=degree).rev().flat_map(move |j| (0..=degree - j).rev().map(move |k| (j, k)))
}

/// A polynomial map of `R ≤ 4` rows on one sphere, or on one for each lane.
#[derive(Clone, Debug, PartialEq)]
pub struct SphereKernel<N: Number, const R: usize> {
    degree: usize,
    /// Coefficients of the polynomial in y and z, then of that which x multiplies.
    coefficients: Vec<N::Rows<R>>,
}

impl<const R: usize> SphereKernel<Lanes, R> {
    /// The same kernel in every lane.
    #[must_use]
    pub fn splat(kernel: &SphereKernel<f64, R>) -> Self {
        let coefficients = kernel.coefficients.iter().map(|of| Lanes::coefficients(*of)).collect();
        Self { degree: kernel.degree, coefficients }
    }

    /// Puts the kernel of another sphere, compiled from the same map, into a lane.
    pub fn load(&mut self, lane: usize, kernel: &SphereKernel<f64, R>) {
        load(&mut self.coefficients, lane, &kernel.coefficients);
    }
}

/// Puts coefficients into a lane.
pub(super) fn load<const R: usize>(lanes: &mut [[Lanes; R]], lane: usize, of: &[[f64; 4]]) {
    for (term, of) in lanes.iter_mut().zip(of) {
        term.iter_mut().zip(of).for_each(|(row, value)| row.0[lane] = *value);
    }
}

impl<N: Number, const R: usize> SphereKernel<N, R> {
    /// Rows at a point of the sphere.
    #[inline(always)]
    #[must_use]
    pub fn value<A: Arithmetic>(&self, [x, y, z]: [N; 3]) -> [N; R] {
        let at = [x, y, z];
        let sum = match self.degree {
            0 => self.coefficients[0],
            1 => self.unrolled::<A, 1, 0>(at),
            2 => self.unrolled::<A, 2, 1>(at),
            3 => self.unrolled::<A, 3, 2>(at),
            4 => self.unrolled::<A, 4, 3>(at),
            5 => self.unrolled::<A, 5, 4>(at),
            6 => self.unrolled::<A, 6, 5>(at),
            7 => self.unrolled::<A, 7, 6>(at),
            8 => self.unrolled::<A, 8, 7>(at),
            10 => self.unrolled::<A, 10, 9>(at),
            12 => self.unrolled::<A, 12, 11>(at),
            degree => {
                let (even, odd) = self.coefficients.split_at(count(degree));
                let odd = streamed::<A, N, R>(degree - 1, odd, y, z);
                N::next::<A, R>(odd, x, streamed::<A, N, R>(degree, even, y, z))
            }
        };
        N::array(sum)
    }

    /// Value by two polynomials of known degrees, which the compiler unrolls.
    #[inline(always)]
    fn unrolled<A: Arithmetic, const EVEN: usize, const ODD: usize>(&self, [x, y, z]: [N; 3]) -> N::Rows<R> {
        let (even, odd) = self.coefficients.split_at(count(EVEN));
        let odd = plane::<A, N, R, ODD>(odd, y, z);
        N::next::<A, R>(odd, x, plane::<A, N, R, EVEN>(even, y, z))
    }
}

/// Polynomial in y and z of degree `D`.
#[inline(always)]
fn plane<A: Arithmetic, N: Number, const R: usize, const D: usize>(
    c: &[N::Rows<R>],
    y: N,
    z: N,
) -> N::Rows<R> {
    let c = &c[..count(D)];
    let mut sum = c[0];
    let (mut start, mut row) = (1, 1);
    while row <= D {
        let mut in_z = c[start];
        let mut term = 1;
        while term <= row {
            in_z = N::next::<A, R>(in_z, z, c[start + term]);
            term += 1;
        }
        sum = N::next::<A, R>(sum, y, in_z);
        start += row + 1;
        row += 1;
    }
    sum
}

/// The same of any degree.
#[inline(always)]
fn streamed<A: Arithmetic, N: Number, const R: usize>(
    degree: usize,
    c: &[N::Rows<R>],
    y: N,
    z: N,
) -> N::Rows<R> {
    let mut sum = c[0];
    let mut left = &c[1..];
    for row in 1..=degree {
        let (terms, next) = left.split_at(row + 1);
        left = next;
        let mut in_z = terms[0];
        for term in &terms[1..] {
            in_z = N::next::<A, R>(in_z, z, *term);
        }
        sum = N::next::<A, R>(sum, y, in_z);
    }
    sum
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::polynomial::Homogeneous;
    use crate::simd::{Rounding, Task, Unfused, dispatch};
    use crate::vec3::{norm, scale};

    /// A dense map whose terms are of one size at this radius; a constant brings terms of lower powers into each degree.
    pub fn dense(degree: usize, rows: usize, radius: f64) -> Series {
        let filled = |degree: usize, phase: f64| {
            let mut part = Homogeneous::zero(degree, rows);
            for (i, c) in part.coefficients_mut().flatten().enumerate() {
                *c = (1.0 + i as f64 + 7.0 * degree as f64 + phase).sin();
            }
            part
        };
        let mut map = Series::zero(degree, rows);
        for d in 0..=degree {
            let mut part = filled(d, 0.0);
            if d > 0 {
                (0..rows).for_each(|row| part.add_row(row, 0.3, (&filled(d - 1, 0.5), row)));
            }
            map.set(part);
        }
        map.stretched(radius.recip())
    }

    /// Points of a sphere: two in no symmetry, an axis, and the plane of the variable that is eliminated.
    pub fn points(radius: f64) -> [[f64; 3]; 4] {
        [[0.7, -1.3, 0.4], [-0.2, 0.9, 1.1], [2.0, 0.0, 0.0], [0.0, -0.6, 0.8]]
            .map(|x| scale(radius / norm(x), x))
    }

    struct At<'a, N: Number>(&'a SphereKernel<N, 4>, [N; 3]);

    impl<N: Number> Task for At<'_, N> {
        type Output = [N; 4];

        #[inline(always)]
        fn run<A: Arithmetic>(self) -> [N; 4] {
            self.0.value::<A>(self.1)
        }
    }

    /// Sums of (d + 1)² terms, some of which binomials of d/2 enlarge.
    fn rounding(degree: usize) -> f64 {
        f64::EPSILON * 2f64.powi(degree as i32 / 2) * ((degree + 1) * (degree + 1)) as f64
    }

    #[test]
    fn kernels_agree_with_the_series_on_their_sphere() {
        for (degree, radius) in (0..14).flat_map(|degree| [1.0, 3e-7, 5e8].map(|radius| (degree, radius))) {
            let map = dense(degree, 4, radius);
            let kernel = SphereMap::new(&map).on_sphere::<4>(radius * radius);
            for x in points(radius) {
                let expected: Vec<f64> = map.value(x);
                for found in [dispatch(Rounding::Fastest, At(&kernel, x)), kernel.value::<Unfused>(x)] {
                    for (found, expected) in found.iter().zip(&expected) {
                        assert!((found - expected).abs() < 4.0 * rounding(degree), "degree {degree}, {x:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn coefficients_are_those_of_a_sphere() {
        for degree in 1..9 {
            let kernel = SphereMap::new(&dense(degree, 3, 1.0)).on_sphere::<3>(1.0);
            assert_eq!(kernel.coefficients.len(), (degree + 1) * (degree + 1));
        }
        let nothing = SphereMap::new(&Series::zero(4, 3)).on_sphere::<3>(1.0);
        assert_eq!(nothing.value::<Unfused>([0.6, 0.8, 0.0]), [0.0; 3]);
    }

    #[test]
    fn lanes_have_the_bits_of_their_own_spheres() {
        for degree in [0, 1, 4, 9, 12] {
            let map = SphereMap::new(&dense(degree, 4, 1.0));
            let radii: [f64; 8] = std::array::from_fn(|lane| 0.5 + 0.1 * lane as f64);
            let kernels = radii.map(|radius| map.on_sphere::<4>(radius * radius));
            let mut together = SphereKernel::<Lanes, 4>::splat(&kernels[0]);
            kernels.iter().enumerate().for_each(|(lane, kernel)| together.load(lane, kernel));
            let x: [[f64; 3]; 8] = std::array::from_fn(|lane| points(radii[lane])[lane % 4]);
            let lanes = [0, 1, 2].map(|axis| Lanes(x.map(|x| x[axis])));
            let found = dispatch(Rounding::Fastest, At(&together, lanes));
            for lane in 0..8 {
                let alone = dispatch(Rounding::Fastest, At(&kernels[lane], x[lane]));
                assert_eq!(found.map(|row| row.0[lane]), alone);
            }
        }
    }
}
