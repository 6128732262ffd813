use super::coefficient;
use super::element::{Element, Role};
use super::error::{ElementError, ElementId, Field, at};
use super::internal::Internal;
use crate::math::expression::Expression;
use crate::model::{DrivenWheel, Wheels};

/// A momentum wheel: a motor gives it a speed relative to the carrier. (C4)
///
/// Its mass and, locked, its inertia belong to the carrier.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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
    /// The wheel as a part of the motion inside the carrier: an angular momentum that it has at any spin, or a speed over time.
    fn turning(&self, place: ElementId) -> Result<Wheels, ElementError> {
        let axis = coefficient::unit(self.axis).map_err(at(place, Field::AXIS))?;
        match &self.speed {
            WheelSpeed::Constant { momentum } => {
                coefficient::finite(&[*momentum]).map_err(at(place, Field::MOMENTUM))?;
                Ok(Wheels { constant: (*momentum * axis).into(), ..Wheels::default() })
            }
            WheelSpeed::Prescribed { inertia, speed } => {
                coefficient::positive(*inertia).map_err(at(place, Field::INERTIA))?;
                let inertia = (*inertia * axis).into();
                Ok(Wheels {
                    driven: vec![DrivenWheel { inertia, speed: speed.clone() }],
                    ..Wheels::default()
                })
            }
        }
    }
}

impl Element for Wheel {
    fn name(&self) -> &str {
        &self.name
    }

    fn role(&self) -> Role {
        Role::Inside(Field::AXIS)
    }

    fn inner(&self, id: ElementId, _: usize) -> Result<Option<Internal>, ElementError> {
        let wheels = self.turning(id)?;
        Ok(Some(Internal { wheels, ..Internal::default() }))
    }
}
