//! Solid elements against closed forms and another program.

mod block;
mod calculix;
mod cell;
mod convergence;
mod patch;
