//! Published numbers against ours.

mod chernousko_1973;
mod common_problem;
mod eddy_currents;
mod ellipsoid;
mod explorer_1;
mod igrf;
mod one_sprung_mass;
mod quillen_2019;
mod quillen_network;
mod quillen_runs;
mod spin_modes;
