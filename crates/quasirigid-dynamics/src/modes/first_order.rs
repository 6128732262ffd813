//! Equations of small motions about a steady spin in first order, `ẏ = S y`.
//! Scaled to unit kinetic energy and to displacements of equal energy; a body of many coordinates is projected on its slowest vibrations
//! and the responses to the loads of the motion.
//! Equation (M2), docs/theory/15-modes.md.

use nalgebra::DMatrix;

use super::displacements::Displacements;
use super::equilibrium::RelativeEquilibrium;
use super::error::ModesError;
use crate::math::eigen::{Dense, NoConvergence};
use crate::math::sym3;
use crate::math::vec3;
use crate::model::{FlexibleBody, SpinCoefficients};

/// Equations of small motions in first order: velocities in a basis of unit kinetic energy, then displacements in units of equal energy. (M2)
pub(super) struct FirstOrder {
    /// Matrix `S`.
    pub matrix: Dense,
    /// Angular velocity and rates of each velocity of unit kinetic energy, one per column.
    pub inverse: DMatrix<f64>,
    /// Basis of the displacements.
    pub basis: Displacements,
}

impl FirstOrder {
    /// Equations with all displacements of a body of up to `whole` elastic coordinates.
    ///
    /// # Errors
    /// [`ModesError`] if the mass matrix is not positive, or the slowest vibrations of a larger body are not found.
    pub fn of(
        body: &FlexibleBody,
        equilibrium: &RelativeEquilibrium,
        coefficients: &SpinCoefficients,
        whole: usize,
    ) -> Result<Self, ModesError> {
        let basis = Displacements::of(body, coefficients, whole)?;
        let (elastic, moving) = (basis.units.len(), 3 + basis.units.len() + body.cyclic().len());
        let size = moving + elastic;
        let failed = || NoConvergence { size };
        let L = basis.of_velocities(mass(coefficients)).cholesky().ok_or(ModesError::BeyondRange)?.unpack();
        let (velocity, stiffness) =
            forces(body, equilibrium.omega, equilibrium.angular_momentum, coefficients);
        let (velocity, stiffness) = (basis.of_velocities(velocity), basis.of_forces(stiffness));
        let solved = |right: DMatrix<f64>| L.solve_lower_triangular(&right).ok_or_else(failed);
        let velocity = solved(solved(velocity)?.transpose())?.transpose();
        let mut stiffness = solved(stiffness)?;
        for (mut column, unit) in stiffness.column_iter_mut().zip(&basis.units) {
            column /= *unit;
        }
        let inverse =
            L.transpose().solve_upper_triangular(&DMatrix::identity(moving, moving)).ok_or_else(failed)?;
        let mut matrix = Dense::zero(size);
        for row in 0..moving {
            (0..moving).for_each(|column| matrix.add(row, column, -velocity[(row, column)]));
            (0..elastic).for_each(|column| matrix.add(row, moving + column, -stiffness[(row, column)]));
        }
        for (row, unit) in basis.units.iter().enumerate() {
            (0..moving)
                .for_each(|column| matrix.add(moving + row, column, unit * inverse[(3 + row, column)]));
        }
        Ok(Self { matrix, inverse, basis })
    }
}

/// Mass of the angular velocity and the rates, `[[J, h], [hᵀ, A]]`.
pub(super) fn mass(coefficients: &SpinCoefficients) -> DMatrix<f64> {
    let SpinCoefficients { inertia, mass: A, h, .. } = coefficients;
    let J = sym3::rows(*inertia);
    DMatrix::from_fn(3 + h.len(), 3 + h.len(), |row, column| {
        match (row.checked_sub(3), column.checked_sub(3)) {
            (None, None) => J[row][column],
            (None, Some(k)) => h[k][row],
            (Some(j), None) => h[j][column],
            (Some(j), Some(k)) => A.at(j, k),
        }
    })
}

/// Forces per angular velocity and rate, and per displacement, on the left-hand side, at a steady angular velocity (rad/s) and angular
/// momentum (N·m·s). (M2)
pub(super) fn forces(
    body: &FlexibleBody,
    omega: [f64; 3],
    angular_momentum: [f64; 3],
    coefficients: &SpinCoefficients,
) -> (DMatrix<f64>, DMatrix<f64>) {
    let SpinCoefficients { inertia, h, slopes, gyroscopic, centrifugal, .. } = coefficients;
    let (n, elastic) = (h.len(), body.elastic());
    let turned = |vector: [f64; 3]| vec3::cross(omega, vector);
    let mut velocity = DMatrix::zeros(3 + n, 3 + n);
    let mut stiffness = DMatrix::zeros(3 + n, elastic);
    for axis in 0..3 {
        let mut unit = [0.0; 3];
        unit[axis] = 1.0;
        let own = turned(sym3::times(*inertia, unit));
        let held = vec3::cross(angular_momentum, unit);
        (0..3).for_each(|row| velocity[(row, axis)] = own[row] - held[row]);
    }
    for j in 0..n {
        let (coriolis, displaced) = (turned(h[j]), turned(slopes[j]));
        for axis in 0..3 {
            velocity[(axis, 3 + j)] = coriolis[axis] + slopes[j][axis];
            velocity[(3 + j, axis)] = -slopes[j][axis];
            if j < elastic {
                stiffness[(axis, j)] = displaced[axis];
            }
        }
        (0..n).for_each(|k| velocity[(3 + j, 3 + k)] = gyroscopic.at(j, k));
        (0..elastic.min(if j < elastic { elastic } else { 0 }))
            .for_each(|k| stiffness[(3 + j, k)] = -centrifugal.at(j, k));
    }
    body.damping().iter().for_each(|(j, k, B)| velocity[(3 + j, 3 + k)] += B);
    for (j, k, C) in body.stiffness().iter().filter(|(j, k, _)| *j < elastic && *k < elastic) {
        stiffness[(3 + j, k)] += C;
    }
    (velocity, stiffness)
}
