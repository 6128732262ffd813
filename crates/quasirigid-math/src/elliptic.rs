//! Elliptic integrals and functions; the only file that names their library.
//!
//! Next to the parameter `m = k²` stands its complement `1 − m`: where one of them is small it is given as a number of its own, and no
//! digits are lost.

use std::f64::consts::PI;

use crate::scalar::Scalar;

/// Complete integral of the first kind `K(m)`, for `0 ≤ m < 1`; infinite at 1.
#[must_use]
pub fn complete_first(m: f64) -> f64 {
    first_of_complement(1.0 - m)
}

/// Nome `exp(−π K(1−m)/K(m))`.
#[must_use]
pub fn nome(m: f64) -> f64 {
    (-PI * first_of_complement(m) / complete_first(m)).exp()
}

/// Parameter below which [`nome_over_parameter`] is the nome over the parameter to rounding.
pub const SMALL_PARAMETER: f64 = 1e-5;

/// Nome over the parameter `m` by its power series, for `m` below [`SMALL_PARAMETER`]: finite where both vanish.
#[inline(always)]
#[must_use]
pub fn nome_over_parameter<T: Scalar>(m: T) -> T {
    let number = T::from;
    let x = m * number(1.0 / 16.0);
    (number(1.0) + x * (number(8.0) + x * (number(84.0) + number(992.0) * x))) * number(1.0 / 16.0)
}

/// `K(1 − m)`, which loses no digits for small `m`: Carlson's `R_F(0, m, 1)`.
#[must_use]
pub fn first_of_complement(m: f64) -> f64 {
    if m > 0.0 { ellip::elliprf(0.0, m, 1.0).unwrap_or(f64::INFINITY) } else { f64::INFINITY }
}

/// Integral of the first kind `F(φ | m)` with `m = 1 − complement`, at any angle.
#[must_use]
pub fn first_to(angle: f64, complement: f64) -> f64 {
    let half_turns = (angle / PI).round();
    let (sine, cosine) = (angle - PI * half_turns).sin_cos();
    let square = cosine * cosine;
    let rest = sine * ellip::elliprf(square, square + complement * sine * sine, 1.0).unwrap_or(f64::NAN);
    if half_turns == 0.0 { rest } else { rest + 2.0 * half_turns * first_of_complement(complement) }
}

/// Excess of the integral of the third kind over the first, `∫ (1/(1 − n sn²) − 1) du` from 0 to `u`, for `n ≤ 0`.
#[must_use]
pub fn third_excess_to(u: f64, n: f64, complement: f64) -> f64 {
    let quarter = first_of_complement(complement);
    let halves = if quarter.is_finite() { (u / (2.0 * quarter)).round() } else { 0.0 };
    let rest = if halves == 0.0 { u } else { u - 2.0 * quarter * halves };
    let [sn, cn, dn] = jacobi(rest, complement);
    let part = sn.powi(3) * carlson_third(cn * cn, dn * dn, 1.0 - n * sn * sn);
    let whole = if halves == 0.0 { 0.0 } else { 2.0 * halves * carlson_third(0.0, complement, 1.0 - n) };
    n / 3.0 * (part + whole)
}

/// `Π(n | m)/K(m) − 1` for `n ≤ 0`: the mean of `1/(1 − n sn²) − 1` over a period.
#[must_use]
pub fn complete_third_excess(n: f64, complement: f64) -> f64 {
    n / 3.0 * carlson_third(0.0, complement, 1.0 - n) / first_of_complement(complement)
}

/// `R_J(x, y, 1, p)`.
fn carlson_third(x: f64, y: f64, p: f64) -> f64 {
    ellip::elliprj(x, y, 1.0, p).unwrap_or(f64::NAN)
}

/// Jacobi's `sn u`, `cn u`, `dn u` where the parameter is `m = 1 − complement`, with `0 ≤ complement ≤ 1`.
///
/// Descending Landen transformation `[@bulirsch1965]`; the error is a rounding or two of the larger of `u` and 1.
#[must_use]
pub fn jacobi(u: f64, complement: f64) -> [f64; 3] {
    if complement <= 0.0 {
        return [u.tanh(), u.cosh().recip(), u.cosh().recip()];
    }
    let (mut a, mut root) = (1.0, complement.sqrt());
    let mut scales = [[0.0; 2]; LANDEN];
    let mut steps = 0;
    let mean = loop {
        scales[steps] = [a, root];
        steps += 1;
        let mean = 0.5 * (a + root);
        if (a - root).abs() <= 1e-8 * a || steps == LANDEN {
            break mean;
        }
        root = (a * root).sqrt();
        a = mean;
    };
    let (sine, cosine) = (mean * u).sin_cos();
    if sine == 0.0 {
        return [0.0, cosine, 1.0];
    }
    let mut ratio = cosine / sine;
    let mut c = mean * ratio;
    let mut dn = 1.0;
    for [a, root] in scales[..steps].iter().rev() {
        ratio *= c;
        c *= dn;
        dn = (root + ratio) / (a + ratio);
        ratio = c / a;
    }
    let sn = (c * c + 1.0).sqrt().recip().copysign(sine);
    [sn, c * sn, dn]
}

/// Landen steps that bring any complement, down to the smallest number, to a circle.
const LANDEN: usize = 24;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integral_and_nome_have_their_tabulated_values() {
        // Abramowitz & Stegun, table 17.1, m = 0.5: 15 digits.
        assert!((complete_first(0.5) - 1.854_074_677_301_372).abs() < 1e-15);
        assert!((nome(0.5) - (-PI).exp()).abs() < 1e-16);
        assert!((nome(1e-12) / (1e-12 / 16.0) - 1.0).abs() < 1e-11);
    }
}
