//! Schur vectors by QR steps with single shifts in complex arithmetic: real matrices need no blocks of two.
//! Written here, as the library beneath keeps its Schur form to itself.

use super::{C, Matrix, Real};
use crate::eigen::NoConvergence;

/// Steps for one eigenvalue, and between steps with a shift of another kind.
const MOST_STEPS: usize = 90;
const STALLED: usize = 10;

/// Unitary matrix that makes a matrix upper triangular.
pub(super) fn unitary(matrix: &Real) -> Result<Matrix, NoConvergence> {
    let size = matrix.nrows();
    if size == 1 {
        return Ok(Matrix::identity(1, 1));
    }
    let lost = NoConvergence { size };
    if matrix.iter().any(|entry| !entry.is_finite()) {
        return Err(lost);
    }
    let (Q, H) = matrix.clone().hessenberg().unpack();
    let mut step = Step { Q: Q.map(C::from), H: H.map(C::from) };
    let (mut end, mut steps) = (size, 0);
    while end > 1 {
        let start = step.coupled(end);
        if start + 1 == end {
            (end, steps) = (end - 1, 0);
            continue;
        }
        steps += 1;
        if steps > MOST_STEPS {
            return Err(lost);
        }
        let shift = if steps % STALLED == 0 { step.stray_shift(end) } else { step.shift(end) };
        step.chase(start, end, shift);
    }
    Ok(step.Q)
}

struct Step {
    Q: Matrix,
    H: Matrix,
}

impl Step {
    /// Start of the last block that is still coupled.
    fn coupled(&mut self, end: usize) -> usize {
        let mut start = end - 1;
        while start > 0 {
            let size = self.H[(start - 1, start - 1)].norm() + self.H[(start, start)].norm();
            let size = if size > 0.0 { size } else { self.H.norm() };
            if self.H[(start, start - 1)].norm() <= f64::EPSILON * size {
                self.H[(start, start - 1)] = C::from(0.0);
                break;
            }
            start -= 1;
        }
        start
    }

    /// Eigenvalue of the last two rows that is nearer to the last entry.
    fn shift(&self, end: usize) -> C {
        let [a, b, c, d] =
            [(2, 2), (2, 1), (1, 2), (1, 1)].map(|(i, k): (usize, usize)| self.H[(end - i, end - k)]);
        let half = 0.5 * (a - d);
        let root = (half * half + b * c).sqrt();
        let far = if (half + root).norm() > (half - root).norm() { half + root } else { half - root };
        if far.norm() == 0.0 { d } else { d - b * c / far }
    }

    /// Shift that breaks a cycle.
    fn stray_shift(&self, end: usize) -> C {
        self.H[(end - 1, end - 1)] + C::from(0.75 * self.H[(end - 1, end - 2)].norm())
    }

    fn chase(&mut self, start: usize, end: usize, shift: C) {
        let size = self.H.nrows();
        for k in start..end - 1 {
            let from = if k > start { k - 1 } else { k };
            let (x, y) =
                (self.H[(k, from)] - if k > start { C::from(0.0) } else { shift }, self.H[(k + 1, from)]);
            let length = x.norm().hypot(y.norm());
            if length == 0.0 {
                continue;
            }
            let (c, s) = (x / length, y / length);
            for column in from..size {
                let [a, b] = [self.H[(k, column)], self.H[(k + 1, column)]];
                self.H[(k, column)] = c.conj() * a + s.conj() * b;
                self.H[(k + 1, column)] = c * b - s * a;
            }
            if k > start {
                self.H[(k + 1, from)] = C::from(0.0);
            }
            let turn = |matrix: &mut Matrix, rows: usize| {
                for row in 0..rows {
                    let [a, b] = [matrix[(row, k)], matrix[(row, k + 1)]];
                    matrix[(row, k)] = c * a + s * b;
                    matrix[(row, k + 1)] = c.conj() * b - s.conj() * a;
                }
            };
            turn(&mut self.H, (k + 3).min(end));
            turn(&mut self.Q, size);
        }
    }
}
