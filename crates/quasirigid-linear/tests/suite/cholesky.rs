//! Factors of matrices stored by rows: solutions, and the line between singular and regular.

use quasirigid_linear::cholesky::Cholesky;
use quasirigid_linear::sparse::SparseRows;

fn tridiagonal(size: usize, end: f64) -> SparseRows<f64> {
    let mut parts = Vec::new();
    for row in 0..size {
        parts.push((row, row, if row == 0 { 1.0 + end } else { 2.0 }));
        if row > 0 {
            parts.push((row, row - 1, -1.0));
            parts.push((row - 1, row, -1.0));
        }
    }
    parts.push((size - 1, size - 1, -1.0));
    SparseRows::sum(size, parts)
}

#[test]
fn solution_satisfies_the_equation() {
    let matrix = tridiagonal(40, 0.3);
    let factor = Cholesky::new(&matrix).unwrap();
    let right: Vec<f64> = (0..80).map(|i| (i as f64 * 0.7).cos()).collect();
    let mut x = right.clone();
    factor.solve(&mut x, 2);
    for column in 0..2 {
        let one: Vec<f64> = x.iter().skip(column).step_by(2).copied().collect();
        for (row, value) in matrix.times(&one).iter().enumerate() {
            assert!((value - right[2 * row + column]).abs() < 1e-11);
        }
    }
}

#[test]
fn a_chain_held_nowhere_moves_as_a_whole() {
    let direction = Cholesky::new(&tridiagonal(12, 0.0)).unwrap_err().direction;
    assert!(direction.iter().all(|entry| (entry.abs() - 1.0).abs() < 1e-9));
}

#[test]
fn units_do_not_make_a_matrix_singular() {
    let entries = [1e-12, 1.0, 1e12].iter().enumerate().map(|(i, d)| (i, i, *d)).collect();
    assert!(Cholesky::new(&SparseRows::sum(3, entries)).is_ok());
}

/// A unit diagonal and the smallest eigenvalue `softness`, in units of its own for each row.
fn pair(softness: f64) -> SparseRows<f64> {
    let units = [3e-6, 7e5];
    let entry = |row: usize, column: usize| {
        let share = if row == column { 1.0 } else { softness - 1.0 };
        (row, column, units[row] * units[column] * share)
    };
    SparseRows::sum(2, vec![entry(0, 0), entry(0, 1), entry(1, 0), entry(1, 1)])
}

#[test]
fn a_matrix_is_singular_below_the_line_and_not_above() {
    assert!(Cholesky::new(&pair(1.02e-13)).is_ok());
    for softness in [0.98e-13, 1e-15, 0.0, -1e-15] {
        let direction = Cholesky::new(&pair(softness)).expect_err("a singular matrix").direction;
        assert!((direction[0] - 1.0).abs() < 1e-9, "{softness:e}: {direction:?}");
        assert!((direction[1] / (3e-6 / 7e5) - 1.0).abs() < 1e-9, "{softness:e}: {direction:?}");
    }
}
