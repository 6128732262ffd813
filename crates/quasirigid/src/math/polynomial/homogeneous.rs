use super::monomial::{count, exponents, index};
use crate::math::scalar::Scalar;

/// Rows of homogeneous polynomials of one degree in three variables.
///
/// A vector field has three rows; a function of all internal coordinates has one row each. Coefficients stand row by
/// row, in the order of [`exponents`].
#[derive(Clone, Debug, PartialEq)]
pub struct Homogeneous {
    degree: usize,
    rows: usize,
    coefficients: Vec<f64>,
}

impl Homogeneous {
    /// Zero.
    #[must_use]
    pub fn zero(degree: usize, rows: usize) -> Self {
        Self { degree, rows, coefficients: vec![0.0; rows * count(degree)] }
    }

    /// The linear map with these rows.
    #[must_use]
    pub fn linear(rows: &[[f64; 3]]) -> Self {
        Self { degree: 1, rows: rows.len(), coefficients: rows.concat() }
    }

    /// The three variables themselves.
    #[must_use]
    pub fn identity() -> Self {
        Self::linear(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    }

    /// Quadratic forms `½ xᵀ S x`, one per row, from symmetric matrices given as xx, yy, zz, yz, zx, xy.
    #[must_use]
    pub fn half_quadratic(matrices: &[[f64; 6]]) -> Self {
        let mut forms = Self::zero(2, matrices.len());
        for (row, [xx, yy, zz, yz, zx, xy]) in matrices.iter().enumerate() {
            forms.row_mut(row).copy_from_slice(&[0.5 * xx, *xy, *zx, 0.5 * yy, *yz, 0.5 * zz]);
        }
        forms
    }

    /// Degree.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Coefficients of a row.
    #[must_use]
    pub fn row(&self, row: usize) -> &[f64] {
        let width = count(self.degree);
        &self.coefficients[row * width..(row + 1) * width]
    }

    /// Coefficients of a row, to change.
    pub fn row_mut(&mut self, row: usize) -> &mut [f64] {
        let width = count(self.degree);
        &mut self.coefficients[row * width..(row + 1) * width]
    }

    /// Every monomial with its coefficient in each row.
    pub fn terms(&self) -> impl Iterator<Item = ([usize; 3], Vec<f64>)> + '_ {
        exponents(self.degree)
            .enumerate()
            .map(|(term, monomial)| (monomial, (0..self.rows).map(|row| self.row(row)[term]).collect()))
    }

    /// Coefficients of a row of this degree: [`count`] of them.
    #[must_use]
    pub fn width(degree: usize) -> usize {
        count(degree)
    }

    /// All coefficients, row by row, to change.
    pub fn coefficients_mut(&mut self) -> &mut [f64] {
        &mut self.coefficients
    }

    /// Multiplies by a number.
    pub fn scale(&mut self, factor: f64) {
        self.coefficients.iter_mut().for_each(|c| *c *= factor);
    }

    /// Adds a multiple of a row of another map of the same degree to a row.
    pub fn add_row(&mut self, row: usize, factor: f64, (other, other_row): (&Self, usize)) {
        debug_assert_eq!(self.degree, other.degree);
        axpy(self.row_mut(row), factor, other.row(other_row));
    }

    /// Largest coefficient, in absolute value.
    #[must_use]
    pub fn amax(&self) -> f64 {
        self.coefficients.iter().fold(0.0, |largest, c| largest.max(c.abs()))
    }

    /// Whether every coefficient is a finite number.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.coefficients.iter().all(|c| c.is_finite())
    }

    /// Adds a multiple of another map of the same degree and rows.
    pub fn add_scaled(&mut self, factor: f64, other: &Self) {
        debug_assert_eq!((self.degree, self.rows), (other.degree, other.rows));
        axpy(&mut self.coefficients, factor, &other.coefficients);
    }

    /// Adds `factor · a · b` to a row, where `a` and `b` are rows of other maps whose degrees add up to this one.
    pub fn add_product(
        &mut self,
        row: usize,
        factor: f64,
        (a, row_a): (&Self, usize),
        (b, row_b): (&Self, usize),
    ) {
        debug_assert_eq!(self.degree, a.degree + b.degree);
        let (left, right) = (a.row(row_a), b.row(row_b));
        let out = self.row_mut(row);
        for (r, block) in blocks(a.degree, left) {
            for (k, c) in block.iter().enumerate().filter(|(_, c)| **c != 0.0) {
                for (other, along) in blocks(b.degree, right) {
                    let start = index([0, r + other - k, k]);
                    axpy(&mut out[start..start + along.len()], factor * c, along);
                }
            }
        }
    }

    /// `matrix · self` for a matrix given by its columns, one per row of `self`.
    #[must_use]
    pub fn contracted(&self, columns: &[[f64; 3]]) -> Self {
        let mut sum = Self::zero(self.degree, 3);
        for (row, column) in columns.iter().enumerate() {
            for (axis, weight) in column.iter().enumerate().filter(|(_, weight)| **weight != 0.0) {
                axpy(sum.row_mut(axis), *weight, self.row(row));
            }
        }
        sum
    }

    /// Cross product of two maps of three rows.
    #[must_use]
    pub fn cross(&self, other: &Self) -> Self {
        let mut product = Self::zero(self.degree + other.degree, 3);
        for axis in 0..3 {
            let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
            product.add_product(axis, 1.0, (self, next), (other, last));
            product.add_product(axis, -1.0, (self, last), (other, next));
        }
        product
    }

    /// Scalar product of two maps of as many rows, as a map of one row.
    #[must_use]
    pub fn dot(&self, other: &Self) -> Self {
        let mut product = Self::zero(self.degree + other.degree, 1);
        for row in 0..self.rows {
            product.add_product(0, 1.0, (self, row), (other, row));
        }
        product
    }

    /// Partial derivative with respect to a variable.
    #[must_use]
    pub fn partial(&self, axis: usize) -> Self {
        let mut derivative = Self::zero(self.degree.saturating_sub(1), self.rows);
        for (term, monomial) in exponents(self.degree).enumerate().filter(|(_, m)| m[axis] > 0) {
            let mut lower = monomial;
            lower[axis] -= 1;
            for row in 0..self.rows {
                derivative.row_mut(row)[index(lower)] += monomial[axis] as f64 * self.row(row)[term];
            }
        }
        derivative
    }

    /// Derivative along a vector field: `∇(self) · field`, row by row. (R6)
    ///
    /// The derivative is linear in the polynomial, so it is made once per monomial and applied to every row.
    #[must_use]
    pub fn along(&self, field: &Self) -> Self {
        let degree = self.degree + field.degree - 1;
        let mut derivative = Self::zero(degree, self.rows);
        let mut monomial = Self::zero(self.degree, 1);
        for term in 0..count(self.degree) {
            monomial.coefficients.fill(0.0);
            monomial.coefficients[term] = 1.0;
            let mut image = Self::zero(degree, 1);
            for axis in 0..3 {
                image.add_product(0, 1.0, (&monomial.partial(axis), 0), (field, axis));
            }
            for row in 0..self.rows {
                let weight = self.row(row)[term];
                axpy(derivative.row_mut(row), weight, &image.coefficients);
            }
        }
        derivative
    }

    /// Value at a point, added to `value` row by row.
    pub fn add_value<T: Scalar>(&self, x: [T; 3], value: &mut [T]) {
        let powers = powers(x, self.degree);
        let monomials: Vec<T> =
            exponents(self.degree).map(|[i, j, k]| powers[0][i] * powers[1][j] * powers[2][k]).collect();
        for (row, sum) in value.iter_mut().enumerate() {
            for (c, monomial) in self.row(row).iter().zip(&monomials) {
                *sum = *sum + *monomial * T::from(*c);
            }
        }
    }
}

/// Parts of a row with equal `r = j + k`, each with its `r`.
fn blocks(degree: usize, row: &[f64]) -> impl Iterator<Item = (usize, &[f64])> {
    (0..=degree).map(move |r| (r, &row[r * (r + 1) / 2..(r + 1) * (r + 2) / 2]))
}

fn axpy(sum: &mut [f64], factor: f64, terms: &[f64]) {
    for (s, t) in sum.iter_mut().zip(terms) {
        *s += factor * t;
    }
}

fn powers<T: Scalar>(x: [T; 3], degree: usize) -> [Vec<T>; 3] {
    x.map(|variable| {
        let mut power = T::from(1.0);
        (0..=degree)
            .map(|_| {
                let next = power * variable;
                std::mem::replace(&mut power, next)
            })
            .collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(degree: usize, rows: usize, seed: u64) -> Homogeneous {
        let mut state = seed;
        let mut map = Homogeneous::zero(degree, rows);
        for c in &mut map.coefficients {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            *c = (state >> 33) as f64 / 2f64.powi(30) - 1.0;
        }
        map
    }

    fn value(map: &Homogeneous, x: [f64; 3]) -> Vec<f64> {
        let mut value = vec![0.0; map.rows()];
        map.add_value(x, &mut value);
        value
    }

    const X: [f64; 3] = [0.7, -1.3, 0.4];

    #[test]
    fn product_of_values_is_value_of_product() {
        let (a, b) = (sample(3, 3, 1), sample(2, 3, 2));
        let (va, vb) = (value(&a, X), value(&b, X));
        let cross = value(&a.cross(&b), X);
        let dot = value(&a.dot(&b), X)[0];
        assert!((cross[1] - (va[2] * vb[0] - va[0] * vb[2])).abs() < 1e-13);
        assert!((dot - (0..3).map(|i| va[i] * vb[i]).sum::<f64>()).abs() < 1e-13);
    }

    #[test]
    fn derivative_along_a_field_is_the_rate_of_the_value() {
        let (q, f) = (sample(4, 2, 3), sample(2, 3, 4));
        let rate = value(&f, X);
        let h = 1e-4;
        let shifted = |s: f64| value(&q, std::array::from_fn(|i| X[i] + s * h * rate[i]));
        let (forward, backward, further, earlier) =
            (shifted(1.0), shifted(-1.0), shifted(2.0), shifted(-2.0));
        let along = value(&q.along(&f), X);
        for row in 0..2 {
            let difference =
                (8.0 * (forward[row] - backward[row]) - (further[row] - earlier[row])) / (12.0 * h);
            assert!((along[row] - difference).abs() < 1e-9 * along[row].abs().max(1.0));
        }
    }

    #[test]
    fn half_quadratic_is_half_of_the_form() {
        let form = Homogeneous::half_quadratic(&[[2.0, 3.0, 5.0, 7.0, 11.0, 13.0]]);
        let [x, y, z] = X;
        let expected =
            0.5 * (2.0 * x * x + 3.0 * y * y + 5.0 * z * z) + 7.0 * y * z + 11.0 * z * x + 13.0 * x * y;
        assert!((value(&form, X)[0] - expected).abs() < 1e-14);
    }
}
