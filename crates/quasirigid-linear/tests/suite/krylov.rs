//! Largest eigenvalues of large pencils, crowded and repeated, against those of diagonal ones.

use quasirigid_linear::krylov::{Pencil, dot};

/// Diagonal pencil with a repeated largest eigenvalue and a dense spectrum below.
#[test]
fn crowded_eigenvalues_are_found() {
    let size = 3000;
    let theta = |i: usize| 1.0 / (1.0 + 1e-3 * (i / 3) as f64);
    let mass = |x: &[f64]| x.iter().enumerate().map(|(i, x)| theta(i) * x).collect::<Vec<f64>>();
    let pencil = Pencil { size, stiffness: &|x: &[f64]| x.to_vec(), solve: &|_: &mut [f64]| (), mass: &mass };
    for (i, x) in pencil.largest(12).unwrap().iter().enumerate() {
        let value = dot(x, &mass(x));
        assert!((value - theta(i)).abs() < 1e-4, "{i}: {value} {}", theta(i));
    }
}

#[test]
fn repeated_eigenvalues_are_found_with_their_multiplicity() {
    let size = 900;
    let theta = |i: usize| if i < 3 { 1.0 } else { 0.9 / (1.0 + 0.01 * i as f64) };
    let scale = |i: usize| 10f64.powi((i % 7) as i32 - 3);
    let stiffness = |x: &[f64]| x.iter().enumerate().map(|(i, x)| scale(i) * x).collect();
    let mass = |x: &[f64]| x.iter().enumerate().map(|(i, x)| theta(i) * scale(i) * x).collect::<Vec<f64>>();
    let solve = |x: &mut [f64]| x.iter_mut().enumerate().for_each(|(i, x)| *x /= scale(i));
    let pencil = Pencil { size, stiffness: &stiffness, solve: &solve, mass: &mass };
    let vectors = pencil.largest(6).unwrap();
    for (i, x) in vectors.iter().enumerate() {
        let value = dot(x, &mass(x));
        assert!((value - theta(i)).abs() < 1e-7, "{i}: {value} {}", theta(i));
    }
}
