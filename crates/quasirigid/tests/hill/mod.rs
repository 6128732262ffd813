//! Hill's equations of the internal coordinates along a polhode, each answer by a second road.

mod bodies;
mod oracle;

mod full;
mod limits;
mod linear;
