use crate::math::expression::Expression;
use crate::math::rotation::Turn;
use crate::math::scalar::Smooth;
use crate::math::vec3::scale;
pub(super) use crate::model::force::Pose;
use crate::model::force::{Force, ForceLaw, Loads, TIME, VARIABLES};
use crate::model::{FlexibleBody, Marker, MotionState, Support};

/// A body with the external forces on it.
#[derive(Clone, Copy, Debug)]
pub struct Forced<'a> {
    /// The body.
    pub body: &'a FlexibleBody,
    /// The forces.
    pub forces: &'a [Force<Marker>],
}

impl<'a> Forced<'a> {
    /// Body without external forces.
    #[must_use]
    pub fn not(body: &'a FlexibleBody) -> Self {
        Self { body, forces: &[] }
    }

    /// True if an external action exists: a force, a support that moves, or a motor that changes the speed of its wheel.
    #[must_use]
    pub fn acts(&self) -> bool {
        !self.forces.is_empty() || self.is_driven() || !self.body.wheels().driven.is_empty()
    }

    /// True if every action is a force or torque in its own axes by the time alone.
    pub(super) fn is_prescribed(&self) -> bool {
        let by_time = |force: &Force<Marker>| match force.law.timed().0 {
            ForceLaw::Torque { .. }
            | ForceLaw::Thrust { .. }
            | ForceLaw::TorqueTable { .. }
            | ForceLaw::ForceTable { .. } => true,
            law => law.formulas().is_some_and(|formulas| {
                let others = |formula: &Expression| (0..VARIABLES).any(|i| i != TIME && formula.uses(i));
                !formulas.iter().any(others)
            }),
        };
        !self.is_driven() && self.body.wheels().driven.is_empty() && self.forces.iter().all(by_time)
    }

    fn is_driven(&self) -> bool {
        matches!(self.body.support(), Support::Prescribed { .. })
    }

    /// True if an action depends on the place or the velocity of the body.
    pub(super) fn feels_path(&self) -> bool {
        self.forces.iter().any(|force| force.law.feels_path())
    }

    /// True if an action depends on the attitude, which turns what moves the body too.
    pub(super) fn feels_attitude(&self) -> bool {
        self.is_driven() || self.feels_path() || self.forces.iter().any(|force| force.law.feels_attitude())
    }

    /// Loads about the centre of mass of a free body, about the pole of a constrained one. (F1), (F11)
    pub(super) fn loads<T: Smooth>(&self, pose: &Pose<T>, motion: MotionState<T>) -> Loads<T> {
        self.body.loads_at(self.forces, pose, motion)
    }

    /// Acceleration (m/s², inertial axes) of the centre of mass or pole under a force (N, body axes).
    pub(super) fn acceleration<T: Smooth>(&self, pose: &Pose<T>, force: [T; 3]) -> [T; 3] {
        match self.body.support() {
            Support::Free => {
                let per_mass = T::from(self.body.invariants().mass.recip());
                scale(per_mass, Turn::of(pose.attitude).to_inertial(force))
            }
            Support::FixedPoint { .. } => [T::from(0.0); 3],
            Support::Prescribed { acceleration, .. } => {
                acceleration.each_ref().map(|component| component.value(&[pose.t]))
            }
        }
    }
}
