use nalgebra::{DMatrix, Matrix3, Vector3};

use super::lumped_masses::MassProperties;
use crate::finite::LumpedMass;
use crate::model::moment;

/// Number of the loads of an acceleration that is linear in the place: `e_a` for each axis, then `ρ_b e_a`, `b` outermost. (K4)
pub(super) const LOADS: usize = 12;

/// Axes `b` and `a` of the loads `ρ_b e_a + ρ_a e_b`, which stretch.
const STRETCHING: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (1, 2), (2, 0), (0, 1)];

/// An acceleration that is linear in the place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Acceleration {
    /// Acceleration at the reference point.
    pub uniform: Vector3<f64>,
    pub gradient: Matrix3<f64>,
}

impl Acceleration {
    /// Acceleration of a load.
    pub fn of_load(load: usize) -> Self {
        let along = Vector3::ith(load % 3, 1.0);
        if load < 3 {
            return Self { uniform: along, gradient: Matrix3::zeros() };
        }
        Self { uniform: Vector3::zeros(), gradient: along * Vector3::ith(load / 3 - 1, 1.0).transpose() }
    }

    /// Acceleration at `s` from the reference point, where a field that is one everywhere has the value `one`.
    pub fn at(&self, s: Vector3<f64>, one: f64) -> Vector3<f64> {
        one * self.uniform + self.gradient * s
    }

    /// Force (N) on a lumped mass, with the place from a reference point.
    pub fn force_on(&self, lumped_mass: &LumpedMass, reference: Vector3<f64>) -> Vector3<f64> {
        lumped_mass.mass * self.at(lumped_mass.place_from(reference), lumped_mass.one())
    }
}

/// Number of the load `ρ_b e_a`.
fn load(b: usize, a: usize) -> usize {
    3 + 3 * b + a
}

/// Keeps the six straining loads (`B` symmetric). Uniform and skew loads are rigid-body inertia, which a free structure balances.
pub(super) fn stretching(forces: &DMatrix<f64>) -> DMatrix<f64> {
    DMatrix::from_rows(&STRETCHING.map(|(b, a)| 0.5 * (forces.row(load(b, a)) + forces.row(load(a, b)))))
}

/// Straining accelerations with the inertia of the rotation that they cause, about the centre of mass. (K7)
pub(super) fn balanced(whole: &MassProperties) -> Vec<Acceleration> {
    let acceleration = |(b, a): (usize, usize)| {
        let half: Matrix3<f64> = 0.5 * Vector3::ith(a, 1.0) * Vector3::ith(b, 1.0).transpose();
        let stretch = half + half.transpose();
        let moment = Vector3::from(moment::cross(&(whole.second * stretch)));
        Acceleration {
            uniform: Vector3::zeros(),
            gradient: stretch - whole.angular_acceleration(moment).cross_matrix(),
        }
    };
    STRETCHING.map(acceleration).to_vec()
}

/// Moments `∫ u_a dm` and `∫ s_b u_a dm` of a field, given the work of each load on it; of a floating structure the straining loads
/// suffice, since its linear and angular momentum are zero.
pub(super) fn moments(works: &[f64]) -> (Vector3<f64>, Matrix3<f64>) {
    if works.len() == LOADS {
        return (Vector3::from_row_slice(&works[..3]), Matrix3::from_row_slice(&works[3..]));
    }
    let mut moment = Matrix3::zeros();
    for ((b, a), work) in STRETCHING.into_iter().zip(works) {
        moment[(b, a)] = *work;
        moment[(a, b)] = *work;
    }
    (Vector3::zeros(), moment)
}
