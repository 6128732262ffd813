//! Linear eigenproblem of small motions about a steady spin, in first order.
//! Scaled to unit kinetic energy and to displacements of equal energy; a body of many coordinates is projected on its slowest vibrations
//! and the responses to the loads of the motion.
//! Equation (M2), docs/theory/15-modes.md.

use nalgebra::{Complex, DMatrix};

use super::equilibrium::RelativeEquilibrium;
use super::error::ModesError;
use crate::math::eigen::{Dense, NoConvergence, eigenvectors};
use crate::math::krylov::Pencil;
use crate::math::span::Span;
use crate::math::sym3;
use crate::math::vec3;
use crate::model::{FlexibleBody, SpinCoefficients};

/// Small motion `e^{λt}`: angular velocity, rates and displacements of all coordinates.
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
/// [`ModesError`] if the eigenvalue solver fails, or the mass matrix is not positive.
pub(super) fn spectrum(
    body: &FlexibleBody,
    equilibrium: &RelativeEquilibrium,
    coefficients: &SpinCoefficients,
) -> Result<Vec<Eigenmotion>, ModesError> {
    within(body, equilibrium, coefficients, WHOLE)
}

/// Spectrum with all displacements of a body of up to `whole` elastic coordinates.
fn within(
    body: &FlexibleBody,
    equilibrium: &RelativeEquilibrium,
    coefficients: &SpinCoefficients,
    whole: usize,
) -> Result<Vec<Eigenmotion>, ModesError> {
    let few = Few::of(body, coefficients, whole)?;
    let (elastic, moving) = (few.elastic.ncols(), 3 + few.elastic.ncols() + body.cyclic().len());
    let size = moving + elastic;
    let failed = || NoConvergence { size };
    let all = few.all(body.cyclic().len());
    let L = (all.transpose() * mass(coefficients) * &all).cholesky().ok_or(ModesError::BeyondRange)?.unpack();
    let back = L.transpose();
    let (velocity, stiffness) = forces(body, equilibrium.omega, equilibrium.angular_momentum, coefficients);
    let velocity = all.transpose() * velocity * &all;
    let stiffness = all.transpose() * stiffness * &few.elastic;
    let units = &few.units;
    let solved = |right: DMatrix<f64>| L.solve_lower_triangular(&right).ok_or_else(failed);
    let velocity = solved(solved(velocity)?.transpose())?.transpose();
    let mut stiffness = solved(stiffness)?;
    for (mut column, unit) in stiffness.column_iter_mut().zip(units) {
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
        let displaced: Vec<Complex<f64>> =
            entries[moving..].iter().zip(units).map(|(entry, unit)| entry / *unit).collect();
        let mut q = few.lifted(&displaced);
        let mut rate = few.lifted(&velocities[3..3 + elastic]);
        let loose = velocities[3 + elastic..].iter();
        q.extend(loose.clone().map(|rate| if lambda.norm() > 0.0 { rate / lambda } else { *rate }));
        rate.extend(loose);
        Eigenmotion { lambda, delta: [velocities[0], velocities[1], velocities[2]], rate, q }
    };
    Ok(values.iter().zip(&vectors).filter(|(value, _)| value[1] >= 0.0).map(motion).collect())
}

/// Basis of elastic displacements: all, or for a body of many coordinates the slowest vibrations and the responses to the loads of a
/// motion about the steady spin.
struct Few {
    /// Basis displacements, one per column.
    elastic: DMatrix<f64>,
    /// Square root of the stiffness of each basis displacement.
    units: Vec<f64>,
}

/// Number of elastic coordinates up to which all displacements are taken, and number of vibrations for a larger body.
const WHOLE: usize = 150;
const SLOW: usize = 40;

impl Few {
    fn of(body: &FlexibleBody, coefficients: &SpinCoefficients, whole: usize) -> Result<Self, NoConvergence> {
        let elastic = body.elastic();
        if elastic <= whole {
            let units = body.stiffness().diagonal()[..elastic].iter().map(|C| C.sqrt()).collect();
            return Ok(Self { elastic: DMatrix::identity(elastic, elastic), units });
        }
        let padded = |x: &[f64]| {
            let mut all = x.to_vec();
            all.resize(body.coordinates().len(), 0.0);
            all
        };
        let cut = |mut x: Vec<f64>| {
            x.truncate(elastic);
            x
        };
        let stiffness = |x: &[f64]| cut(body.stiffness().times(&padded(x)));
        let mass = |x: &[f64]| cut(body.recoiling_mass_times(&padded(x)));
        let solve = |x: &mut [f64]| {
            let mut all = padded(x);
            body.solve_stiffness(&mut all, 1);
            x.copy_from_slice(&all[..elastic]);
        };
        let softened = |mut x: Vec<f64>| {
            solve(&mut x);
            x
        };
        let load = |list: &[[f64; 3]], axis: usize| list[..elastic].iter().map(|load| load[axis]).collect();
        let loads = (0..3).flat_map(|axis| [load(&coefficients.h, axis), load(&coefficients.slopes, axis)]);
        let first: Vec<Vec<f64>> = loads.map(softened).collect();
        let damped = |x: &Vec<f64>| softened(cut(body.damping().times(&padded(x))));
        let centrifugal = |x: &Vec<f64>| softened(cut(coefficients.centrifugal.times(&padded(x))));
        let gyroscopic = |x: &Vec<f64>| softened(cut(coefficients.gyroscopic.times(&padded(x))));
        let after = |x: &Vec<f64>| [softened(mass(x)), damped(x), centrifugal(x), gyroscopic(x)];
        let second: Vec<Vec<f64>> = first.iter().flat_map(after).collect();
        let slow =
            Pencil { size: elastic, stiffness: &stiffness, solve: &solve, mass: &mass }.largest(SLOW)?;
        let span = Span::orthonormal([first, second, slow].concat(), stiffness).into_vectors();
        let matrix = DMatrix::from_fn(elastic, span.len(), |row, column| span[column][row]);
        Ok(Self { units: vec![1.0; span.len()], elastic: matrix })
    }

    /// Basis of angular velocity, elastic displacements and cyclic coordinates, one per column.
    fn all(&self, cyclic: usize) -> DMatrix<f64> {
        let (rows, columns) = self.elastic.shape();
        let mut all = DMatrix::zeros(3 + rows + cyclic, 3 + columns + cyclic);
        all.view_mut((0, 0), (3, 3)).fill_with_identity();
        all.view_mut((3, 3), (rows, columns)).copy_from(&self.elastic);
        all.view_mut((3 + rows, 3 + columns), (cyclic, cyclic)).fill_with_identity();
        all
    }

    /// Displacement of every elastic coordinate.
    fn lifted(&self, shares: &[Complex<f64>]) -> Vec<Complex<f64>> {
        let (rows, columns) = self.elastic.shape();
        (0..rows).map(|row| (0..columns).map(|k| shares[k] * self.elastic[(row, k)]).sum()).collect()
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modes::Given;
    use crate::problems::ring_of_points;

    /// Slow motions of the reduced basis agree with those of the full one: the nutation, and the slowest vibrations.
    #[test]
    fn few_displacements_hold_the_slow_motions() {
        let body = ring_of_points(20).body().unwrap();
        let axis = crate::model::Principal::compute(body.invariants().J).axes[2];
        let steady = RelativeEquilibrium::near(&body, axis, Given::Rate(0.3)).unwrap();
        let coefficients = steady.coefficients(&body);
        let slow = |whole: usize| {
            let mut found = within(&body, &steady, &coefficients, whole).unwrap();
            found.retain(|motion| motion.lambda.norm() > 1e-6);
            found.sort_by(|a, b| a.lambda.norm().total_cmp(&b.lambda.norm()));
            found.iter().take(8).map(|motion| motion.lambda).collect::<Vec<_>>()
        };
        let (all, few) = (slow(usize::MAX), slow(0));
        for (all, few) in all.iter().zip(&few) {
            assert!((all - few).norm() < 1e-4 * all.norm(), "{all} {few}");
        }
        assert!((all[0] - few[0]).norm() < 1e-9 * all[0].norm(), "{} {}", all[0], few[0]);
    }
}
