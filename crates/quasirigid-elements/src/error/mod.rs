//! Validation errors: element, key and problem.

mod advice;
mod field;
mod problem;

use thiserror::Error;

pub(super) use super::{ElementId, ElementKind};
pub use field::Field;
pub use problem::Problem;

/// Error of an element that no body can have: the element, the value and the problem with it.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{element}: {field}: {problem}")]
pub struct ElementError {
    /// The element.
    pub element: ElementId,
    /// The value.
    pub field: Field,
    /// The problem.
    pub problem: Problem,
}

/// Makes an [`ElementError`] of a problem with a value of an element.
pub(super) fn at(element: ElementId, field: Field) -> impl Fn(Problem) -> ElementError {
    move |problem| ElementError { element, field, problem }
}
