//! Validation errors: which element, which key, what is wrong.

mod advice;
mod field;
mod problem;

use thiserror::Error;

pub(super) use super::{ElementId, ElementKind};
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

/// Makes an [`ElementError`] of a problem with a value of an element.
pub(super) fn at(element: ElementId, field: Field) -> impl Fn(Problem) -> ElementError {
    move |problem| ElementError { element, field, problem }
}
