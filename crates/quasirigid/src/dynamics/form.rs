//! Angular-momentum form and angular-velocity form of the reduced equations, as polynomial kernels for integration. (P1), (P2)

use super::conserved_momentum::size;
use crate::math::polynomial::{Homogeneous, Kernel, Number, Series};
use crate::math::simd::{Arithmetic, Plain};
use crate::math::sym3::{self, Sym};
use crate::math::vec3::{self, cross, dot, norm};
use crate::model::ReducedBody;

/// Form of the reduced equations: the variable of integration.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Form {
    /// Angular-momentum form: `K` in body axes, `K̇ = K × Ω(K)`; `|K|` is exact. (P1)
    #[default]
    AngularMomentum,
    /// Angular-velocity form: `J ω̇ + ω × (Jω + k) = μ(ω)`, as in the paper, with the angular momentum `k` of wheels. (P2)
    AngularVelocity,
}

impl Form {
    /// Scale of errors of the state `x`, with this internal angular momentum.
    pub(super) fn size(self, x: [f64; 3], inside: [f64; 3]) -> f64 {
        match self {
            Self::AngularMomentum => size(x, inside),
            Self::AngularVelocity => norm(x),
        }
    }
}

/// Form of the reduced equations: rates of its state `x`, and the quantities that follow from `x`.
pub(super) trait Equations {
    /// Angular velocity (rad/s).
    fn omega<A: Arithmetic, N: Number>(&self, x: [N; 3]) -> [N; 3];

    /// Rate of the state, whose angular velocity is `omega`.
    fn rate<A: Arithmetic, N: Number>(&self, x: [N; 3], omega: [N; 3]) -> [N; 3];

    /// Rate of the form's energy (W) along its own field, which moves the state at `rate`. (P4)
    fn energy_rate<A: Arithmetic>(&self, x: [f64; 3], rate: [f64; 3]) -> f64;

    /// Energy (J).
    fn energy(&self, x: [f64; 3]) -> f64;

    /// Angular momentum (N·m·s, body axes).
    fn angular_momentum(&self, x: [f64; 3]) -> [f64; 3];
}

/// `K̇ = K × Ω(K)`. (P1)
#[derive(Clone, Debug)]
pub(super) struct AngularMomentumForm {
    Omega: Kernel,
    /// `Ω − ∇E`: the part of the angular velocity that changes the energy, kept apart so that no digits cancel.
    working: Kernel,
    energy: Series,
}

impl AngularMomentumForm {
    pub fn new(body: &ReducedBody) -> Self {
        Self::of(&body.Omega, &body.energy_of_momentum)
    }

    /// The form with angular momentum and angular velocity by their components along other axes.
    pub fn in_axes(body: &ReducedBody, axes: [[f64; 3]; 3]) -> Self {
        Self::of(&body.Omega.field_in_axes(axes), &body.energy_of_momentum.in_axes(axes))
    }

    fn of(Omega: &Series, energy: &Series) -> Self {
        let gradient = energy.gradient();
        let mut working = Omega.clone();
        for degree in 0..=working.degree() {
            let mut part = working.part(degree).clone();
            part.add_scaled(-1.0, gradient.part(degree));
            working.set(if degree == 1 { Homogeneous::zero(1, 3) } else { part });
        }
        Self { Omega: Kernel::new(Omega), working: Kernel::new(&working), energy: energy.clone() }
    }

    /// Gradient of the energy over the angular momentum (rad/s).
    pub fn energy_gradient(&self, K: [f64; 3]) -> [f64; 3] {
        let working = self.working.vector::<Plain, f64>(K);
        vec3::add(self.Omega.vector::<Plain, f64>(K), vec3::scale(-1.0, working))
    }
}

impl Equations for AngularMomentumForm {
    #[inline(always)]
    fn omega<A: Arithmetic, N: Number>(&self, K: [N; 3]) -> [N; 3] {
        self.Omega.vector::<A, _>(K)
    }

    #[inline(always)]
    fn rate<A: Arithmetic, N: Number>(&self, K: [N; 3], omega: [N; 3]) -> [N; 3] {
        cross(K, omega)
    }

    /// `∇E·(K × Ω) = ∇E·(K × (Ω − ∇E)) = −(Ω − ∇E)·(K × Ω)`, which has no terms that cancel.
    #[inline(always)]
    fn energy_rate<A: Arithmetic>(&self, K: [f64; 3], rate: [f64; 3]) -> f64 {
        -dot(self.working.vector::<A, _>(K), rate)
    }

    fn energy(&self, K: [f64; 3]) -> f64 {
        self.energy.scalar(K)
    }

    fn angular_momentum(&self, K: [f64; 3]) -> [f64; 3] {
        K
    }
}

/// `J ω̇ + ω × (Jω + k) = μ(ω)`, with the angular momentum `k` of wheels. (P2), (C4)
#[derive(Clone, Debug)]
pub(super) struct AngularVelocityForm {
    J: Sym,
    inverse: Sym,
    wheels: [f64; 3],
    mu: Kernel,
    /// `∇E − Jω`.
    gradient: Kernel,
    energy: Series,
    angular_momentum: Series,
}

impl AngularVelocityForm {
    pub fn new(body: &ReducedBody) -> Self {
        let mut mu = Series::zero(body.f.degree(), 3);
        for degree in 3..=body.f.degree() {
            mu.set(body.mu(degree));
        }
        let mut gradient = body.energy.gradient();
        gradient.set(Homogeneous::zero(1, 3));
        Self {
            J: body.J,
            inverse: sym3::inverse(body.J),
            wheels: body.wheels(),
            mu: Kernel::new(&mu),
            gradient: Kernel::new(&gradient),
            energy: body.energy.clone(),
            angular_momentum: body.K.clone(),
        }
    }
}

impl Equations for AngularVelocityForm {
    #[inline(always)]
    fn omega<A: Arithmetic, N: Number>(&self, omega: [N; 3]) -> [N; 3] {
        omega
    }

    #[inline(always)]
    fn rate<A: Arithmetic, N: Number>(&self, omega: [N; 3], _: [N; 3]) -> [N; 3] {
        let mu = self.mu.vector::<A, _>(omega);
        let [x, y, z] = self.wheels;
        let gyroscopic =
            cross(vec3::add(sym3::times(self.J, omega), [N::from(x), N::from(y), N::from(z)]), omega);
        sym3::times(self.inverse, vec3::add(gyroscopic, mu))
    }

    #[inline(always)]
    fn energy_rate<A: Arithmetic>(&self, omega: [f64; 3], rate: [f64; 3]) -> f64 {
        let mu = self.mu.vector::<A, _>(omega);
        dot(omega, mu) + dot(self.gradient.vector::<A, _>(omega), rate)
    }

    fn energy(&self, omega: [f64; 3]) -> f64 {
        self.energy.scalar(omega)
    }

    fn angular_momentum(&self, omega: [f64; 3]) -> [f64; 3] {
        self.angular_momentum.vector(omega)
    }
}

#[inline(always)]
pub(super) fn vector([x, y, z, _]: [f64; 4]) -> [f64; 3] {
    [x, y, z]
}
