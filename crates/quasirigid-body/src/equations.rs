//! Full equations (S2)–(S6) at a state: angular momentum, generalised momenta, loads and energy.

use super::{FlexibleBody, Invariants, Pair};
use crate::math::scalar::Scalar;
use crate::math::sym3::{Sym, times};
use crate::math::vec3::{add, cross, dot, scale};

/// State of the full system: angular velocity (rad/s, body axes), internal coordinates and their rates.
///
/// Components may be truncated Taylor series in time, which gives the rates of all quantities below.
#[derive(Clone, Copy, Debug)]
pub struct MotionState<'a, T> {
    /// Angular velocity `ω` (rad/s).
    pub omega: [T; 3],
    /// Internal coordinates `q`; values of cyclic ones are not read.
    pub q: &'a [T],
    /// Rates `q̇`.
    pub rate: &'a [T],
}

/// Inertia tensor on straight paths at displacements, of whose products those of these pairs count. (S2), (S6)
fn inertia<'p, T: Scalar>(
    Invariants { J, J1, S, .. }: &Invariants,
    translation: Option<f64>,
    q: &[T],
    pairs: impl Iterator<Item = (usize, usize, &'p Pair)>,
) -> [T; 6] {
    let mut sum = J.map(T::from);
    let mut grow = |amount: T, part: Sym| {
        for (sum, part) in sum.iter_mut().zip(part) {
            *sum = *sum + amount * T::from(part);
        }
    };
    q.iter().zip(J1).for_each(|(q, J1)| grow(*q, *J1));
    pairs.for_each(|(j, k, pair)| grow(q[j] * q[k], pair.J2));
    if let Some(per_mass) = translation {
        let zero = [T::from(0.0); 3];
        let [x, y, z] = q.iter().zip(S).fold(zero, |s, (q, S)| add(s, scale(*q, S.map(T::from))));
        let about = [y * y + z * z, z * z + x * x, x * x + y * y];
        let mixed = [y * z, z * x, x * y];
        for axis in 0..3 {
            sum[axis] = sum[axis] - T::from(per_mass) * about[axis];
            sum[3 + axis] = sum[3 + axis] + T::from(per_mass) * mixed[axis];
        }
    }
    sum
}

impl FlexibleBody {
    /// Inertia tensor at a displacement (kg·m²): about the pole of a constrained body, about the centre of mass of a free one. (S2), (S6)
    #[must_use]
    pub fn inertia_at<T: Scalar>(&self, q: &[T]) -> [T; 6] {
        inertia(self.invariants(), self.translation(), &q[..self.elastic()], self.displaced_pairs())
    }

    /// The same along curved paths, at any displacement. (S2), (K13)
    #[must_use]
    pub fn full_inertia_at(&self, q: &[f64]) -> Sym {
        let Some(paths) = self.paths() else { return self.inertia_at(q) };
        let (mut z, _) = paths.spread(q);
        z[self.cyclic()].fill(0.0);
        inertia(&paths.straight, self.translation(), &z, paths.straight.pairs.iter())
    }

    /// Angular momentum about the pole without that of the wheels, body axes (N·m·s). (S2)
    #[must_use]
    pub fn angular_momentum<T: Scalar>(&self, motion: MotionState<T>) -> [T; 3] {
        let MotionState { omega, q, rate } = motion;
        let invariants = self.invariants();
        let mut K = times(invariants.J, omega);
        for (j, (J1, h)) in invariants.J1.iter().zip(&invariants.h).enumerate() {
            if j < self.elastic() {
                K = add(K, scale(q[j], times(*J1, omega)));
            }
            K = add(K, scale(rate[j], h.map(T::from)));
        }
        for (j, k, pair) in self.displaced_pairs() {
            K = add(K, scale(q[j] * q[k], times(pair.J2, omega)));
            K = add(K, scale(q[j] * rate[k], pair.Z.map(T::from)));
        }
        if let Some(per_mass) = self.translation() {
            let (s, u) = self.translation_of(motion);
            K = add(K, scale(T::from(-per_mass), cross(s, u)));
        }
        K
    }

    /// Generalised momenta `∂L/∂q̇_j = A q̇ + h(q)·ω`. (S4)
    #[must_use]
    pub fn generalized_momentum<T: Scalar>(&self, motion: MotionState<T>) -> Vec<T> {
        let MotionState { omega, q, rate } = motion;
        let invariants = self.invariants();
        let mut p: Vec<T> = invariants.h.iter().map(|h| dot(h.map(T::from), omega)).collect();
        for (j, k, pair) in invariants.pairs.iter() {
            p[j] = p[j] + T::from(pair.A) * rate[k];
        }
        for (j, k, pair) in self.displaced_pairs() {
            p[k] = p[k] + q[j] * dot(pair.Z.map(T::from), omega);
        }
        if let Some(per_mass) = self.translation() {
            let (_, u) = self.translation_of(motion);
            for (p, S) in p.iter_mut().zip(&invariants.S) {
                *p = *p - T::from(per_mass) * dot(S.map(T::from), u);
            }
        }
        p
    }

    /// Loads `∂L/∂q_j + ∂U/∂q_j`: centrifugal and Coriolis forces on the coordinates, and the advection of liquids, without spring and dashpot. (S4), (L21)
    #[must_use]
    pub fn load<T: Scalar>(&self, motion: MotionState<T>) -> Vec<T> {
        let MotionState { omega, q, rate } = motion;
        let invariants = self.invariants();
        let half = T::from(0.5);
        let mut Q: Vec<T> = invariants.J1.iter().map(|J1| half * dot(omega, times(*J1, omega))).collect();
        for (j, k, pair) in self.displaced_pairs() {
            Q[j] = Q[j] + dot(omega, times(pair.J2, omega)) * q[k];
        }
        for (j, k, pair) in invariants.pairs.iter() {
            Q[j] = Q[j] + dot(omega, pair.Z.map(T::from)) * rate[k];
        }
        if let Some(per_mass) = self.translation() {
            let (_, u) = self.translation_of(motion);
            let turned = cross(u, omega);
            for (Q, S) in Q.iter_mut().zip(&invariants.S) {
                *Q = *Q - T::from(per_mass) * dot(S.map(T::from), turned);
            }
        }
        self.advections().iter().for_each(|advection| advection.add_load(rate, &mut Q));
        Q
    }

    /// Energy of the whole system (J), kinetic and elastic, without that of the wheels. (S5), (C5)
    #[must_use]
    pub fn energy(&self, motion: MotionState<f64>) -> f64 {
        let MotionState { omega, q, rate } = motion;
        let K = self.angular_momentum(motion);
        let p = self.generalized_momentum(motion);
        let kinetic = dot(omega, K) + p.iter().zip(rate).map(|(p, v)| p * v).sum::<f64>();
        let elastic = self.stiffness().quadratic(q);
        0.5 * (kinetic + elastic)
    }

    /// Pairs whose first coordinate is elastic: the value of that coordinate displaces mass.
    fn displaced_pairs(&self) -> impl Iterator<Item = (usize, usize, &Pair)> {
        self.invariants().pairs.iter().take_while(|(j, ..)| *j < self.elastic())
    }

    /// First moment `s = Σ q_j S_j` of the displacement and its inertial rate `u = ṡ + ω × s`. (S6)
    pub(crate) fn translation_of<T: Scalar>(
        &self,
        MotionState { omega, q, rate }: MotionState<T>,
    ) -> ([T; 3], [T; 3]) {
        let zero = [T::from(0.0); 3];
        let (mut s, mut u) = (zero, zero);
        for (j, S) in self.invariants().S.iter().enumerate().take(self.elastic()) {
            s = add(s, scale(q[j], S.map(T::from)));
            u = add(u, scale(rate[j], S.map(T::from)));
        }
        (s, add(u, cross(omega, s)))
    }
}
