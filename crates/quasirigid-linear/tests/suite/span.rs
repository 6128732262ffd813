//! Projection on a span whose vectors depend on each other.

use quasirigid_linear::krylov::dot;
use quasirigid_linear::span::{Span, largest};

const C: [[f64; 3]; 3] = [[4.0, 1.0, 0.5], [1.0, 3.0, -0.7], [0.5, -0.7, 2.0]];

fn times(x: &[f64]) -> Vec<f64> {
    C.iter().map(|row| dot(row, x)).collect()
}

#[test]
fn a_combination_of_the_others_is_left_out() {
    let vectors = vec![vec![1.0, 2.0, 3.0], vec![-1.0, 0.5, 2.0], vec![0.0, 2.5, 5.0]];
    let span = Span::orthonormal(vectors.clone(), times);
    let unit = span.projected(times);
    assert_eq!(unit.size(), 2);
    for (row, column) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        let expected = if row == column { 1.0 } else { 0.0 };
        assert!((unit.at(row, column) - expected).abs() < 1e-14);
    }
    let force = times(&vectors[2]);
    let shares = [[1.0, 0.0], [0.0, 1.0]].map(|one| dot(&span.combined(&one), &force));
    let again = span.combined(&shares);
    assert!(again.iter().zip(&vectors[2]).all(|(found, wanted)| (found - wanted).abs() < 1e-13));
    assert_eq!(largest(&[1.0, -3.0, 2.0]), Some(1));
}
