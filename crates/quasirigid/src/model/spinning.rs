//! Coefficients of the full equations about a steady rotation with displaced coordinates. (M2)

use super::{FlexibleBody, Invariants, MotionState};
use crate::math::eigen::Dense;
use crate::math::sym3::{self, Sym, times};
use crate::math::vec3::{add, cross, dot, scale};

/// Coefficients of small motions about a steady angular velocity `ω` and displacements `q`. (M2)
///
/// The translation of a free body is eliminated (S6).
#[derive(Clone, Debug)]
pub struct SpinCoefficients {
    /// Inertia tensor `J(q)` (kg·m²).
    pub inertia: Sym,
    /// Angular momentum per unit rate of each coordinate, `h_k(q)`.
    pub h: Vec<[f64; 3]>,
    /// Change of the angular momentum with each coordinate, `(∂J/∂q_j) ω`; zero of cyclic ones.
    pub slopes: Vec<[f64; 3]>,
    /// Gyroscopic matrix `G`, antisymmetric.
    pub gyroscopic: Dense,
    /// Centrifugal stiffness `N`, symmetric, to be subtracted from `C`.
    pub centrifugal: Dense,
}

impl FlexibleBody {
    /// Centrifugal stiffness `N_jk = ωᵀJ_jk ω` at an angular velocity (rad/s), symmetric. (M2)
    #[must_use]
    pub fn centrifugal_stiffness(&self, omega: [f64; 3]) -> Dense {
        let Invariants { S, pairs, .. } = self.invariants();
        let mut N = Dense::zero(S.len());
        let elastic = self.elastic();
        for (j, k, pair) in pairs.iter().filter(|(j, k, _)| *j < elastic && *k < elastic) {
            N.add(j, k, dot(omega, times(pair.J2, omega)));
        }
        if let Some(per_mass) = self.translation() {
            let square = dot(omega, omega);
            let along: Vec<f64> = S.iter().map(|S| dot(*S, omega)).collect();
            for j in 0..elastic {
                for k in 0..elastic {
                    N.add(j, k, -per_mass * (square * dot(S[j], S[k]) - along[j] * along[k]));
                }
            }
        }
        N
    }

    /// Coefficients of small motions about a steady angular velocity (rad/s) with these displacements. (M2)
    #[must_use]
    pub fn about_spin(&self, omega: [f64; 3], q: &[f64]) -> SpinCoefficients {
        let Invariants { S, J1, h, pairs, .. } = self.invariants();
        let elastic = self.elastic();
        let still = vec![0.0; q.len()];
        let (s, _) = self.translation_of(MotionState { omega, q, rate: &still });
        let mut slopes: Vec<[f64; 3]> = J1.iter().map(|J1| times(*J1, omega)).collect();
        let mut h = h.clone();
        let mut G = Dense::zero(S.len());
        for (j, k, pair) in pairs.iter() {
            let turn = dot(omega, pair.Z);
            G.add(j, k, -turn);
            if j < elastic {
                G.add(k, j, turn);
                slopes[j] = add(slopes[j], scale(2.0 * q[k], times(pair.J2, omega)));
                h[k] = add(h[k], scale(q[j], pair.Z));
            }
        }
        if let Some(per_mass) = self.translation() {
            for j in 0..elastic {
                let along = add(scale(dot(S[j], omega), s), scale(dot(s, omega), S[j]));
                let own = scale(2.0 * dot(S[j], s), omega);
                slopes[j] = add(slopes[j], scale(-per_mass, add(own, scale(-1.0, along))));
                h[j] = add(h[j], scale(-per_mass, cross(s, S[j])));
                for k in 0..elastic {
                    G.add(j, k, 2.0 * per_mass * dot(omega, cross(S[j], S[k])));
                }
            }
        }
        SpinCoefficients {
            inertia: self.inertia_at(q),
            h,
            slopes,
            gyroscopic: G,
            centrifugal: self.centrifugal_stiffness(omega),
        }
    }

    /// Displacements in balance with a steady angular velocity (rad/s), `(C − N) q = ½ ωᵀJ_jω`, cyclic coordinates at zero; none where `C
    /// − N` is singular. (M1)
    #[must_use]
    pub fn balanced(&self, omega: [f64; 3]) -> Option<BalancedSpin> {
        BalancedSpin::of(self, omega)
    }
}

/// Displacements in balance with a steady angular velocity, and the derivative of the angular momentum.
#[derive(Clone, Debug)]
pub struct BalancedSpin {
    /// Displacements of all coordinates.
    pub q: Vec<f64>,
    /// Angular momentum without that of wheels (N·m·s), body axes.
    pub angular_momentum: [f64; 3],
    /// Derivative of the angular momentum by the angular velocity (kg·m²), rows.
    pub slope: [[f64; 3]; 3],
}

impl BalancedSpin {
    fn of(body: &FlexibleBody, omega: [f64; 3]) -> Option<Self> {
        let n = body.coordinates().len();
        let elastic = body.elastic();
        let Invariants { J, J1, .. } = body.invariants();
        let mut q = vec![0.0; n];
        let mut slope = sym3::rows(*J);
        if elastic > 0 {
            let N = body.centrifugal_stiffness(omega);
            let mut left = Dense::of(&body.stiffness().block(0..elastic));
            for j in 0..elastic {
                for k in 0..elastic {
                    left.add(j, k, -N.at(j, k));
                }
            }
            let factor = crate::math::lu::Lu::new(&left)?;
            let load: Vec<f64> = J1[..elastic].iter().map(|J1| 0.5 * dot(omega, times(*J1, omega))).collect();
            q[..elastic].copy_from_slice(&factor.solve(&load, 1)?);
            let SpinCoefficients { inertia, slopes, .. } = body.about_spin(omega, &q);
            let answers = factor.solve(slopes[..elastic].as_flattened(), 3)?;
            slope = sym3::rows(inertia);
            for (j, answer) in answers.as_chunks::<3>().0.iter().enumerate() {
                for (row, left) in slope.iter_mut().zip(slopes[j]) {
                    row.iter_mut().zip(answer).for_each(|(entry, right)| *entry += left * right);
                }
            }
        }
        let angular_momentum = times(body.inertia_at(&q), omega);
        Some(Self { q, angular_momentum, slope })
    }
}
