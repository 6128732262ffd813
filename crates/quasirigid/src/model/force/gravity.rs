//! Loads of uniform gravity and of the gravity gradient, summed over a body by its invariants. (F3), (F4)

use super::Loads;
use crate::math::scalar::Smooth;
use crate::math::sym3::times;
use crate::math::vec3::{add, cross, dot, scale};
use crate::model::{FlexibleBody, Invariants};

/// First moment of the displacements (kg·m), `s = S_j q_j + ½ Γ_jk q_j q_k`, and its slopes `∂s/∂q_j`. (F3)
pub(super) struct FirstMoment<T> {
    pub s: [T; 3],
    pub slopes: Vec<[T; 3]>,
}

impl<T: Smooth> FirstMoment<T> {
    pub fn of(body: &FlexibleBody, q: &[T]) -> Self {
        let Invariants { S, pairs, .. } = body.invariants();
        let mut slopes: Vec<_> = S.iter().map(|S| S.map(T::from)).collect();
        for (j, k, pair) in pairs.iter() {
            slopes[j] = add(slopes[j], scale(q[k], pair.S2.map(T::from)));
        }
        // s = ½ q_j (S_j + ∂s/∂q_j), because s is of second degree.
        let half = T::from(0.5);
        let parts = q.iter().zip(S).zip(&slopes);
        let s = parts.fold([T::from(0.0); 3], |s, ((q, S), slope)| {
            add(s, scale(half * *q, add(S.map(T::from), *slope)))
        });
        Self { s, slopes }
    }
}

impl<T: Smooth> Loads<T> {
    /// Adds the loads of a uniform acceleration `g` (m/s², body axes) of every mass element. (F3)
    pub(super) fn add_uniform(&mut self, body: &FlexibleBody, q: &[T], g: [T; 3]) {
        let FirstMoment { s, slopes } = FirstMoment::of(body, q);
        let mass = body.invariants().mass;
        let (center, pole) = (body.center_of_mass(), body.pole());
        let rest: [T; 3] = std::array::from_fn(|axis| T::from(mass * (center[axis] - pole[axis])));
        self.force = add(self.force, scale(T::from(mass), g));
        self.add_torque(cross(add(rest, s), g));
        for (Q, slope) in self.generalized.iter_mut().zip(slopes) {
            *Q = *Q + dot(slope, g);
        }
    }

    /// Adds the loads of the acceleration `κ(3 n nᵀ − 1)d` of a mass element at `d` from the centre of mass of a free body, from the pole
    /// of a constrained one; `n` unit vector in body axes, `κ` in 1/s². (F4)
    pub(super) fn add_gradient(&mut self, body: &FlexibleBody, q: &[T], n: [T; 3], kappa: T) {
        let invariants = body.invariants();
        let (two, three, half) = (T::from(2.0), T::from(3.0), T::from(0.5));
        // 3 nᵀXn − tr X
        let form = |X| three * dot(n, times(X, n)) - T::from(X[0] + X[1] + X[2]);
        let mut Jn = times(invariants.J, n);
        for (j, J1) in invariants.J1.iter().enumerate() {
            Jn = add(Jn, scale(q[j], times(*J1, n)));
            self.generalized[j] = self.generalized[j] - half * kappa * form(*J1);
        }
        for (j, k, pair) in invariants.pairs.iter() {
            Jn = add(Jn, scale(q[j] * q[k], times(pair.J2, n)));
            self.generalized[j] = self.generalized[j] - half * kappa * two * q[k] * form(pair.J2);
        }
        if let Some(per_mass) = body.translation() {
            let FirstMoment { s, slopes } = FirstMoment::of(body, q);
            let per_mass = T::from(per_mass);
            let along = dot(s, n);
            Jn = add(Jn, scale(per_mass, add(scale(along, s), scale(-dot(s, s), n))));
            for (Q, slope) in self.generalized.iter_mut().zip(slopes) {
                *Q = *Q + kappa * per_mass * (dot(s, slope) - three * along * dot(slope, n));
            }
        }
        self.add_torque(scale(three * kappa, cross(n, Jn)));
    }
}
