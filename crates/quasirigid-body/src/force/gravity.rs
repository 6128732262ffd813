//! Loads of uniform gravity and of the gravity gradient, summed over a body by its invariants. (F3), (F4)

use super::Loads;
use crate::math::scalar::Smooth;
use crate::math::sym3::{Sym, times};
use crate::math::vec3::{add, cross, dot, scale};
use crate::{FlexibleBody, Follower, Invariants};

/// First moment of the displacements (kg·m), `s = S_j q_j + ½ Γ_jk q_j q_k`, and its slopes `∂s/∂q_j`; exact of appendages on hinges.
/// (F3), (I12)
pub(super) struct FirstMoment<T> {
    pub s: [T; 3],
    pub slopes: Vec<[T; 3]>,
}

impl<T: Smooth> FirstMoment<T> {
    pub fn of(body: &FlexibleBody, q: &[T]) -> Self {
        let Invariants { S, .. } = body.invariants();
        let pairs = body.paths().map_or(&body.invariants().pairs, |paths| &paths.straight.pairs);
        let n = S.len();
        let mut slopes: Vec<_> = S.iter().map(|S| S.map(T::from)).collect();
        for (j, k, pair) in pairs.iter().filter(|(j, k, _)| *j < n && *k < n) {
            slopes[j] = add(slopes[j], scale(q[k], pair.S2.map(T::from)));
        }
        // s = ½ q_j (S_j + ∂s/∂q_j), because s is of second degree.
        let half = T::from(0.5);
        let parts = q.iter().zip(S).zip(&slopes);
        let s = parts.fold([T::from(0.0); 3], |s, ((q, S), slope)| {
            add(s, scale(half * *q, add(S.map(T::from), *slope)))
        });
        let mut moment = Self { s, slopes };
        moment.turn(body, q);
        moment
    }

    /// Adds the fields of appendages on hinges; those of second order are in the pairs. (I12)
    fn turn(&mut self, body: &FlexibleBody, q: &[T]) {
        let Some(paths) = body.paths() else { return };
        let mut field = q.len();
        for follower in &paths.followers {
            if matches!(follower, Follower::Rotation { .. }) {
                let start = follower.coordinates().start;
                for (e, (value, slopes)) in follower.amplitudes(q).into_iter().enumerate() {
                    let S = paths.straight.S[field + e].map(T::from);
                    self.s = add(self.s, scale(value, S));
                    for (j, slope) in slopes.into_iter().enumerate() {
                        self.slopes[start + j] = add(self.slopes[start + j], scale(slope, S));
                    }
                }
            }
            field += follower.fields();
        }
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
        let (three, half) = (T::from(3.0), T::from(0.5));
        // 3 nᵀXn − tr X
        let form = |X: Sym| three * dot(n, times(X, n)) - T::from(X[0] + X[1] + X[2]);
        let (invariants, (z, fields)) = match body.paths() {
            Some(paths) => (&paths.straight, paths.spread(q)),
            None => (body.invariants(), (q.to_vec(), Vec::new())),
        };
        let mut Jn = times(invariants.J, n);
        let mut forces = Vec::with_capacity(z.len());
        for (z, J1) in z.iter().zip(&invariants.J1) {
            Jn = add(Jn, scale(*z, times(*J1, n)));
            forces.push(-(half * kappa * form(*J1)));
        }
        for (j, k, pair) in invariants.pairs.iter() {
            Jn = add(Jn, scale(z[j] * z[k], times(pair.J2, n)));
            forces[j] = forces[j] - kappa * z[k] * form(pair.J2);
        }
        for ((start, slopes), force) in fields.iter().zip(forces.split_off(q.len())) {
            slopes.iter().enumerate().for_each(|(j, slope)| {
                forces[start + j] = forces[start + j] + *slope * force;
            });
        }
        self.generalized.iter_mut().zip(forces).for_each(|(Q, force)| *Q = *Q + force);
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
