//! Laws that every body keeps, whatever its numbers.

mod dissipation;
mod exports;
pub mod model;
mod momentum;
mod size;
mod sketch;
pub mod transform;

/// Angular velocities at which laws are tried, of about a unit size.
const DIRECTIONS: [[f64; 3]; 4] = [[0.36, 0.48, 0.8], [-0.6, 0.64, 0.48], [0.0, 0.6, -0.8], [1.0, 0.0, 0.0]];
