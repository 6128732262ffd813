//! Hill's equations of the internal coordinates along a polhode, each result by a second method.

mod bodies;
mod oracle;

mod full;
mod limits;
mod linear;
