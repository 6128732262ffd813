//! Residual of the invariance equation: the truncated series put into the full equations as numbers.
//! Independent of the recursion, so that a wrong index or sign in any degree shows as a wrong slope; also the measure of the truncation at
//! the actual spin.
//! Equation (R12), docs/theory/03-reduction.md.

use crate::math::polynomial::Series;
use crate::math::scalar::Jet;
use crate::math::sym3::{self, Sym};
use crate::math::vec3::{add, cross, norm};
use crate::model::{FlexibleBody, Invariants, MotionState, ReducedBody};

/// Residual of the full equations on the slow manifold at one angular velocity. (R12)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Residual {
    /// Residual force on the elastic coordinates over their load, both measured by the energy that they would store; of order `ω^{p−1}`.
    /// Zero where the load is rounding.
    pub elastic: f64,
    /// Residual force on the cyclic coordinates over their load, both measured by the power that they would dissipate; of order `ω^p`.
    /// Zero where the load is rounding.
    pub cyclic: f64,
    /// Residual torque `|K̇ + ω × K|` (N·m), of order `ω^{p+3}`.
    pub torque: f64,
}

/// Share of the load that the spin could cause about any axis, below which a load is rounding.
const LOAD_ROUNDING: f64 = 1e-12;

/// Residual of the full equations (S3), (S4) on the slow manifold at an angular velocity (rad/s).
///
/// The recursion that made the slow manifold is not used: the polynomials are followed along the motion as truncated Taylor series in time,
/// and enter the equations as numbers.
#[must_use]
pub fn residual(body: &FlexibleBody, reduced: &ReducedBody, omega: [f64; 3]) -> Residual {
    let spin = along(&reduced.f, omega);
    let q = reduced.q.value(spin);
    let mut rate: Vec<Jet> = q.iter().map(|q| Jet { value: q.first, first: q.second, second: 0.0 }).collect();
    let slaved = reduced.rate.value(spin);
    rate[body.cyclic()].copy_from_slice(&slaved[body.cyclic()]);
    let motion = MotionState { omega: spin, q: &q, rate: &rate };
    let K = body.angular_momentum(motion);
    let whole = add(K.map(|K| K.value), body.wheels().angular_momentum(0.0));
    let torque = norm(add(K.map(|K| K.first), cross(omega, whole)));

    let momenta = body.generalized_momentum(motion);
    let load = body.load(motion);
    let inertial: Vec<f64> = load
        .iter()
        .zip(&momenta)
        .map(|(load, angular_momentum)| load.value - angular_momentum.first)
        .collect();
    let spring = body.stiffness().times(&q.iter().map(|q| q.value).collect::<Vec<_>>());
    let dashpot = body.damping().times(&rate.iter().map(|rate| rate.value).collect::<Vec<_>>());
    let left: Vec<f64> = (0..q.len()).map(|j| inertial[j] - dashpot[j] - spring[j]).collect();
    let possible = possible(body, omega);
    let share = |size: fn(&FlexibleBody, &[f64]) -> f64| {
        let whole = size(body, &inertial);
        if whole > LOAD_ROUNDING * size(body, &possible) { size(body, &left) / whole } else { 0.0 }
    };
    Residual { elastic: share(stored), cyclic: share(dissipated), torque }
}

/// Size of the load on each coordinate at an angular velocity (rad/s) of this length about a general axis.
fn possible(body: &FlexibleBody, omega: [f64; 3]) -> Vec<f64> {
    let Invariants { J, J1, h, .. } = body.invariants();
    let (spin, wheels) =
        (norm(omega), norm(sym3::times(sym3::inverse(*J), body.wheels().angular_momentum(0.0))));
    let stretch = |J1: &Sym| J1.iter().fold(0.0_f64, |size, entry| size.max(entry.abs()));
    let load = |(J1, h): (&Sym, &[f64; 3])| spin * (spin * stretch(J1) + (spin + wheels) * norm(*h));
    J1.iter().zip(h).map(load).collect()
}

/// Angular velocity as a Taylor series in time along `ω̇ = f(ω)`.
fn along(f: &Series, omega: [f64; 3]) -> [Jet; 3] {
    let first = f.vector(omega);
    let linear = std::array::from_fn(|i| Jet { value: omega[i], first: first[i], second: 0.0 });
    let second = f.vector(linear);
    std::array::from_fn(|i| Jet { second: second[i].first, ..linear[i] })
}

/// Root of twice the elastic energy that a static force would store, `√(FᵀC⁻¹F)`.
fn stored(body: &FlexibleBody, force: &[f64]) -> f64 {
    let mut response = force.to_vec();
    body.solve_stiffness(&mut response, 1);
    force.iter().zip(&response).map(|(force, response)| force * response).sum::<f64>().max(0.0).sqrt()
}

/// Root of the power that a steady force would dissipate in the cyclic coordinates, `√(FᵀB⁻¹F)`.
fn dissipated(body: &FlexibleBody, force: &[f64]) -> f64 {
    let force = &force[body.cyclic()];
    let mut response = force.to_vec();
    body.solve_friction(&mut response, 1);
    force.iter().zip(&response).map(|(force, response)| force * response).sum::<f64>().max(0.0).sqrt()
}
