use nalgebra::{Complex, Matrix3, Vector3};

use crate::model::LiquidMemory;

/// Terms of the continued fraction beyond the size of its argument.
const TERMS: usize = 30;
/// Argument from which the asymptotic series is as exact.
const LARGE: f64 = 400.0;

/// Force per rate of a liquid at a complex frequency `s` (1/s): `D = I s/(1 − χ)`, with the share `χ` of its momentum that
/// follows the wall. (C11)
pub(crate) fn impedance(memory: &LiquidMemory, s: Complex<f64>) -> Complex<f64> {
    let LiquidMemory { index, inertia, time, .. } = *memory;
    if s.norm() == 0.0 {
        return Complex::from(4.0 * (index + 1.0) * (index + 2.0) * inertia / time);
    }
    let z = (s * time).sqrt();
    let beyond = ratio(index + 1.0, z);
    let share = beyond / (2.0 * (index + 1.0) / z + beyond);
    s * inertia / share
}

/// The same in a body that turns with the mean spin `spin` (rad/s): a frequency in the body is another one in space for the
/// motions of a ball that circle the spin. A liquid with one axis, as in a ring, flows along its tube, where the force of Coriolis
/// has no part. (C11)
pub(crate) fn turned_impedance(
    memory: &LiquidMemory,
    s: Complex<f64>,
    spin: Vector3<f64>,
) -> Matrix3<Complex<f64>> {
    let rate = if memory.axes.len() > 1 { spin.norm() } else { 0.0 };
    let along = impedance(memory, s);
    if rate == 0.0 {
        return Matrix3::from_diagonal_element(along);
    }
    let axis = spin / rate;
    let projection = (axis * axis.transpose()).map(Complex::from);
    let across = Matrix3::identity() - projection;
    let turn = axis.cross_matrix().map(|entry| Complex::new(0.0, entry));
    let half = Complex::from(0.5);
    let [faster, slower] = [rate, -rate].map(|shift| impedance(memory, s + Complex::new(0.0, shift)));
    projection * along + (across - turn) * (half * faster) + (across + turn) * (half * slower)
}

/// `I_{ν+1}(z)/I_ν(z)` of modified Bessel functions, in the right half-plane.
fn ratio(index: f64, z: Complex<f64>) -> Complex<f64> {
    if z.norm() > LARGE {
        return asymptotic(index + 1.0, z) / asymptotic(index, z);
    }
    let terms = TERMS + (1.5 * z.norm()).ceil() as usize;
    let lowest = Complex::from(0.0);
    (1..=terms).rev().fold(lowest, |rest, k| (2.0 * (index + k as f64) / z + rest).inv())
}

/// `I_ν(z)` over `e^z/√(2πz)`, for large arguments.
fn asymptotic(index: f64, z: Complex<f64>) -> Complex<f64> {
    let square = 4.0 * index * index;
    let (mut term, mut sum) = (Complex::from(1.0), Complex::from(1.0));
    for k in 1..8_u32 {
        let odd = f64::from(2 * k - 1);
        term *= -(square - odd * odd) / (z * 8.0 * f64::from(k));
        sum += term;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ball(time: f64) -> LiquidMemory {
        let axes = Matrix3::<f64>::identity().data.0.to_vec();
        LiquidMemory { coordinates: 0..3, axes, index: 1.5, inertia: 1.0, time }
    }

    /// `χ = (5/z²)(z i₁′/i₁ − 1)` of a ball, with hyperbolic functions.
    fn share(z: Complex<f64>) -> Complex<f64> {
        let tanh = (Complex::from(1.0) - (-2.0 * z).exp()) / (Complex::from(1.0) + (-2.0 * z).exp());
        // i₁ = (z cosh z − sinh z)/z², hence z i₁′/i₁ = (z² tanh z − 2z + 2 tanh z)/(z − tanh z).
        let slope = (z * z * tanh - 2.0 * z + 2.0 * tanh) / (z - tanh);
        5.0 / (z * z) * (slope - 1.0)
    }

    #[test]
    fn a_ball_follows_its_wall_as_the_hyperbolic_functions_have_it() {
        for frequency in [3.0, 40.0, 900.0, 1.0e5, 1.0e6, 3.0e7] {
            let s = Complex::new(0.0, frequency);
            let expected = s / (1.0 - share(s.sqrt()));
            let found = impedance(&ball(1.0), s);
            assert!((found / expected - 1.0).norm() < 1e-11, "{frequency}: {found} {expected}");
        }
    }

    /// `1 − χ = z²/35 − 2z⁴/1575 + 37z⁶/606375 − …`.
    #[test]
    fn a_ball_begins_as_its_series() {
        let s = Complex::new(0.0, 0.02);
        let square = s;
        let series = square / 35.0 - 2.0 * square.powi(2) / 1575.0 + 37.0 * square.powi(3) / 606_375.0;
        let found = s / impedance(&ball(1.0), s);
        assert!((found / series - 1.0).norm() < 1e-9);
    }

    /// Pipe flow, a long cylinder, and the rule that small arguments join the limit.
    #[test]
    fn slow_answers_are_those_of_poiseuille_and_chernousko() {
        for (index, slow) in [(0.0, 8.0), (1.0, 24.0), (1.5, 35.0)] {
            let memory = LiquidMemory { index, ..ball(2.0) };
            assert_eq!(impedance(&memory, Complex::from(0.0)), Complex::from(slow / 2.0));
            let near = impedance(&memory, Complex::new(0.0, 1e-9));
            assert!((near / (slow / 2.0) - 1.0).norm() < 1e-9);
        }
    }

    /// Seen from a frame that turns, a motion at rest in space is slow.
    #[test]
    fn the_frame_shifts_the_frequency() {
        let memory = ball(3.0);
        let spin = Vector3::new(0.0, 0.0, 0.7);
        let s = Complex::new(0.0, 1.9);
        let D = turned_impedance(&memory, s, spin);
        for (sign, shifted) in [(-1.0, 2.6), (1.0, 1.2)] {
            let circular = Vector3::new(Complex::from(1.0), Complex::new(0.0, sign), Complex::from(0.0));
            let gap = D * circular - circular * impedance(&memory, Complex::new(0.0, shifted));
            assert!(gap.norm() < 1e-12);
        }
        let along = Vector3::new(0.0, 0.0, 1.0).map(Complex::from);
        assert!((D * along - along * impedance(&memory, s)).norm() < 1e-12);
    }
}
