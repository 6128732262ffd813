//! Reduced equations of a body to any order: the entry point of the reduction.
//! Refuses an order above 12, since the series is asymptotic, and coefficients that overflow, which would turn up as NaN much later.
//! Equations (R1) to (R11) and (R16), docs/theory/03-reduction.md.

use thiserror::Error;

use super::energy_form::EnergyForm;
use super::slow_manifold::SlowManifold;
use super::{angular_momentum_form, energetics};
use crate::math::polynomial::Series;
use crate::model::{FlexibleBody, MAX_ORDER, ReducedBody};

/// Error of a reduction that cannot be made.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ReductionError {
    /// The order is above [`MAX_ORDER`].
    #[error("order {order} is not available; choose 0 (rigid) to {MAX_ORDER}, 3 is the paper's")]
    Order {
        /// Order asked for.
        order: usize,
    },
    /// A coefficient overflows.
    #[error(
        "the coefficients of degree {degree} are not finite numbers; check the units of the model, or lower the order"
    )]
    NotFinite {
        /// Lowest degree at fault.
        degree: usize,
    },
    /// Nothing but the spin restores some coordinates: without stiffness at rest they have no series in powers of the angular velocity. (I13)
    #[error(
        "no spring restores {coordinates}: without stiffness at rest there is no slow manifold in powers of the angular velocity; give the hinge a stiffness"
    )]
    Hung {
        /// Names of the coordinates.
        coordinates: String,
    },
    /// Drives move some coordinates. (T7)
    #[error(
        "{coordinates} follows a law over time, and reduced equations have none: follow the body with the full system, or give the part a constant place"
    )]
    Driven {
        /// Names of the coordinates.
        coordinates: String,
    },
}

/// Derives the reduced equations of a body to order `p`. (R1)–(R11)
///
/// `p = 0` is the rigid body `S*`; `p = 1` adds the cubic torque of liquids and rotors, and equals `p = 0` without them; `p = 2` adds
/// elasticity, `p = 3` is the paper's (4.4); higher orders go beyond it.
///
/// ```
/// use quasirigid::prelude::*;
/// use quasirigid::problems::ring_of_points;
///
/// let reduced = reduce(&ring_of_points(4).body()?, 3)?;
/// let [x, y, z] = reduced.torque([0.1, 0.0, 1.0]);
/// assert!(norm([x, y, z]) < 0.1); // N·m, beside Euler's
/// # Ok::<(), quasirigid::Error>(())
/// ```
///
/// # Errors
/// [`ReductionError`] for an order above [`MAX_ORDER`], and for coefficients that overflow.
pub fn reduce(body: &FlexibleBody, order: usize) -> Result<ReducedBody, ReductionError> {
    let manifold = manifold(body, order)?;
    let J = body.invariants().J;
    let Omega = angular_momentum_form::reverted(&manifold.K, J);
    let energy = energetics::energy(body, &manifold, order);
    let (power, power_shares) = energetics::power(body, &manifold, order);
    let moment = energetics::first_moment(body, &manifold.q);
    let EnergyForm { c, T } = EnergyForm::compute(body, &manifold, &Omega, order);
    let reduced = ReducedBody {
        order,
        mass: body.invariants().mass,
        J,
        energy_of_momentum: angular_momentum_form::of_momentum(&energy, &Omega),
        Omega,
        c,
        T,
        energy,
        power,
        power_shares,
        phi: energetics::force(&moment, &manifold.f),
        pole: moment.scaled(-body.translation().unwrap_or(0.0)),
        f: manifold.f,
        K: manifold.K,
        q: manifold.q,
        rate: manifold.rate,
    };
    finite(&reduced)?;
    Ok(reduced)
}

/// Checks what is derived from the slow manifold: products of numbers near the largest overflow where the numbers do not.
fn finite(reduced: &ReducedBody) -> Result<(), ReductionError> {
    let ReducedBody { K, Omega, c, T, energy, energy_of_momentum, power, phi, pole, q, rate, .. } = reduced;
    let derived = [K, Omega, c, T, energy, energy_of_momentum, power, phi, pole, q, rate];
    let at_fault = |series: &Series| (0..=series.degree()).find(|degree| !series.part(*degree).is_finite());
    match derived.into_iter().filter_map(at_fault).min() {
        Some(degree) => Err(ReductionError::NotFinite { degree }),
        None => Ok(()),
    }
}

/// Slow manifold to order `p`, checked for its order and for overflow.
pub(super) fn manifold(body: &FlexibleBody, order: usize) -> Result<SlowManifold, ReductionError> {
    if order > MAX_ORDER {
        return Err(ReductionError::Order { order });
    }
    if let Some(coordinates) = body.driven() {
        return Err(ReductionError::Driven { coordinates });
    }
    if let Some(hung) = body.hung().filter(|_| order > 0) {
        return Err(ReductionError::Hung { coordinates: hung.names().into() });
    }
    let manifold = SlowManifold::compute(body, order);
    match (2..=order + 2).find(|degree| !manifold.f.part(*degree).is_finite()) {
        Some(degree) => Err(ReductionError::NotFinite { degree }),
        None => Ok(manifold),
    }
}
