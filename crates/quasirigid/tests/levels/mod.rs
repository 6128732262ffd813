//! Steady spins and secular evolution along the levels of the slow energy, for moments that are nearly equal: against integrations, against
//! averages along rigid polhodes, and laws.

mod bodies;
mod criteria;
mod follow;
mod polhodes;
mod steady;
