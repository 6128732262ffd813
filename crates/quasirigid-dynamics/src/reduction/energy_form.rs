//! Energy form of the reduced equations: two polynomials in the angular momentum beside the energy, from which the motion follows without
//! gaining energy, whatever the order.
//! Both are sums over coordinates of the slow manifold; no polynomial is divided by another, so equal moments are no exception.
//! Equations (R16) to (R21), docs/theory/03-reduction.md.

use super::angular_momentum_form::composed;
use super::slow_manifold::SlowManifold;
use crate::math::polynomial::{Homogeneous, Series};
use crate::math::sym3::COMPONENTS;
use crate::model::{Advection, FlexibleBody};

/// Polynomials of the energy form. (R16)
#[derive(Clone, Debug)]
pub(super) struct EnergyForm {
    /// Axial vector `c(K)` of the internal momenta and the gyroscopic forces, degrees 0 to `p − 1`. (R18)
    pub c: Series,
    /// Tensor `T(K)` of the dissipation, `P = K̇·T K̇`: a sum of squares. (R19)
    pub T: Series,
}

/// Components of the antisymmetric matrix of an axial vector.
const AXIAL: [(usize, usize); 3] = [(1, 2), (2, 0), (0, 1)];

impl EnergyForm {
    /// From the slow manifold of order `p` and the reverted series `Ω(K)`.
    pub fn compute(body: &FlexibleBody, manifold: &SlowManifold, Omega: &Series, order: usize) -> Self {
        let Some(highest) = order.checked_sub(1) else {
            return Self { c: Series::zero(0, 3), T: Series::zero(0, 6) };
        };
        let slaved = Slaved { body, manifold, Omega, highest };
        let momenta = columns(&slaved.momenta(), highest);
        let elastic = columns(&slaved.coordinates(), highest);
        let cyclic = slaved.cyclic_columns(&momenta, &elastic);
        let c = slaved.axial(&momenta, &elastic, &cyclic);
        let shorter = body.cyclic().is_empty() && (2..=3).contains(&order);
        let kept = highest - usize::from(shorter);
        let rates = [0, 1, 2].map(|axis| sum(&elastic[axis].truncated(kept), &cyclic[axis].truncated(kept)));
        let forces = rates.each_ref().map(|column| column.times(body.damping()));
        let mut T = Series::zero(2 * kept, 6);
        for degree in 0..=T.degree() {
            for (component, (a, b)) in COMPONENTS.into_iter().enumerate() {
                T.add_row(degree, component, 1.0, (&rates[a].dot(&forces[b], degree), 0));
            }
        }
        Self { c, T }
    }
}

/// Internal motion as functions of the angular momentum.
struct Slaved<'a> {
    body: &'a FlexibleBody,
    manifold: &'a SlowManifold,
    Omega: &'a Series,
    /// Highest degree of `c`, `p − 1`.
    highest: usize,
}

impl Slaved<'_> {
    /// Generalised momenta `p = ∂T/∂q̇`, that of the translation of a free body included, to degree `p`. (R17)
    fn momenta(&self) -> Series {
        let mut p = self.manifold.p.clone();
        if let Some(per_mass) = self.body.translation() {
            for degree in 1..=p.degree() {
                let u = self.manifold.u.part(degree);
                for (j, S) in self.body.invariants().S.iter().enumerate() {
                    for (axis, weight) in S.iter().enumerate().filter(|(_, weight)| **weight != 0.0) {
                        p.add_row(degree, j, -per_mass * weight, (u, axis));
                    }
                }
            }
        }
        composed(&p, 1, self.Omega, p.degree())
    }

    /// Elastic coordinates, to degree `p`.
    fn coordinates(&self) -> Series {
        composed(&self.manifold.q, 2, self.Omega, self.manifold.q.degree())
    }

    /// Columns `R` of the cyclic rates, `q̇ = R K̇`, degree by degree: `B R = −∂p/∂K − B_ce ∂q/∂K + G R`. (R20)
    fn cyclic_columns(&self, momenta: &[Series; 3], elastic: &[Series; 3]) -> [Series; 3] {
        let (body, cyclic) = (self.body, self.body.cyclic());
        let rates = self.carrier_rates();
        [0, 1, 2].map(|axis| {
            let mut column = Series::zero(self.highest, momenta[axis].rows());
            if cyclic.is_empty() {
                return column;
            }
            let braked = elastic[axis].times(body.damping());
            for degree in 0..=self.highest {
                let mut right = self.gyroscopic(&rates, &column, degree);
                for j in cyclic.clone() {
                    right.add_row(j, -1.0, (momenta[axis].part(degree), j));
                    right.add_row(j, -1.0, (braked.part(degree), j));
                }
                right.solve_rows(cyclic.clone(), |rows, width| body.solve_friction(rows, width));
                cyclic.clone().for_each(|j| column.add_row(degree, j, 1.0, (&right, j)));
            }
            column
        })
    }

    /// Rates of the liquids that advect, as functions of the angular momentum.
    fn carrier_rates(&self) -> Series {
        let degree = if self.body.advections().is_empty() { 0 } else { self.highest };
        composed(&self.manifold.rate.truncated(degree), 2, self.Omega, degree)
    }

    /// `c = Σ ∇p_j × ∇q_j`, less what friction couples antisymmetrically and the gyroscopic forces of liquids turn. (R18)
    fn axial(&self, momenta: &[Series; 3], elastic: &[Series; 3], cyclic: &[Series; 3]) -> Series {
        let body = self.body;
        let mut c = Series::zero(self.highest, 3);
        let friction = cyclic.each_ref().map(|column| column.times(body.damping()));
        let rates = self.carrier_rates();
        for degree in 0..=self.highest {
            for (row, (a, b)) in AXIAL.into_iter().enumerate() {
                let mut add = |factor, left: &Series, right: &Series| {
                    c.add_row(degree, row, factor, (&left.dot(right, degree), 0));
                };
                add(1.0, &momenta[a], &elastic[b]);
                add(-1.0, &momenta[b], &elastic[a]);
                add(-1.0, &elastic[a], &friction[b]);
                add(1.0, &elastic[b], &friction[a]);
            }
        }
        if body.cyclic().is_empty() {
            return c;
        }
        let turned = cyclic.each_ref().map(|column| {
            let mut turned = Series::zero(self.highest, column.rows());
            (0..=self.highest).for_each(|degree| turned.set(self.gyroscopic(&rates, column, degree)));
            turned
        });
        for degree in 0..=self.highest {
            for (row, (a, b)) in AXIAL.into_iter().enumerate() {
                c.add_row(degree, row, -1.0, (&cyclic[a].dot(&turned[b], degree), 0));
            }
        }
        c
    }

    /// One degree of `G x`: Coriolis forces of the cyclic coordinates on each other, `ω·W_jk x_k`, and their advection. (R20), (R21)
    fn gyroscopic(&self, rates: &Series, column: &Series, degree: usize) -> Homogeneous {
        let mut sum = advection(self.body.advections(), rates, column, degree);
        let cyclic = self.body.cyclic();
        let pairs = self.body.invariants().pairs.iter();
        for (j, k, pair) in pairs.filter(|(j, k, _)| cyclic.contains(j) && cyclic.contains(k)) {
            for (axis, W) in pair.Z.into_iter().enumerate().filter(|(_, W)| *W != 0.0) {
                for turning in 1..=degree.min(self.Omega.degree()) {
                    let (spin, flow) = (self.Omega.part(turning), column.part(degree - turning));
                    sum.add_product(j, W, (spin, axis), (flow, k));
                }
            }
        }
        sum
    }
}

/// One degree of the advection of liquids as gyroscopic forces, which is `−N(q̇, q̇)` at `x = q̇`. With `t_abc` symmetric in the
/// last two flows and without power, `G_ac = −⅔ Σ_b (t_abc − t_cba) q̇_b`. (R21)
fn advection(advections: &[Advection], rates: &Series, column: &Series, degree: usize) -> Homogeneous {
    let mut sum = Homogeneous::zero(degree, column.rows());
    for Advection { coordinates, shares, terms } in advections {
        let flows = |part: &Homogeneous| {
            let mut flows = Homogeneous::zero(part.degree(), shares.len());
            for (a, row) in shares.iter().enumerate() {
                for (share, j) in row.iter().zip(coordinates.clone()) {
                    flows.add_row(a, *share, (part, j));
                }
            }
            flows
        };
        let mut forces = Homogeneous::zero(degree, shares.len());
        for carrying in 2..=degree.min(rates.degree()) {
            let (carrier, carried) = (flows(rates.part(carrying)), flows(column.part(degree - carrying)));
            for ([a, b, c], term) in terms {
                forces.add_product(*a, -2.0 / 3.0 * term, (&carrier, *b), (&carried, *c));
                forces.add_product(*c, 2.0 / 3.0 * term, (&carrier, *b), (&carried, *a));
            }
        }
        for (a, row) in shares.iter().enumerate() {
            for (share, j) in row.iter().zip(coordinates.clone()) {
                sum.add_row(j, *share, (&forces, a));
            }
        }
    }
    sum
}

/// Derivatives of a map along each axis, to a degree.
fn columns(map: &Series, highest: usize) -> [Series; 3] {
    [0, 1, 2].map(|axis| {
        let mut slope = Series::zero(highest, map.rows());
        for degree in 1..=map.degree().min(highest + 1) {
            slope.set(map.part(degree).partial(axis));
        }
        slope
    })
}

fn sum(a: &Series, b: &Series) -> Series {
    let mut sum = a.clone();
    for degree in 0..=b.degree() {
        let mut part = a.part(degree).clone();
        part.add_scaled(1.0, b.part(degree));
        sum.set(part);
    }
    sum
}
