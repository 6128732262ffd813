//! A system as the sum of two, by the eigenvalues of each.

use nalgebra::DMatrix;

use super::schur::{Schur, singular};
use super::{C, Matrix, Real, System};
use crate::eigen::NoConvergence;

/// Roundings of a sum that are taken for zero; share of a basis that another may have beyond its size.
const ROUNDING: f64 = 64.0;
const SAME_SPACE: f64 = 1e-6;

/// The part of some eigenvalues, and that of the others, which has no feedthrough.
pub(super) fn split(system: &System, schur: &Schur, chosen: &[bool]) -> Result<[System; 2], NoConvergence> {
    let size = system.states();
    let first = chosen.iter().filter(|chosen| **chosen).count();
    let mut schur = schur.clone();
    schur.order(chosen);
    let lost = NoConvergence { size };
    let coupling = separated(&schur.T, first);
    let (own, rest) = (schur.Q.columns(0, first), schur.Q.columns(first, size - first));
    let (kept, pivots) = echelon(real_basis(&own.into_owned())?);
    let others = real_basis(&(own * coupling + rest))?;
    let basis =
        Real::from_fn(size, size, |i, k| if k < first { kept[(i, k)] } else { others[(i, k - first)] });
    let inverse = basis.clone().try_inverse().filter(|inverse| inverse.iter().all(|x| x.is_finite()));
    let inverse = inverse.ok_or(lost)?;
    let part = |from: usize, count: usize, A: Real, D: Real| System {
        A,
        B: inverse.rows(from, count) * &system.B,
        C: &system.C * basis.columns(from, count),
        D,
    };
    let within = product(&system.A, &kept).select_rows(&pivots);
    let beyond = inverse.rows(first, size - first) * &system.A * &others;
    let none = DMatrix::zeros(system.D.nrows(), system.D.ncols());
    Ok([part(0, first, within, system.D.clone()), part(first, size - first, beyond, none)])
}

/// `X` of `T₁ X − X T₂ = −T₁₂`, which uncouples the two diagonal blocks. `[@bartels1972]`
fn separated(T: &Matrix, first: usize) -> Matrix {
    let rest = T.nrows() - first;
    let mut X = Matrix::zeros(first, rest);
    for column in 0..rest {
        for row in (0..first).rev() {
            let right: C = (0..column).map(|k| X[(row, k)] * T[(first + k, first + column)]).sum();
            let left: C = (row + 1..first).map(|k| T[(row, k)] * X[(k, column)]).sum();
            let gap = T[(row, row)] - T[(first + column, first + column)];
            X[(row, column)] = (right - left - T[(row, first + column)]) / gap;
        }
    }
    X
}

/// Orthonormal real basis of a space that holds the conjugate of each of its vectors.
fn real_basis(vectors: &Matrix) -> Result<Real, NoConvergence> {
    let (size, count) = vectors.shape();
    if vectors.iter().any(|entry| !entry.re.is_finite() || !entry.im.is_finite()) {
        return Err(NoConvergence { size });
    }
    let unit = vectors.clone().qr().q();
    let both =
        Real::from_fn(
            size,
            2 * count,
            |i, k| {
                if k < count { unit[(i, k)].re } else { unit[(i, k - count)].im }
            },
        );
    let (U, values, _) = singular(&both)?;
    if values.get(count).is_some_and(|beyond| *beyond > SAME_SPACE) {
        return Err(NoConvergence { size });
    }
    Ok(U.columns(0, count).into_owned())
}

/// The basis of the same space that is one in a row for each vector, and those rows.
fn echelon(mut basis: Real) -> (Real, Vec<usize>) {
    let (size, count) = basis.shape();
    let mut pivots: Vec<usize> = Vec::new();
    for place in 0..count {
        let free = (0..size).filter(|row| !pivots.contains(row));
        let entries = free.flat_map(|row| (place..count).map(move |column| (row, column)));
        let largest = entries.max_by(|a, b| basis[*a].abs().total_cmp(&basis[*b].abs()));
        let Some((row, column)) = largest else { break };
        basis.swap_columns(place, column);
        let pivot = basis[(row, place)];
        basis.column_mut(place).unscale_mut(pivot);
        let own = basis.column(place).into_owned();
        for other in (0..count).filter(|other| *other != place) {
            let share = basis[(row, other)];
            basis.column_mut(other).axpy(-share, &own, 1.0);
        }
        pivots.push(row);
    }
    let least = ROUNDING * size as f64 * f64::EPSILON;
    for mut column in basis.column_iter_mut() {
        let largest = column.amax();
        column.iter_mut().filter(|entry| entry.abs() <= least * largest).for_each(|entry| *entry = 0.0);
    }
    (basis, pivots)
}

/// Product of two matrices, without the entries that are rounding of their sums: integrators stay integrators.
fn product(A: &Real, basis: &Real) -> Real {
    let least = ROUNDING * A.nrows() as f64 * f64::EPSILON;
    let sizes = A.abs() * basis.abs();
    (A * basis).zip_map(&sizes, |entry, size| if entry.abs() <= least * size { 0.0 } else { entry })
}
