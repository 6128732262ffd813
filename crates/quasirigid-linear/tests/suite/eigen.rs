//! Modes, eigenvectors and squares of dense matrices: textbook cases, repeated eigenvalues, any scales and rank.

use nalgebra::{DMatrix, DVector};
use quasirigid_linear::eigen::{Dense, eigenvalues, eigenvectors, modes, squares};

/// Whether `|Mx − λx|` is at most so much of `|x|`.
fn solves(matrix: &DMatrix<f64>, [re, im]: [f64; 2], x: &[[f64; 2]], least: f64) -> bool {
    let part = |i: usize| DVector::from_iterator(x.len(), x.iter().map(|entry| entry[i]));
    let (u, v) = (part(0), part(1));
    let real = matrix * &u - &u * re + &v * im;
    let imaginary = matrix * &v - &v * re - &u * im;
    real.norm().hypot(imaginary.norm()) <= least * u.norm().hypot(v.norm())
}

/// Smallest singular value of the matrix whose columns are these vectors, each divided by its length.
fn independence(vectors: &[Vec<[f64; 2]>]) -> f64 {
    let size = vectors.len();
    let unit = |k: usize| vectors[k].iter().fold(0.0_f64, |sum, [u, v]| sum.hypot(u.hypot(*v))).recip();
    let together = |part: usize| DMatrix::from_fn(size, size, |i, j| vectors[j][i][part] * unit(j));
    let (re, im) = (together(0), together(1));
    let mut real = DMatrix::zeros(2 * size, 2 * size); // has each singular value twice
    for (row, column, block) in [(0, 0, &re), (0, size, &-&im), (size, 0, &im), (size, size, &re)] {
        real.view_mut((row, column), (size, size)).copy_from(block);
    }
    (real.transpose() * real).symmetric_eigenvalues().min().max(0.0).sqrt()
}

/// Copies of an oscillator in turned axes.
#[test]
fn eigenvectors_of_equal_eigenvalues_solve_their_equation_and_are_independent() {
    for copies in 2..6 {
        let size = 2 * copies + 4;
        let basis = DMatrix::from_fn(size, size, |i, j| ((i * 7 + j * 3 + 1) as f64).sin()).qr().q();
        let mut system = DMatrix::<f64>::zeros(size, size);
        for k in 0..size / 2 {
            let (rate, frequency) =
                if k < copies { (0.2, 0.9) } else { (0.1 + 0.3 * k as f64, 1.0 + k as f64) };
            system[(2 * k, 2 * k)] = -rate;
            system[(2 * k + 1, 2 * k + 1)] = -rate;
            system[(2 * k, 2 * k + 1)] = frequency;
            system[(2 * k + 1, 2 * k)] = -frequency * 0.5;
        }
        let turned = &basis * &system * basis.transpose();
        let mut matrix = Dense::zero(size);
        (0..size * size).for_each(|k| matrix.add(k / size, k % size, turned[(k / size, k % size)]));
        let (values, vectors) = eigenvectors(&matrix).unwrap();
        assert!(
            values.iter().zip(&vectors).all(|(value, x)| solves(&turned, *value, x, 1e-12)),
            "{copies} copies"
        );
        assert_eq!(values.iter().filter(|[_, im]| *im > 0.0).count(), size / 2);
        let smallest = independence(&vectors);
        assert!(smallest > 1e-3, "{copies} copies: {smallest:e}");
    }
}

#[test]
fn squares_give_back_a_matrix_of_any_scales_and_rank() {
    let forms = [[1e8, -3e8, 0.0, 0.0], [0.0, 1e-6, 2e-6, 0.0]];
    let entry = |i: usize, j: usize| forms.iter().map(|form| form[i] * form[j]).sum::<f64>();
    let mut matrix = Dense::zero(4);
    (0..16).for_each(|k| matrix.add(k / 4, k % 4, entry(k / 4, k % 4)));
    let found = squares(&matrix).unwrap();
    let back = |i: usize, j: usize| (0..4).map(|form| found.at(form, i) * found.at(form, j)).sum::<f64>();
    for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
        let scale = (entry(i, i) * entry(j, j)).sqrt();
        assert!(
            (back(i, j) - entry(i, j)).abs() <= 1e-14 * scale,
            "{i} {j}: {} for {}",
            back(i, j),
            entry(i, j)
        );
    }
    assert_eq!((0..4).filter(|form| (0..4).any(|row| found.at(*form, row) != 0.0)).count(), 2);
}

#[test]
fn two_masses_on_a_line_have_their_textbook_modes() {
    let (mut A, mut C) = (Dense::zero(2), Dense::zero(2));
    for (i, j, a, c) in [(0, 0, 2.0, 6.0), (1, 1, 2.0, 6.0), (0, 1, 0.0, -4.0), (1, 0, 0.0, -4.0)] {
        A.add(i, j, a);
        C.add(i, j, c);
    }
    let modes = modes(&A, &C).unwrap();
    assert!((modes.frequencies[0] - 1.0).abs() < 1e-14);
    assert!((modes.frequencies[1] - 5.0_f64.sqrt()).abs() < 1e-14);
    let (x, y) = (modes.shapes.at(0, 0), modes.shapes.at(1, 0));
    assert!((x - y).abs() < 1e-14 && (2.0 * (x * x + y * y) - 1.0).abs() < 1e-14);
}

#[test]
fn a_damped_oscillator_has_a_conjugate_pair() {
    let mut matrix = Dense::zero(2);
    matrix.add(0, 1, 1.0);
    matrix.add(1, 0, -1.0);
    matrix.add(1, 1, -0.2);
    let values = eigenvalues(&matrix).unwrap();
    assert!(
        values.iter().all(|[re, im]| (re + 0.1).abs() < 1e-14 && (im.abs() - 0.99_f64.sqrt()).abs() < 1e-14)
    );
}
