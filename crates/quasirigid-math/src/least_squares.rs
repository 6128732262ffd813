//! Nonlinear least squares within bounds by the method of Levenberg and Marquardt, with the Jacobian that tells what the residuals see.
//! Jacobians are finite differences, so that any computation can be fitted; many points at once go to the function, which may share them among
//! threads.

use nalgebra::{DMatrix, DVector};

/// Step of the differences, relative to the parameter; the least size of a parameter that may be zero, and of one that keeps its sign.
const STEP: f64 = 1e-4;
const SMALL: [f64; 2] = [1.0, 1e-3];
/// Iterations at most.
const ITERATIONS: usize = 60;
/// Relative fall of the sum of squares, and relative step, that end the search.
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
    /// Derivatives of the residuals, one list for each parameter.
    pub jacobian: Vec<Vec<f64>>,
    /// Parameters at a bound beyond which the squares would fall.
    pub held: Vec<bool>,
    /// Whether the search ended at a minimum.
    pub converged: bool,
}

/// Singular values of a Jacobian, which tell what its residuals see.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    /// Singular values, descending.
    pub singular: Vec<f64>,
    /// Combination of the parameters that belongs to each, of unit length.
    pub combinations: Vec<Vec<f64>>,
}

impl Spectrum {
    /// Singular values of a Jacobian of one list for each parameter; missing ones, where there are fewer residuals than parameters, are zero.
    #[must_use]
    pub fn of(jacobian: &[Vec<f64>]) -> Self {
        let count = jacobian.len();
        if count == 0 {
            return Self { singular: Vec::new(), combinations: Vec::new() };
        }
        let rows = jacobian.first().map_or(0, Vec::len).max(count);
        let entry = |row: usize, column: usize| jacobian[column].get(row).copied().unwrap_or(0.0);
        let svd = DMatrix::from_fn(rows, count, entry).svd(false, true);
        let combinations = svd.v_t.iter().flat_map(|v| v.row_iter().map(|row| row.iter().copied().collect()));
        Self { combinations: combinations.collect(), singular: svd.singular_values.as_slice().to_vec() }
    }
}

/// Searches for the least squares from a start, whose parameters are of the order of one and lie within their bounds; none where the start
/// or its neighbours have no residuals.
#[must_use]
pub fn least_squares(
    start: &[f64],
    bounds: &[[f64; 2]],
    residuals: &mut Residuals<'_>,
) -> Option<LeastSquares> {
    let mut x = start.to_vec();
    let mut r = DVector::from_vec(residuals(std::slice::from_ref(&x)).pop()??);
    let (mut damping, mut converged) = (FIRST, false);
    let mut J = jacobian_about(&x, &r, bounds, residuals)?;
    for _ in 0..ITERATIONS {
        let held = held(&x, bounds, &J.tr_mul(&r));
        let free = without(&J, &held);
        let Some((next, found)) = step(&free, &r, (&x, bounds), &mut damping, residuals) else {
            converged = is_level(&free, &r);
            break;
        };
        let (before, after) = (r.norm_squared(), found.norm_squared());
        let moved = next.iter().zip(&x).zip(bounds);
        let moved = moved.map(|((a, b), bound)| (a - b).abs() / size(*b, *bound)).fold(0.0, f64::max);
        (x, r) = (next, found);
        J = jacobian_about(&x, &r, bounds, residuals)?;
        if before - after <= FLAT * before || moved <= SHORT {
            converged = true;
            break;
        }
    }
    Some(LeastSquares {
        square: r.norm_squared(),
        held: held(&x, bounds, &J.tr_mul(&r)),
        parameters: x,
        residuals: r.as_slice().to_vec(),
        jacobian: J.column_iter().map(|column| column.iter().copied().collect()).collect(),
        converged,
    })
}

/// Derivatives of the residuals at a point within bounds, one list for each parameter; none where a neighbour has no residuals.
#[must_use]
pub fn jacobian(
    x: &[f64],
    r: &[f64],
    bounds: &[[f64; 2]],
    residuals: &mut Residuals<'_>,
) -> Option<Vec<Vec<f64>>> {
    let J = jacobian_about(x, &DVector::from_column_slice(r), bounds, residuals)?;
    Some(J.column_iter().map(|column| column.iter().copied().collect()).collect())
}

/// A step along which the squares fall; none where even the shortest does not.
fn step(
    J: &DMatrix<f64>,
    r: &DVector<f64>,
    (x, bounds): (&[f64], &[[f64; 2]]),
    damping: &mut f64,
    residuals: &mut Residuals<'_>,
) -> Option<(Vec<f64>, DVector<f64>)> {
    let (normal, gradient) = (J.tr_mul(J), J.tr_mul(r));
    while *damping < MOST {
        let next = downhill(&normal, &gradient, *damping).map(|delta| {
            let next = x.iter().zip(delta.iter()).zip(bounds);
            next.map(|((x, d), [low, high])| (x - d).clamp(*low, *high)).collect::<Vec<f64>>()
        });
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
    let least = (1e-12 * diagonal.amax()).max(f64::MIN_POSITIVE);
    for (i, own) in diagonal.iter().enumerate() {
        damped[(i, i)] += damping * own.max(least);
    }
    damped.cholesky().map(|factor| factor.solve(gradient))
}

/// Whether the linear problem falls no further: its step is short, or the residuals are normal to every column.
fn is_level(J: &DMatrix<f64>, r: &DVector<f64>) -> bool {
    let short = downhill(&J.tr_mul(J), &J.tr_mul(r), FIRST).is_some_and(|delta| delta.amax() <= STILL);
    short || J.column_iter().all(|column| column.dot(r).abs() <= LEVEL * column.norm() * r.norm())
}

/// Parameters at a bound that the gradient leads out of.
fn held(x: &[f64], bounds: &[[f64; 2]], gradient: &DVector<f64>) -> Vec<bool> {
    let each = x.iter().zip(bounds).zip(gradient.iter());
    each.map(|((x, [low, high]), g)| (x <= low && *g > 0.0) || (x >= high && *g < 0.0)).collect()
}

/// The Jacobian without the parameters that are held.
fn without(J: &DMatrix<f64>, held: &[bool]) -> DMatrix<f64> {
    let mut free = J.clone();
    for (i, _) in held.iter().enumerate().filter(|(_, held)| **held) {
        free.column_mut(i).fill(0.0);
    }
    free
}

/// Size of a parameter by which its steps are measured.
fn size(x: f64, [low, high]: [f64; 2]) -> f64 {
    let keeps_sign = low >= 0.0 || high <= 0.0;
    x.abs().max(SMALL[usize::from(keeps_sign)])
}

/// Step of the differences of a parameter, and whether both sides lie within its bounds: else it points inwards.
fn difference(x: f64, bound: [f64; 2]) -> (f64, bool) {
    let [low, high] = bound;
    let step = (STEP * size(x, bound)).min(0.25 * (high - low));
    let [below, above] = [x - step >= low, x + step <= high];
    (if above { step } else { -step }, below && above)
}

/// Central differences, of second order from one side beside a bound.
fn jacobian_about(
    x: &[f64],
    r: &DVector<f64>,
    bounds: &[[f64; 2]],
    residuals: &mut Residuals<'_>,
) -> Option<DMatrix<f64>> {
    let steps: Vec<(f64, bool)> = x.iter().zip(bounds).map(|(x, bound)| difference(*x, *bound)).collect();
    let shifted = |index: usize, step: f64| {
        let mut point = x.to_vec();
        point[index] += step;
        point
    };
    let two = |(i, (h, both)): (usize, &(f64, bool))| {
        [shifted(i, *h), shifted(i, if *both { -h } else { 2.0 * h })]
    };
    let points: Vec<Vec<f64>> = steps.iter().enumerate().flat_map(two).collect();
    let found = residuals(&points).into_iter().collect::<Option<Vec<_>>>()?;
    let entry = |row: usize, column: usize| {
        let ([one, other], (h, both)) = ([0, 1].map(|k| found[2 * column + k][row]), steps[column]);
        if both { (one - other) / (2.0 * h) } else { (4.0 * one - other - 3.0 * r[row]) / (2.0 * h) }
    };
    Some(DMatrix::from_fn(r.len(), x.len(), entry))
}

#[cfg(test)]
mod tests {
    use super::*;

    const FREE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

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
        let found = least_squares(&[0.9, 1.1, 1.05], &[FREE; 3], &mut residuals).unwrap();
        for (found, known) in found.parameters.iter().zip([1.2, 0.8, 1.1]) {
            assert!((found - known).abs() < 1e-8, "{found} {known}");
        }
        assert!(found.converged && found.square < 1e-14);
    }

    /// Rosenbrock's valley.
    #[test]
    fn a_curved_valley_is_followed() {
        let mut residuals = each(|x: &[f64]| Some(vec![10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]]));
        let found = least_squares(&[-1.2, 1.0], &[FREE; 2], &mut residuals).unwrap();
        assert!(found.parameters.iter().all(|x| (x - 1.0).abs() < 1e-7), "{found:?}");
    }

    /// Only the product of two parameters is seen: the combination that is not has a singular value of zero.
    #[test]
    fn combinations_that_are_not_seen_have_no_singular_value() {
        let mut residuals =
            each(|x: &[f64]| Some((1..20).map(|k| f64::from(k) * (x[0] * x[1] - 2.0)).collect()));
        let found = least_squares(&[1.5, 1.5], &[FREE; 2], &mut residuals).unwrap();
        assert!((found.parameters[0] * found.parameters[1] - 2.0).abs() < 1e-9);
        let Spectrum { singular, combinations } = Spectrum::of(&found.jacobian);
        assert!(singular[1] < 1e-7 * singular[0], "{singular:?}");
        let [a, b] = combinations[1][..] else { panic!() };
        assert!((a * found.parameters[1] + b * found.parameters[0]).abs() < 1e-6);
    }

    /// Every step is refused, though the squares would fall by a factor.
    #[test]
    fn a_search_that_no_step_leaves_has_not_converged() {
        let near = |x: f64| x == 1.0 || (x - 1.0).abs() > 0.99e-4 && (x - 1.0).abs() < 1.01e-4;
        let mut residuals = each(|x: &[f64]| near(x[0]).then(|| vec![1e5 * (x[0] - 1.0).powi(2) + x[0]]));
        let found = least_squares(&[1.0], &[FREE; 1], &mut residuals).unwrap();
        assert!(!found.converged, "{found:?}");
    }

    #[test]
    fn points_without_residuals_are_stepped_back_from() {
        let mut residuals = each(|x: &[f64]| (x[0] > 0.0).then(|| vec![x[0].ln() + 3.0]));
        let found = least_squares(&[1.0], &[FREE; 1], &mut residuals).unwrap();
        assert!((found.parameters[0] / (-3.0_f64).exp() - 1.0).abs() < 1e-4, "{found:?}");
        assert!(least_squares(&[-1.0], &[FREE; 1], &mut residuals).is_none());
    }

    /// The least of x² + y² + xy + x beyond y ≥ 1/2 is at the bound, with x = −3/4; that beyond y ≥ −1 is free, at (−2/3, 1/3).
    #[test]
    fn bounds_hold_the_parameters_that_would_cross_them() {
        let (a, b) = (0.75f64.sqrt(), 0.5f64);
        // x² + xy + y² + x = (y + x/2)² + (√¾ x + c)² − c², c = 1/(2 √¾)
        let mut residuals = each(|x: &[f64]| Some(vec![x[1] + b * x[0], a * x[0] + b / a]));
        let found = least_squares(&[1.0, 2.0], &[FREE, [0.5, 5.0]], &mut residuals).unwrap();
        assert!((found.parameters[0] + 0.75).abs() < 1e-8 && found.parameters[1] == 0.5, "{found:?}");
        assert!(found.converged && found.held == [false, true]);
        let found = least_squares(&[1.0, 2.0], &[FREE, [-1.0, 5.0]], &mut residuals).unwrap();
        assert!((found.parameters[0] + 2.0 / 3.0).abs() < 1e-8, "{found:?}");
        assert!((found.parameters[1] - 1.0 / 3.0).abs() < 1e-8 && found.held == [false; 2], "{found:?}");
    }

    /// A start ten thousand times too large or too small, of a parameter that keeps its sign.
    #[test]
    fn steps_are_relative_to_parameters_that_keep_their_sign() {
        let mut residuals = each(|x: &[f64]| (x[0] > 0.0).then(|| vec![2.0 / x[0] - 2.0]));
        for start in [1e4, 1e-4] {
            let found = least_squares(&[start], &[[0.0, f64::INFINITY]], &mut residuals).unwrap();
            assert!((found.parameters[0] - 1.0).abs() < 1e-8 && found.converged, "{found:?}");
        }
    }

    #[test]
    fn fewer_residuals_than_parameters_leave_singular_values_of_zero() {
        let found = Spectrum::of(&[vec![3.0], vec![4.0]]);
        assert!((found.singular[0] - 5.0).abs() < 1e-14 && found.singular[1].abs() < 1e-14, "{found:?}");
    }
}
