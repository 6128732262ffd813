//! Nonlinear least squares by the method of Levenberg and Marquardt, with the singular values that tell what the residuals do not see.
//! Jacobians are central differences, so that any computation can be fitted; many points at once go to the function, which may share them among
//! threads.

use nalgebra::{DMatrix, DVector};

/// Step of the differences: parameters are of the order of one.
const STEP: f64 = 1e-4;
/// Iterations at most.
const ITERATIONS: usize = 60;
/// Relative fall of the sum of squares, and step, that end the search.
const FLAT: f64 = 1e-10;
const SHORT: f64 = 1e-9;
/// Step and cosine between residuals and columns of the Jacobian below which a place where no step falls is a minimum.
const LEVEL: f64 = 1e-3;
const STILL: f64 = 1e-6;
/// Damping at the start, of an accepted step and of a refused one, and the most.
const FIRST: f64 = 1e-3;
const EASED: f64 = 0.2;
const TIGHTENED: f64 = 5.0;
const MOST: f64 = 1e12;

/// Residuals at each of some points; none where there are none.
pub type Residuals<'a> = dyn FnMut(&[Vec<f64>]) -> Vec<Option<Vec<f64>>> + 'a;

/// Least squares that were found.
#[derive(Clone, Debug, PartialEq)]
pub struct LeastSquares {
    /// Parameters.
    pub parameters: Vec<f64>,
    /// Residuals there.
    pub residuals: Vec<f64>,
    /// Sum of their squares.
    pub square: f64,
    /// Singular values of the Jacobian, descending.
    pub singular: Vec<f64>,
    /// Combination of the parameters that belongs to each, of unit length.
    pub combinations: Vec<Vec<f64>>,
    /// Whether the search ended at a minimum.
    pub converged: bool,
}

/// Searches for the least squares from a start, whose parameters are of the order of one; none where the start or its neighbours have no
/// residuals.
#[must_use]
pub fn least_squares(start: &[f64], residuals: &mut Residuals<'_>) -> Option<LeastSquares> {
    let mut x = start.to_vec();
    let mut r = DVector::from_vec(residuals(std::slice::from_ref(&x)).pop()??);
    let (mut damping, mut converged) = (FIRST, false);
    let mut J = jacobian(&x, r.len(), residuals)?;
    for _ in 0..ITERATIONS {
        let Some((next, found)) = step(&J, &r, &x, &mut damping, residuals) else {
            converged = is_level(&J, &r);
            break;
        };
        let (before, after) = (r.norm_squared(), found.norm_squared());
        let moved = next.iter().zip(&x).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        (x, r) = (next, found);
        J = jacobian(&x, r.len(), residuals)?;
        if before - after <= FLAT * before || moved <= SHORT {
            converged = true;
            break;
        }
    }
    let svd = J.svd(false, true);
    let combinations = svd.v_t?.row_iter().map(|row| row.iter().copied().collect()).collect();
    Some(LeastSquares {
        square: r.norm_squared(),
        parameters: x,
        residuals: r.as_slice().to_vec(),
        singular: svd.singular_values.as_slice().to_vec(),
        combinations,
        converged,
    })
}

/// A step along which the squares fall; none where even the shortest does not.
fn step(
    J: &DMatrix<f64>,
    r: &DVector<f64>,
    x: &[f64],
    damping: &mut f64,
    residuals: &mut Residuals<'_>,
) -> Option<(Vec<f64>, DVector<f64>)> {
    let (normal, gradient) = (J.tr_mul(J), J.tr_mul(r));
    while *damping < MOST {
        let next = downhill(&normal, &gradient, *damping)
            .map(|delta| x.iter().zip(delta.iter()).map(|(x, d)| x - d).collect::<Vec<f64>>());
        let found = next.and_then(|next| Some((residuals(std::slice::from_ref(&next)).pop()??, next)));
        if let Some((found, next)) = found {
            let found = DVector::from_vec(found);
            if found.norm_squared() < r.norm_squared() {
                *damping *= EASED;
                return Some((next, found));
            }
        }
        *damping *= TIGHTENED;
    }
    None
}

/// What a damped step of the normal equations takes off the parameters.
fn downhill(normal: &DMatrix<f64>, gradient: &DVector<f64>, damping: f64) -> Option<DVector<f64>> {
    let (mut damped, diagonal) = (normal.clone(), normal.diagonal());
    for (i, own) in diagonal.iter().enumerate() {
        damped[(i, i)] += damping * own.max(1e-12 * diagonal.amax());
    }
    damped.cholesky().map(|factor| factor.solve(gradient))
}

/// Whether the linear problem falls no further: its step is short, or the residuals are normal to every column.
fn is_level(J: &DMatrix<f64>, r: &DVector<f64>) -> bool {
    let short = downhill(&J.tr_mul(J), &J.tr_mul(r), FIRST).is_some_and(|delta| delta.amax() <= STILL);
    short || J.column_iter().all(|column| column.dot(r).abs() <= LEVEL * column.norm() * r.norm())
}

fn jacobian(x: &[f64], rows: usize, residuals: &mut Residuals<'_>) -> Option<DMatrix<f64>> {
    let shifted = |index: usize, step: f64| {
        let mut point = x.to_vec();
        point[index] += step;
        point
    };
    let points: Vec<Vec<f64>> = (0..x.len()).flat_map(|i| [shifted(i, STEP), shifted(i, -STEP)]).collect();
    let found = residuals(&points).into_iter().collect::<Option<Vec<_>>>()?;
    let entry =
        |row: usize, column: usize| (found[2 * column][row] - found[2 * column + 1][row]) / (2.0 * STEP);
    Some(DMatrix::from_fn(rows, x.len(), entry))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn each(f: impl Fn(&[f64]) -> Option<Vec<f64>>) -> impl FnMut(&[Vec<f64>]) -> Vec<Option<Vec<f64>>> {
        move |points| points.iter().map(|point| f(point)).collect()
    }

    /// A decaying oscillation from a start a third off.
    #[test]
    fn parameters_of_exact_data_are_found() {
        let of = |a: f64, d: f64, w: f64, t: f64| a * (-d * t).exp() * (w * t).cos();
        let mut residuals = each(|x: &[f64]| {
            let times = (0..200).map(|k| 0.1 * f64::from(k));
            Some(times.map(|t| of(x[0], 0.1 * x[1], x[2], t) - of(1.2, 0.08, 1.1, t)).collect())
        });
        let found = least_squares(&[0.9, 1.1, 1.05], &mut residuals).unwrap();
        for (found, known) in found.parameters.iter().zip([1.2, 0.8, 1.1]) {
            assert!((found - known).abs() < 1e-8, "{found} {known}");
        }
        assert!(found.converged && found.square < 1e-14);
    }

    /// Rosenbrock's valley.
    #[test]
    fn a_curved_valley_is_followed() {
        let mut residuals = each(|x: &[f64]| Some(vec![10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]]));
        let found = least_squares(&[-1.2, 1.0], &mut residuals).unwrap();
        assert!(found.parameters.iter().all(|x| (x - 1.0).abs() < 1e-7), "{found:?}");
    }

    /// Only the product of two parameters is seen: the combination that is not has a singular value of zero.
    #[test]
    fn combinations_that_are_not_seen_have_no_singular_value() {
        let mut residuals =
            each(|x: &[f64]| Some((1..20).map(|k| f64::from(k) * (x[0] * x[1] - 2.0)).collect()));
        let found = least_squares(&[1.5, 1.5], &mut residuals).unwrap();
        assert!((found.parameters[0] * found.parameters[1] - 2.0).abs() < 1e-9);
        assert!(found.singular[1] < 1e-7 * found.singular[0], "{:?}", found.singular);
        let [a, b] = found.combinations[1][..] else { panic!() };
        assert!((a * found.parameters[1] + b * found.parameters[0]).abs() < 1e-6);
    }

    /// Every step is refused, though the squares would fall by a factor.
    #[test]
    fn a_search_that_no_step_leaves_has_not_converged() {
        let near = |x: f64| x == 1.0 || (x - 1.0).abs() > 0.99e-4 && (x - 1.0).abs() < 1.01e-4;
        let mut residuals = each(|x: &[f64]| near(x[0]).then(|| vec![1e5 * (x[0] - 1.0).powi(2) + x[0]]));
        let found = least_squares(&[1.0], &mut residuals).unwrap();
        assert!(!found.converged, "{found:?}");
    }

    #[test]
    fn points_without_residuals_are_stepped_back_from() {
        let mut residuals = each(|x: &[f64]| (x[0] > 0.0).then(|| vec![x[0].ln() + 3.0]));
        let found = least_squares(&[1.0], &mut residuals).unwrap();
        assert!((found.parameters[0] / (-3.0_f64).exp() - 1.0).abs() < 1e-4, "{found:?}");
        assert!(least_squares(&[-1.0], &mut residuals).is_none());
    }
}
