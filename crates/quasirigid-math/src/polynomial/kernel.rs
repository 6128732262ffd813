//! Compiled polynomial map: nested Horner form over all rows at once, for the right-hand side of the reduced equations.
//! The rows fill one vector register; the polynomials of low degree in y and z are unrolled, higher ones are streamed over the same table.

use std::fmt::Debug;
use std::ops::Div;

use super::Series;
use super::monomial::count;
use crate::lanes::Lanes;
use crate::scalar::Scalar;
use crate::simd::{Arithmetic, Task, dispatch_unfused};

/// A number that kernels are evaluated at: one, or one for each of several problems.
pub trait Number: Scalar + Div<Output = Self> {
    /// Values of so many rows: four numbers, which fill a register, or the rows themselves, each of which fills one.
    type Rows<const R: usize>: Copy + Debug + PartialEq;

    /// Coefficients of a monomial.
    fn coefficients<const R: usize>(of: [f64; 4]) -> Self::Rows<R>;

    /// Next sum of Horner's form: `sum · x + next`.
    fn next<A: Arithmetic, const R: usize>(sum: Self::Rows<R>, x: Self, next: Self::Rows<R>)
    -> Self::Rows<R>;

    /// Next sum with a variable for each row.
    fn next_each<A: Arithmetic, const R: usize>(
        sum: Self::Rows<R>,
        x: Self::Rows<R>,
        next: Self::Rows<R>,
    ) -> Self::Rows<R>;

    /// Rows, at most four, as numbers.
    fn array<const R: usize>(rows: Self::Rows<R>) -> [Self; R];

    /// Numbers, at most four, as rows.
    fn rows<const R: usize>(of: [Self; R]) -> Self::Rows<R>;
}

impl Number for f64 {
    type Rows<const R: usize> = [f64; 4];

    #[inline(always)]
    fn coefficients<const R: usize>(of: [f64; 4]) -> [f64; 4] {
        of
    }

    #[inline(always)]
    fn next<A: Arithmetic, const R: usize>(sum: [f64; 4], x: f64, next: [f64; 4]) -> [f64; 4] {
        A::mul_add_four(sum, x, next)
    }

    #[inline(always)]
    fn next_each<A: Arithmetic, const R: usize>(sum: [f64; 4], x: [f64; 4], next: [f64; 4]) -> [f64; 4] {
        A::mul_add_each(sum, x, next)
    }

    #[inline(always)]
    fn array<const R: usize>(rows: [f64; 4]) -> [f64; R] {
        let mut numbers = [0.0; R];
        numbers.copy_from_slice(&rows[..R]);
        numbers
    }

    #[inline(always)]
    fn rows<const R: usize>(of: [f64; R]) -> [f64; 4] {
        let mut rows = [0.0; 4];
        rows[..R].copy_from_slice(&of);
        rows
    }
}

impl Number for Lanes {
    type Rows<const R: usize> = [Lanes; R];

    #[inline(always)]
    fn coefficients<const R: usize>(of: [f64; 4]) -> [Lanes; R] {
        let mut rows = [Lanes::splat(0.0); R];
        let mut row = 0;
        while row < R {
            rows[row] = Lanes::splat(of[row]);
            row += 1;
        }
        rows
    }

    #[inline(always)]
    fn next<A: Arithmetic, const R: usize>(sum: [Lanes; R], x: Lanes, next: [Lanes; R]) -> [Lanes; R] {
        Self::next_each::<A, R>(sum, [x; R], next)
    }

    #[inline(always)]
    fn next_each<A: Arithmetic, const R: usize>(
        sum: [Lanes; R],
        x: [Lanes; R],
        next: [Lanes; R],
    ) -> [Lanes; R] {
        let mut rows = next;
        let mut row = 0;
        while row < R {
            rows[row] = sum[row].mul_add::<A>(x[row], next[row]);
            row += 1;
        }
        rows
    }

    #[inline(always)]
    fn array<const R: usize>(rows: [Lanes; R]) -> [Lanes; R] {
        rows
    }

    #[inline(always)]
    fn rows<const R: usize>(of: [Lanes; R]) -> [Lanes; R] {
        of
    }
}

/// A polynomial map of at most four rows, compiled for fast evaluation: nested Horner form, one vector operation per
/// monomial for all rows at once.
///
/// The coefficients do not depend on how many points are evaluated together: eight trajectories use the same table, one lane each.
#[derive(Clone, Debug, PartialEq)]
pub struct Kernel {
    degree: usize,
    /// Coefficients in the order of evaluation: powers of x fall, within them those of y, within them those of z.
    coefficients: Vec<[f64; 4]>,
}

/// A symmetric tensor, rows xx, yy, zz, yz, zx, xy, compiled for fast evaluation.
#[derive(Clone, Debug, PartialEq)]
pub struct TensorKernel {
    /// The diagonal, and the other entries.
    halves: [Kernel; 2],
}

impl TensorKernel {
    /// Compiles a map of six rows.
    #[must_use]
    pub fn new(map: &Series) -> Self {
        Self { halves: [[0, 1, 2], [3, 4, 5]].map(|rows| Kernel::new(&map.picked(&rows))) }
    }

    /// Value at a point, or at one point in each lane.
    #[inline(always)]
    #[must_use]
    pub fn value<A: Arithmetic, N: Number>(&self, x: [N; 3]) -> [N; 6] {
        let [xx, yy, zz] = self.halves[0].vector::<A, N>(x);
        let [yz, zx, xy] = self.halves[1].vector::<A, N>(x);
        [xx, yy, zz, yz, zx, xy]
    }

    /// Value at a point by two roundings, as [`Kernel::at`].
    #[must_use]
    pub fn at(&self, x: [f64; 3]) -> [f64; 6] {
        let [[xx, yy, zz, _], [yz, zx, xy, _]] = [self.halves[0].at(x), self.halves[1].at(x)];
        [xx, yy, zz, yz, zx, xy]
    }
}

/// Value of a kernel at a point.
struct At<'a> {
    kernel: &'a Kernel,
    x: [f64; 3],
}

impl Task for At<'_> {
    type Output = [f64; 4];

    #[inline(always)]
    fn run<A: Arithmetic>(self) -> [f64; 4] {
        self.kernel.value::<A>(self.x)
    }
}

/// Highest power of y and z together whose polynomials the compiler unrolls.
const UNROLLED: usize = 6;

impl Kernel {
    /// Compiles a map of at most four rows; missing rows are zero.
    #[must_use]
    pub fn new(map: &Series) -> Self {
        let degree = (0..=map.degree()).rev().find(|d| map.part(*d).amax() > 0.0).unwrap_or(0);
        let mut coefficients = Vec::with_capacity((degree + 1) * count(degree) / 2);
        for i in (0..=degree).rev() {
            for j in (0..=degree - i).rev() {
                for k in (0..=degree - i - j).rev() {
                    let mut term = [0.0; 4];
                    for (row, entry) in term.iter_mut().enumerate().take(map.rows()) {
                        *entry = map.coefficient(row, [i, j, k]);
                    }
                    coefficients.push(term);
                }
            }
        }
        Self { degree, coefficients }
    }

    /// Value at a point by two roundings, in a function of its own: where few points are asked for, as each value that is compiled into its
    /// place is hundreds of instructions.
    #[must_use]
    pub fn at(&self, x: [f64; 3]) -> [f64; 4] {
        dispatch_unfused(At { kernel: self, x })
    }

    /// Value at a point.
    #[inline(always)]
    #[must_use]
    pub fn value<A: Arithmetic>(&self, x: [f64; 3]) -> [f64; 4] {
        self.rows::<A, f64>(x)
    }

    /// First three rows at a point, or at one point in each lane.
    #[inline(always)]
    #[must_use]
    pub fn vector<A: Arithmetic, N: Number>(&self, x: [N; 3]) -> [N; 3] {
        N::array(self.rows::<A, N>(x))
    }

    /// The coefficients of a power of x stand in the same place at every degree, so one chain serves all of them.
    #[inline(always)]
    fn rows<A: Arithmetic, N: Number>(&self, [x, y, z]: [N; 3]) -> N::Rows<3> {
        let (c, degree) = (&self.coefficients[..], self.degree);
        let mut sum = plane::<A, N, 0>(c, y, z);
        if degree >= 1 {
            sum = N::next::<A, 3>(sum, x, plane::<A, N, 1>(c, y, z));
        }
        if degree >= 2 {
            sum = N::next::<A, 3>(sum, x, plane::<A, N, 2>(c, y, z));
        }
        if degree >= 3 {
            sum = N::next::<A, 3>(sum, x, plane::<A, N, 3>(c, y, z));
        }
        if degree >= 4 {
            sum = N::next::<A, 3>(sum, x, plane::<A, N, 4>(c, y, z));
        }
        if degree >= 5 {
            sum = N::next::<A, 3>(sum, x, plane::<A, N, 5>(c, y, z));
        }
        if degree >= UNROLLED {
            sum = N::next::<A, 3>(sum, x, plane::<A, N, UNROLLED>(c, y, z));
        }
        if degree > UNROLLED { self.streamed::<A, N>(sum, [x, y, z]) } else { sum }
    }

    /// The powers of x that are left.
    #[inline(always)]
    fn streamed<A: Arithmetic, N: Number>(&self, mut sum: N::Rows<3>, [x, y, z]: [N; 3]) -> N::Rows<3> {
        let mut left = &self.coefficients[start(UNROLLED + 1)..];
        for plane in UNROLLED + 1..=self.degree {
            let mut in_y = N::coefficients([0.0; 4]);
            for row in 0..=plane {
                let (terms, next) = left.split_at(row + 1);
                left = next;
                let mut in_z = N::coefficients(terms[0]);
                for term in &terms[1..] {
                    in_z = N::next::<A, 3>(in_z, z, N::coefficients(*term));
                }
                in_y = N::next::<A, 3>(in_y, y, in_z);
            }
            sum = N::next::<A, 3>(sum, x, in_y);
        }
        sum
    }
}

/// Place of the first coefficient of a polynomial in y and z of this degree.
const fn start(degree: usize) -> usize {
    degree * (degree + 1) * (degree + 2) / 6
}

/// Polynomial in y and z of degree `I`, the coefficient of one power of x.
#[inline(always)]
fn plane<A: Arithmetic, N: Number, const I: usize>(c: &[[f64; 4]], y: N, z: N) -> N::Rows<3> {
    let c = &c[start(I)..start(I + 1)];
    let mut sum = line::<A, N, 1>(c, 0, z);
    if I >= 1 {
        sum = N::next::<A, 3>(sum, y, line::<A, N, 2>(c, 1, z));
    }
    if I >= 2 {
        sum = N::next::<A, 3>(sum, y, line::<A, N, 3>(c, 3, z));
    }
    if I >= 3 {
        sum = N::next::<A, 3>(sum, y, line::<A, N, 4>(c, 6, z));
    }
    if I >= 4 {
        sum = N::next::<A, 3>(sum, y, line::<A, N, 5>(c, 10, z));
    }
    if I >= 5 {
        sum = N::next::<A, 3>(sum, y, line::<A, N, 6>(c, 15, z));
    }
    if I >= 6 {
        sum = N::next::<A, 3>(sum, y, line::<A, N, 7>(c, 21, z));
    }
    sum
}

/// Polynomial in z with `L` coefficients.
#[inline(always)]
fn line<A: Arithmetic, N: Number, const L: usize>(c: &[[f64; 4]], start: usize, z: N) -> N::Rows<3> {
    let mut sum = N::coefficients(c[start]);
    for term in 1..L {
        sum = N::next::<A, 3>(sum, z, N::coefficients(c[start + term]));
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::polynomial::Homogeneous;
    #[cfg(target_arch = "x86_64")]
    use crate::simd::Fused;

    #[test]
    fn kernel_agrees_with_the_series_at_every_degree() {
        let x = [0.7, -1.3, 0.4];
        for degree in 0..13 {
            let mut map = Series::zero(degree, 3);
            for d in 0..=degree {
                let mut part = Homogeneous::zero(d, 3);
                if d > 0 {
                    let constant = Homogeneous::constant(&[0.3, -0.2, 0.9]);
                    part.add_scaled(1.0, &map.part(d - 1).cross(&constant));
                }
                for (i, c) in part.coefficients_mut().flatten().enumerate() {
                    *c += (1.0 + i as f64 + 7.0 * d as f64).sin();
                }
                map.set(part);
            }
            let kernel = Kernel::new(&map);
            for value in [
                kernel.at(x),
                #[cfg(target_arch = "x86_64")]
                kernel.value::<Fused>(x),
            ] {
                for (found, expected) in value.iter().zip(map.vector(x)) {
                    assert!((found - expected).abs() < 1e-13 * expected.abs().max(1.0), "degree {degree}");
                }
            }
        }
    }
}
