//! Invariants of pairs of coordinates, summed over one coordinate of each pair as soon as its polynomial is known: what is left for every
//! degree are sums over single coordinates, where a sum over pairs would multiply polynomials for each.
//! Equations (R4) and (R5), docs/theory/03-reduction.md; (I4) and (I5), docs/theory/02-invariants.md.

use crate::math::polynomial::{Homogeneous, Series};
use crate::math::sym3::{self, Sym};
use crate::model::FlexibleBody;

/// Displacements weighted by the invariants of pairs, as far as the recursion has come.
#[derive(Clone, Debug)]
pub(super) struct Couplings {
    /// `J_jk q_k`, a map for each component of the tensor.
    stretched: [Series; 6],
    /// `q_j Z_jk`, a map for each axis.
    carried: [Series; 3],
}

/// A symmetric matrix with one component, twice off the diagonal.
const UNITS: [Sym; 6] = {
    let mut units = [[0.0; 6]; 6];
    let mut component = 0;
    while component < 6 {
        units[component][component] = 1.0;
        component += 1;
    }
    units
};

impl Couplings {
    /// Zero for a recursion to order `p`, to the degrees that its last equations need.
    pub fn new(body: &FlexibleBody, order: usize) -> Self {
        let n = body.coordinates().len();
        let last = (order + usize::from(!body.cyclic().is_empty())).saturating_sub(2);
        Self {
            stretched: [(); 6].map(|()| Series::zero(last, n)),
            carried: [(); 3].map(|()| Series::zero(order.saturating_sub(1), n)),
        }
    }

    /// Takes one degree of the displacements.
    pub fn follow(&mut self, body: &FlexibleBody, q: &Homogeneous) {
        let degree = q.degree();
        if degree <= self.stretched[0].degree() {
            for (j, k, pair) in body.invariants().pairs.iter() {
                for (sum, J2) in self.stretched.iter_mut().zip(pair.J2).filter(|(_, J2)| *J2 != 0.0) {
                    sum.add_row(degree, j, J2, (q, k));
                }
            }
        }
        if degree <= self.carried[0].degree() {
            for (j, k, pair) in body.invariants().pairs.iter() {
                for (sum, Z) in self.carried.iter_mut().zip(pair.Z).filter(|(_, Z)| *Z != 0.0) {
                    sum.add_row(degree, k, Z, (q, j));
                }
            }
        }
    }

    /// Adds `[ωᵀJ_jkω q_k + ω·Z_jk q̇_k]_d` to a load, with the rates of degree `d − 1`. (R4)
    pub fn add_load(&self, body: &FlexibleBody, rate: &Homogeneous, load: &mut Homogeneous) {
        let lower = load.degree() - 2;
        for (unit, series) in UNITS.iter().zip(&self.stretched) {
            let form = Homogeneous::half_quadratic(&[unit.map(|entry| 2.0 * entry)]);
            add_products(&form, series.part(lower), load);
        }
        let mut moving = [(); 3].map(|()| Homogeneous::zero(rate.degree(), rate.rows()));
        for (j, k, pair) in body.invariants().pairs.iter() {
            for (sum, Z) in moving.iter_mut().zip(pair.Z).filter(|(_, Z)| *Z != 0.0) {
                sum.add_row(j, Z, (rate, k));
            }
        }
        add_along(&moving.each_ref(), load);
    }

    /// Adds `[h_k(q)·ω]_d` of the displacements to momenta. (S4)
    pub fn add_momentum(&self, momenta: &mut Homogeneous) {
        add_along(&self.carried.each_ref().map(|series| series.part(momenta.degree() - 1)), momenta);
    }

    /// Adds `[q_jq_kJ_jkω + q_jZ_jk q̇_k]_d` to an angular momentum. (R5)
    pub fn add_angular_momentum(&self, q: &Series, rate: &Series, K: &mut Homogeneous) {
        let degree = K.degree();
        let mut displaced = Homogeneous::zero(degree - 1, 6);
        for (component, series) in self.stretched.iter().enumerate() {
            displaced.add_row(component, 1.0, (&q.dot(series, degree - 1), 0));
        }
        add_turned(&displaced, K);
        for (axis, series) in self.carried.iter().enumerate() {
            K.add_row(axis, 1.0, (&series.dot(rate, degree), 0));
        }
    }
}

/// Adds the product of a function with each row of a map to the row of another.
fn add_products(function: &Homogeneous, map: &Homogeneous, sum: &mut Homogeneous) {
    if map.amax() > 0.0 {
        (0..map.rows()).for_each(|row| sum.add_product(row, 1.0, (function, 0), (map, row)));
    }
}

/// Adds the scalar product of `ω` with a map for each axis.
fn add_along(maps: &[&Homogeneous; 3], sum: &mut Homogeneous) {
    for (axis, map) in maps.iter().enumerate() {
        let mut unit = [0.0; 3];
        unit[axis] = 1.0;
        add_products(&Homogeneous::linear(&[unit]), map, sum);
    }
}

/// Adds `Tω` for the components of a symmetric tensor `T(ω)`.
pub(super) fn add_turned(components: &Homogeneous, sum: &mut Homogeneous) {
    for (component, unit) in UNITS.iter().enumerate() {
        let turned = Homogeneous::linear(&sym3::rows(*unit));
        for axis in 0..3 {
            sum.add_product(axis, 1.0, (&turned, axis), (components, component));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problems::ring_of_points;

    const ORDER: usize = 7;

    fn sample(degree: usize, rows: usize) -> Homogeneous {
        let mut map = Homogeneous::zero(degree, rows);
        let coefficients = map.coefficients_mut().flatten().enumerate();
        coefficients.for_each(|(place, c)| *c = (0.7 * place as f64 + degree as f64).sin());
        map
    }

    fn gap(mut found: Homogeneous, expected: &Homogeneous) -> f64 {
        found.add_scaled(-1.0, expected);
        found.amax() / expected.amax().max(f64::MIN_POSITIVE)
    }

    /// Every sum once more, by a product of polynomials for each pair.
    #[test]
    fn sums_over_coordinates_are_those_over_pairs() {
        let body = ring_of_points(5).body().unwrap();
        let n = body.coordinates().len();
        let (mut q, mut rate) = (Series::zero(ORDER, n), Series::zero(ORDER + 1, n));
        let mut couplings = Couplings::new(&body, ORDER);
        for degree in 2..=ORDER {
            q.set(sample(degree, n));
            rate.set(sample(degree + 1, n));
            couplings.follow(&body, q.part(degree));
        }
        let pairs = || body.invariants().pairs.iter();
        assert!(pairs().any(|(_, _, pair)| pair.Z != [0.0; 3]) && pairs().any(|(j, k, _)| j != k));
        for degree in 4..=ORDER {
            let mut load = Homogeneous::zero(degree, n);
            couplings.add_load(&body, rate.part(degree - 1), &mut load);
            let mut momenta = Homogeneous::zero(degree, n);
            couplings.add_momentum(&mut momenta);
            let mut K = Homogeneous::zero(degree, 3);
            couplings.add_angular_momentum(&q, &rate, &mut K);
            let (mut loads, mut moved, mut turned) =
                (Homogeneous::zero(degree, n), Homogeneous::zero(degree, n), Homogeneous::zero(degree, 3));
            for (j, k, pair) in pairs() {
                let form = Homogeneous::half_quadratic(&[pair.J2.map(|entry| 2.0 * entry)]);
                let Z = Homogeneous::linear(&[pair.Z]);
                loads.add_product(j, 1.0, (&form, 0), (q.part(degree - 2), k));
                loads.add_product(j, 1.0, (&Z, 0), (rate.part(degree - 1), k));
                moved.add_product(k, 1.0, (&Z, 0), (q.part(degree - 1), j));
                let tensor = Homogeneous::linear(&sym3::rows(pair.J2));
                let (displaced, moving) =
                    (q.row_product(j, &q, k, degree - 1), q.row_product(j, &rate, k, degree));
                for axis in 0..3 {
                    turned.add_product(axis, 1.0, (&tensor, axis), (&displaced, 0));
                    turned.add_row(axis, pair.Z[axis], (&moving, 0));
                }
            }
            let gaps = [gap(load, &loads), gap(momenta, &moved), gap(K, &turned)];
            assert!(gaps.iter().all(|gap| *gap < 1e-13), "degree {degree}: {gaps:?}");
        }
    }
}
