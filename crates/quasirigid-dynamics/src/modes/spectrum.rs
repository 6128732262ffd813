//! Linear eigenproblem of small motions about a steady spin: eigenvalues with their motions.
//! Equation (M2), docs/theory/15-modes.md.

use nalgebra::{Complex, DMatrix};

use super::deflation::{Pair, without};
use super::equilibrium::RelativeEquilibrium;
use super::error::ModesError;
use super::first_order::FirstOrder;
use crate::math::eigen::NoConvergence;
use crate::model::{FlexibleBody, SpinCoefficients};

/// Small motion `e^{λt}`: angular velocity, rates and displacements of all coordinates.
#[derive(Clone, Debug)]
pub(super) struct Eigenmotion {
    pub lambda: Complex<f64>,
    pub delta: [Complex<f64>; 3],
    pub rate: Vec<Complex<f64>>,
    pub q: Vec<Complex<f64>>,
    /// Angles of liquids whose impedance is known; empty where they move as coordinates.
    pub angles: Vec<Complex<f64>>,
}

/// Share of the spin below which an eigenvalue is zero: a change of `|K|`, or of the direction in a body without a preferred one.
pub(super) const ZERO: f64 = 1e-7;

/// Eigenvalues of the linear equations in first order with their motions, those with `Im λ ≥ 0`, without the zeros of the steady spins
/// beside this one, which are given as changes of the angular velocity; with all displacements of a body of up to `whole` elastic coordinates.
/// (M2), (M12)
///
/// # Errors
/// [`ModesError`] if the eigenvalue solver fails, or the mass matrix is not positive.
pub(super) fn within(
    body: &FlexibleBody,
    equilibrium: &RelativeEquilibrium,
    coefficients: &SpinCoefficients,
    (steady, whole): (&[[f64; 3]], usize),
) -> Result<Vec<Eigenmotion>, ModesError> {
    let FirstOrder { matrix, inverse, basis } = FirstOrder::of(body, equilibrium, coefficients, whole)?;
    let (elastic, moving) = (basis.units.len(), inverse.nrows());
    let size = moving + elastic;
    let matrix = DMatrix::from_fn(size, size, |row, column| matrix.at(row, column));
    let null = null_vectors(&matrix, &inverse, steady).ok_or(NoConvergence { size })?;
    let found = without(&matrix, &null)?;
    let motion = |(lambda, vector): Pair| {
        let entries = vector.as_slice();
        let velocities: Vec<Complex<f64>> = (0..moving)
            .map(|row| (0..moving).map(|column| entries[column] * inverse[(row, column)]).sum())
            .collect();
        let displaced: Vec<Complex<f64>> =
            entries[moving..].iter().zip(&basis.units).map(|(entry, unit)| entry / *unit).collect();
        let mut q = basis.lifted(&displaced);
        let mut rate = basis.lifted(&velocities[3..3 + elastic]);
        let loose = velocities[3 + elastic..].iter();
        q.extend(loose.clone().map(|rate| if lambda.norm() > 0.0 { rate / lambda } else { *rate }));
        rate.extend(loose);
        let delta = [velocities[0], velocities[1], velocities[2]];
        Eigenmotion { lambda, delta, rate, q, angles: Vec::new() }
    };
    Ok(found.into_iter().filter(|(lambda, _)| lambda.im >= 0.0).map(motion).collect())
}

/// Null vectors of the equations in first order, one per column and of unit length: changes of the angular velocity with the displacements
/// that balance them, all rates zero.
fn null_vectors(matrix: &DMatrix<f64>, inverse: &DMatrix<f64>, steady: &[[f64; 3]]) -> Option<DMatrix<f64>> {
    let (size, moving, count) = (matrix.nrows(), inverse.nrows(), steady.len());
    let turned = DMatrix::from_fn(moving, count, |row, k| if row < 3 { steady[k][row] } else { 0.0 });
    let velocities = inverse.solve_upper_triangular(&turned)?;
    let mut null = DMatrix::zeros(size, count);
    null.rows_mut(0, moving).copy_from(&velocities);
    if size > moving {
        let per_displacement = matrix.view((0, moving), (moving, size - moving)).into_owned().qr();
        let load = per_displacement.q().transpose() * -matrix.view((0, 0), (moving, moving)) * velocities;
        null.rows_mut(moving, size - moving).copy_from(&per_displacement.r().solve_upper_triangular(&load)?);
    }
    null.column_iter_mut().for_each(|mut column| {
        column.normalize_mut();
    });
    Some(null)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modes::SpinMagnitude;
    use crate::problems::ring_of_points;

    /// Slow motions of the reduced basis agree with those of the full one: the nutation, and the slowest vibrations.
    #[test]
    fn few_displacements_hold_the_slow_motions() {
        let body = ring_of_points(20).body().unwrap();
        let axis = crate::model::Principal::compute(body.invariants().J).axes[2];
        let steady = RelativeEquilibrium::near(&body, axis, SpinMagnitude::Rate(0.3)).unwrap();
        let coefficients = steady.coefficients(&body);
        let slow = |whole: usize| {
            let mut found = within(&body, &steady, &coefficients, (&[], whole)).unwrap();
            found.retain(|motion| motion.lambda.norm() > 1e-6);
            found.sort_by(|a, b| a.lambda.norm().total_cmp(&b.lambda.norm()));
            found.truncate(8);
            found
        };
        let (all, few) = (slow(usize::MAX), slow(0));
        let gap = |i: usize| (all[i].lambda - few[i].lambda).norm() / all[i].lambda.norm();
        for i in 0..8 {
            assert!(gap(i) < 1e-4, "{} {}", all[i].lambda, few[i].lambda);
        }
        assert!(gap(0) < 1e-9, "{} {}", all[0].lambda, few[0].lambda);
        // Displacements and rates of every coordinate, per angular velocity about the first axis.
        let shape = |motion: &Eigenmotion| -> Vec<Complex<f64>> {
            motion.q.iter().chain(&motion.rate).map(|entry| entry / motion.delta[0]).collect()
        };
        let (all, few) = (shape(&all[0]), shape(&few[0]));
        let size = |x: &mut dyn Iterator<Item = Complex<f64>>| x.map(|x| x.norm_sqr()).sum::<f64>().sqrt();
        let apart = size(&mut all.iter().zip(&few).map(|(a, b)| a - b));
        assert!(apart < 1e-3 * size(&mut all.iter().copied()), "{apart:e}");
    }
}
