use crate::dynamics::external::{Forced, Pose};
use crate::dynamics::layout::{ATTITUDE, Layout, MOMENTUM, PLACE, VELOCITY};
use crate::dynamics::run::PropagateError;
use crate::dynamics::slow::{SlowPoint, SlowState, slow_state_point};
use crate::math::vec3::add;
use crate::model::{Drive, FlexibleBody, MotionState};

/// Initial state of a run of the full system.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct FullState {
    /// Angular velocity (rad/s), body axes.
    pub omega: [f64; 3],
    /// Attitude, unit quaternion, scalar first, from body to inertial axes.
    pub attitude: [f64; 4],
    /// Internal coordinates.
    pub q: Vec<f64>,
    /// Rates of the internal coordinates.
    pub rate: Vec<f64>,
    /// Place (m), inertial axes: of the centre of mass of a free body, of the pole of a constrained one.
    pub place: [f64; 3],
    /// Velocity of that point (m/s).
    pub velocity: [f64; 3],
}

impl FullState {
    /// Rotating body without displacement: elastic parts at rest in their equilibrium, driven ones by their laws.
    #[must_use]
    pub fn at_rest(body: &FlexibleBody, omega: [f64; 3], attitude: [f64; 4]) -> Self {
        let n = body.coordinates().len();
        let still = vec![0.0; n];
        let (place, velocity) = ([0.0; 3], [0.0; 3]);
        Self { omega, attitude, q: still.clone(), rate: still, place, velocity }.driven(body)
    }

    /// The state with its driven coordinates and their rates by their laws just after the start; itself for a body without drives. (T7)
    #[must_use]
    pub fn driven(mut self, body: &FlexibleBody) -> Self {
        for drive in body.drives() {
            let Drive { coordinate, .. } = *drive;
            let places = self.q.get_mut(coordinate).zip(self.rate.get_mut(coordinate));
            if let Some((q, rate)) = places {
                [*q, *rate, _] = drive.at(f64::MIN_POSITIVE);
            }
        }
        self
    }

    /// State on the slow manifold of order `p` that belongs to a slow motion.
    ///
    /// # Errors
    /// [`PropagateError::Order`] if the order is beyond the reduction of forced bodies.
    pub fn on_manifold(system: Forced, order: usize, slow: &SlowState) -> Result<Self, PropagateError> {
        let SlowPoint { omega, q, rate, .. } = slow_state_point(system, order, slow)?;
        let SlowState { attitude, place, velocity, .. } = *slow;
        Ok(Self { omega, attitude, q, rate, place, velocity })
    }

    /// Angular momentum (N·m·s) with that of wheels, body axes.
    #[must_use]
    pub fn angular_momentum(&self, body: &FlexibleBody) -> [f64; 3] {
        add(body.full_momenta(self.motion()).0, body.wheels().angular_momentum(0.0))
    }

    /// Energy of rotation and deformation (J), without that of wheels.
    #[must_use]
    pub fn energy(&self, body: &FlexibleBody) -> f64 {
        body.full_energy(self.motion())
    }

    pub(super) fn pose(&self) -> Pose<f64> {
        Pose { t: 0.0, attitude: self.attitude, place: self.place, velocity: self.velocity }
    }

    pub(super) fn motion(&self) -> MotionState<'_, f64> {
        MotionState { omega: self.omega, q: &self.q, rate: &self.rate }
    }

    /// The state in a layout, with the block of the controllers zero.
    pub(super) fn pack(&self, body: &FlexibleBody, layout: Layout) -> Vec<f64> {
        let mut y = vec![0.0; layout.len()];
        let (own, p) = body.full_momenta(self.motion());
        let angular_momentum = add(own, body.wheels().angular_momentum(0.0));
        y[MOMENTUM..MOMENTUM + 3].copy_from_slice(&angular_momentum);
        y[ATTITUDE..ATTITUDE + 4].copy_from_slice(&self.attitude);
        y[PLACE..PLACE + 3].copy_from_slice(&self.place);
        y[VELOCITY..VELOCITY + 3].copy_from_slice(&self.velocity);
        y[layout.q()].copy_from_slice(&self.q);
        y[layout.p()].copy_from_slice(&p);
        y
    }
}
