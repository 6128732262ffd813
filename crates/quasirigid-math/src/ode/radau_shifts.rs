//! Lanes of the Radau IIA method: the weights of the stages, and the parts at the shifts that decouple them, a lane for each stage or part.
//! Equation (T6), docs/theory/08-full-system.md.

use super::radau_tableau::{A, FROM_EIGEN, SHIFTS, STAGES, TO_EIGEN};
use crate::lanes::{LANES, Lanes};
use crate::simd::Arithmetic;

/// Weights of each stage in the others.
pub(super) const WEIGHTS: [Lanes; STAGES] = {
    let mut columns = [[0.0; LANES]; STAGES];
    let (mut stage, mut other) = (0, 0);
    while stage < STAGES {
        while other < STAGES {
            columns[other][stage] = A[stage][other];
            other += 1;
        }
        (stage, other) = (stage + 1, 0);
    }
    lanes(columns)
};

/// Contribution of each stage to the parts at the shifts: real, then real and imaginary three times; a complex shift counts twice.
pub(super) const TO_SHIFTS: [Lanes; STAGES] = {
    let mut columns = [[0.0; LANES]; STAGES];
    let (mut stage, mut shift) = (0, 1);
    while stage < STAGES {
        columns[stage][0] = TO_EIGEN[0][stage][0];
        while shift < SHIFTS {
            columns[stage][2 * shift - 1] = 2.0 * TO_EIGEN[shift][stage][0];
            columns[stage][2 * shift] = 2.0 * TO_EIGEN[shift][stage][1];
            shift += 1;
        }
        (stage, shift) = (stage + 1, 1);
    }
    lanes(columns)
};

/// Contribution of each part at the shifts to the stages.
pub(super) const FROM_SHIFTS: [Lanes; STAGES] = {
    let mut columns = [[0.0; LANES]; STAGES];
    let (mut stage, mut shift) = (0, 1);
    while stage < STAGES {
        columns[0][stage] = FROM_EIGEN[0][stage][0];
        while shift < SHIFTS {
            columns[2 * shift - 1][stage] = FROM_EIGEN[shift][stage][0];
            columns[2 * shift][stage] = -FROM_EIGEN[shift][stage][1];
            shift += 1;
        }
        (stage, shift) = (stage + 1, 1);
    }
    lanes(columns)
};

const fn lanes(columns: [[f64; LANES]; STAGES]) -> [Lanes; STAGES] {
    let mut result = [Lanes::splat(0.0); STAGES];
    let mut i = 0;
    while i < STAGES {
        result[i] = Lanes(columns[i]);
        i += 1;
    }
    result
}

/// Product with a complex number at each shift: factors of the parts, and of the parts with real and imaginary exchanged.
pub(super) fn factors(numbers: [[f64; 2]; SHIFTS]) -> [Lanes; 2] {
    let [[a, _], [b, bi], [c, ci], [d, di]] = numbers;
    [Lanes([a, b, b, c, c, d, d, 0.0]), Lanes([0.0, -bi, bi, -ci, ci, -di, di, 0.0])]
}

/// Parts at the shifts with real and imaginary exchanged.
#[inline(always)]
pub(super) fn exchanged(Lanes([a, b, c, d, e, f, g, h]): Lanes) -> Lanes {
    Lanes([a, c, b, e, d, g, f, h])
}

/// `start + Σ column · entry` over the first seven entries of the lanes.
#[inline(always)]
pub(super) fn product<R: Arithmetic>(columns: &[Lanes; STAGES], entries: Lanes, start: Lanes) -> Lanes {
    let mut even = start;
    let mut odd = columns[1] * Lanes::splat(entries.0[1]);
    even = columns[0].mul_add::<R>(Lanes::splat(entries.0[0]), even);
    even = columns[2].mul_add::<R>(Lanes::splat(entries.0[2]), even);
    odd = columns[3].mul_add::<R>(Lanes::splat(entries.0[3]), odd);
    even = columns[4].mul_add::<R>(Lanes::splat(entries.0[4]), even);
    odd = columns[5].mul_add::<R>(Lanes::splat(entries.0[5]), odd);
    even = columns[6].mul_add::<R>(Lanes::splat(entries.0[6]), even);
    even + odd
}

/// Sum over the lanes.
#[inline(always)]
pub(super) fn sum(Lanes([a, b, c, d, e, f, g, h]): Lanes) -> f64 {
    ((a + e) + (c + g)) + ((b + f) + (d + h))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::Unfused;

    const ENTRIES: Lanes = Lanes([0.3, -1.2, 0.7, 2.1, -0.4, 0.9, 1.6, 0.0]);

    /// There and back the parts are the stages.
    #[test]
    fn parts_at_the_shifts_are_the_stages_transformed() {
        let zero = Lanes::splat(0.0);
        let parts = product::<Unfused>(&TO_SHIFTS, ENTRIES, zero);
        let found = product::<Unfused>(&FROM_SHIFTS, parts, zero);
        for lane in 0..LANES {
            // the transformation magnifies rounding by its size, some hundreds
            assert!((found.0[lane] - ENTRIES.0[lane]).abs() < 1e-12, "{lane}: {found:?}");
        }
    }

    /// The weights become the inverse of the eigenvalues.
    #[test]
    fn weights_are_diagonal_at_the_shifts() {
        let zero = Lanes::splat(0.0);
        let weighted = product::<Unfused>(&WEIGHTS, ENTRIES, zero);
        let parts = product::<Unfused>(&TO_SHIFTS, weighted, zero);
        let [straight, crossed] = factors(super::super::radau_tableau::GAMMA);
        let found = straight * parts + crossed * exchanged(parts);
        let known = product::<Unfused>(&TO_SHIFTS, ENTRIES, zero);
        for lane in 0..LANES {
            let size = known.0[lane].abs().max(1.0);
            assert!((found.0[lane] - known.0[lane]).abs() < 1e-11 * size, "{lane}: {found:?} {known:?}");
        }
    }
}
