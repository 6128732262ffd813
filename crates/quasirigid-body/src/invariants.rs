use std::ops::AddAssign;

use crate::math::sparse::SparseRows;
use crate::math::sym3::Sym;

/// Inertia invariants of a flexible body about its pole `O`: all properties of the mass in the equations of motion. (I1)–(I6)
///
/// Sums over every mass element, body axes, before the translation of a free body is eliminated; see
/// [`FlexibleBody::translation`](super::FlexibleBody::translation).
#[derive(Clone, Debug, PartialEq)]
pub struct Invariants {
    /// Mass `m*` (kg).
    pub mass: f64,
    /// Inertia tensor `J` of the frozen body (kg·m²). (I1)
    pub J: Sym,
    /// Linear momentum per unit rate of each coordinate, `S_j`. (I2)
    pub S: Vec<[f64; 3]>,
    /// Angular momentum per unit rate of each coordinate, `h_j`. (I2)
    pub h: Vec<[f64; 3]>,
    /// First-order change of inertia, `J_j`. (I3)
    pub J1: Vec<Sym>,
    /// Invariants of pairs of coordinates; row `j`, column `k`.
    pub pairs: SparseRows<Pair>,
}

/// Inertia invariants of a pair of coordinates `(j, k)`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pair {
    /// Modal mass `A_jk`.
    pub A: f64,
    /// Second-order change of inertia, `J_jk`. (I4)
    pub J2: Sym,
    /// Change of `h_k` with `q_j`: the Coriolis coupling, and the symmetric part that curved paths add. (I5) For two cyclic coordinates
    /// the whole gyroscopic coupling, `2ρ∫u_j × u_k dV`. (C2)
    pub Z: [f64; 3],
    /// Change of `S_k` with `q_j`: the curvature of the paths, `Γ_jk`. (I6)
    pub S2: [f64; 3],
}

impl AddAssign for Pair {
    fn add_assign(&mut self, other: Self) {
        self.A += other.A;
        for (sum, part) in self.J2.iter_mut().zip(other.J2) {
            *sum += part;
        }
        for axis in 0..3 {
            self.Z[axis] += other.Z[axis];
            self.S2[axis] += other.S2[axis];
        }
    }
}
