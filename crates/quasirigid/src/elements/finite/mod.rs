//! Finite elements: the matrices of a piece of elastic matter between nodes.

pub(in crate::elements) mod shell;
