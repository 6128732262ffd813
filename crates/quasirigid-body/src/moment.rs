//! Invariants from the second moment `W = ∫ u vᵀ dm` of two vector fields. (I7)

use nalgebra::Matrix3;

use super::Pair;
use crate::math::sym3::Sym;

/// `∫ u × v dm`.
pub fn cross(W: &Matrix3<f64>) -> [f64; 3] {
    [W[(1, 2)] - W[(2, 1)], W[(2, 0)] - W[(0, 2)], W[(0, 1)] - W[(1, 0)]]
}

/// `∫ [2(u·v) 1 − u vᵀ − v uᵀ] dm`.
pub fn inertia(W: &Matrix3<f64>) -> Sym {
    let form = 2.0 * W.trace() * Matrix3::identity() - W - W.transpose();
    [form[(0, 0)], form[(1, 1)], form[(2, 2)], form[(1, 2)], form[(2, 0)], form[(0, 1)]]
}

/// Invariants of two coordinates whose paths are straight. (I4), (I5)
pub fn straight_pair(W: &Matrix3<f64>) -> Pair {
    Pair { A: W.trace(), J2: inertia(W).map(|entry| 0.5 * entry), Z: cross(W), S2: [0.0; 3] }
}

/// Invariants of two coordinates with curved paths, `sum` = `∫ G_jk dm` and `G` = `∫ ρ G_jkᵀ dm`. (I6)
pub fn curved_pair(straight: Pair, sum: [f64; 3], G: &Matrix3<f64>) -> Pair {
    let (bent, turned) = (inertia(G), cross(G));
    Pair {
        J2: std::array::from_fn(|i| straight.J2[i] + 0.5 * bent[i]),
        Z: std::array::from_fn(|i| straight.Z[i] + turned[i]),
        S2: sum,
        ..straight
    }
}
