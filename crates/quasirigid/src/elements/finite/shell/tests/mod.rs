//! The tables that are printed are those of convergence.
#![allow(clippy::print_stdout)]

mod beam;
mod buckling;
mod curved;
mod element;
mod grid;
mod laminate;
mod patch;
mod plate;
mod structure;
mod vibration;
