//! GMRES: linear systems given by products with vectors alone.

use super::arnoldi::{extended, norm, scaled};
use super::watch;

/// Result of an iteration.
#[derive(Clone, Debug, PartialEq)]
pub struct Solved {
    /// The solution reached.
    pub x: Vec<f64>,
    /// `|b − A x|/|b|`.
    pub residual: f64,
    /// Products with the matrix.
    pub products: usize,
}

/// Restarts, each from the residual that the rounding of the one before has left.
const RESTARTS: usize = 4;

/// Solves `A x = b` by the method of generalised minimal residuals (GMRES) `[@saad1986]`, from a start, until the residual is below
/// `tolerance`, or stays as it is, or `most` vectors span the Krylov space.
pub fn gmres(
    times: impl Fn(&[f64]) -> Vec<f64>,
    right: &[f64],
    start: Vec<f64>,
    tolerance: f64,
    most: usize,
) -> Solved {
    let size = norm(right);
    let mut solved = Solved { x: start, residual: f64::INFINITY, products: 0 };
    if size == 0.0 {
        return Solved { x: vec![0.0; right.len()], residual: 0.0, products: 0 };
    }
    for _ in 0..=RESTARTS {
        let image = times(&solved.x);
        solved.products += 1;
        let gap: Vec<f64> = right.iter().zip(&image).map(|(b, image)| b - image).collect();
        let left = norm(&gap) / size;
        let settled = !(left < 0.5 * solved.residual);
        solved.residual = left;
        if left <= tolerance || settled {
            break;
        }
        let (change, products) = correction(&times, gap, 0.1 * tolerance / left, most);
        solved.products += products;
        solved.x.iter_mut().zip(change).for_each(|(x, change)| *x += change);
    }
    solved
}

/// The vector of a Krylov space of `gap` that fits `A x = gap` best, and the number of products.
fn correction(
    times: impl Fn(&[f64]) -> Vec<f64>,
    gap: Vec<f64>,
    tolerance: f64,
    most: usize,
) -> (Vec<f64>, usize) {
    let size = norm(&gap);
    let mut basis = vec![scaled(gap, size)];
    // Columns of the triangle, the rotations that made it, and the rotated right-hand side.
    let (mut triangle, mut rotations, mut sides) =
        (Vec::<Vec<f64>>::new(), Vec::<[f64; 2]>::new(), vec![size]);
    for column in 0..most {
        watch::ask();
        let (mut entries, next) = extended(&basis, times(&basis[column]));
        for (row, [cosine, sine]) in rotations.iter().enumerate() {
            let [upper, lower] = [entries[row], entries[row + 1]];
            entries[row] = cosine * upper + sine * lower;
            entries[row + 1] = cosine * lower - sine * upper;
        }
        let [upper, lower] = [entries[column], entries[column + 1]];
        let length = upper.hypot(lower);
        if !(length > 0.0) {
            break;
        }
        let [cosine, sine] = [upper / length, lower / length];
        entries[column] = length;
        rotations.push([cosine, sine]);
        let side = sides[column];
        sides[column] = cosine * side;
        sides.push(-sine * side);
        triangle.push(entries);
        if sides[column + 1].abs() <= tolerance * size || !(lower > f64::EPSILON * length) {
            break;
        }
        basis.push(next);
    }
    (combined(&basis, &triangle, &sides), triangle.len())
}

/// The combination of the basis that solves the triangle.
fn combined(basis: &[Vec<f64>], triangle: &[Vec<f64>], sides: &[f64]) -> Vec<f64> {
    let mut shares = sides[..triangle.len()].to_vec();
    for column in (0..triangle.len()).rev() {
        shares[column] /= triangle[column][column];
        let share = shares[column];
        shares[..column].iter_mut().zip(&triangle[column]).for_each(|(left, entry)| *left -= share * entry);
    }
    let mut sum = vec![0.0; basis[0].len()];
    for (v, share) in basis.iter().zip(shares) {
        sum.iter_mut().zip(v).for_each(|(sum, v)| *sum += share * v);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::krylov::dot;

    const A: [[f64; 4]; 4] =
        [[2.0, -1.0, 0.3, 0.0], [4.0, 1.0, 0.0, -0.5], [0.0, 7.0, -3.0, 1.0], [0.2, 0.0, 1.0, 5.0]];

    #[test]
    fn a_matrix_without_symmetry_is_solved_in_as_many_products_as_rows() {
        let times = |x: &[f64]| A.iter().map(|row| dot(row, x)).collect::<Vec<_>>();
        let x = [1.0, -2.0, 0.5, 3.0];
        let solved = gmres(times, &times(&x), vec![0.3; 4], 1e-14, 4);
        assert!(solved.x.iter().zip(x).all(|(found, x)| (found - x).abs() < 1e-13), "{solved:?}");
        assert!(solved.residual < 1e-14 && solved.products <= 10, "{solved:?}");
    }

    #[test]
    fn a_singular_system_keeps_its_residual() {
        let times = |x: &[f64]| vec![x[0], 0.0];
        let solved = gmres(times, &[1.0, 1.0], vec![0.0; 2], 1e-12, 2);
        assert!((solved.residual - 0.5_f64.sqrt()).abs() < 1e-12, "{solved:?}");
    }
}
