//! What turns inside a body: rotors, momentum wheels, liquids.

mod bodies;
mod budget;
mod description;
mod oracle;

mod advection;
mod ageing;
mod balance;
mod full;
mod liquids;

mod orders;
mod parts;
mod properties;
mod shapes;
mod spinning;
mod start;
mod without_momentum;
mod wobble;
