//! What of the motion a law depends on.

use std::ops::Range;

use super::law::{ATTITUDE, PLACE, TIME, VARIABLES, VELOCITY};
use super::{Axes, ForceLaw};

impl<P> ForceLaw<P> {
    /// True if a formula of the law uses one of these variables. (F9)
    #[doc(hidden)]
    pub fn uses(&self, mut variables: Range<usize>) -> bool {
        self.formulas()
            .is_some_and(|formulas| variables.any(|i| formulas.iter().any(|formula| formula.uses(i))))
    }

    /// The law within its windows, however many.
    fn acting(&self) -> &Self {
        match self.timed() {
            (law, Some(_)) => law.acting(),
            (law, None) => law,
        }
    }

    /// True if the law depends on the velocity of its point of action.
    #[doc(hidden)]
    pub fn feels_velocity(&self) -> bool {
        matches!(self.acting(), Self::Drag { .. }) || self.uses(VELOCITY)
    }

    /// True if the law depends on the place or the velocity of its point of action.
    #[doc(hidden)]
    pub fn feels_path(&self) -> bool {
        self.feels_velocity() || self.uses(PLACE)
    }

    /// True if the law depends on the attitude.
    #[doc(hidden)]
    pub fn feels_attitude(&self) -> bool {
        match self.acting() {
            Self::SpinDrag { .. } => false,
            Self::Torque { axes, .. }
            | Self::Thrust { axes, .. }
            | Self::TorqueTable { axes, .. }
            | Self::ForceTable { axes, .. } => *axes == Axes::Inertial,
            Self::TorqueExpression { axes, .. } => *axes == Axes::Inertial || self.uses(ATTITUDE),
            _ => true,
        }
    }

    /// True if the force turns with the place where it acts. (F22)
    #[doc(hidden)]
    pub fn turns_with_place(&self) -> bool {
        matches!(
            self.acting(),
            Self::Thrust { axes: Axes::Place, .. } | Self::ForceTable { axes: Axes::Place, .. }
        )
    }

    /// True if the law is a torque, without a force.
    pub(crate) fn is_torque(&self) -> bool {
        matches!(
            self.acting(),
            Self::SpinDrag { .. }
                | Self::Torque { .. }
                | Self::MagneticDipole { .. }
                | Self::EddyCurrent { .. }
                | Self::TorqueExpression { .. }
                | Self::TorqueTable { .. }
        )
    }

    /// True if the law is a torque in body axes by a formula of the angular velocity alone, as that of a rate controller: no direction in
    /// space matters to it.
    #[doc(hidden)]
    pub fn turns_with_body(&self) -> bool {
        matches!(self, Self::TorqueExpression { axes: Axes::Body, .. })
            && !self.uses(0..TIME + 1)
            && !self.uses(ATTITUDE.start..VARIABLES)
    }
}
