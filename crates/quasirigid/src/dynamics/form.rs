//! The two forms of the reduced equations, compiled for integration.

use super::conserved_momentum::size;
use crate::math::polynomial::{Homogeneous, Kernel, Series};
use crate::math::simd::Arithmetic;
use crate::math::sym3::{self, Sym};
use crate::math::vec3::{self, cross, dot, norm};
use crate::model::ReducedBody;

/// Which variable the reduced equations are integrated in.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Form {
    /// The momentum in body axes, `K̇ = K × Ω(K)`: `|K|` is exact. (P1)
    #[default]
    Momentum,
    /// The spin, `J ω̇ + ω × (Jω + k) = μ(ω)`, as in the paper, with the momentum `k` of wheels. (P2)
    Paper,
}

impl Form {
    /// What errors of the state `x` are measured by, with this momentum inside.
    pub(super) fn size(self, x: [f64; 3], inside: [f64; 3]) -> f64 {
        match self {
            Self::Momentum => size(x, inside),
            Self::Paper => norm(x),
        }
    }
}

/// A form of the reduced equations: how its state `x` moves, and what it means.
pub(super) trait Equations {
    /// Spin (rad/s).
    fn omega<A: Arithmetic>(&self, x: [f64; 3]) -> [f64; 3];

    /// Rate of the state, whose spin is `omega`.
    fn rate<A: Arithmetic>(&self, x: [f64; 3], omega: [f64; 3]) -> [f64; 3];

    /// Rate of the form's energy (W) along its own field, which moves the state at `rate`. (P4)
    fn energy_rate<A: Arithmetic>(&self, x: [f64; 3], rate: [f64; 3]) -> f64;

    /// Energy (J).
    fn energy(&self, x: [f64; 3]) -> f64;

    /// Momentum (N·m·s, body axes).
    fn momentum(&self, x: [f64; 3]) -> [f64; 3];
}

/// `K̇ = K × Ω(K)`. (P1)
#[derive(Clone, Debug)]
pub(super) struct MomentumForm {
    Omega: Kernel,
    /// `Ω − ∇E`: the part of the spin that changes the energy, kept apart so that no digits cancel.
    working: Kernel,
    energy: Series,
}

impl MomentumForm {
    pub fn new(body: &ReducedBody) -> Self {
        let gradient = gradient(&body.energy_of_momentum);
        let mut working = body.Omega.clone();
        for degree in 0..=working.degree() {
            let mut part = working.part(degree).clone();
            part.add_scaled(-1.0, gradient.part(degree));
            working.set(if degree == 1 { Homogeneous::zero(1, 3) } else { part });
        }
        Self {
            Omega: Kernel::new(&body.Omega),
            working: Kernel::new(&working),
            energy: body.energy_of_momentum.clone(),
        }
    }
}

impl Equations for MomentumForm {
    #[inline(always)]
    fn omega<A: Arithmetic>(&self, K: [f64; 3]) -> [f64; 3] {
        vector(self.Omega.value::<A>(K))
    }

    #[inline(always)]
    fn rate<A: Arithmetic>(&self, K: [f64; 3], omega: [f64; 3]) -> [f64; 3] {
        cross(K, omega)
    }

    /// `∇E·(K × Ω) = ∇E·(K × (Ω − ∇E)) = −(Ω − ∇E)·(K × Ω)`, which has no terms that cancel.
    #[inline(always)]
    fn energy_rate<A: Arithmetic>(&self, K: [f64; 3], rate: [f64; 3]) -> f64 {
        -dot(vector(self.working.value::<A>(K)), rate)
    }

    fn energy(&self, K: [f64; 3]) -> f64 {
        self.energy.scalar(K)
    }

    fn momentum(&self, K: [f64; 3]) -> [f64; 3] {
        K
    }
}

/// `J ω̇ + ω × (Jω + k) = μ(ω)`, with the momentum `k` of wheels. (P2), (C4)
#[derive(Clone, Debug)]
pub(super) struct PaperForm {
    J: Sym,
    inverse: Sym,
    wheels: [f64; 3],
    mu: Kernel,
    /// `∇E − Jω`.
    gradient: Kernel,
    energy: Series,
    momentum: Series,
}

impl PaperForm {
    pub fn new(body: &ReducedBody) -> Self {
        let mut mu = Series::zero(body.f.degree(), 3);
        for degree in 3..=body.f.degree() {
            mu.set(body.mu(degree));
        }
        let mut gradient = gradient(&body.energy);
        gradient.set(Homogeneous::zero(1, 3));
        Self {
            J: body.J,
            inverse: sym3::inverse(body.J),
            wheels: body.wheels(),
            mu: Kernel::new(&mu),
            gradient: Kernel::new(&gradient),
            energy: body.energy.clone(),
            momentum: body.K.clone(),
        }
    }
}

impl Equations for PaperForm {
    #[inline(always)]
    fn omega<A: Arithmetic>(&self, omega: [f64; 3]) -> [f64; 3] {
        omega
    }

    #[inline(always)]
    fn rate<A: Arithmetic>(&self, omega: [f64; 3], _: [f64; 3]) -> [f64; 3] {
        let mu = vector(self.mu.value::<A>(omega));
        let gyroscopic = cross(vec3::add(sym3::times(self.J, omega), self.wheels), omega);
        sym3::times(self.inverse, vec3::add(gyroscopic, mu))
    }

    #[inline(always)]
    fn energy_rate<A: Arithmetic>(&self, omega: [f64; 3], rate: [f64; 3]) -> f64 {
        let mu = vector(self.mu.value::<A>(omega));
        dot(omega, mu) + dot(vector(self.gradient.value::<A>(omega)), rate)
    }

    fn energy(&self, omega: [f64; 3]) -> f64 {
        self.energy.scalar(omega)
    }

    fn momentum(&self, omega: [f64; 3]) -> [f64; 3] {
        self.momentum.vector(omega)
    }
}

/// Gradient of a map of one row.
fn gradient(map: &Series) -> Series {
    let mut gradient = Series::zero(map.degree() - 1, 3);
    for degree in 1..=map.degree() {
        let mut part = Homogeneous::zero(degree - 1, 3);
        for axis in 0..3 {
            part.add_row(axis, 1.0, (&map.part(degree).partial(axis), 0));
        }
        gradient.set(part);
    }
    gradient
}

#[inline(always)]
pub(super) fn vector([x, y, z, _]: [f64; 4]) -> [f64; 3] {
    [x, y, z]
}
