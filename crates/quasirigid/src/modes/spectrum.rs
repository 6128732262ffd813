use nalgebra::{Complex, DMatrix};

use super::equilibrium::RelativeEquilibrium;
use crate::math::eigen::{Dense, NoConvergence, eigenvectors};
use crate::math::sym;
use crate::model::{FlexibleBody, SpinCoefficients};

/// A small motion `e^{λt}`: angular velocity, rates and displacements of all coordinates.
#[derive(Clone, Debug)]
pub(super) struct Eigenmotion {
    pub lambda: Complex<f64>,
    pub delta: [Complex<f64>; 3],
    pub rate: Vec<Complex<f64>>,
    pub q: Vec<Complex<f64>>,
}

/// Eigenvalues of the linear equations in first order with their motions, those with `Im λ ≥ 0`. (M2)
///
/// # Errors
/// [`NoConvergence`] if the eigenvalue solver fails, or the mass matrix is not positive.
pub(super) fn spectrum(
    body: &FlexibleBody,
    equilibrium: &RelativeEquilibrium,
    coefficients: &SpinCoefficients,
) -> Result<Vec<Eigenmotion>, NoConvergence> {
    let n = body.coordinates().len();
    let elastic = body.elastic();
    let (moving, size) = (3 + n, 3 + n + elastic);
    let failed = || NoConvergence { size };
    let L = mass(body, coefficients).cholesky().ok_or_else(failed)?.unpack();
    let back = L.transpose();
    let (velocity, stiffness) = forces(body, equilibrium, coefficients);
    let units: Vec<f64> = body.stiffness().diagonal()[..elastic].iter().map(|C| C.sqrt()).collect();
    let solved = |right: DMatrix<f64>| L.solve_lower_triangular(&right).ok_or_else(failed);
    let velocity = solved(solved(velocity)?.transpose())?.transpose();
    let mut stiffness = solved(stiffness)?;
    for (mut column, unit) in stiffness.column_iter_mut().zip(&units) {
        column /= *unit;
    }
    let inverse = back.solve_upper_triangular(&DMatrix::identity(moving, moving)).ok_or_else(failed)?;
    let mut system = Dense::zero(size);
    for row in 0..moving {
        (0..moving).for_each(|column| system.add(row, column, -velocity[(row, column)]));
        (0..elastic).for_each(|column| system.add(row, moving + column, -stiffness[(row, column)]));
    }
    for (row, unit) in units.iter().enumerate() {
        (0..moving).for_each(|column| system.add(moving + row, column, unit * inverse[(3 + row, column)]));
    }
    let (values, vectors) = eigenvectors(&system)?;
    let motion = |(value, vector): (&[f64; 2], &Vec<[f64; 2]>)| {
        let entries: Vec<Complex<f64>> = vector.iter().map(|[re, im]| Complex::new(*re, *im)).collect();
        let velocities: Vec<Complex<f64>> = (0..moving)
            .map(|row| (0..moving).map(|column| entries[column] * inverse[(row, column)]).sum())
            .collect();
        let lambda = Complex::new(value[0], value[1]);
        let mut q: Vec<Complex<f64>> =
            entries[moving..].iter().zip(&units).map(|(entry, unit)| entry / *unit).collect();
        let loose = velocities[3 + elastic..].iter();
        q.extend(loose.map(|rate| if lambda.norm() > 0.0 { rate / lambda } else { *rate }));
        let delta = [velocities[0], velocities[1], velocities[2]];
        Eigenmotion { lambda, delta, rate: velocities[3..].to_vec(), q }
    };
    Ok(values.iter().zip(&vectors).filter(|(value, _)| value[1] >= 0.0).map(motion).collect())
}

/// Mass of the angular velocity and the rates, `[[J, h], [hᵀ, A]]`.
fn mass(body: &FlexibleBody, coefficients: &SpinCoefficients) -> DMatrix<f64> {
    let SpinCoefficients { inertia, h, .. } = coefficients;
    let (J, A) = (sym::rows(*inertia), body.mass_matrix());
    DMatrix::from_fn(3 + h.len(), 3 + h.len(), |row, column| {
        match (row.checked_sub(3), column.checked_sub(3)) {
            (None, None) => J[row][column],
            (None, Some(k)) => h[k][row],
            (Some(j), None) => h[j][column],
            (Some(j), Some(k)) => A.at(j, k),
        }
    })
}

/// Forces per angular velocity and rate, and per displacement, on the left-hand side. (M2)
fn forces(
    body: &FlexibleBody,
    equilibrium: &RelativeEquilibrium,
    coefficients: &SpinCoefficients,
) -> (DMatrix<f64>, DMatrix<f64>) {
    let SpinCoefficients { inertia, h, slopes, gyroscopic, centrifugal } = coefficients;
    let (n, elastic) = (h.len(), body.elastic());
    let omega = equilibrium.omega;
    let turned = |vector: [f64; 3]| sym::cross(omega, vector);
    let mut velocity = DMatrix::zeros(3 + n, 3 + n);
    let mut stiffness = DMatrix::zeros(3 + n, elastic);
    for axis in 0..3 {
        let mut unit = [0.0; 3];
        unit[axis] = 1.0;
        let own = turned(sym::times(*inertia, unit));
        let held = sym::cross(equilibrium.momentum, unit);
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
