//! Errors fall with the predicted power of the spin.

use nalgebra::{Matrix3, Vector3};
use proptest::prelude::*;
use quasirigid::elements::Assembly;
use quasirigid::model::{FlexibleBody, ReducedBody, Support};
use quasirigid::reduction::{Vibrations, reduce, residual};
use quasirigid_math::scalar::Jet;
use quasirigid_math::vec3::{add, norm};

use super::compare::directions;
use crate::support::transform::stiffened;
use crate::support::{bodies, cases, direction};

/// Spins tried, as shares of the lowest frequency: each half of the one before.
const SHARES: [f64; 8] = [0.2, 0.1, 0.05, 0.025, 0.0125, 0.00625, 0.003_125, 0.001_562_5];
/// Departure of a measured slope from the predicted one that is allowed.
const SLOPE: f64 = 0.1;
/// Rounding of the equations, relative to their largest term.
const ROUNDING: f64 = 1e-15;
/// Ratio to rounding above which a number is measured.
const MEASURED: f64 = 100.0;

/// Power with which an error falls with the spin, from the slowest four spins at which the error is above rounding.
///
/// `error` gives the error and its rounding at a spin. Opposite spins count together, so that a degree does not mix with the next one;
/// further degrees change the slope between two spins by the square and the fourth power of the spin, and three slopes remove these.
fn power(frequency: f64, error: impl Fn([f64; 3]) -> (f64, f64)) -> Option<f64> {
    let root_mean_square = |share: f64| {
        let mut sum = (0.0, 0.0);
        for u in directions().step_by(7) {
            for sign in [1.0, -1.0] {
                let (value, rounding) = error(u.map(|x| sign * share * frequency * x));
                sum = (sum.0 + value * value, sum.1 + rounding * rounding);
            }
        }
        (sum.0 > MEASURED * MEASURED * sum.1).then(|| sum.0.sqrt())
    };
    let values: Vec<f64> = SHARES.iter().map_while(|share| root_mean_square(*share)).collect();
    let [first, second, third, fourth] = *values.last_chunk::<4>()?;
    let slopes = [(first / second).log2(), (second / third).log2(), (third / fourth).log2()];
    Some((slopes[0] - 20.0 * slopes[1] + 64.0 * slopes[2]) / 45.0)
}

/// The body with stronger dashpots, so that the odd degrees stand out from the even ones behind them.
fn damped(assembly: &Assembly) -> FlexibleBody {
    stiffened(assembly, 1.0, 2.0).body().unwrap()
}

fn lowest(body: &FlexibleBody) -> f64 {
    Vibrations::compute(body).unwrap().frequencies[0]
}

/// Minus the second inertial derivative of the first moment of the displacements, for `q` of the slow manifold.
fn recoil(body: &FlexibleBody, reduced: &ReducedBody, omega: [f64; 3]) -> [f64; 3] {
    let rate = reduced.f.vector(omega);
    let spin: [Jet; 3] = std::array::from_fn(|i| Jet { value: omega[i], first: rate[i], second: 0.0 });
    let second = reduced.f.vector(spin);
    let spin: [Jet; 3] = std::array::from_fn(|i| Jet { second: second[i].first, ..spin[i] });
    let q = reduced.q.value(spin);
    let mut s = [Jet::default(); 3];
    for (q, S) in q.iter().zip(&body.invariants().S) {
        s = add(s, S.map(|S| *q * Jet::from(S)));
    }
    for (j, k, pair) in body.invariants().pairs.iter() {
        s = add(s, pair.S2.map(|curvature| q[j] * q[k] * Jet::from(0.5 * curvature)));
    }
    let [w, turning] = [omega, rate].map(Vector3::from);
    let [s, velocity, acceleration] =
        [s.map(|s| s.value), s.map(|s| s.first), s.map(|s| s.second)].map(Vector3::from);
    let inertial = acceleration + turning.cross(&s) + 2.0 * w.cross(&velocity) + w.cross(&w.cross(&s));
    (-inertial).into()
}

proptest! {
    #![proptest_config(cases(60))]

    /// The residual relative to the load, which is of degree two, falls as `ω^{p−1}`. (R12)
    #[test]
    fn elastic_residual_falls_with_the_power_p_minus_one(assembly in bodies(), p in 1..7usize) {
        let body = damped(&assembly);
        let reduced = reduce(&body, p).unwrap();
        let found = power(lowest(&body), |omega| (residual(&body, &reduced, omega).elastic, ROUNDING));
        let found = found.ok_or_else(|| TestCaseError::fail("nothing measured"))?;
        prop_assert!((found - (p as f64 - 1.0)).abs() < SLOPE, "p = {p}: power {found}");
    }

    /// The residual falls as `ω^{p+3}`; at `p = 2` nothing is odd, which gives one power more. (R12)
    #[test]
    fn torque_residual_falls_with_the_power_p_plus_three(assembly in bodies(), p in 2..7usize) {
        let body = damped(&assembly);
        let reduced = reduce(&body, p).unwrap();
        let found = power(lowest(&body), |omega| {
            let gyroscopic = norm(omega) * norm(reduced.angular_momentum(omega));
            (residual(&body, &reduced, omega).torque, ROUNDING * gyroscopic)
        });
        // At p = 6 a body whose moving masses are light leaves nothing above rounding at any spin tried.
        let Some(found) = found else {
            prop_assert!(p == 6, "p = {p}: nothing measured");
            return Ok(());
        };
        let expected = if p == 2 { 6.0 } else { p as f64 + 3.0 };
        // There the spins that can be measured are so fast that further terms of the series show.
        let slope = if p == 6 { 3.0 * SLOPE } else { SLOPE };
        prop_assert!((found - expected).abs() < slope, "p = {p}: power {found}");
    }

    /// Force on the pole `φ = −(ℓ̇ + ω × ℓ)` with `ℓ = ṡ + ω × s`, `s = S_j q_j + ½ Γ_jk q_j q_k`: the centre of mass of a free body rests.
    /// Followed along the motion as Taylor series in time; the residual starts one degree above the last. (R8)
    #[test]
    fn force_on_the_pole_is_the_recoil_to_the_degree_p_plus_two(assembly in bodies(), p in 3..6usize) {
        let mut free = assembly;
        free.support = Support::Free;
        let body = damped(&free);
        let reduced = reduce(&body, p).unwrap();
        let found = power(lowest(&body), |omega| {
            let recoil = recoil(&body, &reduced, omega);
            let phi = reduced.phi.vector(omega);
            (norm(std::array::from_fn(|i| recoil[i] - phi[i])), 10.0 * ROUNDING * norm(phi))
        });
        let found = found.ok_or_else(|| TestCaseError::fail("nothing measured"))?;
        prop_assert!((found - (p as f64 + 3.0)).abs() < SLOPE, "p = {p}: power {found}");
    }

    /// Euler's equations are the first order, to the last digit. (R2)
    #[test]
    fn first_order_is_the_rigid_body(assembly in bodies(), u in direction()) {
        let body = damped(&assembly);
        let reduced = reduce(&body, 1).unwrap();
        let omega = u.map(|x| 0.1 * lowest(&body) * x);
        let J = Matrix3::from(body.inertia());
        let w = Vector3::from(omega);
        let expected = -J.try_inverse().unwrap() * w.cross(&(J * w));
        let found = Vector3::from(reduced.f.vector(omega));
        prop_assert!((found - expected).norm() < 1e-12 * w.norm_squared());
        let torque = residual(&body, &reduced, omega).torque;
        prop_assert!(torque < 1e-12 * J.amax() * w.norm_squared(), "{torque:e}");
    }
}
