//! Viscous flow in an ellipsoid: polynomials that are solenoidal and zero on the wall, from the null space of the divergence.
//! A polynomial force drives a polynomial flow two degrees higher, so the response is exact and needs no mesh.
//! Equations (L7) and (L8), docs/theory/13-inside.md.

use std::f64::consts::TAU;

use nalgebra::{DMatrix, DVector};

use super::liquid::Liquid;
use crate::flow::Velocity;
use crate::math::polynomial::monomial::{exponents, place};
use crate::math::quadrature::gauss_legendre;

/// Polynomial flows in an ellipsoid, `u = (1 − ξ²) v(ξ)` with `ξ_i = x_i/a_i`. A force that is a polynomial drives a flow that is one two
/// degrees higher, so every response of the liquid is exact. (L7)
pub(super) struct EllipsoidFlow {
    friction: DMatrix<f64>,
    mass: DMatrix<f64>,
    turned: [DMatrix<f64>; 3],
    loads: [DVector<f64>; 3],
    semi_axes: [f64; 3],
    degree: usize,
    flows: Vec<Flow>,
}

/// Parities of the flows that the spin drives, and of those into which it rotates them: a component is odd in the other coordinates where
/// their class is 1, and in its own where that is 0.
const CLASSES: [[usize; 3]; 4] = [[0, 0, 0], [0, 1, 1], [1, 0, 1], [1, 1, 0]];
/// Singular values of the divergence, as a share of the largest, below which they are zero.
const ZERO: f64 = 1e-9;

/// Points of quadrature along the radius of the ball, and along its axis.
const RADII: usize = 8;

/// A vector field: coefficients of the monomials of each component.
type Flow = [DVector<f64>; 3];

impl EllipsoidFlow {
    /// Flows up to a degree in an ellipsoid with these semi-axes: degree 3 holds the slow response, and each step of a chain needs two
    /// more. None if they are linearly dependent up to rounding.
    pub fn new(semi_axes: [f64; 3], degree: usize) -> Option<Self> {
        let flows: Vec<Flow> =
            CLASSES.iter().flat_map(|class| solenoidal(semi_axes, degree - 2, *class)).collect();
        let moments = moments(semi_axes, degree);
        let parts = [0, 1, 2].map(|axis| columns(&flows, |flow| flow[axis].clone()));
        let images = parts.each_ref().map(|part| &moments * part);
        let rows = parts.each_ref().map(DMatrix::transpose);
        let mass = &rows[0] * &images[0] + &rows[1] * &images[1] + &rows[2] * &images[2];
        // (e × u)_b = −u_c and (e × u)_c = u_b for axes e, b, c in their cycle.
        let cycles = [(1, 2), (2, 0), (0, 1)];
        let turned = cycles.map(|(b, c)| &rows[c] * &images[b] - &rows[b] * &images[c]);
        let coordinates = [0, 1, 2].map(|axis| &moments * linear(axis, semi_axes[axis], moments.nrows()));
        let loads = cycles.map(|(b, c)| &rows[c] * &coordinates[b] - &rows[b] * &coordinates[c]);
        let mut friction = DMatrix::zeros(flows.len(), flows.len());
        for (i, j) in (0..9).map(|entry| (entry / 3, entry % 3)) {
            let slopes = columns(&flows, |flow| slope(&flow[i], j, degree) / semi_axes[j]);
            friction += slopes.transpose() * (&moments * &slopes);
        }
        Some(Self { friction, mass, turned, loads, semi_axes, degree, flows })
    }
}

impl Liquid for EllipsoidFlow {
    fn load(&self, axis: usize) -> Vec<f64> {
        self.loads[axis].as_slice().to_vec()
    }

    fn flows(&self, loads: &[Vec<f64>], rate: f64) -> Option<Vec<Vec<f64>>> {
        let factor = (&self.friction + rate * &self.mass).cholesky()?;
        let solved = |load: &Vec<f64>| factor.solve(&DVector::from_column_slice(load));
        Some(loads.iter().map(|load| solved(load).as_slice().to_vec()).collect())
    }

    fn friction(&self, u: &[f64]) -> Vec<f64> {
        times(&self.friction, u)
    }

    fn mass(&self, u: &[f64]) -> Vec<f64> {
        times(&self.mass, u)
    }

    fn turned(&self, axis: usize, u: &[f64]) -> Vec<f64> {
        times(&self.turned[axis], u)
    }

    fn sample(&self, flows: &[Vec<f64>], visit: &mut dyn FnMut(f64, &[Velocity])) {
        let polynomials: Vec<[DVector<f64>; 12]> = flows.iter().map(|u| self.with_slopes(u)).collect();
        let monomials: Vec<[usize; 3]> = all(self.degree).collect();
        let volume: f64 = self.semi_axes.iter().product();
        for (share, xi) in ball() {
            let powers =
                monomials.iter().map(|powers| (0..3).map(|i| xi[i].powi(powers[i] as i32)).product());
            let powers = DVector::<f64>::from_iterator(monomials.len(), powers);
            let velocity = |parts: &[DVector<f64>; 12]| {
                let value = |part: usize| parts[part].dot(&powers);
                let gradient = [0, 1, 2].map(|i| [0, 1, 2].map(|k| value(3 + 3 * i + k)));
                Velocity { u: [0, 1, 2].map(value), gradient }
            };
            visit(volume * share, &polynomials.iter().map(velocity).collect::<Vec<_>>());
        }
    }
}

impl EllipsoidFlow {
    /// Components of a flow, then their slopes `∂u_i/∂x_k` row by row.
    fn with_slopes(&self, u: &[f64]) -> [DVector<f64>; 12] {
        let flow: Flow = std::array::from_fn(|axis| {
            let sum = DVector::zeros(count(self.degree));
            self.flows.iter().zip(u).fold(sum, |sum, (flow, share)| sum + *share * &flow[axis])
        });
        std::array::from_fn(|part| match part.checked_sub(3) {
            None => flow[part].clone(),
            Some(entry) => slope(&flow[entry / 3], entry % 3, self.degree) / self.semi_axes[entry % 3],
        })
    }
}

/// Points of the unit ball with their shares of the volume, exact for products of three slow flows and beyond.
fn ball() -> impl Iterator<Item = (f64, [f64; 3])> {
    let along = || gauss_legendre(RADII).into_iter();
    let angles = 2 * RADII;
    along().flat_map(move |[x, weight]| {
        let (r, weight) = (0.5 * (1.0 + x), 0.5 * weight);
        along().flat_map(move |[cosine, height]| {
            let sine = (1.0 - cosine * cosine).sqrt();
            let share = weight * r * r * height * TAU / angles as f64;
            (0..angles).map(move |i| {
                let (y, x) = (TAU * i as f64 / angles as f64).sin_cos();
                (share, [r * sine * x, r * sine * y, r * cosine])
            })
        })
    })
}

fn times(matrix: &DMatrix<f64>, u: &[f64]) -> Vec<f64> {
    (matrix * DVector::from_column_slice(u)).as_slice().to_vec()
}

/// Solenoidal flows of a class with `v` of a degree: the null space of the divergence.
fn solenoidal(semi_axes: [f64; 3], degree: usize, class: [usize; 3]) -> Vec<Flow> {
    let parity = |component: usize, axis: usize| class[axis] ^ usize::from(component == axis);
    let fits = |component: usize, monomial: &[usize; 3]| {
        (0..3).all(|axis| monomial[axis] % 2 == parity(component, axis))
    };
    let unknowns: Vec<(usize, [usize; 3])> = (0..3)
        .flat_map(|component| {
            all(degree).filter(move |monomial| fits(component, monomial)).map(move |m| (component, m))
        })
        .collect();
    let size = count(degree + 2);
    let field = |(component, monomial): &(usize, [usize; 3])| {
        let mut coefficients = DVector::zeros(size);
        coefficients[place(*monomial)] += 1.0;
        for axis in 0..3 {
            let mut higher = *monomial;
            higher[axis] += 2;
            coefficients[place(higher)] -= 1.0;
        }
        (*component, coefficients)
    };
    let fields: Vec<(usize, DVector<f64>)> = unknowns.iter().map(field).collect();
    let divergences: Vec<DVector<f64>> = fields
        .iter()
        .map(|(component, coefficients)| slope(coefficients, *component, degree + 2) / semi_axes[*component])
        .collect();
    kernel(&divergences)
        .into_iter()
        .map(|shares| {
            let mut flow: Flow = std::array::from_fn(|_| DVector::zeros(size));
            for ((component, coefficients), share) in fields.iter().zip(shares.iter()) {
                flow[*component].axpy(*share, coefficients, 1.0);
            }
            flow
        })
        .collect()
}

/// Combinations of the columns that vanish, orthonormal.
fn kernel(columns: &[DVector<f64>]) -> Vec<DVector<f64>> {
    let count = columns.len();
    let significant: Vec<usize> = (0..columns.first().map_or(0, |column| column.len()))
        .filter(|row| columns.iter().any(|column| column[*row] != 0.0))
        .collect();
    // Rows of zeros fill the matrix up, so that the decomposition has all of the null space.
    let matrix = DMatrix::from_fn(count.max(significant.len()), count, |row, column| {
        significant.get(row).map_or(0.0, |row| columns[column][*row])
    });
    let Some(svd) = matrix.try_svd(false, true, f64::EPSILON, 0) else { return Vec::new() };
    let Some(directions) = svd.v_t else { return Vec::new() };
    let largest = svd.singular_values.max();
    let empty = svd.singular_values.iter().enumerate().filter(|(_, value)| **value <= ZERO * largest);
    empty.map(|(row, _)| directions.row(row).transpose()).collect()
}

/// Monomials up to a degree, in the order of their places.
fn all(degree: usize) -> impl Iterator<Item = [usize; 3]> {
    (0..=degree).flat_map(exponents)
}

fn count(degree: usize) -> usize {
    (degree + 1) * (degree + 2) * (degree + 3) / 6
}

fn linear(axis: usize, factor: f64, size: usize) -> DVector<f64> {
    let mut exponents = [0; 3];
    exponents[axis] = 1;
    let mut coefficients = DVector::zeros(size);
    coefficients[place(exponents)] = factor;
    coefficients
}

/// `∂/∂ξ_axis` of a polynomial of a degree.
fn slope(coefficients: &DVector<f64>, axis: usize, degree: usize) -> DVector<f64> {
    let mut slope = DVector::zeros(coefficients.len());
    for monomial in all(degree).filter(|monomial| monomial[axis] > 0) {
        let mut lower = monomial;
        lower[axis] -= 1;
        slope[place(lower)] += monomial[axis] as f64 * coefficients[place(monomial)];
    }
    slope
}

/// A vector of each flow, a column each.
fn columns(flows: &[Flow], vector: impl Fn(&Flow) -> DVector<f64>) -> DMatrix<f64> {
    DMatrix::from_columns(&flows.iter().map(vector).collect::<Vec<_>>())
}

/// `∫ξ^α ξ^β dV` over the ellipsoid, for monomials up to a degree.
fn moments(semi_axes: [f64; 3], degree: usize) -> DMatrix<f64> {
    let volume: f64 = semi_axes.iter().product();
    let odd = |n: usize| (1..=n).rev().step_by(2).map(|factor| factor as f64).product::<f64>();
    let moment = |[i, j, k]: [usize; 3]| {
        let total = i + j + k;
        // ∫ = 4π (i−1)!!(j−1)!!(k−1)!! / ((n+1)!! (n+3)), n = i + j + k, of even powers.
        let doubles = [i, j, k].map(|n| odd(n.saturating_sub(1))).iter().product::<f64>();
        4.0 * std::f64::consts::PI * doubles / (odd(total + 1) * (total + 3) as f64)
    };
    let list: Vec<[usize; 3]> = all(degree).collect();
    DMatrix::from_fn(list.len(), list.len(), |row, column| {
        let sum: [usize; 3] = std::array::from_fn(|axis| list[row][axis] + list[column][axis]);
        if sum.iter().all(|power| power % 2 == 0) { volume * moment(sum) } else { 0.0 }
    })
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::kinds::cavity::liquid::{Memory, Relaxations};

    /// `P` of an ellipsoid about its first axis; Chernousko's tensor in closed form. (L8)
    fn closed_form([a, b, c]: [f64; 3]) -> f64 {
        let [a2, b2, c2] = [a, b, c].map(|x| x * x);
        let sum = 3.0 * a2 * b2 * b2 + 2.0 * a2 * b2 * c2 + 3.0 * a2 * c2 * c2 + b2 * b2 * c2 + b2 * c2 * c2;
        16.0 * PI * a.powi(3) * b.powi(5) * c.powi(5) / (105.0 * sum)
    }

    #[test]
    fn the_slow_tensor_is_that_of_the_closed_form() {
        for semi_axes in [[1.0, 1.0, 1.0], [0.6, 0.45, 0.3], [2e-3, 7e-3, 3e-3]] {
            for (depth, degree) in [(1, 3), (2, 5), (1, 9)] {
                let flow = EllipsoidFlow::new(semi_axes, degree).unwrap();
                let found = Relaxations::of(&flow, Memory { depth, modes: 0 }, 1.0).unwrap().slow_tensor();
                let [a, b, c] = semi_axes;
                let exact = [[a, b, c], [b, c, a], [c, a, b]].map(closed_form);
                for row in 0..3 {
                    for column in 0..3 {
                        let expected = if row == column { exact[row] } else { 0.0 };
                        let gap = (found[(row, column)] - expected).abs();
                        assert!(gap < 1e-12 * exact[0].max(exact[2]), "{semi_axes:?}: {gap:e}");
                    }
                }
            }
        }
        assert!((closed_form([1.3; 3]) / (8.0 * PI * 1.3_f64.powi(7) / 525.0) - 1.0).abs() < 1e-14);
    }

    /// Relaxation times of the shells of a ball among those of all flows: `a²/(νk²)` with `tan k = k`.
    #[test]
    fn relaxations_of_a_ball_are_those_of_its_shells() {
        let flow = EllipsoidFlow::new([2.0; 3], 15).unwrap();
        let root = flow.friction.clone().cholesky().unwrap().l().try_inverse().unwrap();
        let times = (&root * &flow.mass * root.transpose()).symmetric_eigenvalues();
        for k in [4.493_409_457_909_064_f64, 7.725_251_836_937_707] {
            let same = times.iter().filter(|time| (*time * k * k / 4.0 - 1.0).abs() < 1e-6);
            assert_eq!(same.count(), 3, "{k}");
        }
    }
}
