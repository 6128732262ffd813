//! Numbers by which exported equations are checked: motions at some angular momenta, with and without a torque.
//! The rate is found by Cramer's rule from its linear equation, not by the closed form that is exported.
//! Equations (R17), (R22), docs/theory/03-reduction.md.

use quasirigid_body::ReducedBody;
use quasirigid_math::sym3::{rows, times};
use quasirigid_math::vec3::{add, cross, dot, norm, scale};

use super::FreeBody;

/// Directions of the angular momenta and of the torques, relative to a size.
const STATES: [([f64; 3], [f64; 3]); 6] = [
    ([0.48, 0.64, 0.6], [0.0, 0.0, 0.0]),
    ([-0.36, 0.48, 0.8], [0.0, 0.0, 0.0]),
    ([0.28, -0.96, 0.1], [0.05, -0.02, 0.04]),
    ([0.8, 0.1, -0.59], [-0.03, 0.06, 0.01]),
    ([-0.6, -0.36, 0.7], [0.02, 0.02, -0.05]),
    ([0.1, 0.2, 0.97], [0.0, -0.01, 0.1]),
];
/// Share of the range in which bodies are tested that have no spin, or one beyond the range.
const SHARE: f64 = 0.5;

/// Motions, each `K`, torque, `ω`, `K̇`, power and energy: 14 numbers; the first is that of the start, unless it is beyond the range. (R22)
pub(super) fn test_vectors(body: &FreeBody) -> Vec<[f64; 14]> {
    let FreeBody { reduced, start: (momentum, _), range: [holds, _], .. } = body;
    let largest = reduced.J[..3].iter().fold(0.0_f64, |largest, moment| largest.max(*moment));
    let within = largest * SHARE * if holds.is_finite() { *holds } else { 1.0 };
    let size = match norm(*momentum) {
        own if own > 0.0 && (own < within || holds.is_infinite()) => own,
        _ => within,
    };
    let torque = size * size / largest;
    let states = STATES.iter().map(|(direction, turning)| (scale(size, *direction), scale(torque, *turning)));
    let first = scale(size / norm(*momentum).max(f64::MIN_POSITIVE), *momentum);
    std::iter::once((first, [0.0; 3])).chain(states).map(|(K, M)| vector(reduced, K, M)).collect()
}

fn vector(reduced: &ReducedBody, K: [f64; 3], M: [f64; 3]) -> [f64; 14] {
    let Moved { omega, rate, power } = moved(reduced, K, M);
    let numbers = [K, M, omega, rate].concat();
    let energy = reduced.energy_of_momentum.scalar(K);
    std::array::from_fn(|i| if i < 12 { numbers[i] } else { [power, energy][i - 12] })
}

/// Motion at an angular momentum under a torque.
struct Moved {
    omega: [f64; 3],
    rate: [f64; 3],
    power: f64,
}

/// `K̇ = K × ω + M` with `ω = ∇E − K̇ × c + T K̇`, a linear equation for `K̇`. (R22)
fn moved(reduced: &ReducedBody, K: [f64; 3], M: [f64; 3]) -> Moved {
    let gradient = reduced.energy_of_momentum.gradient().vector(K);
    let (c, T) = (reduced.c.vector(K), reduced.T.tensor(K));
    let omega = |rate: [f64; 3]| add(gradient, add(cross(c, rate), times(T, rate)));
    let units = rows([1.0, 1.0, 1.0, 0.0, 0.0, 0.0]);
    let columns = units.map(|unit| {
        let answer = add(omega(unit), scale(-1.0, gradient));
        add(unit, scale(-1.0, cross(K, answer)))
    });
    let right = add(cross(K, gradient), M);
    let volume = |[a, b, c]: [[f64; 3]; 3]| dot(a, cross(b, c));
    let rate = std::array::from_fn(|axis| {
        let mut replaced = columns;
        replaced[axis] = right;
        volume(replaced) / volume(columns)
    });
    Moved { omega: omega(rate), rate, power: dot(rate, times(T, rate)) }
}

/// Steps to the angular momentum of a spin, and the relative error that is one of rounding.
const STEPS: usize = 200;
const ROUNDING: f64 = 1e-12;

/// Angular momentum (N·m·s, body axes) with an angular velocity (rad/s) where no torque acts; none where the series has none. (R17)
#[must_use]
pub fn momentum_of(reduced: &ReducedBody, omega: [f64; 3]) -> Option<[f64; 3]> {
    let mut K = reduced.angular_momentum(omega);
    if omega == [0.0; 3] {
        return Some(K);
    }
    let mut best = (f64::INFINITY, K);
    for _ in 0..STEPS {
        let gap = add(omega, scale(-1.0, reduced.angular_velocity(K)));
        if norm(gap) < best.0 {
            best = (norm(gap), K);
        }
        K = add(K, times(reduced.J, gap));
    }
    (best.0 <= ROUNDING * norm(omega)).then_some(best.1)
}

#[cfg(test)]
mod tests {
    use quasirigid::prelude::reduce;
    use quasirigid::problems::ring_of_points;

    use super::*;

    #[test]
    fn a_torque_does_the_work_that_the_energy_gains() {
        let reduced = reduce(&ring_of_points(4).body().unwrap(), 5).unwrap();
        for (K, M) in STATES {
            let Moved { omega, rate, power } = moved(&reduced, K, M);
            let gained = dot(reduced.energy_of_momentum.gradient().vector(K), rate);
            let size = norm(omega) * norm(rate);
            assert!((gained - (dot(omega, M) - power)).abs() < 1e-14 * size, "{gained}");
            let kept = add(cross(K, omega), M);
            assert!(norm(add(kept, scale(-1.0, rate))) < 1e-14 * size);
            let free = (moved(&reduced, K, [0.0; 3]), reduced.motion(K));
            assert!(norm(add(free.0.omega, scale(-1.0, free.1.omega))) < 1e-14 * norm(omega));
        }
    }

    #[test]
    fn an_angular_momentum_has_its_spin() {
        let reduced = reduce(&ring_of_points(4).body().unwrap(), 3).unwrap();
        let omega = [0.1, -0.2, 0.3];
        let K = momentum_of(&reduced, omega).unwrap();
        assert!(norm(add(reduced.angular_velocity(K), scale(-1.0, omega))) < 1e-12 * norm(omega));
        assert_eq!(momentum_of(&reduced, [300.0, 1.0, 2.0]), None);
    }
}
