//! Steady spins of a reduced body on the sphere `|K| = G`, with growth rate and frequency of a small nutation.
//! Near principal axes they come from Newton's method; all of them from a search of the sphere, which bodies with nearly equal moments
//! need.
//! Equation (P5), docs/theory/05-propagation.md; (N2), docs/theory/17-levels.md.

use nalgebra::{Matrix3, Matrix4, Vector3, Vector4};

use crate::math::polynomial::Series;
use crate::math::sphere::{StationaryKind, deviator, jacobian, stationary, tangents};
use crate::math::sym3;
use crate::math::vec3::{dot, norm, scale};
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
/// Share of the dissipation of any motion below which that of a small nutation is rounding, as of a rotor along the axis of the spin.
const UNDAMPED: f64 = 1e-14;

/// Steady spins of a reduced body with the angular momentum `|K|` (N·m·s), one near each principal axis, in the order of ascending
/// moments; a negative value reverses all axes, which matters for momentum wheels. None where the axis is not determined, as across the
/// axis of a body of revolution, or no steady spin is near it.
#[must_use]
pub fn steady_spins(body: &ReducedBody, angular_momentum: f64) -> [Option<SteadySpin>; 3] {
    let principal = Principal::compute(body.J);
    let (determined, axes) = (principal.determined(), principal.axes);
    let gradient = &body.energy_of_momentum.gradient();
    std::array::from_fn(|i| {
        let K = determined[i].then(|| steady_angular_momentum(gradient, axes[i], angular_momentum))??;
        Some(nutation(body, gradient, K))
    })
}

/// Steady spin of a reduced body next to an angular momentum (N·m·s, body axes), of the same size; none if there is none near it. (P5)
#[must_use]
pub fn steady_spin_near(body: &ReducedBody, angular_momentum: [f64; 3]) -> Option<SteadySpin> {
    let G = norm(angular_momentum);
    let gradient = &body.energy_of_momentum.gradient();
    let K = steady_angular_momentum(gradient, scale(G.recip(), angular_momentum), G)?;
    Some(nutation(body, gradient, K))
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
    /// Isolated steady spins: those of least energy, saddles, those of greatest energy, each in the order of growth.
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
    let given = Principal::compute(body.J).senses();
    let slowness = sym3::inverse(body.J).iter().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
    let rounding = TANGENTIAL * slowness * angular_momentum.abs();
    let gradient = body.energy_of_momentum.gradient();
    let found = stationary(&deviator(&gradient, angular_momentum), &given, rounding);
    let isolated = found.points.iter().map(|point| {
        let K = scale(angular_momentum, point.place);
        IsolatedSpin { spin: nutation(body, &gradient, K.into()), angular_momentum: K, kind: point.kind }
    });
    let mut isolated: Vec<IsolatedSpin> = isolated.collect();
    let rank = |kind| match kind {
        StationaryKind::Minimum => 0,
        StationaryKind::Saddle => 1,
        StationaryKind::Maximum => 2,
    };
    isolated.sort_by(|a, b| rank(a.kind).cmp(&rank(b.kind)).then(a.spin.growth.total_cmp(&b.spin.growth)));
    SteadySpins { isolated, families: found.families, complete: found.complete }
}

/// Solves `∇E(K) = λK`, `|K| = G`, by Newton's method from a principal axis.
pub(super) fn steady_angular_momentum(gradient: &Series, axis: [f64; 3], G: f64) -> Option<Vector3<f64>> {
    let mut K = G * Vector3::from(axis);
    let spin = Vector3::from(gradient.vector(K.into()));
    let mut rate = spin.dot(&K) / (G * G);
    let scale = spin.norm();
    for _ in 0..NEWTON_STEPS {
        let gap = Vector3::from(gradient.vector(K.into())) - rate * K;
        let length = 0.5 * (G * G - K.norm_squared());
        if gap.norm() < 1e-14 * scale && length.abs() < 1e-14 * G * G {
            return Some(K);
        }
        let mut system = Matrix4::zeros();
        let slope = Matrix3::from(jacobian(gradient, K.into())) - rate * Matrix3::identity();
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
    let gap = Vector3::from(gradient.vector(K.into())) - rate * K;
    (gap.norm() < 1e-11 * scale).then_some(K)
}

/// Growth and frequency of a small nutation about a steady spin, by the energy form: with `h` the second variation of the energy on the
/// sphere and `D = a² + G² det T`, growth `−G² tr(adj(T) h)/2D` and determinant `G² det h/D`. At a least energy it never grows, at a
/// greatest it never decays. (P5)
fn nutation(body: &ReducedBody, gradient: &Series, K: Vector3<f64>) -> SteadySpin {
    let G = K.norm();
    let omega = body.angular_velocity(K.into());
    let rate = dot(gradient.vector(K.into()), K.into()) / (G * G);
    let [first, second] = tangents((K / G).into()).map(Vector3::from);
    let slopes = Matrix3::from(jacobian(gradient, K.into())) - rate * Matrix3::identity();
    let T = Matrix3::from(sym3::rows(body.T.tensor(K.into())));
    let widest = |axis: [f64; 3]| Matrix3::from(sym3::rows(body.T.tensor(axis.map(|x| G * x)))).norm();
    let largest =
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(widest).into_iter().fold(T.norm(), f64::max);
    let rounding = UNDAMPED * largest * slopes.norm();
    let across = |matrix: &Matrix3<f64>| {
        let entry = |a: &Vector3<f64>, b: &Vector3<f64>| a.dot(&(matrix * b));
        let mixed = 0.5 * (entry(&first, &second) + entry(&second, &first));
        [entry(&first, &first), entry(&second, &second), mixed]
    };
    let (h, T) = (across(&slopes), across(&T));
    let determinant = |[xx, yy, xy]: [f64; 3]| xx * yy - xy * xy;
    let a = 1.0 + dot(body.c.vector(K.into()), K.into());
    let scale = G * G / (a * a + G * G * determinant(T));
    let damped = T[1] * h[0] + T[0] * h[1] - 2.0 * T[2] * h[2];
    let damping = if damped.abs() > rounding { -0.5 * scale * damped } else { 0.0 };
    let square = damping * damping - scale * determinant(h);
    let (growth, frequency) =
        if square < 0.0 { (damping, (-square).sqrt()) } else { (damping + square.sqrt(), 0.0) };
    SteadySpin { omega, growth, frequency }
}
