//! Exact zeros taken out of an eigenproblem: a matrix with known null vectors has, beside its zeros, the eigenvalues of its block on their
//! complement.
//! The zeros of a steady spin are those of the steady spins beside it; rounding would split them into a growth and a decay. (M12)

use nalgebra::{Complex, DMatrix, DVector};

use crate::math::eigen::{Dense, NoConvergence, eigenvectors};

/// Eigenvalue with its vector.
pub(super) type Pair = (Complex<f64>, DVector<Complex<f64>>);

/// Eigenvalues of a matrix with their vectors, without those of null vectors that are known.
pub(super) fn without(matrix: &DMatrix<f64>, null: &DMatrix<f64>) -> Result<Vec<Pair>, NoConvergence> {
    let (size, count) = null.shape();
    let mut padded = DMatrix::identity(size, size + count);
    padded.view_mut((0, 0), (size, count)).copy_from(null);
    padded.view_mut((0, count), (size, size)).fill_with_identity();
    // the first columns span the null vectors, the others their complement
    let basis = padded.qr().q();
    let (null, others) = (basis.columns(0, count), basis.columns(count, size - count));
    let ahead = matrix * others;
    let left = others.transpose() * &ahead;
    let feeds = null.transpose() * &ahead;
    let mut dense = Dense::zero(left.nrows());
    for row in 0..left.nrows() {
        (0..left.nrows()).for_each(|column| dense.add(row, column, left[(row, column)]));
    }
    let (values, vectors) = eigenvectors(&dense)?;
    let (null, others, feeds) =
        (null.map(Complex::from), others.map(Complex::from), feeds.map(Complex::from));
    let lifted = |(value, vector): (&[f64; 2], &Vec<[f64; 2]>)| {
        let lambda = Complex::new(value[0], value[1]);
        let x = DVector::from_iterator(vector.len(), vector.iter().map(|[re, im]| Complex::new(*re, *im)));
        // an eigenvalue of exactly zero belongs to a chain of the null vectors, which is its motion
        let share = if lambda.norm() > 0.0 { (&feeds * &x) / lambda } else { &feeds * &x };
        (lambda, &others * &x + &null * share)
    };
    Ok(values.iter().zip(&vectors).map(lifted).collect())
}
