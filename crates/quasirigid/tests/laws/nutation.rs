//! Small nutation about a steady spin grows and rotates as the flow of the angular momentum says. (P5)

use proptest::prelude::*;
use quasirigid::dynamics::{SteadySpin, steady_spins};
use quasirigid::model::{Principal, ReducedBody};
use quasirigid::reduction::reduce;
use quasirigid_math::sym3::times;
use quasirigid_math::vec3::{add, dot, norm, scale};

use crate::support::transform::rescaled;
use crate::support::{assemblies, cases, direction, units};

/// Newton's method ends at rounding of the spin.
const STEADY: f64 = 1e-12;
/// Step of differences of the fourth order, of the angular momentum: truncation and rounding are equal about here.
const DIFFERENCE: f64 = 1e-3;
/// Error of those differences, whose linear parts cancel in the sum of the roots.
const ROUNDING: f64 = 1e-11;
/// A share of a spin that is itself a tenth of the lowest frequency.
const SLOW: f64 = 0.03;

/// Sum and product of the two eigenvalues across `K` of the derivative of `K̇`, by differences of the fourth order: the third is zero,
/// since the flow has no part along `K`.
fn roots(body: &ReducedBody, K: [f64; 3]) -> (f64, f64) {
    let step = DIFFERENCE * norm(K);
    let columns: [[f64; 3]; 3] = std::array::from_fn(|j| {
        let across = |half: f64| {
            let [ahead, behind] = [half, -half].map(|step| {
                let mut beside = K;
                beside[j] += step;
                body.motion(beside).rate
            });
            scale(0.5 / half, add(ahead, scale(-1.0, behind)))
        };
        add(scale(4.0 / 3.0, across(step)), scale(-1.0 / 3.0, across(2.0 * step)))
    });
    let minor = |i: usize, j: usize| columns[i][i] * columns[j][j] - columns[i][j] * columns[j][i];
    (columns[0][0] + columns[1][1] + columns[2][2], minor(0, 1) + minor(1, 2) + minor(2, 0))
}

/// Fault of a steady spin near an axis.
fn fault(body: &ReducedBody, spin: SteadySpin, axis: [f64; 3], angular_momentum: f64) -> Option<String> {
    let SteadySpin { omega, growth, frequency } = spin;
    let fast = norm(omega);
    let K = omega.map(|w| angular_momentum * w / fast);
    let left = norm(body.motion(K).rate) / (angular_momentum * fast);
    let (sum, product) = roots(body, K);
    let wrong = if frequency > 0.0 {
        let turning = growth * growth + frequency * frequency - product;
        ((2.0 * growth - sum) / fast).abs().max(turning.abs() / (fast * fast))
    } else {
        let root = growth * growth - sum * growth + product;
        if growth >= 0.5 * sum { root.abs() / (fast * fast) } else { f64::INFINITY }
    };
    let near = dot(K, axis) > 0.9 * angular_momentum;
    let sound = near && left < STEADY && wrong < ROUNDING;
    (!sound).then(|| format!("{spin:?} near {axis:?}: left {left:e}, roots {wrong:e}, {sum:e} {product:e}"))
}

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn nutation_has_the_roots_of_the_flow(
        assembly in assemblies(), units in units(), spin in direction(), p in 3..6usize
    ) {
        let body = reduce(&rescaled(&assembly, units).body().unwrap(), p).unwrap();
        let angular_momentum = norm(times(body.J, spin.map(|w| w / units.time)));
        let axes = Principal::compute(body.J).axes;
        let spins = steady_spins(&body, angular_momentum).map(|spin| spin.expect("distinct moments"));
        for (spin, axis) in spins.into_iter().zip(axes) {
            let fault = fault(&body, spin, axis, angular_momentum);
            prop_assert!(fault.is_none(), "{fault:?}");
        }
    }

    /// A damped body leaves its minor axis, as Explorer 1 did, and settles on its major one; the middle one repels.
    ///
    /// At a spin so slow that no higher degree outweighs the first that dissipates.
    #[test]
    fn nutation_grows_about_the_minor_axis_and_dies_about_the_major(
        assembly in assemblies(), units in units(), spin in direction()
    ) {
        let body = reduce(&rescaled(&assembly, units).body().unwrap(), 3).unwrap();
        let angular_momentum = norm(times(body.J, spin.map(|w| SLOW * w / units.time)));
        let [minor, middle, major] = steady_spins(&body, angular_momentum).map(|spin| spin.expect("distinct moments"));
        prop_assert!(minor.growth > 0.0 && minor.frequency > 0.0, "{minor:?}");
        prop_assert!(middle.growth > 0.0 && middle.frequency == 0.0, "{middle:?}");
        prop_assert!(major.growth < 0.0 && major.frequency > 0.0, "{major:?}");
    }
}
