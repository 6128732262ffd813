//! Least squares with unknowns that are not negative.

use nalgebra::{DMatrix, DVector};

/// Slope, as a share of the largest at the start, that is taken for zero.
const FLAT: f64 = 1e-13;
/// Exchanges of unknowns allowed, over their number.
const EXCHANGES: usize = 10;

/// Unknowns `x ≥ 0` with the least `|A x − b|`, by the active sets of Lawson and Hanson `[@lawson1974]`.
///
/// `rows` are those of `A`, one for each entry of `b`, all of one length.
#[must_use]
pub fn nonnegative_least_squares(rows: &[Vec<f64>], b: &[f64]) -> Vec<f64> {
    let columns = rows.first().map_or(0, Vec::len);
    let A = DMatrix::from_fn(rows.len(), columns, |row, column| rows[row][column]);
    least(&A, &DVector::from_column_slice(b)).as_slice().to_vec()
}

fn least(A: &DMatrix<f64>, b: &DVector<f64>) -> DVector<f64> {
    let count = A.ncols();
    let (mut x, mut free) = (DVector::zeros(count), Vec::new());
    let flat = FLAT * A.tr_mul(b).amax();
    for _ in 0..EXCHANGES * count {
        let slope = A.tr_mul(&(b - A * &x));
        let held = (0..count).filter(|j| !free.contains(j));
        let Some(next) = held.max_by(|i, j| slope[*i].total_cmp(&slope[*j])) else { break };
        if !(slope[next] > flat) {
            break;
        }
        free.push(next);
        settle(A, b, &mut x, &mut free);
        if !free.contains(&next) {
            break; // its slope was rounding
        }
    }
    x
}

/// Goes to the least squares of the free unknowns, and holds those that would become negative on the way.
fn settle(A: &DMatrix<f64>, b: &DVector<f64>, x: &mut DVector<f64>, free: &mut Vec<usize>) {
    while !free.is_empty() {
        let Ok(goal) = A.select_columns(free.iter()).svd(true, true).solve(b, f64::EPSILON) else { return };
        let falling = free.iter().zip(&goal).filter(|(_, goal)| **goal <= 0.0);
        let step = falling.map(|(j, goal)| x[*j] / (x[*j] - goal)).fold(1.0, f64::min);
        free.iter().zip(&goal).for_each(|(j, goal)| x[*j] += step * (goal - x[*j]));
        if step == 1.0 {
            return;
        }
        let smallest = free.iter().zip(&goal).filter(|(_, goal)| **goal <= 0.0);
        let Some((first, _)) = smallest.min_by(|a, b| x[*a.0].total_cmp(&x[*b.0])) else { return };
        x[*first] = 0.0;
        free.retain(|j| {
            x[*j] = x[*j].max(0.0);
            x[*j] > 0.0
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A corner of the quadrant, checked by the conditions of Karush, Kuhn and Tucker, and unknowns that are all free.
    #[test]
    fn no_unknown_is_negative_and_no_slope_leads_further_down() {
        let on_diagonal = |i, j| if i == j { 0.3 } else { 0.0 };
        let A = DMatrix::from_fn(9, 5, |i, j| (0.7 * ((i + 1) * (j + 2)) as f64).sin() + on_diagonal(i, j));
        let wanted = DVector::from_vec(vec![0.4, 0.0, 1.5, 0.0, 2.0]);
        let found = least(&A, &(&A * &wanted));
        assert!((found - wanted).amax() < 1e-10);
        for seed in 0..40 {
            let b = DVector::from_fn(9, |i, _| ((seed * 13 + i * 5) as f64).cos());
            let x = least(&A, &b);
            let slope = A.tr_mul(&(&b - &A * &x));
            for j in 0..5 {
                assert!(x[j] >= 0.0);
                assert!(slope[j] < 1e-10, "{seed}: {x} {slope}");
                assert!(x[j] == 0.0 || slope[j].abs() < 1e-10, "{seed}: {x} {slope}");
            }
        }
    }
}
