//! Steady spins of a reduced body on the sphere `|K| = G`, with growth rate and frequency of a small nutation.
//! Near principal axes they come from Newton's method; all of them from a search of the sphere, which bodies with nearly equal moments
//! need.
//! Equation (P5), docs/theory/05-propagation.md; (N2), docs/theory/17-levels.md.

use nalgebra::{Matrix3, Matrix4, Vector3, Vector4};

use crate::math::polynomial::{Homogeneous, Series};
use crate::math::sphere::{StationaryKind, deviator, jacobian, stationary, tangents};
use crate::math::sym3;
use crate::math::vec3::{dot, scale};
use crate::model::{Principal, ReducedBody};

/// Steady spin near a principal axis, with growth rate and frequency of a small nutation about it. (P5)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteadySpin {
    /// Angular velocity (rad/s), body axes.
    pub omega: [f64; 3],
    /// Growth rate of the nutation angle (1/s): positive if the motion leaves this axis.
    pub growth: f64,
    /// Frequency of the nutation in the body frame (rad/s); zero of a motion without oscillation.
    pub frequency: f64,
}

const NEWTON_STEPS: usize = 30;
/// Relative difference of the entries of a symmetric matrix that counts as rounding.
const ROUNDING: f64 = 1e-12;

/// Steady spins of a reduced body with the angular momentum `|K|` (N·m·s), one near each principal axis, in the order of ascending
/// moments; a negative value reverses all axes, which matters for momentum wheels. None where the axis is not determined, as across the
/// axis of a body of revolution, or no steady spin is near it.
#[must_use]
pub fn steady_spins(body: &ReducedBody, angular_momentum: f64) -> [Option<SteadySpin>; 3] {
    let principal = Principal::compute(body.J);
    let (determined, axes) = (principal.determined(), principal.axes);
    std::array::from_fn(|i| {
        let K = determined[i].then(|| steady_angular_momentum(&body.Omega, axes[i], angular_momentum))??;
        Some(nutation(&body.Omega, K))
    })
}

/// Isolated steady spin anywhere on the sphere `|K| = G`, with its kind of stationary point of the energy. (N2)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IsolatedSpin {
    /// Angular velocity, growth rate and frequency of a small nutation.
    pub spin: SteadySpin,
    /// Angular momentum (N·m·s), body axes.
    pub angular_momentum: [f64; 3],
    /// Kind of stationary point: least energy attracts, greatest energy repels, a saddle separates the motions about the others.
    pub kind: StationaryKind,
}

/// All steady spins with one angular momentum. (N2)
#[derive(Clone, Debug, PartialEq)]
pub struct SteadySpins {
    /// Isolated steady spins, those near principal axes first.
    pub isolated: Vec<IsolatedSpin>,
    /// True if other steady spins form curves, as across the axis of a body of revolution.
    pub families: bool,
    /// True if extrema outnumber saddles by two, which without a family means that none is missing.
    pub complete: bool,
}

/// Share of the angular velocity below which a tangential part is rounding.
const TANGENTIAL: f64 = 1e-14;

/// All steady spins of a reduced body with the angular momentum `|K|` (N·m·s), not only those near principal axes. (N2)
#[must_use]
pub fn all_steady_spins(body: &ReducedBody, angular_momentum: f64) -> SteadySpins {
    let axes = Principal::compute(body.J).axes;
    let given = [axes, axes.map(|axis| scale(-1.0, axis))].concat();
    let slowness = sym3::inverse(body.J).iter().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
    let rounding = TANGENTIAL * slowness * angular_momentum.abs();
    let found = stationary(&deviator(&body.Omega, angular_momentum), &given, rounding);
    let isolated = found.points.iter().map(|point| {
        let K = scale(angular_momentum, point.place);
        IsolatedSpin { spin: nutation(&body.Omega, K.into()), angular_momentum: K, kind: point.kind }
    });
    SteadySpins { isolated: isolated.collect(), families: found.families, complete: found.complete }
}

/// Solves `Ω(K) = λK`, `|K| = G`, by Newton's method from a principal axis.
pub(super) fn steady_angular_momentum(Omega: &Series, axis: [f64; 3], G: f64) -> Option<Vector3<f64>> {
    let mut K = G * Vector3::from(axis);
    let spin = Vector3::from(Omega.vector(K.into()));
    let mut rate = spin.dot(&K) / (G * G);
    let scale = spin.norm();
    for _ in 0..NEWTON_STEPS {
        let gap = Vector3::from(Omega.vector(K.into())) - rate * K;
        let length = 0.5 * (G * G - K.norm_squared());
        if gap.norm() < 1e-14 * scale && length.abs() < 1e-14 * G * G {
            return Some(K);
        }
        let mut system = Matrix4::zeros();
        let slope = Matrix3::from(jacobian(Omega, K.into())) - rate * Matrix3::identity();
        system.fixed_view_mut::<3, 3>(0, 0).copy_from(&slope);
        system.fixed_view_mut::<3, 1>(0, 3).copy_from(&-K);
        system.fixed_view_mut::<1, 3>(3, 0).copy_from(&K.transpose());
        let right = Vector4::new(-gap[0], -gap[1], -gap[2], length);
        let step = system.lu().solve(&right)?;
        K += step.fixed_rows::<3>(0);
        rate += step[3];
        if !(K - G * Vector3::from(axis)).norm().is_finite()
            || K.dot(&Vector3::from(axis)) * G.signum() < 0.5 * G.abs()
        {
            return None;
        }
    }
    let gap = Vector3::from(Omega.vector(K.into())) - rate * K;
    (gap.norm() < 1e-11 * scale).then_some(K)
}

/// Growth and frequency of a small nutation about a steady spin.
fn nutation(Omega: &Series, K: Vector3<f64>) -> SteadySpin {
    let G = K.norm();
    let omega = Omega.vector(K.into());
    let rate = dot(omega, K.into()) / (G * G);
    let [first, second] = tangents((K / G).into()).map(Vector3::from);
    let mut deviation = Omega.clone();
    deviation.set(Homogeneous::zero(1, 3));
    let linear = Matrix3::from(jacobian(&Omega.truncated(1), K.into())) - rate * Matrix3::identity();
    let bent = Matrix3::from(jacobian(&deviation, K.into()));
    let M = |a: &Vector3<f64>, b: &Vector3<f64>| a.dot(&(linear * b)) + a.dot(&(bent * b));
    let determinant = M(&first, &first) * M(&second, &second) - M(&first, &second) * M(&second, &first);
    // The linear map is symmetric: its part of the difference would be rounding and is left out.
    let (over, under) = (first.dot(&(bent * second)), second.dot(&(bent * first)));
    let asymmetry =
        if (over - under).abs() > ROUNDING * (over.abs() + under.abs()) { over - under } else { 0.0 };
    let damping = 0.5 * G * asymmetry;
    let square = damping * damping - G * G * determinant;
    let (growth, frequency) =
        if square < 0.0 { (damping, (-square).sqrt()) } else { (damping + square.sqrt(), 0.0) };
    SteadySpin { omega, growth, frequency }
}
