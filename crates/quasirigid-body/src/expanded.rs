//! Full equations on polynomials: momenta and forces of a free body where angular velocity, rates and displacements are polynomials.
//! Linear sums over pairs of coordinates come first, so that a product of polynomials is formed once for each coordinate, not for each pair.
//! Equations (S2), (S4), (S6), docs/theory/01-system.md; (K13), docs/theory/12-structures.md; (W1), docs/theory/18-submanifolds.md.

use std::ops::Range;

use crate::math::submanifold::{Equations, PolynomialSystem, Ring, Truncated};
use crate::math::sym3::Sym;

use super::path_series::Series;
use super::{FlexibleBody, Invariants, Pair};

/// Full equations of a body without external moments as a polynomial system; state: `ω`, `q̇` of all coordinates, `q` of the elastic ones.
/// (W1)
#[derive(Clone, Copy, Debug)]
pub struct ExpandedMotion<'a> {
    body: &'a FlexibleBody,
}

impl<'a> ExpandedMotion<'a> {
    /// Equations of a body.
    #[must_use]
    pub fn of(body: &'a FlexibleBody) -> Self {
        Self { body }
    }
}

type Vector = [Truncated; 3];

/// Components of a vector of the next two axes, for products.
const NEXT: [[usize; 2]; 3] = [[1, 2], [2, 0], [0, 1]];
/// Rows and columns of the entries of a [`Sym`].
const ENTRIES: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [1, 2], [2, 0], [0, 1]];

/// Polynomial arithmetic of vectors.
struct Vectors<'a>(&'a Ring);

impl Vectors<'_> {
    fn zero(&self) -> Vector {
        std::array::from_fn(|_| self.0.zero())
    }

    fn constant(&self, vector: [f64; 3]) -> Vector {
        vector.map(|entry| self.0.constant(entry))
    }

    fn dot(&self, a: &Vector, b: &Vector) -> Truncated {
        let mut sum = self.0.zero();
        a.iter().zip(b).for_each(|(a, b)| self.0.add_product(&mut sum, 1.0, a, b));
        sum
    }

    fn add_cross(&self, sum: &mut Vector, factor: f64, a: &Vector, b: &Vector) {
        for (axis, [next, last]) in NEXT.into_iter().enumerate() {
            self.0.add_product(&mut sum[axis], factor, &a[next], &b[last]);
            self.0.add_product(&mut sum[axis], -factor, &a[last], &b[next]);
        }
    }

    fn add_symmetric(&self, sum: &mut Vector, matrix: &[Truncated; 6], vector: &Vector) {
        for (entry, [row, column]) in matrix.iter().zip(ENTRIES) {
            self.0.add_product(&mut sum[row], 1.0, entry, &vector[column]);
            if row != column {
                self.0.add_product(&mut sum[column], 1.0, entry, &vector[row]);
            }
        }
    }
}

/// Adds a constant vector times a polynomial.
fn add_along(sum: &mut Vector, vector: [f64; 3], factor: f64, amount: &Truncated) {
    sum.iter_mut().zip(vector).for_each(|(sum, entry)| sum.add_scaled(factor * entry, amount));
}

/// Adds a constant symmetric matrix times a polynomial.
fn add_tensor(sum: &mut [Truncated; 6], tensor: Sym, factor: f64, amount: &Truncated) {
    sum.iter_mut().zip(tensor).for_each(|(sum, entry)| sum.add_scaled(factor * entry, amount));
}

/// Motion of a body on straight paths: values and rates of its coordinates, and of the fields that follow them.
struct Straight<'a> {
    ring: &'a Ring,
    invariants: &'a Invariants,
    /// `1/m*` of a free body.
    per_mass: f64,
    omega: &'a Vector,
    /// Values; zero of cyclic coordinates.
    z: Vec<Truncated>,
    rate: Vec<Truncated>,
}

/// Momenta and loads on straight paths.
struct Loads {
    angular_momentum: Vector,
    momenta: Vec<Truncated>,
    /// Loads `∂L/∂z + ∂U/∂z`.
    loads: Vec<Truncated>,
}

impl Straight<'_> {
    /// (S2), (S4), (S6)
    fn loads(&self) -> Loads {
        let Self { ring, invariants, per_mass, omega, z, rate } = self;
        let Invariants { J, J1, S, h, pairs, .. } = invariants;
        let vectors = Vectors(ring);
        let count = z.len();
        let tensor = || std::array::from_fn::<Truncated, 6, _>(|_| ring.zero());
        let mut inertia: [Truncated; 6] = J.map(|entry| ring.constant(entry));
        let mut grown: Vec<[Truncated; 6]> = (0..count).map(|_| tensor()).collect();
        let mut turning: Vec<Vector> = h.iter().map(|h| vectors.constant(*h)).collect();
        let mut coriolis: Vec<Vector> = (0..count).map(|_| vectors.zero()).collect();
        let mut momenta: Vec<Truncated> = (0..count).map(|_| ring.zero()).collect();
        for (j, k, Pair { A, J2, Z, .. }) in pairs.iter() {
            momenta[j].add_scaled(*A, &rate[k]);
            add_tensor(&mut grown[j], *J2, 1.0, &z[k]);
            add_along(&mut turning[k], *Z, 1.0, &z[j]);
            add_along(&mut coriolis[j], *Z, 1.0, &rate[k]);
        }
        let (mut s, mut drift) = (vectors.zero(), vectors.zero());
        for (j, S) in S.iter().enumerate() {
            add_along(&mut s, *S, 1.0, &z[j]);
            add_along(&mut drift, *S, 1.0, &rate[j]);
        }
        for (j, grown) in grown.iter_mut().enumerate() {
            add_tensor(&mut inertia, J1[j], 1.0, &z[j]);
            for (sum, grown) in inertia.iter_mut().zip(grown.iter()) {
                ring.add_product(sum, 1.0, &z[j], grown);
            }
            add_tensor(grown, J1[j], 0.5, &ring.constant(1.0));
        }
        let mut u = drift;
        vectors.add_cross(&mut u, 1.0, omega, &s);
        let mut angular_momentum = vectors.zero();
        vectors.add_symmetric(&mut angular_momentum, &inertia, omega);
        vectors.add_cross(&mut angular_momentum, -per_mass, &s, &u);
        let mut recoil = vectors.zero();
        vectors.add_cross(&mut recoil, *per_mass, &u, omega);
        let square: [Truncated; 6] = ENTRIES.map(|[row, column]| {
            let twice = if row == column { 1.0 } else { 2.0 };
            ring.product(&omega[row], &omega[column]).scaled(twice)
        });
        let mut loads = Vec::with_capacity(count);
        for k in 0..count {
            for axis in 0..3 {
                ring.add_product(&mut angular_momentum[axis], 1.0, &turning[k][axis], &rate[k]);
                momenta[k].add_scaled(-per_mass * S[k][axis], &u[axis]);
            }
            momenta[k].add_scaled(1.0, &vectors.dot(&turning[k], omega));
            let mut load = vectors.dot(&coriolis[k], omega);
            for (grown, square) in grown[k].iter().zip(&square) {
                ring.add_product(&mut load, 1.0, grown, square);
            }
            recoil.iter().zip(S[k]).for_each(|(recoil, S)| load.add_scaled(-S, recoil));
            loads.push(load);
        }
        Loads { angular_momentum, momenta, loads }
    }
}

impl ExpandedMotion<'_> {
    /// Components of a state: angular velocity, rates, displacements of the elastic coordinates.
    fn parts<'x>(&self, x: &'x [Truncated]) -> (Vector, &'x [Truncated], &'x [Truncated]) {
        let (omega, rest) = x.split_at(3);
        let (rate, q) = rest.split_at(self.body.coordinates().len());
        (std::array::from_fn(|axis| omega[axis].clone()), rate, q)
    }

    /// Loads of the coordinates, with those of the fields along curved paths. (K13)
    fn loads(&self, ring: &Ring, omega: &Vector, rate: &[Truncated], q: &[Truncated]) -> Loads {
        let body = self.body;
        let n = rate.len();
        let per_mass = body.translation().unwrap_or(0.0);
        let values = |fields: usize| -> Vec<Truncated> {
            let zero = std::iter::repeat_n(ring.zero(), n - q.len() + fields);
            q.iter().cloned().chain(zero).collect()
        };
        let Some(paths) = body.paths() else {
            let invariants = body.invariants();
            return Straight { ring, invariants, per_mass, omega, z: values(0), rate: rate.to_vec() }.loads();
        };
        let followed = paths.followers.iter().flat_map(|follower| {
            let coordinates = follower.coordinates();
            follower.series(ring, q).into_iter().map(move |series| (coordinates.clone(), series))
        });
        let followed: Vec<(Range<usize>, Series)> = followed.collect();
        let (mut z, mut rates) = (values(followed.len()), rate.to_vec());
        let along = |row: &[Truncated], coordinates: &Range<usize>| {
            let mut sum = ring.zero();
            let rates = &rate[coordinates.clone()];
            row.iter().zip(rates).for_each(|(entry, rate)| ring.add_product(&mut sum, 1.0, entry, rate));
            sum
        };
        for (e, (coordinates, series)) in followed.iter().enumerate() {
            z[n + e] = series.value.clone();
            rates.push(along(&series.slopes, coordinates));
        }
        let invariants = &paths.straight;
        let whole = Straight { ring, invariants, per_mass, omega, z, rate: rates }.loads();
        let Loads { angular_momentum, mut momenta, mut loads } = whole;
        let (field_momenta, field_loads) = (momenta.split_off(n), loads.split_off(n));
        for (e, (coordinates, series)) in followed.iter().enumerate() {
            let rows = series.second.chunks_exact(coordinates.len().max(1));
            for ((j, slope), row) in coordinates.clone().zip(&series.slopes).zip(rows) {
                ring.add_product(&mut momenta[j], 1.0, slope, &field_momenta[e]);
                ring.add_product(&mut loads[j], 1.0, slope, &field_loads[e]);
                ring.add_product(&mut loads[j], 1.0, &along(row, coordinates), &field_momenta[e]);
            }
        }
        Loads { angular_momentum, momenta, loads }
    }

    /// Adds the advection of liquids to the loads. (L21)
    fn add_advection(&self, ring: &Ring, rate: &[Truncated], loads: &mut [Truncated]) {
        for advection in self.body.advections() {
            let start = advection.coordinates.start;
            let flow = |row: &Vec<f64>| {
                let mut sum = ring.zero();
                row.iter().zip(&rate[start..]).for_each(|(share, rate)| sum.add_scaled(*share, rate));
                sum
            };
            let flows: Vec<Truncated> = advection.shares.iter().map(flow).collect();
            let mut forces: Vec<Truncated> = flows.iter().map(|_| ring.zero()).collect();
            for ([a, b, c], term) in &advection.terms {
                ring.add_product(&mut forces[*a], -term, &flows[*b], &flows[*c]);
            }
            for (row, force) in advection.shares.iter().zip(&forces) {
                row.iter().enumerate().for_each(|(j, share)| loads[start + j].add_scaled(*share, force));
            }
        }
    }
}

impl PolynomialSystem for ExpandedMotion<'_> {
    fn size(&self) -> usize {
        3 + self.body.coordinates().len() + self.body.elastic()
    }

    fn equations(&self, ring: &Ring, x: &[Truncated]) -> Equations {
        let (omega, rate, q) = self.parts(x);
        let Loads { angular_momentum, momenta, mut loads } = self.loads(ring, &omega, rate, q);
        self.add_advection(ring, rate, &mut loads);
        self.body.damping().iter().for_each(|(j, k, B)| loads[j].add_scaled(-B, &rate[k]));
        let elastic = self.body.elastic();
        let springs = self.body.stiffness().iter().filter(|(j, k, _)| *j < elastic && *k < elastic);
        springs.for_each(|(j, k, C)| loads[j].add_scaled(-C, &q[k]));
        let wheels = self.body.wheels().constant;
        let mut K = angular_momentum;
        K.iter_mut().zip(wheels).for_each(|(K, wheel)| K.add_scaled(wheel, &ring.constant(1.0)));
        let vectors = Vectors(ring);
        let mut moment = vectors.zero();
        vectors.add_cross(&mut moment, 1.0, &K, &omega);
        Equations {
            momenta: K.into_iter().chain(momenta).chain(q.iter().cloned()).collect(),
            forces: moment.into_iter().chain(loads).chain(rate[..elastic].iter().cloned()).collect(),
        }
    }

    fn scales(&self) -> Vec<f64> {
        let [xx, yy, zz, ..] = self.body.invariants().J;
        let A = self.body.mass_matrix();
        let masses = (0..A.size()).map(|j| A.at(j, j));
        let stiffness = self.body.grounded_stiffness().diagonal();
        let all = [xx, yy, zz].into_iter().chain(masses).chain(stiffness);
        all.map(|size| size.sqrt().recip()).collect()
    }

    fn conserved(&self, ring: &Ring, momenta: &[Truncated]) -> Option<Truncated> {
        let mut square = ring.zero();
        momenta[..3].iter().for_each(|K| ring.add_product(&mut square, 0.5, K, K));
        Some(square)
    }
}
