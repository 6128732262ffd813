//! Eddy currents averaged over a free rotation in a field that turns slowly: the angular momentum falls and turns, the wobble changes.
//! The angular momentum follows `dK/dt = −(m/G) N K` with one scalar `m`, so that its direction is a closed function of `x = ∫ m/G dt`, and
//! no components are integrated.
//! Equations (A14) and (A15), docs/theory/10-torque-free.md.

use crate::averaging::eddy_torque::EddyTorque;
use crate::averaging::poinsot::FreeRotation;
use crate::math::vec3::{add, dot, norm, scale};
use crate::model::Principal;

/// Averaged eddy currents of a body with known principal axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct MeanEddy {
    /// Diagonal of the magnetic tensor in principal axes (S·m⁴).
    tensor: [f64; 3],
    /// Mean square of the field (T²).
    square: f64,
    /// Eigenvalues of `N/⟨B²⟩ = 1 − ⟨BBᵀ⟩/⟨B²⟩`, ascending, with their axes.
    across: Principal,
}

/// Averaged rates of eddy currents.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct EddyRates {
    /// Rate (1/s) of the logarithm of the angular momentum.
    pub growth: f64,
    /// Work (W) on the wobble of a short-axis mode, `⟨M·(ω − K/I)⟩`; of a long-axis mode with the other sign.
    pub work: f64,
    /// Rate (1/s) of the exposure `⟨B²⟩ ∫ m/G dt`.
    pub exposure: f64,
}

impl MeanEddy {
    pub fn new(torque: &EddyTorque, principal: &Principal) -> Self {
        let B = torque.field.mean_square();
        let square = B[0][0] + B[1][1] + B[2][2];
        let share = |i: usize, j: usize| -B[i][j] / square;
        let N =
            [1.0 + share(0, 0), 1.0 + share(1, 1), 1.0 + share(2, 2), share(1, 2), share(2, 0), share(0, 1)];
        Self { tensor: torque.along(principal.axes), square, across: Principal::compute(N) }
    }

    /// Direction of an angular momentum after an exposure: of `exp(−N x) u`. (A15)
    pub fn direction(&self, u: [f64; 3], exposure: f64) -> [f64; 3] {
        if exposure == 0.0 {
            return u;
        }
        let Principal { moments: eigenvalues, axes } = self.across;
        let parts = [0, 1, 2].map(|i| {
            let left = (-(eigenvalues[i] - eigenvalues[0]) * exposure).exp();
            scale(left * dot(axes[i], u), axes[i])
        });
        let turned = parts.into_iter().fold([0.0; 3], add);
        scale(1.0 / norm(turned), turned)
    }

    /// Rates at a free rotation with its angular momentum along `u`, inertial axes; `axis` is the circled one. (A14)
    pub fn rates(&self, motion: &FreeRotation, axis: usize, u: [f64; 3]) -> EddyRates {
        let (I, G, M) = (motion.moments(), motion.angular_momentum(), self.tensor);
        let trace: f64 = M.iter().sum();
        let eigenvalues = self.across.moments;
        let across: f64 =
            (0..3).map(|i| eigenvalues[i] * dot(self.across.axes[i], u).powi(2)).sum::<f64>() * self.square;
        let along = (self.square - across).max(0.0);
        let others = [0, 1, 2].map(|i| trace - M[i]);
        let away = I.map(|moment| 1.0 - moment / I[axis]);
        let quadratic = |weights: [f64; 3]| {
            motion.mean(2, |omega| (0..3).map(|i| weights[i] * omega[i] * omega[i]).sum())
        };
        let m = 0.5 * quadratic([0, 1, 2].map(|i| others[i] * I[i])) / G;
        let straight = quadratic([0, 1, 2].map(|i| others[i] * away[i]));
        let nodding = motion.mean(4, |omega| {
            let tilt = |i: usize, j: usize| (I[j] - I[i]) / G * omega[i] * omega[j];
            M[0] * tilt(1, 2).powi(2) + M[1] * tilt(2, 0).powi(2) + M[2] * tilt(0, 1).powi(2)
        });
        EddyRates {
            growth: -m * across / G,
            work: -nodding * along + 0.5 * across * (nodding - straight),
            exposure: self.square * m / G,
        }
    }
}
