//! What no element can be: where it is, which value is wrong, and what is wrong with it.

mod advice;
mod field;
mod problem;

use thiserror::Error;

pub use field::Field;
pub use problem::Problem;

/// An element that no body can have: which it is, which of its values is wrong, and what is wrong with it.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{element}: {field}: {problem}")]
pub struct ElementError {
    /// The element.
    pub element: ElementId,
    /// The value.
    pub field: Field,
    /// What is wrong.
    pub problem: Problem,
}

/// An element of an [`Assembly`](super::Assembly): its kind, and its index in the list of that kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ElementId {
    /// Its kind.
    pub kind: ElementKind,
    /// Its index; 0 where a body has one of the kind at most.
    pub index: usize,
}

/// Defines the kinds of elements, each with the words for one of them.
macro_rules! kinds {
    ($($(#[$doc:meta])* $kind:ident: $words:literal,)+) => {
        /// A kind of element.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum ElementKind {
            $($(#[$doc])* $kind,)+
        }

        impl ElementKind {
            /// What one of the kind is called.
            #[must_use]
            pub fn words(self) -> &'static str {
                match self {
                    $(Self::$kind => $words,)+
                }
            }
        }
    };
}

kinds! {
    /// The carrier.
    Carrier: "carrier",
    /// A material point.
    Point: "point",
    /// A spring.
    Spring: "spring",
    /// A hinged appendage.
    Hinged: "appendage",
    /// An ellipsoid.
    Ellipsoid: "ellipsoid",
    /// A solid inside a closed surface.
    Surface: "surface",
    /// A part of finite elements.
    Part: "part",
    /// A connection.
    Connection: "connection",
    /// A rotor.
    Rotor: "rotor",
    /// A momentum wheel.
    Wheel: "wheel",
    /// A cavity full of liquid.
    Cavity: "cavity",
    /// The support.
    Support: "support",
    /// An external force.
    Force: "force",
}

impl ElementKind {
    /// The element of the kind with an index.
    #[must_use]
    pub const fn at(self, index: usize) -> ElementId {
        ElementId { kind: self, index }
    }

    /// Whether a body has one of the kind at most.
    #[must_use]
    pub fn is_single(self) -> bool {
        matches!(self, Self::Carrier | Self::Support)
    }
}

impl ElementId {
    /// The carrier.
    pub const CARRIER: Self = ElementKind::Carrier.at(0);
    /// The support.
    pub const SUPPORT: Self = ElementKind::Support.at(0);
}

impl std::fmt::Display for ElementId {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.kind.is_single() {
            true => write!(f, "{}", self.kind.words()),
            false => write!(f, "{} {}", self.kind.words(), self.index + 1),
        }
    }
}

/// Makes an [`ElementError`] of a problem with a value of an element.
pub(super) fn at(element: ElementId, field: Field) -> impl Fn(Problem) -> ElementError {
    move |problem| ElementError { element, field, problem }
}
