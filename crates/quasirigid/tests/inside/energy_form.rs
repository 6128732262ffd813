//! Energy form of bodies with rotors, liquids and wheels: that of the series to its order, and never a gain of energy. (R16)–(R21)

use quasirigid::elements::{Assembly, WheelSpeed};
use quasirigid::model::{EnergyMotion, ReducedBody};
use quasirigid::reduction::reduce;
use quasirigid_math::vec3::{add, cross, dot, norm, scale};

use super::bodies::everything;

const DIRECTION: [f64; 3] = [0.5, -0.7, 0.4];

/// The body with its wheel slowed down by a factor, as its spin is.
fn slowed(factor: f64) -> Assembly {
    let mut assembly = everything();
    let WheelSpeed::Constant { angular_momentum } = assembly.wheels[0].speed else { unreachable!() };
    assembly.wheels[0].speed = WheelSpeed::Constant { angular_momentum: factor * angular_momentum };
    assembly.reduction.order = 6;
    assembly
}

/// Difference of the angular velocity of the energy form from the reverted series, relative.
fn gap(reduced: &ReducedBody, factor: f64) -> f64 {
    let K = add(reduced.wheels(), scale(6.0 * factor, DIRECTION));
    let series = reduced.Omega.vector(K);
    norm(add(reduced.angular_velocity(K), scale(-1.0, series))) / norm(series)
}

/// Friction, gyroscopic forces of liquids, wheels and springs together: the first degree that differs is `p + 2`.
#[test]
fn angular_velocity_is_that_of_the_series_to_its_order() {
    for (p, slow) in (1..=5).zip([0.02, 0.02, 0.2, 0.4, 0.6]) {
        let [coarse, fine] = [slow, slow / 2.0]
            .map(|factor| gap(&reduce(&slowed(factor).body().unwrap(), p).unwrap(), factor));
        let order = (coarse / fine).log2();
        println!("p = {p}: {coarse:e} {fine:e} order {order}");
        assert!(order > p as f64 + 0.7, "p = {p}: {order}");
    }
}

/// `∇E·K̇ = −P ≤ 0` at every spin, far outside the range too.
#[test]
fn energy_falls_by_the_power() {
    for p in 0..=5 {
        for factor in [1e-3, 1e-2, 0.1, 1.0, 10.0] {
            let reduced = reduce(&slowed(1.0).body().unwrap(), p).unwrap();
            let K = add(reduced.wheels(), scale(factor, DIRECTION));
            let EnergyMotion { omega, rate, power } = reduced.motion(K);
            let gradient = reduced.energy_of_momentum.gradient().vector(K);
            let size = norm(gradient) * norm(cross(K, gradient));
            assert!(power >= 0.0 && (p == 0) == (power == 0.0), "p = {p}: {power:e}");
            assert!((dot(gradient, rate) + power).abs() <= 1e-12 * size.max(power), "p = {p}");
            assert!(dot(K, rate).abs() <= 1e-12 * norm(K) * norm(rate));
            assert!(norm(add(cross(K, omega), scale(-1.0, rate))) <= 1e-12 * norm(K) * norm(omega));
        }
    }
}
