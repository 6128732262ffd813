//! Compiled quadratic maps, whose monomials several maps of one point share.

use super::kernel::Number;
use super::{Homogeneous, Series};
use crate::simd::Arithmetic;

/// Powers of the monomials x², xy, xz, y², yz, z².
const POWERS: [[usize; 3]; 6] = [[2, 0, 0], [1, 1, 0], [1, 0, 1], [0, 2, 0], [0, 1, 1], [0, 0, 2]];

/// A quadratic map of at most four rows, compiled for fast evaluation.
#[derive(Clone, Debug, PartialEq)]
pub struct QuadraticKernel([[f64; 4]; 6]);

impl QuadraticKernel {
    /// Compiles a map of at most four rows; none where it has parts of another degree.
    #[must_use]
    pub fn new(map: &Series) -> Option<Self> {
        let other = (0..=map.degree()).filter(|degree| *degree != 2).map(|degree| map.part(degree));
        let is_quadratic =
            map.degree() >= 2 && other.into_iter().all(|part: &Homogeneous| part.amax() == 0.0);
        is_quadratic.then(|| {
            Self(POWERS.map(|powers| {
                let mut rows = [0.0; 4];
                for (row, entry) in rows.iter_mut().enumerate().take(map.rows()) {
                    *entry = map.coefficient(row, powers);
                }
                rows
            }))
        })
    }

    /// Monomials of a point, or of one point in each lane.
    #[inline(always)]
    #[must_use]
    pub fn monomials<N: Number>([x, y, z]: [N; 3]) -> [N; 6] {
        [x * x, x * y, x * z, y * y, y * z, z * z]
    }

    /// First three rows at the monomials of a point.
    #[inline(always)]
    #[must_use]
    pub fn vector<A: Arithmetic, N: Number>(&self, monomials: &[N; 6]) -> [N; 3] {
        let mut sum = N::coefficients([0.0; 4]);
        for (coefficients, monomial) in self.0.iter().zip(monomials) {
            sum = N::next::<A, 3>(N::coefficients(*coefficients), *monomial, sum);
        }
        N::array(sum)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::Unfused;

    #[test]
    fn quadratic_maps_agree_with_the_series_and_others_are_none() {
        let mut map = Series::zero(2, 3);
        let mut part = Homogeneous::zero(2, 3);
        for (i, c) in part.coefficients_mut().flatten().enumerate() {
            *c = (1.0 + i as f64).sin();
        }
        map.set(part);
        let kernel = QuadraticKernel::new(&map).unwrap();
        let x = [0.7, -1.3, 0.4];
        let found = kernel.vector::<Unfused, f64>(&QuadraticKernel::monomials(x));
        for (found, expected) in found.iter().zip(map.vector(x)) {
            assert!((found - expected).abs() < 1e-15, "{found} {expected}");
        }
        map.set(Homogeneous::constant(&[0.0, 1e-9, 0.0]));
        assert_eq!(QuadraticKernel::new(&map), None);
    }
}
