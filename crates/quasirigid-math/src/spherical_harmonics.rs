//! Real spherical harmonics without angles, so that they are regular over the poles, and series where the direction is one.

use std::f64::consts::TAU;
use std::sync::LazyLock;

use super::quadrature::gauss_legendre;
use super::scalar::Scalar;

/// Number of real harmonics up to a degree.
#[must_use]
pub const fn count(degree: usize) -> usize {
    (degree + 1) * (degree + 1)
}

/// Calls back with the degree and the value of every real harmonic up to a degree at a unit vector, always in the same order: by the order
/// `m`, then by the degree, cosine before sine.
///
/// Each has the mean square one over the sphere, so that `Σ_m Y_lm(a) Y_lm(b) = (2l+1) P_l(a·b)`.
#[inline(always)]
pub fn each_harmonic<T: Scalar>(degree: usize, [x, y, z]: [T; 3], mut found: impl FnMut(usize, T)) {
    let mut sectoral = T::from(1.0); // of degree and order m, without the factor cos mφ or sin mφ
    let (mut cos, mut sin) = (T::from(1.0), T::from(0.0));
    for m in 0..=degree {
        if m > 0 {
            (cos, sin) = (x * cos - y * sin, x * sin + y * cos);
            // √2 once, for the mean square of cos mφ
            let rise = if m == 1 { 3.0 } else { (2 * m + 1) as f64 / (2 * m) as f64 };
            sectoral = sectoral.scaled(rise.sqrt());
        }
        let (mut before, mut here) = (T::from(0.0), sectoral);
        for l in m..=degree {
            if l > m {
                let [rise, fall] = factors(l, m);
                (before, here) = (here, (z * here).scaled(rise) - before.scaled(fall));
            }
            found(l, here * cos);
            if m > 0 {
                found(l, here * sin);
            }
        }
    }
}

/// Degree up to which the factors of the recursion are kept.
const KEPT: usize = 64;

static FACTORS: LazyLock<Vec<[f64; 2]>> =
    LazyLock::new(|| (1..=KEPT).flat_map(|l| (0..l).map(move |m| recursion(l, m))).collect());

/// Factors of `z` times the harmonic of the degree `l − 1` and of that of the degree `l − 2`, of the order `m < l`.
fn factors(l: usize, m: usize) -> [f64; 2] {
    FACTORS
        .get(if l <= KEPT { l * (l - 1) / 2 + m } else { usize::MAX })
        .copied()
        .unwrap_or_else(|| recursion(l, m))
}

fn recursion(l: usize, m: usize) -> [f64; 2] {
    let square = |n: usize| (n * n) as f64;
    let rise = ((4.0 * square(l) - 1.0) / (square(l) - square(m))).sqrt();
    let fall = ((square(l - 1) - square(m)) / (4.0 * square(l - 1) - 1.0)).sqrt();
    [rise, rise * fall]
}

/// Unit vectors and weights, of the sum one, that integrate every polynomial up to a degree over the sphere exactly: Gauss's rule along the
/// axis, equal steps about it.
#[must_use]
pub fn sphere_rule(degree: usize) -> Vec<([f64; 3], f64)> {
    let longitudes = degree + 1;
    let rule = gauss_legendre(degree / 2 + 1);
    let ring = |[z, weight]: [f64; 2]| {
        let across = ((1.0 - z) * (1.0 + z)).sqrt();
        (0..longitudes).map(move |step| {
            let (sin, cos) = (TAU * step as f64 / longitudes as f64).sin_cos();
            ([across * cos, across * sin, z], 0.5 * weight / longitudes as f64)
        })
    };
    rule.into_iter().flat_map(ring).collect()
}

/// Legendre polynomials up to a degree.
#[must_use]
pub fn legendre(degree: usize, x: f64) -> Vec<f64> {
    let mut values = vec![1.0; degree + 1];
    for l in 1..=degree {
        let (n, before) = (l as f64, if l > 1 { values[l - 2] } else { 0.0 });
        values[l] = ((2.0 * n - 1.0) * x * values[l - 1] - (n - 1.0) * before) / n;
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vec3::{dot, unit};

    fn harmonics(degree: usize, at: [f64; 3]) -> Vec<(usize, f64)> {
        let mut values = Vec::new();
        each_harmonic(degree, at, |l, value| values.push((l, value)));
        values
    }

    /// The addition theorem, of Legendre polynomials by their own recursion, holds at the poles too.
    #[test]
    fn harmonics_of_two_directions_add_to_legendre_polynomials() {
        let a = unit([0.3, -0.8, 0.4]);
        for b in [unit([-1.0, 0.2, 0.7]), [0.0, 0.0, 1.0], [0.0, -1.0, 0.0], a] {
            let (at_a, at_b) = (harmonics(9, a), harmonics(9, b));
            assert_eq!(at_a.len(), count(9));
            for (l, known) in legendre(9, dot(a, b)).into_iter().enumerate() {
                let sum: f64 =
                    at_a.iter().zip(&at_b).filter(|((m, _), _)| *m == l).map(|((_, p), (_, q))| p * q).sum();
                let known = (2 * l + 1) as f64 * known;
                assert!((sum - known).abs() < 1e-12, "{l}: {sum} {known}");
            }
        }
    }

    #[test]
    fn harmonics_are_orthonormal_by_a_rule_of_twice_their_degree() {
        let rule: Vec<_> =
            sphere_rule(10).into_iter().map(|(at, weight)| (harmonics(5, at), weight)).collect();
        for i in 0..count(5) {
            for j in 0..=i {
                let mean: f64 = rule.iter().map(|(values, weight)| weight * values[i].1 * values[j].1).sum();
                let known = if i == j { 1.0 } else { 0.0 };
                assert!((mean - known).abs() < 1e-13, "{i} {j} {mean}");
            }
        }
    }
}
