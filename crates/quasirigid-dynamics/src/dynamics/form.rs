//! Energy form, in the angular momentum, and angular-velocity form of the reduced equations, as polynomial kernels for integration.
//! Equations (P1), (P2), docs/theory/05-propagation.md; (R16), docs/theory/03-reduction.md.

use super::conserved_momentum::size;
use crate::math::polynomial::{Homogeneous, Kernel, Number, QuadraticKernel, Series, TensorKernel};
use crate::math::simd::Arithmetic;
use crate::math::sym3::{self, Sym};
use crate::math::vec3::{self, cross, dot, norm};
use crate::model::{EnergyMotion, Form, ReducedBody, energy_form, energy_form_under};

/// Scale of errors of the state `x` of a form, with this internal angular momentum.
pub(super) fn error_scale(form: Form, x: [f64; 3], inside: [f64; 3]) -> f64 {
    match form {
        Form::AngularMomentum => size(x, inside),
        Form::AngularVelocity => norm(x),
    }
}

/// Motion at a state of a form.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion {
    /// Angular velocity (rad/s).
    pub omega: [f64; 3],
    /// Rate of the state.
    pub rate: [f64; 3],
    /// Power taken by the dashpots (W).
    pub power: f64,
    /// Rate of the form's energy (W) along its own field. (P4)
    pub energy_rate: f64,
}

/// Rates of the state of a form.
pub(super) trait Rates<N: Number> {
    /// Rate of the state.
    fn rate<A: Arithmetic>(&self, x: [N; 3]) -> [N; 3];
}

/// Form of the reduced equations: the quantities that follow from its state `x`.
pub(super) trait Equations {
    /// Angular velocity (rad/s).
    fn omega(&self, x: [f64; 3]) -> [f64; 3];

    /// Angular velocity, rate of the state, power and rate of the energy at once.
    fn motion<A: Arithmetic>(&self, x: [f64; 3]) -> Motion;

    /// Energy (J).
    fn energy(&self, x: [f64; 3]) -> f64;

    /// Gradient of the energy over the state, where the form loses exactly its power. (R16)
    fn energy_gradient(&self, x: [f64; 3]) -> Option<[f64; 3]>;

    /// Angular momentum (N·m·s, body axes).
    fn angular_momentum(&self, x: [f64; 3]) -> [f64; 3];
}

/// Energy form `K̇ = [a v + K × T v]/(a² + K·adj(T)K)`, `v = K × ∇E`: keeps `|K|` and loses exactly its power. (P1), (R16)
#[derive(Clone, Debug)]
pub(super) struct AngularMomentumForm {
    gradient: Kernel,
    c: Kernel,
    T: TensorKernel,
    /// `c` and the two halves of `T`, where both are quadratic: at order 3 without rotors and liquids.
    quadratic: Option<[QuadraticKernel; 3]>,
    energy: Kernel,
}

impl AngularMomentumForm {
    pub fn new(body: &ReducedBody) -> Self {
        let quadratic = || {
            let [diagonal, others] =
                [[0, 1, 2], [3, 4, 5]].map(|rows| QuadraticKernel::new(&body.T.picked(&rows)));
            Some([QuadraticKernel::new(&body.c)?, diagonal?, others?])
        };
        Self {
            quadratic: quadratic(),
            gradient: Kernel::new(&body.energy_of_momentum.gradient()),
            c: Kernel::new(&body.c),
            T: TensorKernel::new(&body.T),
            energy: Kernel::new(&body.energy_of_momentum),
        }
    }

    /// Gradient of the energy over the angular momentum (rad/s).
    pub fn slope(&self, K: [f64; 3]) -> [f64; 3] {
        vector(self.gradient.at(K))
    }

    /// Motion under a torque (N·m, body axes). (R22)
    #[inline(always)]
    pub fn under<A: Arithmetic>(&self, K: [f64; 3], torque: [f64; 3]) -> EnergyMotion<f64> {
        let (gradient, c, T) = self.terms::<A>(K);
        energy_form_under(K, gradient, c, T, torque)
    }

    /// Gradient of the energy, `c` and `T`.
    #[inline(always)]
    fn terms<A: Arithmetic>(&self, K: [f64; 3]) -> ([f64; 3], [f64; 3], [f64; 6]) {
        let gradient = self.gradient.vector::<A, f64>(K);
        let Some(quadratic) = &self.quadratic else {
            return (gradient, self.c.vector::<A, f64>(K), self.T.value::<A, f64>(K));
        };
        let monomials = QuadraticKernel::monomials(K);
        let [c, [xx, yy, zz], [yz, zx, xy]] =
            quadratic.each_ref().map(|kernel| kernel.vector::<A, f64>(&monomials));
        (gradient, c, [xx, yy, zz, yz, zx, xy])
    }
}

impl Equations for AngularMomentumForm {
    fn omega(&self, K: [f64; 3]) -> [f64; 3] {
        energy_form(K, self.slope(K), vector(self.c.at(K)), self.T.at(K)).omega
    }

    #[inline(always)]
    fn motion<A: Arithmetic>(&self, K: [f64; 3]) -> Motion {
        let (gradient, c, T) = self.terms::<A>(K);
        let EnergyMotion { omega, rate, power } = energy_form(K, gradient, c, T);
        Motion { omega, rate, power, energy_rate: -power }
    }

    fn energy(&self, K: [f64; 3]) -> f64 {
        self.energy.at(K)[0]
    }

    fn energy_gradient(&self, K: [f64; 3]) -> Option<[f64; 3]> {
        Some(self.slope(K))
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
    power: Kernel,
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
            power: Kernel::new(&body.power),
            energy: body.energy.clone(),
            angular_momentum: body.K.clone(),
        }
    }
}

impl AngularVelocityForm {
    /// Rate of the angular velocity under the torque `μ`.
    #[inline(always)]
    fn driven_rate<N: Number>(&self, omega: [N; 3], mu: [N; 3]) -> [N; 3] {
        let [x, y, z] = self.wheels;
        let gyroscopic =
            cross(vec3::add(sym3::times(self.J, omega), [N::from(x), N::from(y), N::from(z)]), omega);
        sym3::times(self.inverse, vec3::add(gyroscopic, mu))
    }
}

impl<N: Number> Rates<N> for AngularVelocityForm {
    #[inline(always)]
    fn rate<A: Arithmetic>(&self, omega: [N; 3]) -> [N; 3] {
        self.driven_rate(omega, self.mu.vector::<A, _>(omega))
    }
}

impl Equations for AngularVelocityForm {
    fn omega(&self, omega: [f64; 3]) -> [f64; 3] {
        omega
    }

    #[inline(always)]
    fn motion<A: Arithmetic>(&self, omega: [f64; 3]) -> Motion {
        let mu = self.mu.vector::<A, f64>(omega);
        let rate = self.driven_rate(omega, mu);
        let energy_rate = dot(omega, mu) + dot(self.gradient.vector::<A, _>(omega), rate);
        Motion { omega, rate, power: self.power.value::<A>(omega)[0], energy_rate }
    }

    fn energy(&self, omega: [f64; 3]) -> f64 {
        self.energy.scalar(omega)
    }

    fn energy_gradient(&self, _: [f64; 3]) -> Option<[f64; 3]> {
        None
    }

    fn angular_momentum(&self, omega: [f64; 3]) -> [f64; 3] {
        self.angular_momentum.vector(omega)
    }
}

#[inline(always)]
pub(super) fn vector([x, y, z, _]: [f64; 4]) -> [f64; 3] {
    [x, y, z]
}
