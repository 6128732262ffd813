//! Eigenvalues of the first-order equations, zeros removed exactly. (M7)

use nalgebra::{Complex, DMatrix, DVector};

use super::error::SteadyError;
use super::system::System;
use crate::math::eigen::{Dense, NoConvergence, eigenvectors};
use crate::model::FlexibleBody;

type C = Complex<f64>;

/// Small motion `e^{λt}`.
#[derive(Clone, Debug)]
pub(super) struct Eigenmotion {
    pub lambda: C,
    /// `θ`, or the angular velocity where no force depends on the attitude.
    pub turn: [C; 3],
    pub q: Vec<C>,
    pub velocity: Vec<C>,
}

/// Motions with `Im λ ≥ 0`, and the number of zero eigenvalues.
pub(super) fn spectrum(
    body: &FlexibleBody,
    system: &System,
    attitude: bool,
) -> Result<(Vec<Eigenmotion>, usize), SteadyError> {
    let (n, elastic) = (body.coordinates().len(), body.elastic());
    let moving = system.mass.nrows();
    let turns = if attitude { 3 } else { 0 };
    let size = moving + turns + elastic;
    let failed = || NoConvergence { size };
    let L = system.mass.clone().cholesky().ok_or(SteadyError::BeyondRange)?.unpack();
    let back = L.transpose();
    let solved = |right: DMatrix<f64>| L.solve_lower_triangular(&right).ok_or_else(failed);
    let units = units(body, system, attitude);
    let rate = solved(solved(system.rate.clone())?.transpose())?.transpose();
    let columns = system.stiffness.columns(3 - turns, turns + elastic).into_owned();
    let mut stiffness = solved(columns)?;
    stiffness.column_iter_mut().zip(&units).for_each(|(mut column, unit)| column /= *unit);
    let inverse = back.solve_upper_triangular(&DMatrix::identity(moving, moving)).ok_or_else(failed)?;
    let mut A = DMatrix::zeros(size, size);
    A.view_mut((0, 0), (moving, moving)).copy_from(&-rate);
    A.view_mut((0, moving), (moving, turns + elastic)).copy_from(&-stiffness);
    for k in 0..turns + elastic {
        let from = if k < turns { k } else { 3 + k - turns };
        let row = units[k] * inverse.row(from);
        A.view_mut((moving + k, 0), (1, moving)).copy_from(&row);
    }
    let turning = system.turning();
    for i in 0..turns {
        for k in 0..turns {
            A[(moving + i, moving + k)] = -units[i] * turning[(i, k)] / units[k];
        }
    }
    let (found, zeros) = without_zeros(A)?;
    let motion = |(lambda, vector): (C, DVector<C>)| {
        let rates: Vec<C> =
            (0..moving).map(|row| (row..moving).map(|k| vector[k] * inverse[(row, k)]).sum()).collect();
        let displaced = |k: usize| vector[moving + k] / units[k];
        let turn = [0, 1, 2].map(|i| if attitude { displaced(i) } else { rates[i] });
        let mut q: Vec<C> = (0..elastic).map(|j| displaced(turns + j)).collect();
        q.extend(rates[3 + elastic..3 + n].iter().map(|rate| rate / lambda));
        Eigenmotion { lambda, turn, q, velocity: rates[3 + n..].to_vec() }
    };
    Ok((found.into_iter().filter(|(lambda, _)| lambda.im >= 0.0).map(motion).collect(), zeros))
}

/// Units of the displacements that make them as large as the velocities: the root of their stiffness.
fn units(body: &FlexibleBody, system: &System, attitude: bool) -> Vec<f64> {
    let mut units = Vec::new();
    if attitude {
        let J = system.mass.view((0, 0), (3, 3)).trace() / 3.0;
        let held = system.stiffness.view((0, 0), (3, 3)).amax();
        let gyroscopic = system.rate.view((0, 0), (3, 3)).amax().powi(2) / J;
        let unit = (held + gyroscopic + J * system.turning().norm_squared()).sqrt();
        units.extend([if unit > 0.0 { unit } else { J.sqrt() }; 3]);
    }
    let held = body.stiffness().diagonal();
    let loaded = |j: usize| system.stiffness[(3 + j, 3 + j)].abs();
    units.extend((0..body.elastic()).map(|j| if held[j] > 0.0 { held[j] } else { loaded(j) }.sqrt()));
    units
}

/// Eigenvalue with its vector.
type Pair = (C, DVector<C>);

/// Share of the largest singular value, per row, below which a singular value is zero.
const ZERO: f64 = 1e-14;

/// Nonzero eigenvalues with their vectors, and the number of zeros.
///
/// A matrix with `Av = 0` has, in a basis of `v` and its complement, the eigenvalue zero and those of the block on the complement. The
/// reduction is repeated while that block is singular, so that a Jordan chain of the eigenvalue zero goes one by one.
fn without_zeros(A: DMatrix<f64>) -> Result<(Vec<Pair>, usize), NoConvergence> {
    let size = A.nrows();
    let mut levels: Vec<(DMatrix<f64>, DVector<f64>, DVector<f64>)> = Vec::new();
    let mut left = A;
    while left.nrows() > 0 {
        let count = left.nrows();
        let factors = left.clone().svd(false, true);
        let values = &factors.singular_values;
        let least = values.imin();
        if values[least] > ZERO * (count as f64) * values.max() && values.max() > 0.0 {
            break;
        }
        let vectors = factors.v_t.ok_or(NoConvergence { size })?;
        let null: DVector<f64> = vectors.row(least).transpose();
        let across = vectors.remove_row(least).transpose();
        // Row of the block that leads to the null vector.
        let feeds = (null.transpose() * &left * &across).transpose();
        left = across.transpose() * &left * &across;
        levels.push((across, null, feeds));
    }
    let mut dense = Dense::zero(left.nrows());
    for row in 0..left.nrows() {
        (0..left.nrows()).for_each(|column| dense.add(row, column, left[(row, column)]));
    }
    let (values, vectors) = eigenvectors(&dense)?;
    let lifted = |(value, vector): (&[f64; 2], &Vec<[f64; 2]>)| {
        let lambda = C::new(value[0], value[1]);
        let mut x = DVector::from_iterator(vector.len(), vector.iter().map(|[re, im]| C::new(*re, *im)));
        for (across, null, feeds) in levels.iter().rev() {
            let share: C = feeds.iter().zip(x.iter()).map(|(a, x)| *a * x).sum::<C>() / lambda;
            x = across.map(C::from) * &x + null.map(C::from) * share;
        }
        (lambda, x)
    };
    Ok((values.iter().zip(&vectors).map(lifted).collect(), levels.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Matrices with the eigenvalue zero, once and in a Jordan chain: the others have their eigenvectors, parts along the null vectors too.
    #[test]
    fn eigenvectors_beside_zeros_are_those_of_the_whole_matrix() {
        let once = [2.0, 1.0, 3.0, 0.0, -1.0, 1.0, 2.0, 0.0, 4.0];
        // P diag([[0, 1], [0, 0]], 3, −2) P⁻¹ with a P of whole numbers.
        let P =
            DMatrix::from_row_slice(4, 4, &[1., 2., 0., 1., 0., 1., 3., 0., 1., 0., 1., 1., 0., 1., 0., 2.]);
        let mut chain = DMatrix::zeros(4, 4);
        (chain[(0, 1)], chain[(2, 2)], chain[(3, 3)]) = (1.0, 3.0, -2.0);
        let chain = &P * chain * P.clone().try_inverse().unwrap();
        for (A, zeros) in [(DMatrix::from_row_slice(3, 3, &once), 1), (chain, 2)] {
            let (found, count) = without_zeros(A.clone()).unwrap();
            assert_eq!((found.len(), count), (A.nrows() - zeros, zeros));
            for (lambda, x) in found {
                let gap = (A.map(C::from) * &x - &x * lambda).norm();
                assert!(gap < 1e-12 * A.norm() * x.norm(), "{lambda}: {gap:e}");
            }
        }
    }
}
