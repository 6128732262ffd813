//! Laws of external forces, generic in the description of their places.
//! One type serves the assembly, where a place is an element, and the body, where a place is a marker; [`Force::try_map`] takes one to the
//! other.
//! Equations (F3) to (F9), docs/theory/07-forces.md.

use super::{MagneticField, Orbit};
use crate::math::expression::Expression;

/// External force: name and law, with its place of action.
///
/// `P` describes a place: by the number of an element in an assembly, by a [`Marker`](crate::model::Marker) on a body.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Force<P> {
    /// Name, for messages.
    pub name: String,
    /// Law.
    pub law: ForceLaw<P>,
}

/// Laws of external forces. (F3)–(F9)
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub enum ForceLaw<P> {
    /// Uniform gravity: the same acceleration of every mass element (m/s²), inertial axes. (F3)
    UniformGravity {
        /// Acceleration (m/s²), inertial axes.
        acceleration: [f64; 3],
    },
    /// Attraction of a distant centre, on a given orbit: the gravity gradient about the centre of mass of a free body, about the pole of
    /// a constrained one. (F4)
    CentralGravity {
        /// Orbit.
        orbit: Orbit,
    },
    /// Drag `−k Ṙ` of a place. (F5)
    Drag {
        /// Place of action.
        at: P,
        /// Coefficient `k` (N·s/m).
        coefficient: f64,
    },
    /// Drag torque `−κ ω` on the carrier. (F5)
    SpinDrag {
        /// Coefficient `κ` (N·m·s).
        coefficient: f64,
    },
    /// Torque on the carrier. (F6)
    Torque {
        /// Amplitude (N·m).
        torque: [f64; 3],
        /// Axes of the amplitude.
        axes: Axes,
        /// Variation in time.
        wave: Wave,
    },
    /// Force at a place, in body axes (a thruster) or inertial axes (a pull). (F7)
    Thrust {
        /// Place of action.
        at: P,
        /// Amplitude (N).
        force: [f64; 3],
        /// Axes of the amplitude.
        axes: Axes,
        /// Variation in time.
        wave: Wave,
    },
    /// Torque on a magnetic dipole of the carrier. (F8)
    MagneticDipole {
        /// Dipole moment (A·m²), body axes.
        moment: [f64; 3],
        /// Magnetic field.
        field: MagneticField,
    },
    /// User-defined force at a place, inertial axes (N): one expression per component in the inertial place `x y z` and velocity `vx vy
    /// vz`, the time `t`, the angular velocity `wx wy wz` (body axes) and the attitude `qw qx qy qz`, in this order. (F9)
    Expression {
        /// Place of action.
        at: P,
        /// Components.
        force: [Expression; 3],
    },
    /// User-defined torque on the carrier (N·m), in the same variables with the place and the velocity of the pole. (F9)
    TorqueExpression {
        /// Components.
        torque: [Expression; 3],
        /// Axes of the components.
        axes: Axes,
    },
}

impl<P> Force<P> {
    /// Force with its place mapped to another description.
    ///
    /// # Errors
    /// The error of the map.
    pub fn try_map<Q, E>(&self, map: impl FnOnce(&P) -> Result<Q, E>) -> Result<Force<Q>, E> {
        Ok(Force { name: self.name.clone(), law: self.law.try_map(map)? })
    }
}

impl<P> ForceLaw<P> {
    /// Place of action; none for a law that acts on the whole body or is a torque.
    #[must_use]
    pub fn place(&self) -> Option<&P> {
        match self {
            Self::Drag { at, .. } | Self::Thrust { at, .. } | Self::Expression { at, .. } => Some(at),
            Self::UniformGravity { .. }
            | Self::CentralGravity { .. }
            | Self::SpinDrag { .. }
            | Self::Torque { .. }
            | Self::MagneticDipole { .. }
            | Self::TorqueExpression { .. } => None,
        }
    }

    /// Formulas of a user-defined law.
    #[must_use]
    pub fn formulas(&self) -> Option<&[Expression; 3]> {
        match self {
            Self::Expression { force: formulas, .. } | Self::TorqueExpression { torque: formulas, .. } => {
                Some(formulas)
            }
            _ => None,
        }
    }

    /// Law with its place mapped to another description.
    ///
    /// # Errors
    /// The error of the map.
    pub fn try_map<Q, E>(&self, map: impl FnOnce(&P) -> Result<Q, E>) -> Result<ForceLaw<Q>, E> {
        Ok(match self {
            Self::UniformGravity { acceleration } => ForceLaw::UniformGravity { acceleration: *acceleration },
            Self::CentralGravity { orbit } => ForceLaw::CentralGravity { orbit: *orbit },
            Self::Drag { at, coefficient } => ForceLaw::Drag { at: map(at)?, coefficient: *coefficient },
            Self::SpinDrag { coefficient } => ForceLaw::SpinDrag { coefficient: *coefficient },
            Self::Torque { torque, axes, wave } => {
                ForceLaw::Torque { torque: *torque, axes: *axes, wave: *wave }
            }
            Self::Thrust { at, force, axes, wave } => {
                ForceLaw::Thrust { at: map(at)?, force: *force, axes: *axes, wave: *wave }
            }
            Self::MagneticDipole { moment, field } => {
                ForceLaw::MagneticDipole { moment: *moment, field: *field }
            }
            Self::Expression { at, force } => ForceLaw::Expression { at: map(at)?, force: force.clone() },
            Self::TorqueExpression { torque, axes } => {
                ForceLaw::TorqueExpression { torque: torque.clone(), axes: *axes }
            }
        })
    }
}

/// Axes of an amplitude.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Axes {
    /// Body axes.
    #[default]
    Body,
    /// Inertial axes.
    Inertial,
}

/// Variation in time: the factor `cos(Ωt + φ)`; constant when `Ω` and `φ` are zero.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wave {
    /// Angular frequency `Ω` (rad/s).
    pub frequency: f64,
    /// Phase `φ` (rad).
    pub phase: f64,
}
