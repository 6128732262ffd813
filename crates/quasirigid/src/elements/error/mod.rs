//! What no element can be: where it is, which value is wrong, and what is wrong with it.

mod field;
mod problem;

use thiserror::Error;

pub use field::Field;
pub use problem::Problem;

/// An element that no body can have: where it is, which of its values is wrong, and what is wrong with it.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{place}: {field}: {problem}")]
pub struct ElementError {
    /// The element.
    pub place: Place,
    /// The value.
    pub field: Field,
    /// What is wrong.
    pub problem: Problem,
}

/// An element of an [`Assembly`](super::Assembly), by its index in the list of its kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// The carrier.
    Carrier,
    /// A material point.
    Point(usize),
    /// A spring.
    Spring(usize),
    /// A hinged appendage.
    Hinged(usize),
    /// An ellipsoid.
    Ellipsoid(usize),
    /// A solid inside a closed surface.
    Surface(usize),
    /// A part of finite elements.
    Part(usize),
    /// A connection.
    Connection(usize),
    /// A rotor.
    Rotor(usize),
    /// A momentum wheel.
    Wheel(usize),
    /// A cavity full of liquid.
    Cavity(usize),
    /// The support.
    Support,
    /// An external force.
    Force(usize),
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Carrier => write!(f, "carrier"),
            Self::Point(index) => write!(f, "point {}", index + 1),
            Self::Spring(index) => write!(f, "spring {}", index + 1),
            Self::Hinged(index) => write!(f, "hinged appendage {}", index + 1),
            Self::Ellipsoid(index) => write!(f, "ellipsoid {}", index + 1),
            Self::Surface(index) => write!(f, "surface {}", index + 1),
            Self::Part(index) => write!(f, "part {}", index + 1),
            Self::Connection(index) => write!(f, "connection {}", index + 1),
            Self::Rotor(index) => write!(f, "rotor {}", index + 1),
            Self::Wheel(index) => write!(f, "wheel {}", index + 1),
            Self::Cavity(index) => write!(f, "cavity {}", index + 1),
            Self::Support => write!(f, "support"),
            Self::Force(index) => write!(f, "force {}", index + 1),
        }
    }
}

/// Makes an [`ElementError`] of a problem with a value of an element.
pub(super) fn at(place: Place, field: Field) -> impl Fn(Problem) -> ElementError {
    move |problem| ElementError { place, field, problem }
}
