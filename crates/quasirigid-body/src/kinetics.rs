//! Kinetics of the full system: velocities from momenta, and loads on the coordinates.
//! The mass matrix is factored once, and the angular velocity is a system of size three.
//! Equations (S2), (S4) and (S6), docs/theory/01-system.md; (T1), docs/theory/08-full-system.md.

use super::curved::CurvedKinetics;
use super::mass_inverse::MassInverse;
use super::{FlexibleBody, Invariants, MotionState};
use crate::math::sym3::{self, Sym, of_unit_mass, products, times};
use crate::math::vec3::{add, cross, dot, scale};

/// Velocities from momenta: solves (S2) and (S4) for the angular velocity and the rates of the coordinates, at any displacement.
///
/// The kinetic energy is `½ωᵀJ(q)ω + ω·h(q)q̇ + ½q̇ᵀAq̇`, for a free body with the translation eliminated. (S6)
#[derive(Clone, Debug)]
pub struct Kinetics<'a> {
    body: &'a FlexibleBody,
    inverse: MassInverse,
    /// `h_k(q)` in the first three columns, the generalised momenta in the last; then `A⁻¹` times both.
    rows: Vec<[f64; 4]>,
    solved: Vec<[f64; 4]>,
    /// `½∂J/∂q_j` of the body without recoil in translation.
    slopes: Vec<Sym>,
    /// Kinetics along curved paths, where the body has them.
    curved: Option<CurvedKinetics<'a>>,
}

/// Velocities of a state, with the data of its loads.
#[derive(Clone, Copy, Debug)]
pub struct Velocities<'k> {
    /// Angular velocity (rad/s), body axes.
    pub omega: [f64; 3],
    body: &'k FlexibleBody,
    /// Inertial rate of the first moment of the displacement, `ṡ + ω × s` (N·s); zero for a constrained body.
    u: [f64; 3],
    slopes: &'k [Sym],
    curved: Option<&'k CurvedKinetics<'k>>,
}

impl FlexibleBody {
    /// Angular momentum about the pole without that of the wheels (N·m·s, body axes), and generalised momenta, of a motion along curved
    /// paths: the arguments of [`Kinetics::velocities`]. (S2), (S4), (K13)
    #[must_use]
    pub fn full_momenta(&self, motion: MotionState<f64>) -> ([f64; 3], Vec<f64>) {
        match self.paths() {
            Some(paths) => CurvedKinetics::new(self, paths).momenta(motion),
            None => (self.angular_momentum(motion), self.generalized_momentum(motion)),
        }
    }

    /// Energy of a motion along curved paths (J), kinetic and elastic, without that of the wheels. (S5), (K13)
    #[must_use]
    pub fn full_energy(&self, motion: MotionState<f64>) -> f64 {
        let (K, p) = self.full_momenta(motion);
        let kinetic = dot(motion.omega, K) + p.iter().zip(motion.rate).map(|(p, rate)| p * rate).sum::<f64>();
        let forces = self.stiffness().times(motion.q);
        0.5 * (kinetic + forces.iter().zip(motion.q).map(|(force, q)| force * q).sum::<f64>())
    }
}

impl<'a> Kinetics<'a> {
    /// Factors the mass matrix of a body; none if that matrix is not positive, as with a carrier whose mass is lost in rounding.
    #[must_use]
    pub fn new(body: &'a FlexibleBody) -> Option<Self> {
        let n = body.coordinates().len();
        let rows = vec![[0.0; 4]; n];
        let curved = body.paths().map(|paths| CurvedKinetics::new(body, paths));
        let slopes = vec![[0.0; 6]; n];
        Some(Self { body, inverse: MassInverse::new(body)?, solved: rows.clone(), rows, slopes, curved })
    }

    /// Body.
    #[must_use]
    pub fn body(&self) -> &'a FlexibleBody {
        self.body
    }

    /// Sets the rates of the driven coordinates, in the order of the drives: zero at first. (T8)
    pub fn drive(&mut self, rates: impl Iterator<Item = f64>) {
        if let Some(curved) = &mut self.curved {
            curved.drive(rates);
        }
    }

    /// Angular velocity at these momenta (N·m·s, without the wheels; units of the coordinates) and coordinates; writes the rates of the
    /// coordinates. Momenta of driven coordinates are not asked for: they follow. (T8)
    pub fn velocities(&mut self, K: [f64; 3], p: &[f64], q: &[f64], rate: &mut [f64]) -> Velocities<'_> {
        if let Some(curved) = &mut self.curved {
            let omega = curved.velocities(K, p, q, rate);
            return Velocities {
                omega,
                body: self.body,
                u: [0.0; 3],
                slopes: &[],
                curved: self.curved.as_ref(),
            };
        }
        let (J, s) = self.prepare(q);
        for (row, p) in self.rows.iter_mut().zip(p) {
            row[3] = *p;
        }
        self.inverse.apply(&self.rows, &mut self.solved);
        let mut schur = J;
        let mut load = K;
        for ([hx, hy, hz, _], [x, y, z, p]) in self.rows.iter().zip(&self.solved) {
            let products = [hx * x, hy * y, hz * z, hy * z, hz * x, hx * y];
            schur.iter_mut().zip(products).for_each(|(entry, product)| *entry -= product);
            load = add(load, scale(-p, [*hx, *hy, *hz]));
        }
        let omega = times(sym3::inverse(schur), load);
        let mut drift = [0.0; 3];
        for ((rate, [x, y, z, p]), S) in rate.iter_mut().zip(&self.solved).zip(&self.body.invariants().S) {
            *rate = p - (x * omega[0] + y * omega[1] + z * omega[2]);
            drift = add(drift, scale(*rate, *S));
        }
        let u = if self.body.translation().is_some() { add(drift, cross(omega, s)) } else { [0.0; 3] };
        Velocities { omega, body: self.body, u, slopes: &self.slopes, curved: None }
    }

    /// Returns `J(q)` and the first moment of the displacement; stores `h_k(q)` in the rows, and the slopes.
    fn prepare(&mut self, q: &[f64]) -> (Sym, [f64; 3]) {
        let Invariants { J, J1, S, h, pairs, .. } = self.body.invariants();
        let mut J = *J;
        let mut s = [0.0; 3];
        for (row, h) in self.rows.iter_mut().zip(h) {
            *row = [h[0], h[1], h[2], 0.0];
        }
        for (j, qj) in q[..self.body.elastic()].iter().enumerate() {
            s = add(s, scale(*qj, S[j]));
            let mut square = [0.0; 6];
            for (k, pair) in pairs.row(j) {
                square.iter_mut().zip(pair.J2).for_each(|(sum, J2)| *sum += q[k] * J2);
                self.rows[k].iter_mut().zip(pair.Z).for_each(|(h, Z)| *h += qj * Z);
            }
            for (((J, J1), square), slope) in J.iter_mut().zip(J1[j]).zip(square).zip(&mut self.slopes[j]) {
                *J += qj * (J1 + square);
                *slope = 0.5 * J1 + square;
            }
        }
        let Some(per_mass) = self.body.translation() else {
            return (J, [0.0; 3]);
        };
        J.iter_mut().zip(of_unit_mass(s)).for_each(|(J, part)| *J -= per_mass * part);
        for (row, S) in self.rows.iter_mut().zip(S) {
            let turn = cross(s, *S);
            row.iter_mut().zip(turn).for_each(|(h, turn)| *h -= per_mass * turn);
        }
        (J, s)
    }
}

impl Velocities<'_> {
    /// Momenta of the driven coordinates, in the order of the drives. (T8)
    pub fn driven_momenta(&self) -> impl Iterator<Item = f64> {
        let momentum = |curved: &CurvedKinetics, j: usize| curved.momentum_of(j);
        let drives = self.body.drives().iter();
        drives.filter_map(move |drive| Some(momentum(self.curved?, drive.coordinate)))
    }

    /// Adds the load on each coordinate, centrifugal and Coriolis, spring and dashpot, to `sum`; returns the power that the dashpots take
    /// (W). (S4)
    pub fn add_loads(&self, q: &[f64], rate: &[f64], sum: &mut [f64]) -> f64 {
        let Self { omega, body, u, slopes, curved } = *self;
        body.advections().iter().for_each(|advection| advection.add_load(rate, sum));
        if let Some(curved) = curved {
            curved.add_loads(sum);
            return add_internal(body, q, rate, sum);
        }
        let Invariants { S, pairs, .. } = body.invariants();
        let [xx, yy, zz, yz, zx, xy] = products(omega);
        let square = [xx, yy, zz, 2.0 * yz, 2.0 * zx, 2.0 * xy];
        let recoil = scale(body.translation().unwrap_or(0.0), cross(u, omega));
        for (j, sum) in sum.iter_mut().enumerate() {
            let centrifugal: f64 = slopes[j].iter().zip(square).map(|(slope, square)| slope * square).sum();
            let mut turning = [0.0; 3];
            for (k, pair) in pairs.row(j) {
                turning.iter_mut().zip(pair.Z).for_each(|(turning, Z)| *turning += rate[k] * Z);
            }
            *sum += centrifugal + dot(omega, turning) - dot(S[j], recoil);
        }
        add_internal(body, q, rate, sum)
    }
}

/// Adds the loads of springs and dashpots; returns the power that the dashpots take (W).
fn add_internal(body: &FlexibleBody, q: &[f64], rate: &[f64], sum: &mut [f64]) -> f64 {
    let mut power = 0.0;
    for (j, sum) in sum.iter_mut().enumerate() {
        let damped: f64 = body.damping().row(j).map(|(k, b)| b * rate[k]).sum();
        let elastic: f64 = body.stiffness().row(j).map(|(k, c)| c * q[k]).sum();
        power += damped * rate[j];
        *sum -= damped + elastic;
    }
    for friction in body.frictions() {
        power += friction.power(rate);
        sum[friction.coordinate] -= friction.force(rate);
    }
    power
}
