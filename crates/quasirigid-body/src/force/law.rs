//! Laws of external forces, generic in the description of their places.
//! One type serves the assembly, where a place is an element, and the body, where a place is a marker; [`Force::try_map`] takes one to the
//! other.
//! Equations (F3) to (F9), (F13) to (F15) and (F27), docs/theory/07-forces.md.

use std::ops::Range;
use std::sync::Arc;

use super::{MagneticField, SunPath, SunlightLoads, Timetable, Trajectory, Windows};
use crate::math::expression::Expression;
use crate::math::taylor::Taylor;

/// Variables of a formula. (F9)
pub const VARIABLES: usize = 14;
/// Place among the variables.
pub const PLACE: Range<usize> = 0..3;
pub(crate) const VELOCITY: Range<usize> = 3..6;
/// Time among the variables.
pub const TIME: usize = 6;
pub(crate) const ATTITUDE: Range<usize> = 10..14;

/// External force: name and law, with its place of action.
///
/// `P` describes a place: by the number of an element in an assembly, by a [`Marker`](crate::Marker) on a body.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Force<P> {
    /// Name, for messages.
    pub name: String,
    /// Law.
    pub law: ForceLaw<P>,
}

/// Laws of external forces. (F3)–(F9), (F13)–(F15), (F27)
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub enum ForceLaw<P> {
    /// Uniform gravity: the same acceleration of every mass element (m/s²), inertial axes. (F3)
    UniformGravity {
        /// Acceleration (m/s²), inertial axes.
        acceleration: [f64; 3],
    },
    /// Attraction of a distant centre, on a given path: the gravity gradient about the centre of mass of a free body, about the pole of
    /// a constrained one. (F4)
    CentralGravity {
        /// Path past the centre.
        orbit: Trajectory,
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
    /// Torque on the eddy currents of a conducting carrier that rotates in a magnetic field. (F15)
    EddyCurrent {
        /// Magnetic tensor (S·m⁴), body axes: symmetric, no negative eigenvalue.
        tensor: [[f64; 3]; 3],
        /// Time (s) in which the currents decay; zero where it is not known. [`Conductor::decay_time`](super::Conductor::decay_time)
        decay_time: f64,
        /// Magnetic field.
        field: MagneticField,
    },
    /// Pressure of sunlight, and of what the surface scatters and emits, on the body at equilibrium. (F27)
    Sunlight {
        /// Force and torque by the direction of the Sun.
        loads: Arc<SunlightLoads>,
        /// Where the Sun stands.
        sun: SunPath,
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
    /// Torque on the carrier from a table (N·m). (F14)
    TorqueTable {
        /// Table.
        table: Timetable,
        /// Axes of the components.
        axes: Axes,
    },
    /// Force at a place from a table (N). (F14)
    ForceTable {
        /// Place of action.
        at: P,
        /// Table.
        table: Timetable,
        /// Axes of the components.
        axes: Axes,
    },
    /// Law that acts in windows of time alone. (F13)
    During {
        /// Windows.
        windows: Windows,
        /// Law.
        law: Box<ForceLaw<P>>,
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

/// Relative difference of two times that is rounding.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

impl<P> ForceLaw<P> {
    /// Place of action; none for a law that acts on the whole body or is a torque.
    #[must_use]
    pub fn place(&self) -> Option<&P> {
        match self {
            Self::Drag { at, .. }
            | Self::Thrust { at, .. }
            | Self::Expression { at, .. }
            | Self::ForceTable { at, .. } => Some(at),
            Self::During { law, .. } => law.place(),
            Self::UniformGravity { .. }
            | Self::CentralGravity { .. }
            | Self::SpinDrag { .. }
            | Self::Torque { .. }
            | Self::MagneticDipole { .. }
            | Self::EddyCurrent { .. }
            | Self::Sunlight { .. }
            | Self::TorqueExpression { .. }
            | Self::TorqueTable { .. } => None,
        }
    }

    /// Formulas of a user-defined law.
    #[must_use]
    pub fn formulas(&self) -> Option<&[Expression; 3]> {
        match self {
            Self::Expression { force: formulas, .. } | Self::TorqueExpression { torque: formulas, .. } => {
                Some(formulas)
            }
            Self::During { law, .. } => law.formulas(),
            _ => None,
        }
    }

    /// Law that acts, without the windows in which it does, and those windows. (F13)
    #[must_use]
    pub fn timed(&self) -> (&Self, Option<&Windows>) {
        match self {
            Self::During { windows, law } => (law, Some(windows)),
            law => (law, None),
        }
    }

    /// True if the law depends on the time alone, and gives nothing at `t = 0` and for some time thereafter.
    #[must_use]
    pub fn sleeps(&self) -> bool {
        match self {
            Self::During { windows, law } => !windows.contains(0.0) || law.sleeps(),
            Self::TorqueTable { table, .. } | Self::ForceTable { table, .. } => {
                table.at(Taylor::<2>::variable(0.0)).iter().all(|part| part.derivatives() == [0.0; 2])
            }
            Self::Expression { force: formulas, .. } | Self::TorqueExpression { torque: formulas, .. } => {
                let mut variables = [Taylor::<8>::from(0.0); VARIABLES];
                variables[TIME] = Taylor::variable(0.0);
                let alone = |formula: &Expression| (0..VARIABLES).all(|i| i == TIME || !formula.uses(i));
                formulas
                    .iter()
                    .all(|formula| alone(formula) && formula.value(&variables).derivatives() == [0.0; 8])
            }
            _ => false,
        }
    }

    /// Path that the body is on by the law, past a centre of attraction or the Sun; none without one, or within windows.
    #[must_use]
    pub fn trajectory(&self) -> Option<&Trajectory> {
        match self {
            Self::CentralGravity { orbit } | Self::Sunlight { sun: SunPath::Orbit(orbit), .. } => Some(orbit),
            _ => None,
        }
    }

    /// Magnetic field that the law acts by; none within windows.
    #[must_use]
    pub fn magnetic_field(&self) -> Option<&MagneticField> {
        match self {
            Self::MagneticDipole { field, .. } | Self::EddyCurrent { field, .. } => Some(field),
            _ => None,
        }
    }

    /// First and last time (s) of a path that is not known over the whole of a run to this time, where the law acts.
    #[must_use]
    pub fn uncovered(&self, end: f64) -> Option<[f64; 2]> {
        let (law, windows) = self.timed();
        let known = law.trajectory()?.span()?;
        let rounding = ROUNDING * known[0].abs().max(known[1].abs());
        let before = known[0] - rounding;
        let beyond = |from: f64, to: f64| from < to && (from < before || to > known[1] + rounding);
        let acting = windows.map_or(&[[0.0, f64::INFINITY]][..], |windows| windows.list());
        acting.iter().any(|[from, to]| beyond(from.max(0.0), to.min(end))).then_some(known)
    }

    /// Law with its place mapped to another description.
    ///
    /// # Errors
    /// The error of the map.
    pub fn try_map<Q, E>(&self, map: impl FnOnce(&P) -> Result<Q, E>) -> Result<ForceLaw<Q>, E> {
        Ok(match self {
            Self::UniformGravity { acceleration } => ForceLaw::UniformGravity { acceleration: *acceleration },
            Self::CentralGravity { orbit } => ForceLaw::CentralGravity { orbit: orbit.clone() },
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
            Self::EddyCurrent { tensor, decay_time, field } => {
                ForceLaw::EddyCurrent { tensor: *tensor, decay_time: *decay_time, field: *field }
            }
            Self::Sunlight { loads, sun } => ForceLaw::Sunlight { loads: loads.clone(), sun: sun.clone() },
            Self::Expression { at, force } => ForceLaw::Expression { at: map(at)?, force: force.clone() },
            Self::TorqueExpression { torque, axes } => {
                ForceLaw::TorqueExpression { torque: torque.clone(), axes: *axes }
            }
            Self::TorqueTable { table, axes } => ForceLaw::TorqueTable { table: table.clone(), axes: *axes },
            Self::ForceTable { at, table, axes } => {
                ForceLaw::ForceTable { at: map(at)?, table: table.clone(), axes: *axes }
            }
            Self::During { windows, law } => {
                ForceLaw::During { windows: windows.clone(), law: Box::new(law.try_map(map)?) }
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
    /// Body axes at equilibrium, turned with the place where a force acts. (F22)
    Place,
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
