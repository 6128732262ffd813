//! Arnoldi's step: an orthonormal basis of a Krylov space, one vector longer.

use super::krylov::dot;

/// Components of a vector along an orthonormal basis and beyond it, and the next vector of the basis; the rest as it is where nothing lies beyond.
#[must_use]
pub fn extended(basis: &[Vec<f64>], mut image: Vec<f64>) -> (Vec<f64>, Vec<f64>) {
    let mut entries = vec![0.0; basis.len() + 1];
    for _ in 0..2 {
        for (entry, v) in entries.iter_mut().zip(basis) {
            let share = dot(v, &image);
            image.iter_mut().zip(v).for_each(|(x, v)| *x -= share * v);
            *entry += share;
        }
    }
    let left = norm(&image);
    entries[basis.len()] = left;
    let next = if left > 0.0 { scaled(image, left) } else { image };
    (entries, next)
}

/// Euclidean norm.
#[must_use]
pub fn norm(x: &[f64]) -> f64 {
    dot(x, x).sqrt()
}

/// Vector over a length.
#[must_use]
pub fn scaled(mut x: Vec<f64>, size: f64) -> Vec<f64> {
    x.iter_mut().for_each(|entry| *entry /= size);
    x
}
