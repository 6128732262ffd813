//! Reduced equations under forces as a system for the integrator, in either form.
//! One state vector serves both forms: its first three components are the angular momentum or the angular velocity, its place the centre of
//! mass or the pole.
//! Equations (E2), (E3) and (E6), docs/theory/09-forced-reduction.md.

use super::equations::{SlowEquations, SlowFlow};
use super::flow::SlowPoint;
use super::state::SlowState;
use super::torque::{ForcedTorque, RigidState, forced_torque};
use crate::dynamics::external::Pose;
use crate::dynamics::invariant_monitor::StateView;
use crate::dynamics::layout::{
    ANGLE, ATTITUDE, DISSIPATED, IMPULSE, MOMENTUM, PLACE, SLOW_LENGTH, VELOCITY, WORK, triple,
};
use crate::math::ode::{Stretch, System};
use crate::math::rotation::{self, Turn};
use crate::math::simd::Arithmetic;
use crate::math::sym3::{inverse, times};
use crate::math::vec3::{add, cross, dot, norm};
use crate::model::force::{KinematicState, Loads};
use crate::model::{Form, MotionState};

/// Reduced equations of a forced body. In the angular-momentum form the state has the angular momentum, `K̇ = K × ω + M`, with angular
/// velocity and loads of the slow motion (E2), (E6); in the angular-velocity form the angular velocity, `Jω̇ + ω × Jω = M* + μ`, and the place
/// of the pole (E3).
#[derive(Clone, Copy, Debug)]
pub(super) struct SlowSystem<'a> {
    pub equations: SlowEquations<'a>,
    pub form: Form,
    /// Stretch between breakpoints of the forces that steps lie in. (Z1)
    pub stretch: Stretch,
}

/// Rates and internal coordinates at a state.
struct Rates {
    omega: [f64; 3],
    angular_momentum: [f64; 3],
    energy: f64,
    power: f64,
    first: [f64; 3],
    acceleration: [f64; 3],
    loads: Loads<f64>,
    q: Vec<f64>,
    rate: Vec<f64>,
}

impl SlowSystem<'_> {
    fn rates(&self, t: f64, y: &[f64], flow: impl Fn([f64; 3], &Pose<f64>) -> SlowFlow) -> Rates {
        match self.form {
            Form::AngularMomentum => self.angular_momentum_form(t, y, flow),
            Form::AngularVelocity => self.angular_velocity_form(t, y),
        }
    }

    /// Quantities of a state.
    pub fn view(&self, t: f64, y: &[f64]) -> StateView {
        let Rates { omega, angular_momentum, energy, q, rate, .. } =
            self.rates(t, y, |K, pose| self.equations.at(K, pose));
        let (dissipated, work) = (y[DISSIPATED], y[WORK]);
        StateView {
            omega,
            angular_momentum,
            energy,
            q,
            rate,
            dissipated,
            work,
            explained: [-dissipated, work],
            angle: y[ANGLE],
            impulse: triple(y, IMPULSE),
        }
    }

    fn angular_momentum_form(
        &self,
        t: f64,
        y: &[f64],
        flow: impl Fn([f64; 3], &Pose<f64>) -> SlowFlow,
    ) -> Rates {
        let state = SlowState::unpack(y);
        let (angular_momentum, pose) = (state.angular_momentum, state.pose(t));
        let SlowFlow { omega, energy, power, point } = flow(angular_momentum, &pose);
        let SlowPoint { q, rate, loads, .. } = point;
        Rates {
            omega,
            angular_momentum,
            energy,
            power,
            first: add(cross(angular_momentum, omega), loads.moment),
            acceleration: self.equations.system.acceleration(&pose, loads.force),
            loads,
            q,
            rate,
        }
    }

    fn angular_velocity_form(&self, t: f64, y: &[f64]) -> Rates {
        let state = SlowState::unpack(y);
        let SlowState { angular_momentum: omega, attitude, place, velocity } = state;
        let SlowEquations { system, order, .. } = self.equations;
        let body = system.body;
        let at = RigidState { t, omega, attitude, pole: place, pole_velocity: velocity };
        let ForcedTorque { moment, mu, force, phi, q, rate, .. } = forced_torque(system, order, &at);
        let J = body.invariants().J;
        let torque = add(add(moment, mu), cross(times(J, omega), omega));
        let motion = MotionState { omega, q: &q, rate: &rate };
        let kinematics = KinematicState { t, attitude, pole: place, pole_velocity: velocity, motion };
        Rates {
            omega,
            angular_momentum: add(body.angular_momentum(motion), body.wheels().angular_momentum(t)),
            energy: body.energy(motion),
            power: body.damping().quadratic(&rate),
            first: times(inverse(J), torque),
            acceleration: system.acceleration(&state.pose(t), add(force, phi)),
            loads: body.loads(system.forces, &kinematics).about_center(body, &q),
            q,
            rate,
        }
    }
}

impl System<[f64; SLOW_LENGTH]> for SlowSystem<'_> {
    fn rate<A: Arithmetic>(&mut self, t: f64, y: &[f64; SLOW_LENGTH], rate: &mut [f64; SLOW_LENGTH]) {
        let t = self.stretch.within(t);
        let now = self.rates(t, y, |K, pose| self.equations.for_rates(K, pose));
        let SlowState { attitude, velocity, .. } = SlowState::unpack(y);
        let motion = MotionState { omega: now.omega, q: &now.q, rate: &now.rate };
        rate[MOMENTUM..MOMENTUM + 3].copy_from_slice(&now.first);
        rate[ATTITUDE..ATTITUDE + 4].copy_from_slice(&rotation::rate(attitude, now.omega));
        rate[DISSIPATED] = now.power;
        let motors = dot(now.omega, self.equations.system.body.wheels().torque(t));
        rate[WORK] = now.loads.power(motion, [0.0; 3]) - motors;
        rate[ANGLE] = norm(now.omega);
        let impulse = Turn::of(attitude).to_inertial(now.loads.moment);
        rate[IMPULSE..IMPULSE + 3].copy_from_slice(&impulse);
        rate[PLACE..PLACE + 3].copy_from_slice(&velocity);
        rate[VELOCITY..VELOCITY + 3].copy_from_slice(&now.acceleration);
    }

    fn enter(&mut self, stretch: Stretch) {
        self.stretch = stretch;
    }
}
