//! Slow manifold of a body without external forces: recursion for displacements, rates and angular momentum, degree by degree.
//! Each degree uses lower ones only, so `C` is factored once; elastic values and cyclic rates are slaved by the same steps. The order of
//! the steps within a degree matters.
//! Equations (R1) to (R6) and (R13), docs/theory/03-reduction.md; (C3), (L21), docs/theory/13-inside.md; (S6), docs/theory/01-system.md.

use super::couplings::{Couplings, add_turned};
use crate::math::polynomial::{Homogeneous, Series};
use crate::math::sym3::{self, Sym};
use crate::math::watch;
use crate::model::{Advection, FlexibleBody};

/// Slow manifold: internal coordinates and angular acceleration as polynomials in the angular velocity `ω`, degree by degree. (R1)
///
/// Coordinates and rates are kept apart: the value of an elastic coordinate is slaved to the angular velocity and the rate follows, the
/// rate of a cyclic one (R13) is slaved, and the same steps serve both.
#[derive(Clone, Debug)]
pub(super) struct SlowManifold {
    /// Internal coordinates `q`, to degree `p`.
    pub q: Series,
    /// Rates `q̇` of the coordinates, to degree `p + 1`.
    pub rate: Series,
    /// Angular acceleration `ω̇ = f(ω)`, to degree `p + 2`.
    pub f: Series,
    /// Angular momentum `K(ω)`, to degree `p + 1`; that of wheels is part of its degree 1.
    pub K: Series,
    /// First moment `s` of the displacement, to degree `p`, and its inertial rate `u`, to degree `p + 1`. (S6)
    pub s: Series,
    pub u: Series,
    /// Generalised momenta `A q̇ + h(q)·ω`, without the translation, to degree `p`. (S4)
    pub p: Series,
}

/// Recursion (R2)–(R5) for a body, in progress.
struct Recursion<'a> {
    body: &'a FlexibleBody,
    order: usize,
    inverse_inertia: Sym,
    manifold: SlowManifold,
    couplings: Couplings,
}

impl SlowManifold {
    /// Follows the recursion to order `p`.
    pub fn compute(body: &FlexibleBody, order: usize) -> Self {
        let n = body.coordinates().len();
        let mut recursion = Recursion {
            body,
            order,
            inverse_inertia: sym3::inverse(body.invariants().J),
            manifold: Self {
                q: Series::zero(order, n),
                rate: Series::zero(order + 1, n),
                f: Series::zero(order + 2, 3),
                K: Series::zero(order + 1, 3),
                s: Series::zero(order, 3),
                u: Series::zero(order + 1, 3),
                p: Series::zero(order, n),
            },
            couplings: Couplings::new(body, order),
        };
        let mut K = Homogeneous::linear(&body.inertia());
        let wheels = body.wheels().angular_momentum(0.0);
        if wheels != [0.0; 3] {
            K.add_scaled(1.0, &Homogeneous::constant(&wheels));
        }
        recursion.manifold.K.set(K);
        if order > 0 {
            recursion.manifold.p.set(Homogeneous::linear(&body.invariants().h));
        }
        watch::stage("reducing the equations");
        for degree in 2..=order + 2 {
            watch::progress((degree - 2) as f64 / (order + 1) as f64);
            recursion.spin_rate(degree);
            if degree <= order + 1 {
                recursion.rates(degree);
                recursion.coordinates(degree);
                recursion.angular_momentum(degree);
            }
        }
        recursion.manifold
    }
}

impl Recursion<'_> {
    /// `J f_d = −[ω × K]_d − [d/dt (K − Jω)]_d`. (R2)
    fn spin_rate(&mut self, degree: usize) {
        let SlowManifold { f, K, .. } = &self.manifold;
        let mut torque = Homogeneous::identity().cross(K.part(degree - 1));
        let mut deviation = K.clone();
        deviation.set(Homogeneous::zero(1, 3));
        torque.add_scaled(1.0, &deviation.rate(f, degree));
        self.manifold.f.set(mapped(self.inverse_inertia, -1.0, &torque));
    }

    /// `[q̇]_d = Σ ∇q_a f_b`, `a + b = d + 1`, of elastic coordinates, with those of the cyclic ones, and the inertial rate of the first
    /// moment. (R3)
    fn rates(&mut self, degree: usize) {
        let SlowManifold { q, f, s, .. } = &self.manifold;
        let mut rate = q.rate(f, degree);
        if !self.body.cyclic().is_empty() {
            self.add_cyclic_rates(&mut rate);
        }
        let mut u = rate.contracted(&self.body.invariants().S);
        u.add_scaled(1.0, &Homogeneous::identity().cross(s.part(degree - 1)));
        self.manifold.rate.set(rate);
        self.manifold.u.set(u);
    }

    /// `B q̇_d = [load]_d − [d/dt (A q̇ + h(q)·ω)]_d` of cyclic coordinates, less the damping forces from elastic ones. (C3)
    fn add_cyclic_rates(&self, rate: &mut Homogeneous) {
        let degree = rate.degree();
        let cyclic = self.body.cyclic();
        let mut right = self.load(degree);
        right.add_scaled(-1.0, &self.manifold.p.rate(&self.manifold.f, degree));
        for j in cyclic.clone() {
            for (k, B) in self.body.damping().row(j).filter(|(k, _)| !cyclic.contains(k)) {
                right.add_row(j, -B, (rate, k));
            }
        }
        right.solve_rows(cyclic.clone(), |rows, width| self.body.solve_friction(rows, width));
        cyclic.for_each(|j| rate.add_row(j, 1.0, (&right, j)));
    }

    /// `C q_d = [load]_d − [d/dt (A q̇ + h(q)·ω)]_d − B [q̇]_d`. (R4)
    fn coordinates(&mut self, degree: usize) {
        if degree > self.order {
            return;
        }
        let mut right = self.load(degree);
        right.add_scaled(-1.0, &self.manifold.p.rate(&self.manifold.f, degree));
        let rate = self.manifold.rate.part(degree);
        for (j, k, B) in self.body.damping().iter().take_while(|(j, ..)| *j < self.body.elastic()) {
            right.add_row(j, -B, (rate, k));
        }
        let all = 0..right.rows();
        right.solve_rows(all, |rows, width| self.body.solve_stiffness(rows, width));
        self.manifold.s.set(right.contracted(&self.body.invariants().S));
        self.couplings.follow(self.body, &right);
        self.manifold.q.set(right);
        self.manifold.p.set(self.generalized_momentum(degree));
    }

    /// `[½ ωᵀJ_jω + ωᵀJ_jkω q_k + ω·Z_jk q̇_k]_d`, `S_j·(u̇ + ω×u)/m*` for a free body, and the advection of liquids. (R4), (S6), (L21)
    fn load(&self, degree: usize) -> Homogeneous {
        let SlowManifold { rate, f, u, .. } = &self.manifold;
        let invariants = self.body.invariants();
        if degree == 2 {
            return Homogeneous::half_quadratic(&invariants.J1);
        }
        let mut load = Homogeneous::zero(degree, rate.rows());
        self.couplings.add_load(self.body, rate.part(degree - 1), &mut load);
        self.body.advections().iter().for_each(|advection| self.add_advection(advection, &mut load));
        if let Some(per_mass) = self.body.translation() {
            let mut acceleration = u.rate(f, degree);
            acceleration.add_scaled(1.0, &Homogeneous::identity().cross(u.part(degree - 1)));
            for (j, S) in invariants.S.iter().enumerate() {
                for (axis, weight) in S.iter().enumerate() {
                    load.add_row(j, per_mass * weight, (&acceleration, axis));
                }
            }
        }
        load
    }

    /// Adds `−[N(q̇, q̇)]_d` of a liquid, whose rates begin with degree two. (L21)
    fn add_advection(&self, Advection { coordinates, shares, terms }: &Advection, load: &mut Homogeneous) {
        let degree = load.degree();
        let flows = |part: usize| {
            let mut flows = Homogeneous::zero(part, shares.len());
            for (a, row) in shares.iter().enumerate() {
                for (share, j) in row.iter().zip(coordinates.clone()) {
                    flows.add_row(a, *share, (self.manifold.rate.part(part), j));
                }
            }
            flows
        };
        let mut forces = Homogeneous::zero(degree, shares.len());
        for part in 2..(degree - 1).max(2) {
            let (carrier, carried) = (flows(part), flows(degree - part));
            for ([a, b, c], term) in terms {
                forces.add_product(*a, -term, (&carrier, *b), (&carried, *c));
            }
        }
        for (a, row) in shares.iter().enumerate() {
            for (share, j) in row.iter().zip(coordinates.clone()) {
                load.add_row(j, *share, (&forces, a));
            }
        }
    }

    /// `[A q̇ + h(q)·ω]_d`. (S4)
    fn generalized_momentum(&self, degree: usize) -> Homogeneous {
        let rate = self.manifold.rate.part(degree);
        let mut p = Homogeneous::zero(degree, rate.rows());
        self.body.invariants().pairs.iter().for_each(|(j, k, pair)| p.add_row(j, pair.A, (rate, k)));
        self.couplings.add_momentum(&mut p);
        p
    }

    /// `K_d = [q_jJ_jω + q_jq_kJ_jkω + h_j(q) q̇_j]_d`, less `s × u/m*` for a free body. (R5), (S6)
    fn angular_momentum(&mut self, degree: usize) {
        let SlowManifold { q, rate, s, u, .. } = &self.manifold;
        let invariants = self.body.invariants();
        let mut K = rate.part(degree).contracted(&invariants.h);
        add_turned(&q.part(degree - 1).contracted(&invariants.J1), &mut K);
        self.couplings.add_angular_momentum(q, rate, &mut K);
        if let Some(per_mass) = self.body.translation() {
            K.add_scaled(-per_mass, &s.cross(u, degree));
        }
        self.manifold.K.set(K);
    }
}

/// `factor · matrix · map`.
pub(super) fn mapped(matrix: Sym, factor: f64, map: &Homogeneous) -> Homogeneous {
    let mut image = map.contracted(&sym3::rows(matrix));
    image.scale(factor);
    image
}
