//! Reduced equations of a nearly rigid body to order `p`, as polynomials in the angular velocity or the angular momentum.
//! A plain record: validity, propagation and averages take it, and bodies known only by their equations can be built without a reduction.
//! Equations (R1) to (R11), docs/theory/03-reduction.md; (P7), docs/theory/05-propagation.md; (C4) to (C6), docs/theory/13-inside.md.

use crate::energy_form::{EnergyMotion, energy_form, energy_gradient};
use crate::math::polynomial::monomial::index;
use crate::math::polynomial::{Homogeneous, Series};
use crate::math::sym3::{self, Sym};

/// Reduced equations of a nearly rigid body to order `p`: the second core type.
///
/// Polynomials in the angular velocity `ω` (rad/s, body axes), stored degree by degree. Every use of the reduced equations takes this
/// type, independent of its origin.
///
/// ```
/// use quasirigid::prelude::*;
/// use quasirigid::problems::ring_of_points;
///
/// let reduced = reduce(&ring_of_points(4).body()?, 4)?;
/// let omega = [0.1, -0.3, 1.0];
/// let mu4 = reduced.mu(4).value(omega); // N·m
/// let entry = reduced.tensor(&[0, 0, 1, 1]); // the vector D_{·xxyy}
/// assert_eq!((mu4.len(), entry.len()), (3, 3));
/// assert!(reduced.dissipated_power(omega) >= 0.0);
/// # Ok::<(), quasirigid::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ReducedBody {
    /// Order `p`: the motion over a fixed time is in error by `ε^{p+1}`.
    pub order: usize,
    /// Mass `m*` (kg).
    pub mass: f64,
    /// Inertia tensor `J` of the frozen body about the pole (kg·m²): xx, yy, zz, yz, zx, xy.
    pub J: Sym,
    /// Angular acceleration `ω̇ = f(ω)` (rad/s²), degrees 2 to `p + 2`. With momentum wheels, whose angular momentum has degree one, each
    /// degree contains lower monomials too, here and in every polynomial below. (R2), (C4)
    pub f: Series,
    /// Angular momentum `K(ω)` (N·m·s) with that of wheels, degrees 1 to `p + 1`. (R5)
    pub K: Series,
    /// Angular velocity `Ω(K)` (rad/s) as a polynomial in the angular momentum (N·m·s), degrees 1 to `p + 1`. (R11)
    pub Omega: Series,
    /// Axial vector `c(K)` (1/(N·m·s)) by which the internal momenta slow the angular momentum down, `K̇ = (K × ∇E)/(1 + K·c)` without
    /// dissipation: degrees 0 to `p − 1`, over the angular momentum. (R18)
    pub c: Series,
    /// Tensor `T(K)` (s/(kg·m²)) of the dissipation, `P = K̇·T K̇`, positive semi-definite: xx, yy, zz, yz, zx, xy, over the angular momentum;
    /// of elastic coordinates from degree 2, of cyclic ones from degree 0. (R19)
    pub T: Series,
    /// Energy (J) without that of the wheels, degrees 2 to `p + 2`. (R10), (C5)
    pub energy: Series,
    /// Energy (J) as a polynomial in the angular momentum (N·m·s), degrees 2 to `p + 2`. (R11)
    pub energy_of_momentum: Series,
    /// Power dissipated (W), a sum of squares: by elastic coordinates of degrees 6 to `2p`, none below `p = 3`; by cyclic ones
    /// of degrees 4 to `2p + 2`, none below `p = 1`. (R9), (C6)
    pub power: Series,
    /// Power of each dissipator (W), by name; materials without equation of motion have none. (D3)
    pub power_shares: Vec<(String, Series)>,
    /// Force `φ = −Σ m r̈` of the displacements (N), degrees 4 to `p + 2`: moves the pole of a free body, and acts on a support that
    /// fixes the pole. (R8)
    pub phi: Series,
    /// Place of the pole of a free body from its centre of mass (m), body axes, `−s/m*`, degrees 2 to `p`; zero where a point
    /// is fixed or driven. (P7)
    pub pole: Series,
    /// Internal coordinates `q(ω)`, one row each, degrees 2 to `p`; zero for cyclic ones. (R4)
    pub q: Series,
    /// Rates `q̇(ω)` of the coordinates: of elastic ones of degrees 3 to `p + 1`, of cyclic ones of degrees 2 to `p + 1`. (R3), (C3)
    pub rate: Series,
}

impl ReducedBody {
    /// Torque `μ_d = J f_d` (N·m), one degree of the deviation from Euler's equations; degree 2 is the torque `−ω × Jω` of Euler's
    /// equations. (R7)
    ///
    /// # Panics
    /// If `degree` is above [`highest_degree`](Self::highest_degree).
    #[must_use]
    pub fn mu(&self, degree: usize) -> Homogeneous {
        let highest = self.highest_degree();
        assert!(
            degree <= highest,
            "degree {degree} of a body reduced to order {}: at most {highest}",
            self.order
        );
        self.f.part(degree).contracted(&sym3::rows(self.J))
    }

    /// Highest known degree of the torque, `p + 2`.
    #[must_use]
    pub fn highest_degree(&self) -> usize {
        self.f.degree()
    }

    /// Entry of the tensor of one degree of `μ`, symmetric in the indices of `ω`: with indices `k, l, m, n` the vector `D_{·klmn}` of the
    /// paper's (4.4), `μ₄ = D_{·klmn} ω_k ω_l ω_m ω_n`; with five indices `E`. (R7)
    ///
    /// # Panics
    /// If there are fewer than two indices or more than `p + 2`, or an index is above 2.
    #[must_use]
    pub fn tensor(&self, indices: &[usize]) -> [f64; 3] {
        let degree = indices.len();
        assert!(degree >= 2, "the torque begins with degree 2, Euler's; {degree} indices are too few");
        assert!(indices.iter().all(|axis| *axis < 3), "indices are 0, 1 and 2: {indices:?}");
        let mut exponents = [0; 3];
        indices.iter().for_each(|axis| exponents[*axis] += 1);
        let factorial = |n: usize| (1..=n).product::<usize>() as f64;
        let orderings = factorial(degree) / exponents.map(factorial).iter().product::<f64>();
        let mu = self.mu(degree);
        [0, 1, 2].map(|row| mu.row(row)[index(exponents)] / orderings)
    }

    /// Angular momentum `k` of the wheels relative to the body (N·m·s), body axes. (C4)
    #[must_use]
    pub fn wheels(&self) -> [f64; 3] {
        [0, 1, 2].map(|row| self.K.coefficient(row, [0; 3]))
    }

    /// True if the body has momentum wheels.
    #[must_use]
    pub fn has_wheels(&self) -> bool {
        self.wheels() != [0.0; 3]
    }

    /// Total deviation torque `μ(ω)` (N·m) at an angular velocity (rad/s).
    #[must_use]
    pub fn torque(&self, omega: [f64; 3]) -> [f64; 3] {
        let mut f = [0.0; 3];
        for degree in 3..=self.f.degree() {
            self.f.part(degree).add_value(omega, &mut f);
        }
        sym3::times(self.J, f)
    }

    /// Angular momentum (N·m·s, body axes) on the slow manifold at an angular velocity (rad/s).
    #[must_use]
    pub fn angular_momentum(&self, omega: [f64; 3]) -> [f64; 3] {
        self.K.vector(omega)
    }

    /// Motion at an angular momentum (N·m·s, body axes) by the energy form. (R16)
    #[must_use]
    pub fn motion(&self, K: [f64; 3]) -> EnergyMotion<f64> {
        let gradient = energy_gradient(&self.energy_of_momentum, K);
        energy_form(K, gradient, self.c.vector(K), self.T.tensor(K))
    }

    /// Angular velocity (rad/s, body axes) at an angular momentum (N·m·s, body axes) by the energy form. (R17)
    #[must_use]
    pub fn angular_velocity(&self, K: [f64; 3]) -> [f64; 3] {
        self.motion(K).omega
    }

    /// Energy (J) of the whole body on the slow manifold at an angular velocity (rad/s).
    #[must_use]
    pub fn energy(&self, omega: [f64; 3]) -> f64 {
        self.energy.scalar(omega)
    }

    /// Power (W) that each dissipator takes at an angular velocity (rad/s), by name. (D3)
    #[must_use]
    pub fn power_budget(&self, omega: [f64; 3]) -> Vec<(String, f64)> {
        self.power_shares.iter().map(|(name, power)| (name.clone(), power.scalar(omega))).collect()
    }

    /// Power (W) taken by the dashpots at an angular velocity (rad/s); never negative.
    #[must_use]
    pub fn dissipated_power(&self, omega: [f64; 3]) -> f64 {
        self.power.scalar(omega)
    }
}
