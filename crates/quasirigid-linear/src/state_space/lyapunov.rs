//! Square roots of Gramians, without the Gramians.

use super::schur::Schur;
use super::{C, Matrix, Real};

/// Real square root `R` of the Gramian, `A R Rᵀ + R Rᵀ Aᵀ + B Bᵀ = 0`, of a stable matrix in Schur form. `[@hammarling1982]`
pub(super) fn controllable(schur: &Schur, B: &Real) -> Real {
    let own = schur.Q.adjoint() * B.map(C::from);
    real(&schur.Q * root(&schur.T, own))
}

/// The same of the outputs: `Aᵀ R Rᵀ + R Rᵀ A + Cᵀ C = 0`.
pub(super) fn observable(schur: &Schur, outputs: &Real) -> Real {
    let size = schur.T.nrows();
    let reversed = Matrix::from_fn(size, size, |i, k| schur.T[(size - 1 - k, size - 1 - i)].conj());
    let own = schur.Q.adjoint() * outputs.transpose().map(C::from);
    let rows = |matrix: &Matrix| Matrix::from_fn(size, matrix.ncols(), |i, k| matrix[(size - 1 - i, k)]);
    real(&schur.Q * rows(&root(&reversed, rows(&own))))
}

/// Upper triangular `U` with `T U Uᴴ + U Uᴴ Tᴴ + B Bᴴ = 0`, column by column from the last; what is left of `B` is that of the others.
fn root(T: &Matrix, mut B: Matrix) -> Matrix {
    let size = T.nrows();
    let mut U = Matrix::zeros(size, size);
    for last in (0..size).rev() {
        let pole = T[(last, last)];
        let row: Vec<C> = B.row(last).iter().copied().collect();
        let length = row.iter().fold(0.0_f64, |sum, entry| sum.hypot(entry.norm()));
        if length == 0.0 {
            continue;
        }
        let diagonal = length / (-2.0 * pole.re).sqrt();
        let weights: Vec<C> = row.iter().map(|entry| entry.conj() / diagonal).collect();
        U[(last, last)] = C::from(diagonal);
        for i in (0..last).rev() {
            let pushed: C = weights.iter().enumerate().map(|(k, weight)| B[(i, k)] * weight).sum();
            let above: C = (i + 1..last).map(|k| T[(i, k)] * U[(k, last)]).sum();
            U[(i, last)] = -(T[(i, last)] * diagonal + pushed + above) / (T[(i, i)] + pole.conj());
        }
        for (i, k) in (0..last).flat_map(|i| (0..weights.len()).map(move |k| (i, k))) {
            let taken = U[(i, last)] * weights[k].conj();
            B[(i, k)] -= taken;
        }
    }
    U
}

/// Real root of a real matrix from a complex one, square.
fn real(root: Matrix) -> Real {
    let size = root.nrows();
    let both =
        Real::from_fn(2 * size, size, |i, k| if i < size { root[(k, i)].re } else { root[(k, i - size)].im });
    both.qr().r().transpose()
}
