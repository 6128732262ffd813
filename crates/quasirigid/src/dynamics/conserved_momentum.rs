use crate::math::rotation;
use crate::math::sym3::{Sym, times};
use crate::math::vec3::{add, norm, scale};

/// The momentum of a body that no moment acts on: constant in inertial axes, whatever an integrator makes of it. (P3), (P6)
#[derive(Clone, Copy, Debug)]
pub(super) struct Conserved {
    /// In inertial axes (N·m·s).
    pub K_N: [f64; 3],
    /// Its size `|K|` at the start.
    G: f64,
    /// The momentum of what turns inside, if that takes up the whole.
    cancelled: Option<f64>,
}

/// Below this share of the momentum of what turns inside the whole is what is left where two momenta cancel: their errors are larger
/// than its own would be.
const CANCELLED: f64 = 1e-3;

fn cancelled(G: f64, inside: [f64; 3]) -> Option<f64> {
    let inside = norm(inside);
    (G <= CANCELLED * inside).then_some(inside)
}

/// The part of a momentum (N·m·s) that the frozen body does not have at this spin (rad/s): of wheels and of all that moves.
pub(super) fn inside(K: [f64; 3], J: Sym, omega: [f64; 3]) -> [f64; 3] {
    add(K, scale(-1.0, times(J, omega)))
}

/// What errors of a momentum (N·m·s) are measured by: itself, or the part [`inside`] that takes it up.
pub(super) fn size(K: [f64; 3], inside: [f64; 3]) -> f64 {
    cancelled(norm(K), inside).unwrap_or(norm(K))
}

impl Conserved {
    /// A momentum in inertial axes, its size, and the part [`inside`].
    pub fn new(K_N: [f64; 3], G: f64, inside: [f64; 3]) -> Self {
        Self { K_N, G, cancelled: cancelled(G, inside) }
    }

    /// Of a momentum in body axes, at an attitude, and the part [`inside`].
    pub fn of(K: [f64; 3], attitude: [f64; 4], inside: [f64; 3]) -> Self {
        let K_N = rotation::to_inertial(attitude, K);
        Self::new(K_N, norm(K_N), inside)
    }

    /// Whether there is a momentum to hold: none where what turns inside takes it up.
    #[inline(always)]
    pub fn held(&self) -> bool {
        self.cancelled.is_none()
    }

    /// `ln(|K|/G)`, which a projection takes back. (P6)
    #[inline(always)]
    pub fn drift(&self, K: [f64; 3]) -> f64 {
        (norm(K) / self.G).ln()
    }

    /// Change of `|K|`, relative to itself or to the part inside that takes it up.
    pub fn change(&self, K: [f64; 3]) -> f64 {
        match self.cancelled {
            Some(inside) => (norm(K) - self.G) / inside,
            None => norm(K) / self.G - 1.0,
        }
    }

    /// The attitude that gives the momentum its inertial direction, if that is to be held. (P3)
    #[inline(always)]
    pub fn aligned(&self, attitude: [f64; 4], K: [f64; 3]) -> [f64; 4] {
        if self.held() { rotation::aligned(attitude, K, self.K_N) } else { rotation::normalized(attitude) }
    }
}
