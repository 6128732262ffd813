//! Energy, dissipated power and force on the pole as polynomials along the slow manifold. (R8) to (R10)

use super::slow_manifold::SlowManifold;
use crate::math::polynomial::{Homogeneous, Series};
use crate::math::sparse::SparseRows;
use crate::math::vec3;
use crate::model::{Dissipator, FlexibleBody};

/// Energy on the slow manifold, degrees 2 to `p + 2`. (R10)
///
/// Twice the kinetic energy is `ω·K + p·q̇`, with the momenta of `ω` and `q̇`.
pub(super) fn energy(body: &FlexibleBody, manifold: &SlowManifold, order: usize) -> Series {
    let mut energy = Series::zero(order + 2, 1);
    let forces = manifold.q.times(body.stiffness());
    for degree in 2..=order + 2 {
        let mut part = Homogeneous::identity().dot(&own(body, manifold, degree - 1));
        part.add_scaled(1.0, &internal(body, manifold, &forces, degree));
        part.scale(0.5);
        energy.set(part);
    }
    energy
}

/// One degree of the angular momentum without that of the wheels.
fn own(body: &FlexibleBody, manifold: &SlowManifold, degree: usize) -> Homogeneous {
    if degree == 1 { Homogeneous::linear(&body.inertia()) } else { manifold.K.part(degree).clone() }
}

/// `[q̇·(A q̇ + h(q)·ω) + q·C q]_d`, from the momenta `p` and the forces `C q`.
fn internal(body: &FlexibleBody, manifold: &SlowManifold, forces: &Series, degree: usize) -> Homogeneous {
    let SlowManifold { q, rate, u, p, .. } = manifold;
    let mut sum = rate.dot(p, degree);
    sum.add_scaled(1.0, &q.dot(forces, degree));
    if let Some(per_mass) = body.translation() {
        let mut moving = Series::zero(rate.degree(), 3);
        for part in 0..=rate.degree() {
            moving.set(rate.part(part).contracted(&body.invariants().S));
        }
        sum.add_scaled(-per_mass, &moving.dot(u, degree));
    }
    sum
}

/// Power `q̇ᵀB q̇`: a sum of squares, with the rates of elastic coordinates to degree `p`, degrees 6 to `2p`, and of cyclic ones to
/// degree `p + 1`, degrees 4 to `2p + 2`; and the power of each dissipator with damping, by name. The slow manifold may be of a higher order.
/// (R9), (C6), (D3)
pub(super) fn power(
    body: &FlexibleBody,
    manifold: &SlowManifold,
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
    let power = |rate: &Series, forces: &Series| {
        let mut power = Series::zero(highest.max(2), 1);
        (4..=highest).for_each(|degree| power.set(rate.dot(forces, degree)));
        power
    };
    let named = body.dissipators().iter().filter(|part| part.damping.iter().next().is_some());
    let share = |part: &Dissipator| {
        let mut moved: Vec<usize> = part.damping.iter().flat_map(|(j, k, _)| [j, k]).collect();
        moved.sort_unstable();
        moved.dedup();
        let place = |j: usize| moved.partition_point(|other| *other < j);
        let entries = part.damping.iter().map(|(j, k, B)| (place(j), place(k), *B)).collect();
        let own = rate.picked(&moved);
        (part.name.clone(), power(&own, &own.times(&SparseRows::sum(moved.len(), entries))))
    };
    let shares = named.map(share).collect();
    (power(&rate, &rate.times(body.damping())), shares)
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
    let curved = invariants.pairs.iter().any(|(_, _, pair)| vec3::norm(pair.S2) > 0.0);
    let curvatures = if curved { weighted(body, q) } else { Vec::new() };
    let mut moment = Series::zero(q.degree(), 3);
    for degree in 2..=q.degree() {
        let mut part = q.part(degree).contracted(&invariants.S);
        for (axis, curvature) in curvatures.iter().enumerate() {
            part.add_row(axis, 0.5, (&q.dot(curvature, degree), 0));
        }
        moment.set(part);
    }
    moment
}

/// `Γ_jk q_k` along each axis.
fn weighted(body: &FlexibleBody, q: &Series) -> Vec<Series> {
    let along = |axis: usize| {
        let entries = body.invariants().pairs.iter().map(|(j, k, pair)| (j, k, pair.S2[axis]));
        q.times(&SparseRows::sum(q.rows(), entries.collect()))
    };
    (0..3).map(along).collect()
}
