//! Systems of the reduced equations: variable of the form alone, or with attitude and energy accounts. (P1) to (P4)

use super::form::{Equations, Motion, Rates, vector};
use crate::math::ode::System;
use crate::math::rotation;
use crate::math::simd::Arithmetic;
use crate::math::vec3::norm;

/// Variable of the form alone; the fourth component is idle and fills a vector register.
pub(super) struct SpinOnly<'a, R>(pub &'a R);

impl<R: Rates<f64>> System<[f64; 4]> for SpinOnly<'_, R> {
    #[inline(always)]
    fn rate<A: Arithmetic>(&mut self, _: f64, y: &[f64; 4], rate: &mut [f64; 4]) {
        let x = vector(*y);
        let [x, y, z] = self.0.rate::<A>(x);
        *rate = [x, y, z, 0.0];
    }
}

/// Variable of the form with attitude and accounts.
pub(super) struct Accounted<'a, E> {
    pub equations: &'a E,
}

/// State of [`Accounted`], fields in the order of the state vector.
#[derive(Clone, Copy, Debug)]
pub(super) struct Accounts {
    /// Variable of the form.
    pub x: [f64; 3],
    /// Attitude, `R_NB`.
    pub attitude: [f64; 4],
    /// Energy taken by the dashpots, `∫P dt` (J).
    pub dissipated: f64,
    /// Change of energy along the field, `∫∇E·F dt` (J).
    pub energy_change: f64,
    /// Angle turned, `∫|ω| dt` (rad).
    pub angle: f64,
}

/// Index of the attitude in [`Accounts`].
pub(super) const ATTITUDE: usize = 4;

impl Accounts {
    #[inline(always)]
    pub fn pack(self) -> [f64; 12] {
        let [x, y, z] = self.x;
        let [s, i, j, k] = self.attitude;
        [x, y, z, 0.0, s, i, j, k, self.dissipated, self.energy_change, self.angle, 0.0]
    }

    /// Accounts from a state vector of twelve components.
    #[inline(always)]
    pub fn unpack(y: &[f64]) -> Self {
        Self {
            x: [y[0], y[1], y[2]],
            attitude: [0, 1, 2, 3].map(|i| y[ATTITUDE + i]),
            dissipated: y[8],
            energy_change: y[9],
            angle: y[10],
        }
    }
}

impl<E: Equations> System<[f64; 12]> for Accounted<'_, E> {
    #[inline(always)]
    fn rate<A: Arithmetic>(&mut self, _: f64, y: &[f64; 12], rate: &mut [f64; 12]) {
        let Accounts { x, attitude, .. } = Accounts::unpack(y);
        let Motion { omega, rate: moved, power, energy_rate } = self.equations.motion::<A>(x);
        let rates = Accounts {
            x: moved,
            attitude: rotation::rate(attitude, omega),
            dissipated: power,
            energy_change: energy_rate,
            angle: norm(omega),
        };
        *rate = rates.pack();
    }
}
