//! Whether the masses and the second variation of the energy of a body of many coordinates are positive, from the factors of its blocks: a spin
//! with a positive second variation is stable, however many motions are not found.
//! Equations (M4), (M12) and (M24), docs/theory/15-modes.md.

use nalgebra::{Matrix3, SMatrix, Vector3};

use super::slow::SlowDirection;
use crate::math::cholesky::Cholesky;
use crate::math::sparse::SparseRows;
use crate::math::sym3;
use crate::model::{FlexibleBody, Recoiling, SpinCoefficients, SpinMatrix};

/// Share of the mass and inertia of the body below which those left by its parts are rounding.
const ROUNDING: f64 = 1e-13;

/// Whether the kinetic energy is positive for every motion; none where the coefficients are not sparse.
pub(super) fn positive_masses(body: &FlexibleBody, coefficients: &SpinCoefficients) -> Option<bool> {
    let SpinMatrix::Recoiling(Recoiling { own, moments, .. }) = &coefficients.mass else { return None };
    let Ok(factor) = Cholesky::new(own) else { return Some(false) };
    let row = |j: usize| {
        let ([x, y, z], s) = (coefficients.h[j], moments.get(j).copied().unwrap_or_default());
        [x, y, z, s[0], s[1], s[2]]
    };
    let columns: Vec<[f64; 6]> = (0..coefficients.h.len()).map(row).collect();
    let mut solved = columns.as_flattened().to_vec();
    factor.solve(&mut solved, 6);
    let J = Matrix3::from(sym3::rows(coefficients.inertia));
    let mut left = SMatrix::<f64, 6, 6>::zeros();
    left.fixed_view_mut::<3, 3>(0, 0).copy_from(&J);
    left.fixed_view_mut::<3, 3>(3, 3).fill_diagonal(body.invariants().mass);
    let whole = Vector3::new(J.diagonal().amax(), body.invariants().mass, 0.0);
    for (given, solved) in columns.iter().zip(solved.as_chunks::<6>().0) {
        for (row, column) in (0..6).flat_map(|row| (0..6).map(move |column| (row, column))) {
            left[(row, column)] -= given[row] * solved[column];
        }
    }
    let unit = |row: usize| whole[row / 3].sqrt().recip();
    let left = SMatrix::<f64, 6, 6>::from_fn(|row, column| left[(row, column)] * unit(row) * unit(column));
    Some(left.symmetric_eigenvalues().min() > ROUNDING)
}

/// Whether the second variation of the energy is positive for every change of a spin but that of its size, in a body that dashpots alone, and
/// materials of springs and dashpots beside the stiffness given, dissipate: it is stable then. False where that is not known.
pub(super) fn positive_energy(
    body: &FlexibleBody,
    coefficients: &SpinCoefficients,
    slow: Option<&SlowDirection>,
) -> bool {
    let materials = body.viscoelastic().iter().all(|part| part.rheology.given_at_rest());
    let dashpots = materials && body.memories().is_empty();
    let elastic = body.elastic();
    let within = |(j, k, _): &(usize, usize, f64)| *j < elastic && *k < elastic;
    let springs = body.stiffness().iter().map(|(j, k, C)| (j, k, *C));
    let softened: Vec<(usize, usize, f64)> = match &coefficients.centrifugal {
        // the recoil only adds to the stiffness that the spin leaves
        SpinMatrix::Recoiling(Recoiling { own, .. }) => own.iter().map(|(j, k, N)| (j, k, -N)).collect(),
        SpinMatrix::Dense(N) => {
            let all = (0..elastic).flat_map(|j| (0..elastic).map(move |k| (j, k)));
            all.map(|(j, k)| (j, k, -N.at(j, k))).collect()
        }
    };
    let parts = springs.chain(softened).filter(within).collect();
    let held = || Cholesky::new(&SparseRows::sum(elastic, parts)).is_ok();
    dashpots && slow.is_some_and(SlowDirection::is_least) && held()
}
