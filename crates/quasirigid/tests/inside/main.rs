//! What turns inside a body: rotors, momentum wheels, liquids.
#![allow(non_snake_case, clippy::unwrap_used, clippy::print_stdout)]

mod bodies;
mod oracle;

mod ageing;
mod full;
mod liquids;

mod orders;
mod shapes;
mod start;
mod wobble;
