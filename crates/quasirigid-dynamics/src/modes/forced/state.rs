//! Steady state of a body under forces: search from a start, and test for steadiness.
//! The reference of the forces decides the unknowns: the attitude, the attitude across an axis, the rate, or the angular velocity.
//! Equation (M6) and the table after it, docs/theory/15-modes.md.

use nalgebra::Vector3;

use super::error::SteadyError;
use super::frame_rotation::{FrameRotation, effective, rests};
use super::newton::Problem;
use super::slopes::Instant;
use super::steadiness;
use crate::math::rotation;
use crate::math::vec3::norm;
use crate::model::force::Force;
use crate::model::{FlexibleBody, Marker, MotionState};
use crate::modes::equilibrium::RelativeEquilibrium;

type V = Vector3<f64>;

/// Start of the search for a steady state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteadyStateGuess {
    /// Angular velocity (rad/s), body axes.
    pub omega: [f64; 3],
    /// Attitude, unit quaternion, scalar first, from body to inertial axes.
    pub attitude: [f64; 4],
    /// Place of the pole of a constrained body (m), inertial axes.
    pub place: [f64; 3],
    /// Velocity of the pole (m/s); of a free body the start of the search for its steady velocity.
    pub velocity: [f64; 3],
    /// True if this angular velocity is asked for, and the attitude follows it; false if it is that of the start, of which only the part
    /// about the axis of the forces matters.
    pub asked: bool,
}

/// Steady state of a body under moments: at rest in axes that rotate at a constant rate about an axis fixed in space. (M6)
#[derive(Clone, Debug, PartialEq)]
pub struct SteadyState {
    /// Angular velocity (rad/s), body axes.
    pub omega: [f64; 3],
    /// Attitude at `t = 0`, unit quaternion, scalar first, from body to inertial axes.
    pub attitude: [f64; 4],
    /// Unit vector of the axis of rotation, inertial axes; none for a body at rest.
    pub axis: Option<[f64; 3]>,
    /// Displacements of the internal coordinates; zero of cyclic ones.
    pub q: Vec<f64>,
    /// Angular momentum with that of wheels (N·m·s), body axes.
    pub angular_momentum: [f64; 3],
    /// Energy of rotation and deformation (J), without that of wheels and of position.
    pub energy: f64,
    /// Velocity (m/s): of the centre of mass of a free body under drag, body axes; of a constrained pole, inertial axes.
    pub velocity: [f64; 3],
    /// Angle (rad) between the attitude of the start and that of the state; between the angular velocities, where one was asked for or no
    /// force depends on the attitude.
    pub away: f64,
    pub(super) place: [f64; 3],
    pub(super) turning: FrameRotation,
    pub(super) followed: bool,
}

/// Limit of the number of coordinates.
pub(super) const MAX_COORDINATES: usize = 250;
/// True if an external action moves a body, or a motor changes the speed of a wheel: if not, its steady states are those of (M1).
#[must_use]
pub fn acts(body: &FlexibleBody, forces: &[Force<Marker>]) -> bool {
    let changing = body.wheels().driven.iter().any(|wheel| wheel.speed.uses(0));
    !effective(body, forces).0.is_empty() || !rests(body) || changing
}

impl SteadyState {
    /// Steady state next to a start. (M6)
    ///
    /// # Errors
    /// [`SteadyError`] says why there is none, or that none was found.
    pub fn near(
        body: &FlexibleBody,
        forces: &[Force<Marker>],
        near: SteadyStateGuess,
    ) -> Result<Self, SteadyError> {
        let coordinates = body.coordinates().len();
        if coordinates > MAX_COORDINATES {
            return Err(SteadyError::TooMany { coordinates, most: MAX_COORDINATES });
        }
        let (forces, followed) = effective(body, forces);
        let mut turning = FrameRotation::of(body, &forces, &near)?;
        let attitude = rotation::normalized(near.attitude);
        let omega_N = V::from(rotation::to_inertial(attitude, near.omega));
        let rests = omega_N == V::zeros();
        match turning {
            FrameRotation::Unknown if !rests => turning = FrameRotation::About(omega_N.normalize()),
            FrameRotation::Unknown => turning = FrameRotation::Still,
            FrameRotation::Own if rests && forces.is_empty() => turning = FrameRotation::Still,
            _ => {}
        }
        let problem =
            Problem { body, forces: &forces, followed, near: SteadyStateGuess { attitude, ..near } };
        let found = match &turning {
            FrameRotation::Set { what, .. } if near.asked => {
                return Err(SteadyError::Set { what: what.clone() });
            }
            FrameRotation::Set { rate, .. } => problem.turned(rate.normalize(), rate.norm())?,
            FrameRotation::About(axis) => problem.about(*axis, omega_N)?,
            FrameRotation::Still | FrameRotation::Unknown => problem.turned(V::zeros(), 0.0)?,
            FrameRotation::Own => problem.own()?,
        };
        let state = Self::of(&problem, &found, turning);
        steadiness::check(body, &forces, &state)?;
        Ok(state)
    }

    /// Steady spin without moments, from body axes along the inertial ones. (M1)
    #[must_use]
    pub fn of_spin(spin: &RelativeEquilibrium) -> Self {
        let rate = norm(spin.omega);
        Self {
            omega: spin.omega,
            attitude: rotation::ALIGNED,
            axis: (rate > 0.0).then_some(spin.omega.map(|entry| entry / rate)),
            q: spin.q.clone(),
            angular_momentum: spin.angular_momentum,
            energy: spin.energy,
            velocity: [0.0; 3],
            away: 0.0,
            place: [0.0; 3],
            turning: FrameRotation::Own,
            followed: false,
        }
    }

    /// Rest without moments, momentum wheels turning.
    #[must_use]
    pub fn at_rest(body: &FlexibleBody) -> Self {
        Self::of_spin(&RelativeEquilibrium {
            omega: [0.0; 3],
            q: vec![0.0; body.coordinates().len()],
            angular_momentum: body.wheels().angular_momentum(0.0),
            ratio: 0.0,
            energy: 0.0,
        })
    }

    /// The state in another attitude (unit quaternion, scalar first, from body to inertial axes): where no force acts it is steady in any.
    #[must_use]
    pub fn in_attitude(self, attitude: [f64; 4]) -> Self {
        let rate = norm(self.omega);
        let axis = self.axis.map(|_| rotation::to_inertial(attitude, self.omega).map(|entry| entry / rate));
        Self { attitude, axis, ..self }
    }

    /// State at a time, for the evaluation of forces; a constrained pole at its place at `t = 0`.
    pub(super) fn at(&self, t: f64) -> Instant {
        let spin = V::from(rotation::to_inertial(self.attitude, self.omega));
        let attitude = rotation::turned(self.attitude, (t * spin).into());
        Instant {
            t,
            attitude,
            omega: self.omega,
            q: self.q.clone(),
            place: self.place,
            velocity: self.velocity,
        }
    }

    fn of(problem: &Problem, at: &Instant, turning: FrameRotation) -> Self {
        let Problem { body, followed, near, .. } = *problem;
        let still = vec![0.0; at.q.len()];
        let motion = MotionState { omega: at.omega, q: &at.q, rate: &still };
        let angular_momentum =
            V::from(body.full_momenta(motion).0) + V::from(body.wheels().angular_momentum(0.0));
        let spin = norm(at.omega);
        let spins = near.asked || turning == FrameRotation::Own;
        let away = if spins {
            rotation::angle(near.omega, at.omega)
        } else {
            rotation::angle_between(near.attitude, at.attitude)
        };
        let axis = rotation::to_inertial(at.attitude, at.omega).map(|entry| entry / spin);
        Self {
            omega: at.omega,
            attitude: at.attitude,
            axis: (spin > 0.0).then_some(axis),
            q: at.q.clone(),
            angular_momentum: angular_momentum.into(),
            energy: body.full_energy(motion),
            velocity: at.velocity,
            away,
            place: at.place,
            turning,
            followed,
        }
    }
}
