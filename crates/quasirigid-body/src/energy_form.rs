//! Energy form of the reduced equations at one angular momentum: its motion keeps `|K|` and loses exactly the power, whatever the truncation.
//! Equations (R16) and (R17), docs/theory/03-reduction.md.

use std::ops::Div;

use crate::math::polynomial::Series;
use crate::math::scalar::{Jet, Scalar};
use crate::math::sym3::{adjugate, smooth_times};
use crate::math::vec3::{add, cross, dot, scale};

/// Motion of a reduced body at an angular momentum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyMotion<N> {
    /// Angular velocity (rad/s), body axes. (R17)
    pub omega: [N; 3],
    /// Rate of the angular momentum in body axes (N·m), `K × ω`. (R16)
    pub rate: [N; 3],
    /// Power dissipated (W), which the energy `E(K)` loses. (R16)
    pub power: N,
}

/// Rate of the angular momentum `K̇ = [a v + K × T v]/(a² + K·adj(T)K)`, with `v = K × ∇E` and `a = 1 + K·c`. Of `T` it takes only how it
/// acts across `K`. (R16)
#[inline(always)]
pub fn momentum_rate<N: Scalar + Div<Output = N>>(K: [N; 3], gradient: [N; 3], a: N, T: [N; 6]) -> [N; 3] {
    let v = cross(K, gradient);
    let denominator = a * a + dot(K, smooth_times(adjugate(T), K));
    let turned = cross(K, smooth_times(T, v));
    let factor = N::from(1.0) / denominator;
    scale(factor, add(scale(a, v), turned))
}

/// Motion at an angular momentum, with the angular velocity `ω = ∇E − K̇ × c + T K̇` whose `K × ω` is the rate. (R16), (R17)
#[inline(always)]
pub fn energy_form<N: Scalar + Div<Output = N>>(
    K: [N; 3],
    gradient: [N; 3],
    c: [N; 3],
    T: [N; 6],
) -> EnergyMotion<N> {
    let rate = momentum_rate(K, gradient, N::from(1.0) + dot(K, c), T);
    let braking = smooth_times(T, rate);
    let omega = add(gradient, add(cross(c, rate), braking));
    EnergyMotion { omega, rate, power: dot(rate, braking) }
}

/// Motion under a torque `M` (N·m, body axes), `K̇ = K × ω + M` with the same `ω`: the torque adds `(a − K × T)⁻¹ (M + c K·M)` to the
/// rate, and the energy rises by `ω·M − P`. (R22)
#[inline(always)]
pub fn energy_form_under(
    K: [f64; 3],
    gradient: [f64; 3],
    c: [f64; 3],
    T: [f64; 6],
    torque: [f64; 3],
) -> EnergyMotion<f64> {
    let a = 1.0 + dot(K, c);
    let denominator = a * a + dot(K, smooth_times(adjugate(T), K));
    let pushed = add(torque, scale(dot(K, torque), c));
    let once = cross(K, smooth_times(T, pushed));
    let twice = cross(K, smooth_times(T, once));
    let turned = scale(denominator.recip(), add(scale(a, once), twice));
    let rate = add(momentum_rate(K, gradient, a, T), scale(a.recip(), add(pushed, turned)));
    let braking = smooth_times(T, rate);
    let omega = add(gradient, add(cross(c, rate), braking));
    EnergyMotion { omega, rate, power: dot(rate, braking) }
}

/// Gradient of a function of the angular momentum at a place.
pub fn energy_gradient(energy: &Series, K: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|axis| {
        let along =
            std::array::from_fn(|i| Jet { value: K[i], first: f64::from(u8::from(i == axis)), second: 0.0 });
        energy.scalar(along).first
    })
}
