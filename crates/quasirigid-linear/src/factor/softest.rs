//! The softest direction of a matrix, which tells whether it is positive definite.

use super::NotPositive;
use super::structure::Structure;
use super::triangle::Triangle;
use crate::symmetric::Symmetric;

/// Quadratic forms below this, for a unit diagonal, are rounding.
const SINGULAR: f64 = 1e-13;
/// After two inverse iterations a form above this excludes a singular direction: such a direction would have grown
/// 10⁸ times as much.
const SAFE: f64 = 1e-9;
/// Steps of inverse iteration; each gains the ratio of the two smallest eigenvalues.
const INVERSE_ITERATIONS: usize = 8;
/// Shift that makes a singular matrix factorable when its null direction is looked for.
const SHIFT: f64 = 1e-11;
/// Ratio of one shift to the next while the matrix stays indefinite.
const GROWTH: f64 = 10.0;

/// Refuses a matrix whose softest direction has no stiffness; `solve` is `(S A S)⁻¹ x` in place. Returns false if
/// `solve` fails.
pub(crate) fn verdict(
    matrix: &Symmetric,
    scale: &[f64],
    solve: impl FnMut(&mut [f64]) -> bool,
) -> Result<bool, NotPositive> {
    match softest(matrix, scale, solve) {
        None => Ok(false),
        Some((form, _)) if form > SINGULAR => Ok(true),
        Some((_, direction)) => Err(NotPositive { direction }),
    }
}

/// A direction in which a matrix that has no factor is not positive.
pub(crate) fn refusal(matrix: &Symmetric, structure: &Structure, scale: &[f64]) -> NotPositive {
    let mut shift = SHIFT;
    // For a unit diagonal no shift beyond the number of unknowns is needed.
    while shift < GROWTH * scale.len() as f64 {
        if let Some(factor) = Triangle::<f64>::new(structure.clone(), matrix, scale, shift) {
            let solve = |x: &mut [f64]| {
                factor.solve(x, 1);
                true
            };
            if let Some((_, direction)) = softest(matrix, scale, solve) {
                return NotPositive { direction };
            }
        }
        shift *= GROWTH;
    }
    NotPositive { direction: vec![1.0; scale.len()] }
}

/// Smallest quadratic form of the scaled matrix over unit vectors, by inverse iteration, and the unscaled vector
/// that has it.
fn softest(
    matrix: &Symmetric,
    scale: &[f64],
    mut solve: impl FnMut(&mut [f64]) -> bool,
) -> Option<(f64, Vec<f64>)> {
    let mut x: Vec<f64> = (0..scale.len()).map(|row| 1.0 + 0.5 * (row as f64).sin()).collect();
    let mut softest = (f64::NEG_INFINITY, Vec::new());
    for step in 0..INVERSE_ITERATIONS {
        if !solve(&mut x) {
            return None;
        }
        let norm = x.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
        x.iter_mut().for_each(|entry| *entry /= norm);
        if step == 0 {
            continue;
        }
        let unscaled: Vec<f64> = x.iter().zip(scale).map(|(entry, scale)| entry * scale).collect();
        let form = unscaled.iter().zip(matrix.times(&unscaled)).map(|(a, b)| a * b).sum();
        softest = (form, unscaled);
        if form > SAFE {
            break;
        }
    }
    let (form, direction) = softest;
    let largest = direction.iter().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
    Some((form, direction.iter().map(|entry| entry / largest).collect()))
}
