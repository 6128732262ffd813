use crate::Assembly;
use crate::contribution::Internal;
use crate::element::Element;
use crate::error::{ElementError, ElementId, Field, at};
use crate::math::expression::Expression;
use crate::model::{DrivenWheel, Wheels};
use crate::number;
use crate::visual::{Outline, disc};

/// Momentum wheel: a motor sets its speed relative to the carrier. (C4)
///
/// The mass of the wheel and, locked, its inertia belong to the carrier.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Wheel {
    /// Unique name.
    pub name: String,
    /// Direction of the axis, any length but zero; the wheel rotates about it by the right-hand rule.
    pub axis: [f64; 3],
    /// Speed of the wheel.
    pub speed: WheelSpeed,
}

/// Speed of a momentum wheel relative to the carrier.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub enum WheelSpeed {
    /// Constant at all times.
    Constant {
        /// Moment of inertia about the wheel's axis times speed (N·m·s).
        angular_momentum: f64,
    },
    /// Given by a formula.
    Prescribed {
        /// Moment of inertia about the wheel's axis (kg·m²).
        inertia: f64,
        /// Speed (rad/s): an expression of the single variable `t` (s).
        speed: Expression,
    },
}

impl Wheel {
    /// Internal motion of the wheel: a constant angular momentum at any spin, or a speed over time.
    fn turning(&self, place: ElementId) -> Result<Wheels, ElementError> {
        let axis = number::unit(self.axis).map_err(at(place, Field::AXIS))?;
        match &self.speed {
            WheelSpeed::Constant { angular_momentum } => {
                number::finite(&[*angular_momentum]).map_err(at(place, Field::MOMENTUM))?;
                Ok(Wheels { constant: (*angular_momentum * axis).into(), ..Wheels::default() })
            }
            WheelSpeed::Prescribed { inertia, speed } => {
                number::positive(*inertia).map_err(at(place, Field::INERTIA))?;
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
    /// Disc about the axis of the wheel, at the centre of the carrier: the model gives it no place.
    fn outline(&self, _: ElementId, body: &Assembly) -> Option<Outline> {
        disc(body.carrier.as_ref()?, self.axis)
    }

    fn inner(&self, id: ElementId, _: usize) -> Result<Option<Internal>, ElementError> {
        let wheels = self.turning(id)?;
        Ok(Some(Internal { wheels, ..Internal::default() }))
    }
}
