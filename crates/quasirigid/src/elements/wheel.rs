use super::coefficient;
use super::error::{ElementError, ElementKind, Field, at};
use crate::math::expression::Expression;
use crate::model::{DrivenWheel, Wheels};

/// A momentum wheel: a motor gives it a speed relative to the carrier. (C4)
///
/// Its mass and, locked, its inertia belong to the carrier.
#[derive(Clone, Debug, PartialEq)]
pub struct Wheel {
    /// Unique name.
    pub name: String,
    /// Direction of the axis, any length but zero; the wheel turns about it by the right-hand rule.
    pub axis: [f64; 3],
    /// How fast it turns.
    pub speed: WheelSpeed,
}

/// How fast a momentum wheel turns relative to the carrier.
#[derive(Clone, Debug, PartialEq)]
pub enum WheelSpeed {
    /// The same at all times.
    Constant {
        /// Moment of inertia about its axis times speed (N·m·s).
        momentum: f64,
    },
    /// As a formula has it.
    Prescribed {
        /// Moment of inertia about its axis (kg·m²).
        inertia: f64,
        /// Speed (rad/s): an expression of the single variable `t` (s).
        speed: Expression,
    },
}

impl Wheel {
    pub(super) fn check(&self, index: usize) -> Result<(), ElementError> {
        self.added(index, &mut Wheels::default())
    }

    /// Adds the wheel to those of a body.
    pub(super) fn added(&self, index: usize, wheels: &mut Wheels) -> Result<(), ElementError> {
        let place = ElementKind::Wheel.at(index);
        let axis = coefficient::unit(self.axis).map_err(at(place, Field::Axis))?;
        match &self.speed {
            WheelSpeed::Constant { momentum } => {
                coefficient::finite(&[*momentum]).map_err(at(place, Field::Momentum))?;
                let sum = &mut wheels.constant;
                sum.iter_mut().zip(axis.iter()).for_each(|(sum, axis)| *sum += momentum * axis);
            }
            WheelSpeed::Prescribed { inertia, speed } => {
                coefficient::positive(*inertia).map_err(at(place, Field::Inertia))?;
                let inertia = (*inertia * axis).into();
                wheels.driven.push(DrivenWheel { inertia, speed: speed.clone() });
            }
        }
        Ok(())
    }
}
