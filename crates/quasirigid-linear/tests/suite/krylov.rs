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

/// A chain whose first Krylov space would be larger than it, with stiffnesses over twelve orders of magnitude and coordinates without mass:
/// the frequencies are those of its matrices by hand.
#[test]
fn a_pencil_smaller_than_a_space_is_solved_whole() {
    let size = 18;
    let stiff = |i: usize| 10f64.powi(2 * (i % 7) as i32 - 6);
    let heavy = |i: usize| if i % 3 == 2 { 0.0 } else { stiff(i) * 4f64.powi(-(i as i32)) };
    // coupled by a turn of neighbours, so that no row stands alone
    let turned = |x: &[f64], back: bool| {
        let (sin, cos) = if back { (-0.6, 0.8) } else { (0.6, 0.8) };
        let mut y = x.to_vec();
        let pairs: Vec<usize> = if back { (0..size - 1).rev().collect() } else { (0..size - 1).collect() };
        for i in pairs {
            let [a, b] = [y[i], y[i + 1]];
            (y[i], y[i + 1]) = (cos * a - sin * b, sin * a + cos * b);
        }
        y
    };
    let diagonal = |x: &[f64], of: &dyn Fn(usize) -> f64| {
        let y: Vec<f64> = turned(x, false).iter().enumerate().map(|(i, x)| of(i) * x).collect();
        turned(&y, true)
    };
    let stiffness = |x: &[f64]| diagonal(x, &stiff);
    let mass = |x: &[f64]| diagonal(x, &heavy);
    let solve = |x: &mut [f64]| x.copy_from_slice(&diagonal(x, &|i| stiff(i).recip()));
    let pencil = Pencil { size, stiffness: &stiffness, solve: &solve, mass: &mass };
    let found = pencil.largest(4).unwrap();
    assert_eq!(found.len(), 4);
    for (x, expected) in found.iter().zip([0, 1, 3, 4].map(|i| 4f64.powi(-i))) {
        let value = dot(x, &mass(x)) / dot(x, &stiffness(x));
        assert!((value / expected - 1.0).abs() < 1e-6, "{value} and not {expected}");
    }
    assert_eq!(pencil.largest(size).unwrap().len(), 12);
}
