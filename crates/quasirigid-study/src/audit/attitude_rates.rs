//! Angular velocity of an attitude alone, by differences of exact relative rotations, with its error.
//!
//! The rotation vectors from a row to its neighbours, body axes, `φⱼ = log(q̄ ⊗ qⱼ)`, are points of a smooth curve through zero whose slope there is
//! `ω`: the differential of the exponential map is one at zero. The slope is that of the polynomial through seven rows, of sixth order; its
//! distance from the slope through six of them, of fifth order, and the rounding of the quaternions are its error. (J4)

use quasirigid_math::rotation::{normalized, product, rotation_vector};
use quasirigid_math::vec3::{add, norm, scale};

/// Rows on each side of the one whose rate is found.
pub const REACH: usize = 3;
/// Rows that give rates enough for a trend.
pub const FEWEST: usize = 2 * REACH + 2;
/// Largest rotation (rad) from row to row: over [`REACH`] rows it stays below a half turn.
pub const LARGEST_TURN: f64 = 1.0;
/// Rotation (rad) by which a quaternion may be off whose four parts are each off by one.
const OF_PARTS: f64 = 4.0;

/// Rates of an attitude.
#[derive(Clone, Debug)]
pub struct AttitudeRates {
    /// Angular velocity (rad/s), body axes, of all rows but [`REACH`] at each end.
    pub rates: Vec<[f64; 3]>,
    /// Most by which a component may be off (rad/s).
    pub error: f64,
}

impl AttitudeRates {
    /// Rates of unit quaternions from body to inertial axes at ascending times (s), of [`FEWEST`] rows or more that are [`LARGEST_TURN`] apart at
    /// most. Parts of quaternions are off by `rounding`.
    pub fn of(t: &[f64], attitude: &[[f64; 4]], rounding: f64) -> Self {
        let (mut apart, mut off) = (0.0_f64, 0.0_f64);
        let rates = (REACH..t.len() - REACH).map(|row| {
            let near: Vec<usize> = (row - REACH..=row + REACH).filter(|other| *other != row).collect();
            let [all, fewer] = [&near[..], &near[..near.len() - 1]].map(|near| weights(t, row, near));
            let turns: Vec<[f64; 3]> =
                near.iter().map(|other| relative(attitude[row], attitude[*other])).collect();
            let slope = |weights: &[f64]| {
                weights
                    .iter()
                    .zip(&turns)
                    .fold([0.0; 3], |sum, (weight, turn)| add(sum, scale(*weight, *turn)))
            };
            let rate = slope(&all);
            apart = apart.max(norm(add(rate, scale(-1.0, slope(&fewer)))));
            off = off.max(OF_PARTS * rounding * all.iter().map(|weight| weight.abs()).sum::<f64>());
            rate
        });
        let rates = rates.collect();
        Self { rates, error: apart + off }
    }
}

/// The first row that turns farther from the one before than [`LARGEST_TURN`], and the angle (rad).
pub fn too_far(attitude: &[[f64; 4]]) -> Option<(usize, f64)> {
    let turns = attitude.windows(2).map(|pair| norm(relative(pair[0], pair[1])));
    turns.enumerate().map(|(before, turn)| (before + 1, turn)).find(|(_, turn)| *turn > LARGEST_TURN)
}

/// Weights of the values at other rows in the slope at a row, where the value is zero: those of the polynomial through all.
fn weights(t: &[f64], row: usize, near: &[usize]) -> Vec<f64> {
    let at = |other: usize| t[other] - t[row];
    let weight = |one: &usize| {
        let others = near.iter().filter(|other| *other != one);
        others.map(|other| at(*other) / (at(*other) - at(*one))).product::<f64>() / at(*one)
    };
    near.iter().map(weight).collect()
}

/// Rotation vector (rad) from one attitude to another, in the body axes of the first.
fn relative(from: [f64; 4], to: [f64; 4]) -> [f64; 3] {
    let [w, x, y, z] = normalized(from);
    rotation_vector(product([w, -x, -y, -z], normalized(to)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Attitude and angular velocity of a precession at 0.7 rad/s about the inertial z, a tilt of 0.4 rad, a spin of 0.9 rad/s.
    fn motion(t: f64) -> ([f64; 4], [f64; 3]) {
        let half = |angle: f64| (0.5 * angle).sin_cos();
        let ((sp, cp), (st, ct), (ss, cs)) = (half(0.7 * t), half(0.4), half(0.9 * t));
        let q = product(product([cp, 0.0, 0.0, sp], [ct, st, 0.0, 0.0]), [cs, 0.0, 0.0, ss]);
        let (s, c) = (0.9 * t).sin_cos();
        (q, [0.7 * 0.4_f64.sin() * s, 0.7 * 0.4_f64.sin() * c, 0.9 + 0.7 * 0.4_f64.cos()])
    }

    /// Error of the rates at rows of a spacing, uneven by a share of it, and the error that is told.
    fn errors(spacing: f64, uneven: f64) -> [f64; 2] {
        let t: Vec<f64> =
            (0..200).map(|k| spacing * (f64::from(k) + uneven * (1.7 * f64::from(k)).sin())).collect();
        // a quaternion and its negative are the same attitude
        let signed = |(k, t): (usize, &f64)| motion(*t).0.map(|part| if k % 3 == 0 { -part } else { part });
        let attitude: Vec<[f64; 4]> = t.iter().enumerate().map(signed).collect();
        let found = AttitudeRates::of(&t, &attitude, 0.5 * f64::EPSILON);
        assert_eq!(found.rates.len(), 194);
        let error = |(rate, t): (&[f64; 3], &f64)| norm(add(*rate, scale(-1.0, motion(*t).1)));
        let worst = found.rates.iter().zip(&t[REACH..]).map(error).fold(0.0, f64::max);
        [worst, found.error]
    }

    #[test]
    fn rates_are_of_sixth_order_within_the_error_told() {
        for uneven in [0.0, 0.2] {
            let [coarse, fine] = [0.2, 0.1].map(|spacing| errors(spacing, uneven));
            for [error, told] in [coarse, fine] {
                assert!(error < told && told < 100.0 * error, "{uneven}: {error:e} {told:e}");
            }
            let order = (coarse[0] / fine[0]).log2();
            assert!((order - 6.0).abs() < 0.2, "{uneven}: {order}");
        }
    }

    #[test]
    fn rounding_is_covered() {
        for digits in [1e5, 1e8] {
            let t: Vec<f64> = (0..400).map(|k| 0.05 * f64::from(k)).collect();
            let attitude: Vec<[f64; 4]> =
                t.iter().map(|t| motion(*t).0.map(|part| (part * digits).round() / digits)).collect();
            let found = AttitudeRates::of(&t, &attitude, 0.5 / digits);
            let rows = found.rates.iter().zip(&t[REACH..]);
            let worst = rows.map(|(rate, t)| norm(add(*rate, scale(-1.0, motion(*t).1)))).fold(0.0, f64::max);
            assert!(worst < found.error && found.error < 20.0 * worst, "{worst:e} {:e}", found.error);
        }
    }

    #[test]
    fn a_row_too_far_is_found() {
        let attitude = |spacing: f64| [0.0, 1.0, 2.0].map(|k| motion(spacing * k).0);
        assert_eq!(too_far(&attitude(0.6)), None);
        let (row, turn) = too_far(&attitude(0.8)).unwrap();
        assert!(row == 1 && turn > 1.0 && turn < 1.3, "{row} {turn}");
    }
}
