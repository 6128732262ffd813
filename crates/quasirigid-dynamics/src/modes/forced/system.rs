//! Linear equations about a state, and its residual. (M6), (M7)

use nalgebra::{DMatrix, Matrix3, Vector3};

use super::slopes::{DISPLACED, Instant, OMEGA, Slopes, THETA, VELOCITY};
use crate::math::sym3::times;
use crate::math::vec3::{add, cross, dot, norm, scale};
use crate::model::{FlexibleBody, SpinCoefficients};
use crate::modes::first_order::{forces, mass};

/// `M ẇ + D w + S y = 0` with `w = (δω, δq̇, δv)` and `y = (θ, δq)`; `δv` only of a body whose velocity is followed. (M6)
#[derive(Clone, Debug)]
pub(super) struct System {
    pub omega: [f64; 3],
    pub coefficients: SpinCoefficients,
    pub mass: DMatrix<f64>,
    pub rate: DMatrix<f64>,
    /// Columns: `θ`, then the elastic displacements.
    pub stiffness: DMatrix<f64>,
    /// Residual of `M ẇ = 0`, and the size of the terms of the moments (N·m).
    pub residual: Vec<f64>,
    pub terms: f64,
    /// Part `|ω||K|` of `terms`, whose rounding alone may remain.
    pub turned: f64,
    /// Slopes of the loads alone.
    pub slopes: Slopes,
}

impl System {
    /// System about an instant, with the velocity of a free body if that is followed.
    pub fn about(body: &FlexibleBody, slopes: Slopes, instant: &Instant, followed: bool) -> Self {
        let Instant { omega, q, velocity, .. } = instant;
        let (n, elastic) = (q.len(), body.elastic());
        let coefficients = body.about_spin_on_paths(*omega, q);
        let angular_momentum = add(times(coefficients.inertia, *omega), body.wheels().angular_momentum(0.0));
        let size = if followed { 6 + n } else { 3 + n };
        let mut mass_matrix = DMatrix::zeros(size, size);
        mass_matrix.view_mut((0, 0), (3 + n, 3 + n)).copy_from(&mass(&coefficients));
        let (velocities, displacements) = forces(body, *omega, angular_momentum, &coefficients);
        let mut rate = DMatrix::zeros(size, size);
        rate.view_mut((0, 0), (3 + n, 3 + n)).copy_from(&velocities);
        let mut stiffness = DMatrix::zeros(size, 3 + elastic);
        stiffness.view_mut((0, 3), (3 + n, elastic)).copy_from(&displacements);
        let by = slopes.by.rows(0, size);
        let less = |matrix: &mut DMatrix<f64>, at: usize, from: usize, count: usize| {
            let mut block = matrix.columns_mut(at, count);
            block -= by.columns(from, count);
        };
        less(&mut rate, 0, OMEGA, 3);
        less(&mut rate, 3, DISPLACED + elastic, n);
        less(&mut stiffness, 0, THETA, 3);
        less(&mut stiffness, 3, DISPLACED, elastic);
        let gyroscopic = cross(*omega, angular_momentum);
        let mut residual: Vec<f64> = (0..3).map(|i| gyroscopic[i] - slopes.value.moment[i]).collect();
        let held = body.stiffness().times(q);
        let pulled = |j: usize| 0.5 * dot(*omega, coefficients.slopes[j]);
        residual.extend((0..n).map(|j| held[j] - pulled(j) - slopes.value.generalized[j]));
        if followed {
            less(&mut rate, 3 + n, VELOCITY, 3);
            let m = body.invariants().mass;
            let (w, v) = (Vector3::from(*omega), Vector3::from(*velocity));
            let mut own = rate.view_mut((3 + n, 3 + n), (3, 3));
            own += m * w.cross_matrix();
            let mut turned = rate.view_mut((3 + n, 0), (3, 3));
            turned -= m * v.cross_matrix();
            mass_matrix.view_mut((3 + n, 3 + n), (3, 3)).copy_from(&(m * Matrix3::identity()));
            let carried = scale(m, cross(*omega, *velocity));
            residual.extend((0..3).map(|i| carried[i] - slopes.value.force[i]));
        }
        let turned = norm(*omega) * norm(angular_momentum);
        let terms = turned + loads(body, &slopes);
        Self {
            omega: *omega,
            coefficients,
            mass: mass_matrix,
            rate,
            stiffness,
            residual,
            terms,
            turned,
            slopes,
        }
    }

    /// `[ω]ₓ`: `θ̇ = δω − ω × θ`.
    pub fn turning(&self) -> Matrix3<f64> {
        Vector3::from(self.omega).cross_matrix()
    }
}

/// Length scale of the body (m): the root of its inertia over its mass.
pub(super) fn length(body: &FlexibleBody) -> f64 {
    let [xx, yy, zz, ..] = body.invariants().J;
    ((xx + yy + zz) / (3.0 * body.invariants().mass)).sqrt()
}

/// Size of the moments of the loads (N·m).
fn loads(body: &FlexibleBody, slopes: &Slopes) -> f64 {
    let turned = slopes.by.view((0, THETA), (3, 3)).abs().max();
    norm(slopes.value.moment) + length(body) * norm(slopes.value.force) + turned
}
