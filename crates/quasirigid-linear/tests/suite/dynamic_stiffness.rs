//! Solutions of stiff vibrations at a complex rate, by the dense and by the sparse inverse, against the equations.

use nalgebra::{Complex, DMatrix, DVector};
use quasirigid_linear::dynamic_stiffness::{COLUMNS, Oscillator};
use quasirigid_linear::sparse::SparseRows;

/// Size up to which the inverse is a matrix.
const DENSE: usize = 48;

/// Matrices of `M ẍ + B ẋ + C x`.
struct Matrices {
    M: DMatrix<f64>,
    B: DMatrix<f64>,
    C: DMatrix<f64>,
}

fn full(matrix: &SparseRows<f64>) -> DMatrix<f64> {
    let mut rows = DMatrix::zeros(matrix.size(), matrix.size());
    matrix.iter().for_each(|(row, column, entry)| rows[(row, column)] += entry);
    rows
}

/// A chain of masses with six columns taken off its mass matrix, its matrices, and a right-hand side.
fn chain(n: usize) -> (Oscillator, Matrices, Vec<[f64; 2]>) {
    let wave = |i: usize, scale: f64| scale * (1.3 * i as f64 + 0.4).sin();
    let band = |diagonal: f64, side: f64| {
        let entries = (0..n).flat_map(|i| {
            let near = [(i, i, diagonal + 0.1 * wave(i, diagonal))];
            near.into_iter()
                .chain((i + 1 < n).then_some([(i, i + 1, side), (i + 1, i, side)]).into_iter().flatten())
        });
        SparseRows::sum(n, entries.collect())
    };
    let U: Vec<[f64; COLUMNS]> = (0..n).map(|i| std::array::from_fn(|j| wave(i * 7 + j, 0.2))).collect();
    let mut D = [[0.02; COLUMNS]; COLUMNS];
    (0..COLUMNS).for_each(|i| D[i][i] = 0.3);
    let right = (0..2 * n).map(|i| [wave(i, 1.0), wave(i + 3, 2.0)]).collect();
    let (A, B, C) = (band(2.0, 0.3), band(0.7, -0.2), band(50.0, -20.0));
    let columns = DMatrix::from_fn(n, COLUMNS, |i, j| U[i][j]);
    let weights = DMatrix::from_fn(COLUMNS, COLUMNS, |i, j| D[i][j]);
    let M = full(&A) - &columns * weights * columns.transpose();
    let matrices = Matrices { M, B: full(&B), C: full(&C) };
    (Oscillator::new(A, U, D, B, C), matrices, right)
}

/// Both forms of the inverse satisfy the equations.
#[test]
fn solution_satisfies_both_equations() {
    for n in [7, DENSE, DENSE + 1, 90] {
        let (oscillator, Matrices { M, B, C }, given) = chain(n);
        let s = Complex::new(1.7, 4.1);
        let mut stiffness = oscillator.at([s.re, s.im]);
        let form = if n <= DENSE { "inverse: Dense(" } else { "inverse: Sparse(" };
        assert!(format!("{stiffness:?}").contains(form), "{n}");
        let mut solution = given.clone();
        oscillator.solve(&mut stiffness, &mut solution);
        let part = |list: &[[f64; 2]]| DVector::from_fn(n, |i, _| Complex::new(list[i][0], list[i][1]));
        let (g, f) = (part(&given), part(&given[n..]));
        let (x, momentum) = (part(&solution), part(&solution[n..]));
        let y = &x * s - g;
        let [expected, damped, elastic] =
            [(M, &y), (B, &y), (C, &x)].map(|(matrix, of)| matrix.map(Complex::from) * of);
        let rest = &momentum * s + damped + elastic - f;
        for i in 0..n {
            assert!(rest[i].norm() < 1e-12, "row {i} of {n}: {}", rest[i]);
            assert!((momentum[i] - expected[i]).norm() < 1e-12, "momentum {i} of {n}");
        }
    }
}
