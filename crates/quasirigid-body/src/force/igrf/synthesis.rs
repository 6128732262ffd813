//! Gradient of a potential of solid harmonics, without angles, so that it is regular over the poles.
//! Recursions of Cunningham for `V + iW = (R/r)^{n+1} P_nm(cos θ) e^{imλ}`, equation (F21), docs/theory/07-forces.md.

use super::table::PAIRS;
use crate::math::scalar::Scalar;

/// Harmonics of one degree more than the coefficients, by `n(n+1)/2 + m`.
const HARMONICS: usize = 120;

/// Field `−∇ R Σ (g V + h W)` of the coefficients `g, h` up to a degree, at a place in radii of the Earth, with `1/r²` and `1/r`.
pub(super) fn field<S: Scalar>(
    coefficients: &[[f64; 2]; PAIRS],
    degree: usize,
    place: [S; 3],
    powers: [S; 2],
) -> [S; 3] {
    let (V, W) = harmonics(degree + 1, place, powers);
    let at = |n: usize, m: usize| n * (n + 1) / 2 + m;
    let number = |value: f64| S::from(value);
    let mut sum = [number(0.0); 3];
    let mut add = |axis: usize, part: S| sum[axis] = sum[axis] + part;
    for n in 1..=degree {
        for m in 0..=n {
            let [g, h] = coefficients[at(n, m)].map(number);
            let (above, below) = (at(n + 1, m + 1), at(n + 1, m));
            add(2, number((n - m + 1) as f64) * (g * V[below] + h * W[below]));
            if m == 0 {
                add(0, g * V[above]);
                add(1, g * W[above]);
                continue;
            }
            let before = at(n + 1, m - 1);
            let half = number(0.5);
            let share = number(0.5 * ((n - m + 2) * (n - m + 1)) as f64);
            add(0, half * (g * V[above] + h * W[above]) - share * (g * V[before] + h * W[before]));
            add(1, half * (g * W[above] - h * V[above]) + share * (g * W[before] - h * V[before]));
        }
    }
    sum
}

/// `V` and `W` up to a degree.
fn harmonics<S: Scalar>(
    degree: usize,
    [x, y, z]: [S; 3],
    [per_square, per_radius]: [S; 2],
) -> ([S; HARMONICS], [S; HARMONICS]) {
    let (mut V, mut W) = ([S::from(0.0); HARMONICS], [S::from(0.0); HARMONICS]);
    let at = |n: usize, m: usize| n * (n + 1) / 2 + m;
    let [X, Y, Z] = [x, y, z].map(|entry| entry * per_square);
    V[0] = per_radius;
    for m in 0..=degree {
        if m > 0 {
            let (here, last, odd) = (at(m, m), at(m - 1, m - 1), S::from((2 * m - 1) as f64));
            V[here] = odd * (X * V[last] - Y * W[last]);
            W[here] = odd * (X * W[last] + Y * V[last]);
        }
        for n in m + 1..=degree {
            let rising = S::from((2 * n - 1) as f64 / (n - m) as f64) * Z;
            let (here, last) = (at(n, m), at(n - 1, m));
            (V[here], W[here]) = (rising * V[last], rising * W[last]);
            if n > m + 1 {
                let falling = S::from((n + m - 1) as f64 / (n - m) as f64) * per_square;
                let before = at(n - 2, m);
                V[here] = V[here] - falling * V[before];
                W[here] = W[here] - falling * W[before];
            }
        }
    }
    (V, W)
}
