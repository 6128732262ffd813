//! Solutions by dense factors, and refusals.

use quasirigid_linear::eigen::Dense;
use quasirigid_linear::lu::{ComplexDense, ComplexLu, Lu};

#[test]
fn a_complex_system_in_odd_units_is_solved() {
    let mut matrix = ComplexDense::zero(3);
    let rows = [
        [[2.0e9, 1.0e9], [-1.0e9, 0.0], [0.5e9, 0.25e9]],
        [[1.0e-7, 0.0], [3.0e-7, -2.0e-7], [0.0, 1.0e-7]],
        [[0.0, 1.0], [4.0, 0.0], [-1.0, 2.0]],
    ];
    let solution = [[1.0, -2.0], [0.5, 3.0], [-4.0, 0.25]];
    let mut right = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        let mut sum = [0.0; 2];
        for (j, entry) in row.iter().enumerate() {
            matrix.add(i, j, *entry);
            let x: [f64; 2] = solution[j];
            sum[0] += entry[0] * x[0] - entry[1] * x[1];
            sum[1] += entry[0] * x[1] + entry[1] * x[0];
        }
        right.push(sum);
    }
    let found = ComplexLu::new(&matrix).and_then(|factor| factor.solve(&right, 1)).expect("regular");
    for (found, expected) in found.iter().zip(solution) {
        assert!((found[0] - expected[0]).hypot(found[1] - expected[1]) < 1e-13);
    }
}

#[test]
fn a_row_of_zeros_is_refused() {
    let mut matrix = Dense::zero(2);
    matrix.add(0, 0, 1.0);
    assert!(Lu::new(&matrix).is_none());
}
