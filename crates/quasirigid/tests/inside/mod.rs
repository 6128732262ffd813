//! Internal rotors, momentum wheels and liquids.

pub mod bodies;
mod budget;
mod description;
mod oracle;

mod advection;
mod balance;
mod energy_form;
mod full;
mod liquids;
mod secular;

mod orders;
mod parts;
mod properties;
mod shapes;
mod spinning;
mod start;
mod without_angular_momentum;
mod wobble;
