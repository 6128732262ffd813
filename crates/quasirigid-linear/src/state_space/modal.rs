//! What is left of fast modes where they are left out: their static part, and a bound on the rest. (M22)

use super::{C, Matrix, Real, System};
use crate::eigen::{Dense, NoConvergence, eigenvectors};

/// Response `−C A⁻¹ B` of modes at rest, which stays in the feedthrough.
pub(super) fn static_part(modes: &System) -> Result<Real, NoConvergence> {
    let solved = modes.A.clone().lu().solve(&modes.B);
    let solved = solved.filter(|solved| solved.iter().all(|entry| entry.is_finite()));
    Ok(-&modes.C * solved.ok_or(NoConvergence { size: modes.states() })?)
}

/// Bound up to a frequency (rad/s) on the gain of modes less their static part; infinite where eigenvectors are not independent.
pub(super) fn bound(modes: &System, frequency: f64) -> Result<f64, NoConvergence> {
    let size = modes.states();
    let mut dense = Dense::zero(size);
    (0..size * size).for_each(|k| dense.add(k / size, k % size, modes.A[(k / size, k % size)]));
    let (values, vectors) = eigenvectors(&dense)?;
    let shapes = Matrix::from_fn(size, size, |i, k| C::new(vectors[k][i][0], vectors[k][i][1]));
    let Some(inverse) = shapes.clone().try_inverse() else { return Ok(f64::INFINITY) };
    let (seen, pushed) = (modes.C.map(C::from) * shapes, inverse * modes.B.map(C::from));
    let terms = values.iter().enumerate().map(|(k, [re, im])| {
        let pole = C::new(*re, *im);
        seen.column(k).norm() * pushed.row(k).norm() * largest(pole, frequency) / pole.norm()
    });
    let sum: f64 = terms.sum();
    Ok(if sum.is_nan() { f64::INFINITY } else { sum })
}

/// Largest `ν / |iν − λ|` for `0 ≤ ν ≤ frequency`.
fn largest(pole: C, frequency: f64) -> f64 {
    let worst = pole.norm_sqr() / pole.im; // where the slope vanishes
    if pole.im > 0.0 && worst < frequency {
        pole.norm() / pole.re.abs()
    } else {
        frequency / (C::new(0.0, frequency) - pole).norm()
    }
}
