//! Averaged rates of a rotation under slow torques and dissipation: of `ξ`, of `ln G`, of the revolutions and of the direction.
//! The energy above the steady spin is followed instead of the energy, so that a steady spin stays one in every digit and no rate is a
//! difference of large numbers.
//! Equations (A8), (A14) and (A15), docs/theory/10-torque-free.md.

use std::f64::consts::TAU;

use super::Drift;
use super::eddy::EddyRates;
use crate::averaging::poinsot::FreeRotation;
use crate::averaging::power::MeanPower;
use crate::math::ode::System;
use crate::math::simd::Arithmetic;
use crate::math::vec3::{add, dot, scale, unit};
use crate::model::Mode;

/// Variables that are integrated: `ξ`, `ln G` from a start, revolutions, and the direction of the angular momentum, inertial axes.
pub(super) type Variables = [f64; 6];

/// Rates of the variables in one mode and on one side.
pub(super) struct Rates<'d, P> {
    pub drift: &'d Drift<P>,
    pub mode: Mode,
    pub side: f64,
    /// Angular momentum that the logarithm is counted from.
    pub angular_momentum: f64,
    /// True if the wobble has died out, and stays so.
    pub steady: bool,
}

/// Place, as `ξ`, beyond which nothing but the size of the wobble changes: `e^{−36}` is a rounding.
const AXIS: f64 = 36.0;

/// Direction of the angular momentum, a unit vector.
pub(super) fn direction([.., x, y, z]: &Variables) -> [f64; 3] {
    unit([*x, *y, *z])
}

/// Variables with a direction, or rates with its rate.
pub(super) fn with_direction([xi, logarithm, revolutions]: [f64; 3], [x, y, z]: [f64; 3]) -> Variables {
    [xi, logarithm, revolutions, x, y, z]
}

impl<P: MeanPower> System<Variables> for Rates<'_, P> {
    fn rate<R: Arithmetic>(&mut self, t: f64, y: &Variables, rate: &mut Variables) {
        *rate = self.of(t, y);
        if self.steady {
            rate[0] = 0.0;
        }
    }
}

impl<P: MeanPower> Rates<'_, P> {
    /// Rates at a time (s) and the integrated variables; that of `ξ` also where the wobble has died out, to tell whether the steady spin is stable.
    pub fn of(&self, t: f64, y: &Variables) -> Variables {
        self.at(t, y[0], self.angular_momentum * y[1].exp(), direction(y))
    }

    /// Free rotation at a place `ξ` and an angular momentum; beyond `AXIS` that at `AXIS`.
    pub fn motion(&self, xi: f64, G: f64) -> FreeRotation {
        FreeRotation::at_logit(self.drift.moments, G, self.mode, xi.min(AXIS))
    }

    /// The rates at a time (s), a place and an angular momentum in this direction. (A8), (A14)
    pub fn at(&self, t: f64, xi: f64, G: f64, direction: [f64; 3]) -> Variables {
        let Drift { moments, constant, drag, ref eddy, .. } = *self.drift;
        let motion = self.motion(xi, G);
        let axis = self.mode.circled();
        let mut torque = [0.0; 3];
        torque[axis] = self.side * constant[axis];
        // Torque along the angular momentum, and its work on the wobble: `±M·(ω − K/I)` with the moment of the circled axis.
        let along = |omega: [f64; 3]| {
            let K = [0, 1, 2].map(|i| moments[i] * omega[i]);
            dot(add(torque, scale(-drag, omega)), K) / G
        };
        let away = |omega: [f64; 3]| {
            let sum: f64 = (0..3).map(|i| (1.0 - moments[i] / moments[axis]) * omega[i] * omega[i]).sum();
            -drag * sum
        };
        let eddy = eddy.as_ref().map_or(EddyRates::default(), |eddy| eddy.rates(t, &motion, axis, direction));
        let growth = motion.mean(2, along) / G + eddy.growth;
        let work = motion.mean(2, away) + eddy.work;
        let turning = 2.0 * motion.energy() / (G * TAU);
        if moments[0] == moments[2] {
            return with_direction([0.0, growth, turning], eddy.turning);
        }
        let power = self.drift.power.mean_power(&motion);
        let gain = match self.mode {
            Mode::ShortAxis => work - power,
            Mode::LongAxis => power - work,
        };
        let excess = gain / motion.energy_from_axis() - 2.0 * growth;
        with_direction([-excess / self.slope(xi.min(AXIS)), growth, turning], eddy.turning)
    }

    /// `−d ln(X/G²)/dξ` for the energy `X` of the wobble.
    fn slope(&self, xi: f64) -> f64 {
        let [I1, I2, I3] = self.drift.moments;
        let to_axis = 1.0 / (1.0 + xi.exp());
        let to_separatrix = 1.0 / (1.0 + (-xi).exp());
        let bend = match self.mode {
            Mode::ShortAxis => (I3 - I2) * to_axis / (I3 - (I3 - I2) * to_axis),
            Mode::LongAxis => -(I2 - I1) * to_axis / (I1 + (I2 - I1) * to_axis),
        };
        to_separatrix * (1.0 + bend)
    }
}
