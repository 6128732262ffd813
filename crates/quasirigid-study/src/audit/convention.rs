//! Convention of an attitude, from its agreement with the rates: place of the scalar, direction of the rotation, axes of the rates.
//!
//! The rotation from one row to another must be the integral of the rates, in body axes `q̄ₐ ⊗ q_b`, in inertial ones `q_b ⊗ q̄ₐ`. (P3) A quaternion
//! of the JPL convention has the numbers of Hamilton's conjugate, and is found as one of the other direction.

use quasirigid_math::rotation::{normalized, product, rotation_vector};
use quasirigid_math::vec3::{add, dot, scale};

/// Convention of an attitude.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Convention {
    /// Whether the scalar stands first, not last.
    pub scalar_first: bool,
    /// Whether the quaternion takes body components to inertial ones, not the reverse.
    pub to_inertial: bool,
    /// Whether the rates are in body axes, not in inertial ones.
    pub body_rates: bool,
}

/// Agreement of an attitude in a convention with the rates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Agreement {
    /// The convention.
    pub convention: Convention,
    /// Factor of the units of rates and times, as in (J2).
    pub factor: f64,
    /// Share of the rotations that the rates leave unexplained, as a root of squares.
    pub misfit: f64,
}

/// Stretches of rows that are compared.
const STRETCHES: usize = 1000;
/// Rotation (rad) over a stretch that is enough for its digits, and the largest that is still told from its complement.
const ENOUGH: f64 = 0.1;
const LARGEST: f64 = 2.5;

impl Convention {
    /// All conventions, the usual first; of a scalar at a known place those with it first.
    pub fn all(scalar_known: bool) -> impl Iterator<Item = Self> {
        let places = if scalar_known { &[true][..] } else { &[true, false] };
        places.iter().flat_map(|scalar_first| {
            [(true, true), (false, true), (true, false), (false, false)].map(|(to_inertial, body_rates)| {
                Self { scalar_first: *scalar_first, to_inertial, body_rates }
            })
        })
    }

    /// Quaternion, scalar first, from body to inertial axes, of four numbers of a file.
    pub fn attitude(self, stored: [f64; 4]) -> [f64; 4] {
        let [a, b, c, d] = stored;
        let [w, x, y, z] = if self.scalar_first { stored } else { [d, a, b, c] };
        if self.to_inertial { [w, x, y, z] } else { [w, -x, -y, -z] }
    }

    /// The convention of the quaternion in words.
    pub fn attitude_words(self) -> String {
        format!(
            "scalar {}, from {} axes",
            if self.scalar_first { "first" } else { "last" },
            if self.to_inertial { "body to inertial" } else { "inertial to body" }
        )
    }

    /// The convention in words.
    pub fn words(self) -> String {
        let axes = if self.body_rates { "body" } else { "inertial" };
        format!("{}, rates in {axes} axes", self.attitude_words())
    }
}

/// Agreement in each convention in which the rotation has the sense of the rates, the best first; none where rows are too far apart to compare.
pub fn agreements(
    t: &[f64],
    rates: &[[f64; 3]],
    stored: &[[f64; 4]],
    scalar_known: bool,
) -> Option<Vec<Agreement>> {
    let stride = stride(stored)?;
    let starts = stored.len() - stride;
    let count = starts.min(STRETCHES);
    let stretches: Vec<(usize, [f64; 3])> = (0..count)
        .map(|k| k * starts / count)
        .map(|start| (start, integral(&t[start..=start + stride], &rates[start..=start + stride])))
        .collect();
    let of = |convention: Convention| {
        let (mut both, mut turned, mut rated) = (0.0, 0.0, 0.0);
        for (start, integral) in &stretches {
            let turn = rotation(convention, stored[*start], stored[start + stride]);
            both += dot(turn, *integral);
            turned += dot(turn, turn);
            rated += dot(*integral, *integral);
        }
        let misfit = (1.0 - both * both / (turned * rated)).max(0.0).sqrt();
        Agreement { convention, factor: both / rated, misfit }
    };
    let mut found: Vec<Agreement> =
        Convention::all(scalar_known).map(of).filter(|found| found.factor > 0.0).collect();
    found.sort_by(|a, b| a.misfit.total_cmp(&b.misfit));
    Some(found)
}

/// Rows over which the attitude turns by much, and by less than a half turn.
fn stride(stored: &[[f64; 4]]) -> Option<usize> {
    let mut stride = 1;
    loop {
        let starts = stored.len().checked_sub(stride).filter(|starts| *starts > 0)?;
        let count = starts.min(STRETCHES);
        // the cosine of half the angle is the same wherever the scalar stands
        let half = |start: usize| {
            let cosine: f64 = stored[start].iter().zip(stored[start + stride]).map(|(a, b)| a * b).sum();
            2.0 * cosine.abs().min(1.0).acos()
        };
        let angles = (0..count).map(|k| half(k * starts / count));
        let mean = angles.sum::<f64>() / count as f64;
        if mean > LARGEST {
            return None;
        }
        if mean >= ENOUGH || 4 * stride >= stored.len() {
            return Some(stride);
        }
        stride *= 2;
    }
}

/// Integral of the rates over rows, by the trapezoidal rule.
fn integral(t: &[f64], rates: &[[f64; 3]]) -> [f64; 3] {
    let pieces = t.windows(2).zip(rates.windows(2));
    pieces.fold([0.0; 3], |sum, (t, w)| add(sum, scale(0.5 * (t[1] - t[0]), add(w[0], w[1]))))
}

/// Rotation vector from one attitude to another, in the axes of the rates.
fn rotation(convention: Convention, from: [f64; 4], to: [f64; 4]) -> [f64; 3] {
    let [from, to] = [from, to].map(|stored| normalized(convention.attitude(stored)));
    let [w, x, y, z] = from;
    let back = [w, -x, -y, -z];
    rotation_vector(if convention.body_rates { product(back, to) } else { product(to, back) })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A precessing motion written out in every convention is found in its own.
    #[test]
    fn each_convention_is_found() {
        let t: Vec<f64> = (0..400).map(|k| 0.05 * f64::from(k)).collect();
        let half = |angle: f64| (0.5 * angle).sin_cos();
        let motion = |t: f64| {
            // precession 0.7 rad/s about z, tilt 0.4 rad, spin 0.9 rad/s about the body's z
            let ((sp, cp), (st, ct), (ss, cs)) = (half(0.7 * t), half(0.4), half(0.9 * t));
            let q = product(product([cp, 0.0, 0.0, sp], [ct, st, 0.0, 0.0]), [cs, 0.0, 0.0, ss]);
            let (s, c) = (0.9 * t).sin_cos();
            let body = [0.7 * 0.4_f64.sin() * s, 0.7 * 0.4_f64.sin() * c, 0.9 + 0.7 * 0.4_f64.cos()];
            (q, body)
        };
        for convention in Convention::all(false) {
            let rows = t.iter().map(|t| motion(*t));
            let stored = |[w, x, y, z]: [f64; 4]| {
                let [w, x, y, z] = if convention.to_inertial { [w, x, y, z] } else { [w, -x, -y, -z] };
                if convention.scalar_first { [w, x, y, z] } else { [x, y, z, w] }
            };
            let rate = |q, body| {
                if convention.body_rates { body } else { quasirigid_math::rotation::to_inertial(q, body) }
            };
            let (written, rates): (Vec<_>, Vec<_>) =
                rows.map(|(q, body)| (stored(q), scale(10.0, rate(q, body)))).unzip();
            let found = agreements(&t, &rates, &written, false).unwrap();
            assert_eq!(found[0].convention, convention);
            assert!(found[0].misfit < 2e-3 && found[1].misfit > 0.1, "{found:?}");
            assert!((found[0].factor - 0.1).abs() < 1e-4);
        }
    }
}
