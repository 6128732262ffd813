//! Problems with known answers, each with its source.

mod axial_mass;
mod common_problem;
mod explorer1;
mod hub_of_points;
mod quartic_quintic;
mod ring_of_points;

pub use axial_mass::AxialMass;
pub use common_problem::CommonProblem;
pub use explorer1::Explorer1;
pub use hub_of_points::hub_of_points;
pub use quartic_quintic::QuarticQuintic;
pub use ring_of_points::ring_of_points;
