//! Compiled polynomial map: nested Horner form over all rows at once, for the right-hand side of the reduced equations.
//! The rows fill one vector register; loops of fixed degree are unrolled, higher ones are streamed over the same table.

use super::Series;
use super::monomial::count;
use crate::simd::{Arithmetic, scaled_sum};

/// A polynomial map of at most four rows, compiled for fast evaluation: nested Horner form, one vector operation per
/// monomial for all rows at once.
///
/// The coefficients do not depend on how many points are evaluated together, so a batch of trajectories can use the
/// same table with one lane each.
#[derive(Clone, Debug, PartialEq)]
pub struct Kernel {
    degree: usize,
    /// Coefficients in the order of evaluation: powers of x fall, within them those of y, within them those of z.
    coefficients: Vec<[f64; 4]>,
}

/// Highest degree that the compiler unrolls.
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

    /// Value at a point.
    #[inline(always)]
    #[must_use]
    pub fn value<A: Arithmetic>(&self, x: [f64; 3]) -> [f64; 4] {
        match self.degree {
            0 => self.coefficients[0],
            1 => self.unrolled::<A, 1>(x),
            2 => self.unrolled::<A, 2>(x),
            3 => self.unrolled::<A, 3>(x),
            4 => self.unrolled::<A, 4>(x),
            5 => self.unrolled::<A, 5>(x),
            UNROLLED => self.unrolled::<A, UNROLLED>(x),
            _ => self.streamed::<A>(x),
        }
    }

    #[inline(always)]
    fn unrolled<A: Arithmetic, const D: usize>(&self, [x, y, z]: [f64; 3]) -> [f64; 4] {
        let c = &self.coefficients[..(D + 1) * (D + 2) * (D + 3) / 6];
        let mut sum = plane::<A, 0>(c, y, z);
        if D >= 1 {
            sum = scaled_sum::<A, 4>(sum, x, plane::<A, 1>(c, y, z));
        }
        if D >= 2 {
            sum = scaled_sum::<A, 4>(sum, x, plane::<A, 2>(c, y, z));
        }
        if D >= 3 {
            sum = scaled_sum::<A, 4>(sum, x, plane::<A, 3>(c, y, z));
        }
        if D >= 4 {
            sum = scaled_sum::<A, 4>(sum, x, plane::<A, 4>(c, y, z));
        }
        if D >= 5 {
            sum = scaled_sum::<A, 4>(sum, x, plane::<A, 5>(c, y, z));
        }
        if D >= 6 {
            sum = scaled_sum::<A, 4>(sum, x, plane::<A, 6>(c, y, z));
        }
        sum
    }

    #[inline(always)]
    fn streamed<A: Arithmetic>(&self, [x, y, z]: [f64; 3]) -> [f64; 4] {
        let mut terms = self.coefficients.iter();
        let mut sum = [0.0; 4];
        for plane in 0..=self.degree {
            let mut in_y = [0.0; 4];
            for row in 0..=plane {
                let mut in_z = [0.0; 4];
                for term in terms.by_ref().take(row + 1) {
                    in_z = scaled_sum::<A, 4>(in_z, z, *term);
                }
                in_y = scaled_sum::<A, 4>(in_y, y, in_z);
            }
            sum = scaled_sum::<A, 4>(sum, x, in_y);
        }
        sum
    }
}

/// Polynomial in y and z of degree `I`, the coefficient of one power of x.
#[inline(always)]
fn plane<A: Arithmetic, const I: usize>(c: &[[f64; 4]], y: f64, z: f64) -> [f64; 4] {
    let start = I * (I + 1) * (I + 2) / 6;
    let mut sum = line::<A, 1>(c, start, z);
    if I >= 1 {
        sum = scaled_sum::<A, 4>(sum, y, line::<A, 2>(c, start + 1, z));
    }
    if I >= 2 {
        sum = scaled_sum::<A, 4>(sum, y, line::<A, 3>(c, start + 3, z));
    }
    if I >= 3 {
        sum = scaled_sum::<A, 4>(sum, y, line::<A, 4>(c, start + 6, z));
    }
    if I >= 4 {
        sum = scaled_sum::<A, 4>(sum, y, line::<A, 5>(c, start + 10, z));
    }
    if I >= 5 {
        sum = scaled_sum::<A, 4>(sum, y, line::<A, 6>(c, start + 15, z));
    }
    if I >= 6 {
        sum = scaled_sum::<A, 4>(sum, y, line::<A, 7>(c, start + 21, z));
    }
    sum
}

/// Polynomial in z with `L` coefficients.
#[inline(always)]
fn line<A: Arithmetic, const L: usize>(c: &[[f64; 4]], start: usize, z: f64) -> [f64; 4] {
    let mut sum = c[start];
    for term in 1..L {
        sum = scaled_sum::<A, 4>(sum, z, c[start + term]);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::polynomial::Homogeneous;
    use crate::simd::{Fused, Plain};

    #[test]
    fn kernel_agrees_with_the_series_at_every_degree() {
        let x = [0.7, -1.3, 0.4];
        for degree in 0..9 {
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
            for value in [kernel.value::<Plain>(x), kernel.value::<Fused>(x)] {
                for (found, expected) in value.iter().zip(map.vector(x)) {
                    assert!((found - expected).abs() < 1e-13 * expected.abs().max(1.0), "degree {degree}");
                }
            }
        }
    }
}
