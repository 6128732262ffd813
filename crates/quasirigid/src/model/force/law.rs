use super::{MagneticField, Orbit};
use crate::math::expression::Expression;

/// An external force: what it is called, and its law, with the places it acts at.
///
/// `P` is how a place is given: by the element's number in an assembly, by a [`Marker`](crate::model::Marker) on a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Force<P> {
    /// Name, for messages.
    pub name: String,
    /// What it does.
    pub law: Law<P>,
}

/// Laws of external forces. (F1)–(F9)
#[derive(Clone, Debug, PartialEq)]
pub enum Law<P> {
    /// The same acceleration of every mass element (m/s²), inertial axes. (F3)
    UniformGravity {
        /// Acceleration (m/s²), inertial axes.
        acceleration: [f64; 3],
    },
    /// Attraction of a distant centre, on a given orbit: the gravity gradient about the centre of mass of a free body,
    /// about the pole of a held one. (F4)
    CentralGravity {
        /// The orbit.
        orbit: Orbit,
    },
    /// Drag `−k Ṙ` of a place. (F5)
    Drag {
        /// Where it acts.
        at: P,
        /// Coefficient `k` (N·s/m).
        coefficient: f64,
    },
    /// Drag torque `−κ ω` on the carrier. (F5)
    SpinDrag {
        /// Coefficient `κ` (N·m·s).
        coefficient: f64,
    },
    /// A torque on the carrier. (F6)
    Torque {
        /// Amplitude (N·m).
        torque: [f64; 3],
        /// Axes of the amplitude.
        axes: Axes,
        /// How it varies.
        wave: Wave,
    },
    /// A force at a place, in body axes (a thruster) or inertial axes (a pull). (F7)
    Thrust {
        /// Where it acts.
        at: P,
        /// Amplitude (N).
        force: [f64; 3],
        /// Axes of the amplitude.
        axes: Axes,
        /// How it varies.
        wave: Wave,
    },
    /// Torque on a magnetic dipole of the carrier. (F8)
    MagneticDipole {
        /// Dipole moment (A·m²), body axes.
        moment: [f64; 3],
        /// The field it is in.
        field: MagneticField,
    },
    /// A force of the user's own at a place, inertial axes (N): one expression per component in the inertial place
    /// `x y z`, velocity `vx vy vz` and time `t`, in this order. (F9)
    Expression {
        /// Where it acts.
        at: P,
        /// Components.
        force: [Expression; 3],
    },
}

/// Axes of an amplitude.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Axes {
    /// The body's.
    #[default]
    Body,
    /// Inertial.
    Inertial,
}

/// Variation in time: the factor `cos(Ωt + φ)`; constant when `Ω` and `φ` are zero.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wave {
    /// Angular frequency `Ω` (rad/s).
    pub frequency: f64,
    /// Phase `φ` (rad).
    pub phase: f64,
}
