//! Bodies with a mass off every axis and chosen moments.

use nalgebra::{Matrix3, Rotation3, Vector3};
use quasirigid::elements::Assembly;

use crate::support::parts;
use crate::support::sprung_body;

/// Mass, place, stiffness and damping of the sprung mass, and the mass of the carrier (kg, m, N/m, N s/m).
const MASS: f64 = 0.5;
const PLACE: [f64; 3] = [0.6, 0.2, -0.3];
const STIFFNESS: f64 = 200.0;
const DAMPING: f64 = 6.0;
const CARRIER: f64 = 5.0;

/// A free body whose inertia tensor as a whole is this one (kg m²), with a mass on a spring off every axis.
pub fn with_tensor(J: Matrix3<f64>) -> Assembly {
    let rho = Vector3::from(PLACE);
    let reduced_mass = MASS * CARRIER / (MASS + CARRIER);
    let of_mass = reduced_mass * (rho.norm_squared() * Matrix3::identity() - rho * rho.transpose());
    let carrier = parts::carrier(CARRIER, [0.0; 3], (J - of_mass).into());
    let mass = parts::sprung(MASS, PLACE, [STIFFNESS; 3], [DAMPING; 3]);
    sprung_body(carrier, &[mass])
}

/// Free body with moments `2(1 + δ·(0, 0.4, 1))` about rotated axes.
pub fn nearly_equal(difference: f64, turn: [f64; 3]) -> Assembly {
    let R = *Rotation3::new(Vector3::from(turn)).matrix();
    let moments = Vector3::new(2.0, 2.0 * (1.0 + 0.4 * difference), 2.0 * (1.0 + difference));
    let J = R * Matrix3::from_diagonal(&moments) * R.transpose();
    with_tensor(0.5 * (J + J.transpose()))
}

/// Moments 2, 2.00008 and 2.0002 kg m² along the axes of the file.
pub fn near_sphere() -> Assembly {
    nearly_equal(1e-4, [0.0; 3])
}

/// The spin of the near sphere (rad/s).
pub const SPIN: [f64; 3] = [0.9, 0.5, 1.2];
