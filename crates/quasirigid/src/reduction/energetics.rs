//! Energy, dissipated power and force on the pole as polynomials along the slow manifold. (R8) to (R10)

use std::collections::HashMap;

use super::manifold::Manifold;
use crate::math::polynomial::{Homogeneous, Series};
use crate::math::vec3;
use crate::model::FlexibleBody;

/// Energy on the slow manifold, degrees 2 to `p + 2`. (R10)
///
/// Twice the kinetic energy is `ω·K + p·q̇`, with the momenta of `ω` and `q̇`.
pub(super) fn energy(body: &FlexibleBody, manifold: &Manifold, order: usize) -> Series {
    let mut energy = Series::zero(order + 2, 1);
    for degree in 2..=order + 2 {
        let mut part = Homogeneous::identity().dot(&own(body, manifold, degree - 1));
        part.add_scaled(1.0, &internal(body, manifold, degree));
        part.scale(0.5);
        energy.set(part);
    }
    energy
}

/// One degree of the angular momentum without that of the wheels.
fn own(body: &FlexibleBody, manifold: &Manifold, degree: usize) -> Homogeneous {
    if degree == 1 { Homogeneous::linear(&body.inertia()) } else { manifold.K.part(degree).clone() }
}

/// `[q̇·(A q̇ + h(q)·ω) + q·C q]_d`.
fn internal(body: &FlexibleBody, manifold: &Manifold, degree: usize) -> Homogeneous {
    let Manifold { q, rate, u, .. } = manifold;
    let invariants = body.invariants();
    let omega = Homogeneous::identity();
    let mut sum = Homogeneous::zero(degree, 1);
    let turning = rate.part(degree - 1).contracted(&invariants.h);
    sum.add_scaled(1.0, &omega.dot(&turning));
    for (j, k, pair) in invariants.pairs.iter() {
        sum.add_scaled(pair.A, &rate.row_product(j, rate, k, degree));
        let moving = q.row_product(j, rate, k, degree - 1);
        sum.add_product(0, 1.0, (&Homogeneous::linear(&[pair.Z]), 0), (&moving, 0));
    }
    for (j, k, C) in body.stiffness().iter() {
        sum.add_scaled(*C, &q.row_product(j, q, k, degree));
    }
    if let Some(per_mass) = body.translation() {
        let mut moving = Series::zero(rate.degree(), 3);
        for part in 0..=rate.degree() {
            moving.set(rate.part(part).contracted(&invariants.S));
        }
        sum.add_scaled(-per_mass, &moving.dot(u, degree));
    }
    sum
}

/// Power `q̇ᵀB q̇`: a sum of squares, with the rates of elastic coordinates to degree `p`, degrees 6 to `2p`, and of cyclic ones to
/// degree `p + 1`, degrees 4 to `2p + 2`; and the power of each dissipator with damping, by name. The manifold may be of a higher order.
/// (R9), (C6), (D3)
pub(super) fn power(
    body: &FlexibleBody,
    manifold: &Manifold,
    order: usize,
) -> (Series, Vec<(String, Series)>) {
    let mut rate = manifold.rate.truncated(order);
    let mut highest = 2 * order;
    if !body.cyclic().is_empty() {
        rate = manifold.rate.truncated(order + 1);
        let mut last = Homogeneous::zero(order + 1, rate.rows());
        body.cyclic().for_each(|j| last.add_row(j, 1.0, (rate.part(order + 1), j)));
        rate.set(last);
        highest += 2;
    }
    let zero = Series::zero(highest.max(2), 1);
    let named = body.dissipators().iter().filter(|part| part.damping.iter().next().is_some());
    let mut shares: Vec<(String, Series)> = named.map(|part| (part.name.clone(), zero.clone())).collect();
    let owners = owners(body);
    let mut power = zero;
    for degree in 4..=highest {
        let mut whole = Homogeneous::zero(degree, 1);
        let mut parts = vec![whole.clone(); shares.len()];
        for (j, k, B) in body.damping().iter() {
            let product = rate.row_product(j, &rate, k, degree);
            whole.add_scaled(*B, &product);
            for (owner, B) in owners.get(&(j, k)).into_iter().flatten() {
                parts[*owner].add_scaled(*B, &product);
            }
        }
        power.set(whole);
        shares.iter_mut().zip(parts).for_each(|((_, share), part)| share.set(part));
    }
    (power, shares)
}

/// Contribution of each dissipator with damping to an entry of `B`, by row and column.
fn owners(body: &FlexibleBody) -> HashMap<(usize, usize), Vec<(usize, f64)>> {
    let mut owners: HashMap<(usize, usize), Vec<(usize, f64)>> = HashMap::new();
    let named = body.dissipators().iter().filter(|part| part.damping.iter().next().is_some());
    for (owner, part) in named.enumerate() {
        for (j, k, entry) in part.damping.iter() {
            owners.entry((j, k)).or_default().push((owner, *entry));
        }
    }
    owners
}

/// Force `φ = −Σ mᵢ r̈ᵢ` of the displacements, degrees 4 to `p + 2`, from their first moment. (R8)
pub(super) fn force(moment: &Series, f: &Series) -> Series {
    let order = moment.degree();
    let mut phi = Series::zero(order + 2, 3);
    let omega = Homogeneous::identity();
    let mut velocity = Series::zero(order + 1, 3);
    for degree in 2..=order + 1 {
        let mut part = moment.rate(f, degree);
        part.add_scaled(1.0, &omega.cross(moment.part(degree - 1)));
        velocity.set(part);
    }
    for degree in 4..=order + 2 {
        let mut part = velocity.rate(f, degree);
        part.add_scaled(1.0, &omega.cross(velocity.part(degree - 1)));
        part.scale(-1.0);
        phi.set(part);
    }
    phi
}

/// First moment of the displacements with the curvature of their paths, `s = S_j q_j + ½ Γ_jk q_j q_k`, as far as the
/// coordinates go. (F3)
pub(super) fn first_moment(body: &FlexibleBody, q: &Series) -> Series {
    let invariants = body.invariants();
    let mut moment = Series::zero(q.degree(), 3);
    for degree in 2..=q.degree() {
        let mut part = q.part(degree).contracted(&invariants.S);
        for (j, k, pair) in invariants.pairs.iter().filter(|(_, _, pair)| vec3::norm(pair.S2) > 0.0) {
            let product = q.row_product(j, q, k, degree);
            for (axis, curvature) in pair.S2.iter().enumerate() {
                part.add_row(axis, 0.5 * curvature, (&product, 0));
            }
        }
        moment.set(part);
    }
    moment
}
