use crate::math::rotation;
use crate::math::sym3::{Sym, times};
use crate::math::vec3::{add, norm, scale};

/// Conserved angular momentum of a body without external moments: constant in inertial axes, so that errors of an integrator show against
/// it. (P3), (P6)
#[derive(Clone, Copy, Debug)]
pub(super) struct Conserved {
    /// Angular momentum in inertial axes (N·m·s).
    pub K_N: [f64; 3],
    /// Size `|K|` at the start.
    G: f64,
    /// Size of the internal angular momentum, if it nearly cancels that of the carrier.
    cancelled: Option<f64>,
}

/// Share of the internal angular momentum below which the total is a small difference of two large terms, whose errors are larger than
/// those of the total.
const CANCELLED: f64 = 1e-3;

fn cancelled(G: f64, inside: [f64; 3]) -> Option<f64> {
    let inside = norm(inside);
    (G <= CANCELLED * inside).then_some(inside)
}

/// Internal angular momentum: the part of `K` (N·m·s) that the frozen body does not have at this angular velocity (rad/s), that of wheels
/// and of internal motion.
pub(super) fn inside(K: [f64; 3], J: Sym, omega: [f64; 3]) -> [f64; 3] {
    add(K, scale(-1.0, times(J, omega)))
}

/// Scale of errors of an angular momentum (N·m·s): its size, or that of the part [`inside`] that nearly cancels the rest.
pub(super) fn size(K: [f64; 3], inside: [f64; 3]) -> f64 {
    cancelled(norm(K), inside).unwrap_or(norm(K))
}

impl Conserved {
    /// From an angular momentum in inertial axes, its size, and the part [`inside`].
    pub fn new(K_N: [f64; 3], G: f64, inside: [f64; 3]) -> Self {
        Self { K_N, G, cancelled: cancelled(G, inside) }
    }

    /// From an angular momentum in body axes, an attitude, and the part [`inside`].
    pub fn of(K: [f64; 3], attitude: [f64; 4], inside: [f64; 3]) -> Self {
        let K_N = rotation::to_inertial(attitude, K);
        Self::new(K_N, norm(K_N), inside)
    }

    /// True if the angular momentum is to be restored: false where internal rotors nearly cancel it.
    #[inline(always)]
    pub fn held(&self) -> bool {
        self.cancelled.is_none()
    }

    /// `ln(|K|/G)`, the drift that a projection removes. (P6)
    #[inline(always)]
    pub fn drift(&self, K: [f64; 3]) -> f64 {
        (norm(K) / self.G).ln()
    }

    /// Angular momentum along another, with the size at the start. (P6)
    #[inline(always)]
    pub fn sized(&self, K: [f64; 3]) -> [f64; 3] {
        scale(self.G / norm(K), K)
    }

    /// Change of `|K|`, relative to `|K|` or to the internal part that nearly cancels the rest; from rest as it is (N·m·s).
    pub fn change(&self, K: [f64; 3]) -> f64 {
        match self.cancelled {
            Some(0.0) => norm(K),
            Some(inside) => (norm(K) - self.G) / inside,
            None => norm(K) / self.G - 1.0,
        }
    }

    /// Attitude that gives the angular momentum its inertial direction, if [`held`](Self::held). (P3)
    #[inline(always)]
    pub fn aligned(&self, attitude: [f64; 4], K: [f64; 3]) -> [f64; 4] {
        if self.held() { rotation::aligned(attitude, K, self.K_N) } else { rotation::normalized(attitude) }
    }
}
