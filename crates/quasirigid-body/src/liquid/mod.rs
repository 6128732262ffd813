//! Liquids whose linear response to small motions about a steady spin is known at every frequency. (L15)

mod ball;
mod bessel;
mod cylinder;
mod galerkin;
mod jacobi;
mod known;

use std::ops::Range;

use nalgebra::{Complex, Matrix3, Vector3};

/// Liquid whose linear response about a steady spin is known at every frequency, beside the coordinates that represent the liquid in the
/// equations of motion. (L15)
#[derive(Clone, Debug, PartialEq)]
pub struct LiquidMemory {
    /// Coordinates of the liquid.
    pub coordinates: Range<usize>,
    /// Axes of rotation of the liquid, unit vectors, body axes: one, or three for a ball.
    pub axes: Vec<[f64; 3]>,
    /// Flow.
    pub flow: LiquidFlow,
    /// Moment of inertia of the frozen liquid (kg·m²), of a spheroid about its axis.
    pub inertia: f64,
    /// `a²/ν` of its radius, of a spheroid that of its equator (s).
    pub time: f64,
}

/// Flow of a liquid whose linear response is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LiquidFlow {
    /// Flow along a slender ring, where the Coriolis force has no part. (C11)
    Tube,
    /// Flow in a spinning ball. (L16)
    Ball,
    /// Flow in a spheroid that spins about its axis. (L16)
    Spheroid {
        /// Axis of the cavity, a unit vector, body axes.
        axis: [f64; 3],
        /// Square of the ratio of the semi-axes along the axis and across the axis.
        stretch: f64,
    },
    /// Flow in a cylinder that spins about its axis. (L20)
    Cylinder {
        /// Axis of the cavity, a unit vector, body axes.
        axis: [f64; 3],
        /// Half the height over the radius.
        half: f64,
    },
}

/// Reynolds number from which the spin is significant in the response.
const COUNTS: f64 = 20.0;

impl LiquidMemory {
    /// Estimate of the relative error of the power from the response about the mean spin, in a free rotation at a spin (rad/s) with a
    /// wobble (rad). The periodic part of the spin is left out, and its effect is even in the wobble. (L19)
    #[must_use]
    pub fn left_out(&self, spin: f64, wobble: f64) -> f64 {
        if self.flow == LiquidFlow::Tube {
            return 0.0;
        }
        (spin * self.time / COUNTS).powi(2).min(1.0) * wobble * wobble
    }

    pub(super) fn scaled(&self, factor: f64) -> Self {
        Self { time: factor * self.time, ..self.clone() }
    }

    pub(super) fn moved(&self, start: usize) -> Self {
        Self { coordinates: self.coordinates.start - start..self.coordinates.end - start, ..self.clone() }
    }
}

/// Force on a liquid per rate relative to the body, `D = I²Π⁻¹`, at a complex frequency `s` (1/s) about a steady spin (rad/s, body axes).
/// (L15)
///
/// A ball has no direction but that of the spin; a spheroid and a cylinder spin about their axes, and the component across is left out.
/// There is one response along the axis and one for each sense of circling the axis. NaN where the fields have no finite solution.
#[doc(hidden)]
pub fn impedance(memory: &LiquidMemory, s: Complex<f64>, spin: Vector3<f64>) -> Matrix3<Complex<f64>> {
    let LiquidMemory { inertia, time, flow, .. } = *memory;
    let unit = inertia / time;
    let own = match flow {
        LiquidFlow::Tube => {
            return Matrix3::from_diagonal_element(unit * bessel::drag(bessel::RING, time * s));
        }
        LiquidFlow::Ball => None,
        LiquidFlow::Spheroid { axis, .. } | LiquidFlow::Cylinder { axis, .. } => Some(Vector3::from(axis)),
    };
    let spin = own.map_or(spin, |axis| axis * axis.dot(&spin));
    let rate = spin.norm();
    let axis = if rate > 0.0 { spin / rate } else { own.unwrap_or_else(Vector3::z) };
    let [along, faster, slower] = [0, 1, -1].map(|m| unit * drag(flow, m, time * s, time * rate));
    let projection = (axis * axis.transpose()).map(Complex::from);
    let across = Matrix3::identity() - projection;
    // The rotation generator takes (1, i, 0) about the spin to −i times itself.
    let turn = axis.cross_matrix().map(|entry| Complex::new(0.0, entry));
    let half = Complex::from(0.5);
    projection * along + (across + turn) * (half * faster) + (across - turn) * (half * slower)
}

/// Force per rate of a motion `e^{imφ}` about the spin, per `I ν/a²` with the inertia about the axis.
///
/// `m` is 0 about the spin, 1 for `(1, i, 0)` and −1 for `(1, −i, 0)`, the conjugate of `m = 1` at the conjugate frequency.
fn drag(flow: LiquidFlow, m: i32, sigma: Complex<f64>, tau: f64) -> Complex<f64> {
    if m < 0 {
        return drag(flow, -m, sigma.conj(), tau).conj();
    }
    let m = m as usize;
    // Ratio of the squared loads of motions across and about the axis.
    let across = |ratio: f64| if m == 0 { 1.0 } else { ratio };
    match flow {
        LiquidFlow::Tube => bessel::drag(bessel::RING, sigma),
        LiquidFlow::Ball if tau == 0.0 => bessel::drag(bessel::BALL, sigma),
        LiquidFlow::Ball => ball::SpinningSpheroid { stretch: 1.0, tau }.drag(m, sigma),
        LiquidFlow::Spheroid { stretch, .. } => {
            ball::SpinningSpheroid { stretch, tau }.drag(m, sigma) / across(stretch)
        }
        LiquidFlow::Cylinder { half, .. } => {
            cylinder::SpinningCylinder { half, tau }.drag(m, sigma) / across(0.5 + 2.0 * half * half / 3.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ball(time: f64) -> LiquidMemory {
        let axes = Matrix3::<f64>::identity().data.0.to_vec();
        LiquidMemory { coordinates: 0..3, axes, flow: LiquidFlow::Ball, inertia: 1.3, time }
    }

    /// Motion at rest in inertial axes: seen from a body that spins about z, a fixed vector circles as `(1, i, 0)e^{iΩt}`, and the core
    /// of a ball with a thin layer hardly resists that motion.
    #[test]
    fn the_core_of_a_ball_rests_in_space() {
        let (memory, rate) = (ball(1e6), 0.7);
        let circling =
            |sign: f64| Vector3::new(Complex::from(1.0), Complex::new(0.0, sign), Complex::from(0.0));
        let s = Complex::new(0.0, rate);
        let D = impedance(&memory, s, Vector3::new(0.0, 0.0, rate));
        let [resting, other] =
            [1.0, -1.0].map(|sign| (D * circling(sign)).dot(&circling(sign).conjugate()).norm());
        assert!(
            resting < 0.01 * other && (other / (2.0 * 1.3 * 2.0 * rate) - 1.0).abs() < 0.01,
            "{resting} {other}"
        );
    }

    /// Isotropy of a ball: the response rotates with the spin, since no other axis is distinguished.
    #[test]
    fn a_ball_knows_the_axis_of_the_spin_alone() {
        let (memory, spin) = (ball(40.0), Vector3::new(0.4, -0.5, 0.8));
        let s = Complex::new(0.02, 0.9);
        let D = impedance(&memory, s, spin);
        let turn = nalgebra::Rotation3::rotation_between(&Vector3::z(), &spin).unwrap();
        let R = turn.matrix().map(Complex::from);
        let about_z = impedance(&memory, s, Vector3::new(0.0, 0.0, spin.norm()));
        assert!((D - R * about_z * R.transpose()).norm() < 1e-12 * D.norm());
        let opposite = impedance(&memory, s, -spin);
        assert!((D - opposite.transpose()).norm() < 1e-12 * D.norm(), "the other sense is the transpose");
    }

    /// Arguments that are not finite, as from an iteration without convergence, give NaN.
    #[test]
    fn what_is_asked_at_no_number_has_no_answer() {
        let axis = [0.0, 0.0, 1.0];
        for flow in [
            LiquidFlow::Tube,
            LiquidFlow::Ball,
            LiquidFlow::Spheroid { axis, stretch: 0.5 },
            LiquidFlow::Cylinder { axis, half: 1.2 },
        ] {
            for (m, tau) in [(0, 3.0), (1, 1e-2), (-1, 1e7)] {
                let sigma = Complex::new(0.0, f64::NAN);
                assert!(drag(flow, m, sigma, tau).re.is_nan(), "{flow:?} {m} {tau}");
            }
        }
    }

    /// Limit of zero spin: the fields of a spinning ball lead to the Bessel functions of a ball at rest.
    #[test]
    fn a_ball_that_hardly_spins_is_one_that_does_not() {
        for size in [0.3_f64, 40.0, 3e3, 1e5] {
            let sigma = Complex::new(-0.1 * size, size);
            let [still, spinning] = [0.0, 1e-9].map(|tau| drag(LiquidFlow::Ball, 1, sigma, tau));
            assert!((spinning / still - 1.0).norm() < 1e-5, "{size} {still} {spinning}");
        }
    }
}
