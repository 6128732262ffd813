//! Observables along a slow manifold about a spin: angular velocity, direction of the angular momentum, turning about it, and powers.
//! The turning, the powers and the revolutions are split into the integral of a polynomial and a mean that depends on amplitudes alone, so
//! that a history needs no step within a period. (W8), (W10)

use crate::math::submanifold::{InvariantManifold, Monomials, Ring, Truncated};
use crate::math::vec3::{dot, norm, scale};
use crate::model::{Dissipator, FlexibleBody};

use super::steady::SteadySpin;

/// Observables along a manifold.
#[derive(Clone, Debug)]
pub(super) struct Observables {
    /// Direction of the angular momentum, body axes.
    pub direction: [Truncated; 3],
    /// Angle of the body about the angular momentum.
    pub turning: Accrued,
    /// Length `∫|ω|dt` of the rotation (rad).
    pub revolved: Accrued,
    /// Energy taken by each dissipator (J).
    pub dissipated: Vec<Accrued>,
}

/// Quantity that accrues along the motion: `∫ g dt = G(z) + ∫ ḡ dt`. (W8)
#[derive(Clone, Debug)]
pub(super) struct Accrued {
    /// Periodic part `G`.
    pub periodic: Truncated,
    /// Mean rate `ḡ`.
    pub mean: Truncated,
}

impl Accrued {
    fn of(manifold: &InvariantManifold, rate: &Truncated) -> Self {
        let (periodic, mean) = manifold.integral(rate);
        Self { periodic, mean }
    }

    /// Mean rate and periodic part at coordinates.
    pub fn at(&self, monomials: &Monomials) -> [f64; 2] {
        [monomials.value(&self.mean)[0], monomials.value(&self.periodic)[0]]
    }
}

impl Observables {
    pub fn of(body: &FlexibleBody, spin: &SteadySpin, manifold: &InvariantManifold) -> Self {
        let ring = &manifold.ring;
        let system = crate::model::ExpandedMotion::of(body);
        let G = norm(spin.angular_momentum);
        let axis = scale(G.recip(), spin.angular_momentum);
        let momenta =
            crate::math::submanifold::PolynomialSystem::equations(&system, ring, &manifold.state).momenta;
        let omega: [Truncated; 3] = std::array::from_fn(|i| manifold.state[i].clone());
        let direction: [Truncated; 3] = std::array::from_fn(|i| momenta[i].scaled(G.recip()));
        let rates = &manifold.state[3..3 + body.coordinates().len()];
        let powers = body.dissipators().iter().map(|dissipator| power(ring, dissipator, rates));
        Self {
            turning: Accrued::of(manifold, &turning(ring, &omega, &direction, axis)),
            revolved: Accrued::of(manifold, &length(ring, &omega, dot(spin.omega, spin.omega))),
            dissipated: powers.map(|power| Accrued::of(manifold, &power)).collect(),
            direction,
        }
    }
}

/// Rate of the angle about the angular momentum, `ω·(u + e)/(1 + u·e)`: the rotation that takes `u` to `e` by the shortest way is split
/// off. (W10)
fn turning(ring: &Ring, omega: &[Truncated; 3], direction: &[Truncated; 3], axis: [f64; 3]) -> Truncated {
    let mut cosine = ring.zero();
    let mut upper = ring.zero();
    for i in 0..3 {
        cosine.add_scaled(axis[i], &direction[i]);
        let mut sum = direction[i].clone();
        sum.add_scaled(axis[i], &ring.constant(1.0));
        ring.add_product(&mut upper, 1.0, &omega[i], &sum);
    }
    cosine.add_scaled(1.0, &ring.constant(1.0));
    ring.product(&upper, &inverse(ring, &cosine, 2.0))
}

/// Inverse of a polynomial whose constant is known.
fn inverse(ring: &Ring, of: &Truncated, constant: f64) -> Truncated {
    let mut rest = of.scaled(-constant.recip());
    rest.add_scaled(1.0, &ring.constant(1.0));
    let mut sum = ring.constant(1.0);
    for _ in 0..ring.degree() {
        let mut next = ring.constant(1.0);
        ring.add_product(&mut next, 1.0, &rest, &sum);
        sum = next;
    }
    sum.scaled(constant.recip())
}

/// `|ω|` as a polynomial, from the square at the steady spin.
fn length(ring: &Ring, omega: &[Truncated; 3], square: f64) -> Truncated {
    let mut rest = ring.zero();
    omega.iter().for_each(|omega| ring.add_product(&mut rest, square.recip(), omega, omega));
    rest.add_scaled(-1.0, &ring.constant(1.0));
    let (mut sum, mut term, mut factor) = (ring.constant(1.0), ring.constant(1.0), 1.0);
    for k in 1..=ring.degree() {
        factor *= (1.5 - k as f64) / k as f64;
        term = ring.product(&term, &rest);
        sum.add_scaled(factor, &term);
    }
    sum.scaled(square.sqrt())
}

/// Power of a dissipator (W).
fn power(ring: &Ring, dissipator: &Dissipator, rates: &[Truncated]) -> Truncated {
    let mut power = ring.zero();
    for (j, rate) in rates.iter().enumerate() {
        let mut force = ring.zero();
        let mut acts = false;
        for (k, B) in dissipator.damping.row(j) {
            force.add_scaled(*B, &rates[k]);
            acts = true;
        }
        if acts {
            ring.add_product(&mut power, 1.0, rate, &force);
        }
    }
    power
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_square_of_a_length_is_the_sum_of_the_squares() {
        let ring = Ring::new(2, 5);
        let omega = [ring.shifted(2.0, 0, 0.3), ring.shifted(-1.0, 1, 0.5), ring.shifted(0.5, 0, -0.7)];
        let length = length(&ring, &omega, 5.25);
        let mut gap = ring.product(&length, &length);
        omega.iter().for_each(|omega| ring.add_product(&mut gap, -1.0, omega, omega));
        for monomial in 0..ring.size() {
            let [re, im] = gap.coefficient(monomial);
            assert!(re.hypot(im) < 1e-14, "{:?}: {re:e}", ring.exponents()[monomial]);
        }
    }
}
