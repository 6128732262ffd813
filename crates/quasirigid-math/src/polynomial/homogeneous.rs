//! Homogeneous polynomial maps of three variables, with a constant that is graded as degree one.
//! The constant lets an angular momentum of given size, as of a wheel, enter the recursion at the degree of the angular velocity.
//! Equations (R3) and (R6), docs/theory/03-reduction.md, and (C4), docs/theory/13-inside.md.

use std::ops::Range;

use super::monomial::count;
use super::ternary::Ternary;
use crate::scalar::Scalar;

/// Rows of homogeneous polynomials of one degree in three variables and a constant of degree one.
///
/// A vector field has three rows; a function of all internal coordinates has one row each. The constant, `σ` below, has the value 1: it
/// marks the terms of a constant of the problem that is graded as degree one, as the angular momentum of a wheel, which is of the degree of
/// the angular velocity. Without it only powers of the three variables are kept.
#[derive(Clone, Debug, PartialEq)]
pub struct Homogeneous {
    /// The part without `σ`.
    pure: Ternary,
    /// The parts that `σ, σ², …` multiply, of falling degree; none where there is no constant.
    mixed: Vec<Ternary>,
}

impl Homogeneous {
    /// Zero.
    #[must_use]
    pub fn zero(degree: usize, rows: usize) -> Self {
        Self::from(Ternary::zero(degree, rows))
    }

    /// The linear map with these rows.
    #[must_use]
    pub fn linear(rows: &[[f64; 3]]) -> Self {
        Self::from(Ternary::linear(rows))
    }

    /// The constant with these rows, as degree one: `value · σ`.
    #[must_use]
    pub fn constant(value: &[f64]) -> Self {
        let mut constant = Ternary::zero(0, value.len());
        constant.coefficients_mut().copy_from_slice(value);
        Self { pure: Ternary::zero(1, value.len()), mixed: vec![constant] }
    }

    /// The three variables themselves.
    #[must_use]
    pub fn identity() -> Self {
        Self::linear(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    }

    /// Quadratic forms `½ xᵀ S x`, one per row, from symmetric matrices given as xx, yy, zz, yz, zx, xy.
    #[must_use]
    pub fn half_quadratic(matrices: &[[f64; 6]]) -> Self {
        Self::from(Ternary::half_quadratic(matrices))
    }

    /// Whether no term has the constant, so that the value at a multiple of a point is a power of the factor times the value.
    #[must_use]
    pub fn is_pure(&self) -> bool {
        self.mixed.is_empty()
    }

    /// Degree.
    #[inline]
    #[must_use]
    pub fn degree(&self) -> usize {
        self.pure.degree()
    }

    /// Number of rows.
    #[inline]
    #[must_use]
    pub fn rows(&self) -> usize {
        self.pure.rows()
    }

    /// Coefficients of a row of the monomials of a degree, this one or a lower; none where there is no such part.
    #[must_use]
    pub fn row_of(&self, degree: usize, row: usize) -> Option<&[f64]> {
        let power = self.degree().checked_sub(degree)?;
        let part = if power == 0 { &self.pure } else { self.mixed.get(power - 1)? };
        Some(part.row(row))
    }

    /// Coefficients of a row without the constant.
    ///
    /// # Panics
    /// If there is no such row.
    #[inline]
    #[must_use]
    pub fn row(&self, row: usize) -> &[f64] {
        assert!(row < self.rows(), "row {row} of {}", self.rows());
        self.pure.row(row)
    }

    /// Coefficients of a row without the constant, to change.
    #[inline]
    pub fn row_mut(&mut self, row: usize) -> &mut [f64] {
        self.pure.row_mut(row)
    }

    /// Monomials with their coefficients in each row; those below the degree come from the constant.
    pub fn terms(&self) -> impl Iterator<Item = ([usize; 3], Vec<f64>)> + '_ {
        self.parts().flat_map(Ternary::terms)
    }

    /// Hands rows to a solver that works on them in place, with the number of coefficients to a row.
    pub fn solve_rows(&mut self, rows: Range<usize>, mut solve: impl FnMut(&mut [f64], usize)) {
        for part in self.parts_mut() {
            let width = count(part.degree());
            solve(&mut part.coefficients_mut()[rows.start * width..rows.end * width], width);
        }
    }

    /// All coefficients, a list row by row for each power of the constant, to change.
    pub fn coefficients_mut(&mut self) -> impl Iterator<Item = &mut [f64]> {
        self.parts_mut().map(Ternary::coefficients_mut)
    }

    /// Multiplies by a number.
    pub fn scale(&mut self, factor: f64) {
        self.coefficients_mut().flatten().for_each(|c| *c *= factor);
    }

    /// Adds a multiple of a row of another map, of the same degree or of a lower one that `σ` lifts to it, to a row.
    ///
    /// # Panics
    /// If the other map is of a higher degree, or has no such row.
    pub fn add_row(&mut self, row: usize, factor: f64, (other, other_row): (&Self, usize)) {
        assert!(other.degree() <= self.degree(), "degree {} does not fit {}", other.degree(), self.degree());
        let lift = self.degree() - other.degree();
        for (power, part) in other.parts().enumerate() {
            self.part_mut(lift + power).add_row(row, factor, (part, other_row));
        }
    }

    /// Largest coefficient, in absolute value.
    #[must_use]
    pub fn amax(&self) -> f64 {
        self.parts().map(Ternary::amax).fold(0.0, f64::max)
    }

    /// Whether every coefficient is a finite number.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.parts().all(Ternary::is_finite)
    }

    /// Adds a multiple of another map of the same degree and rows.
    ///
    /// # Panics
    /// If the degrees or the rows differ.
    pub fn add_scaled(&mut self, factor: f64, other: &Self) {
        for (power, part) in other.parts().enumerate() {
            self.part_mut(power).add_scaled(factor, part);
        }
    }

    /// Adds `factor · a · b` to a row, where `a` and `b` are rows of other maps whose degrees add up to this one.
    ///
    /// # Panics
    /// If the degrees do not add up, or there is no such row.
    pub fn add_product(
        &mut self,
        row: usize,
        factor: f64,
        (a, row_a): (&Self, usize),
        (b, row_b): (&Self, usize),
    ) {
        for (power_a, a) in a.parts().enumerate() {
            for (power_b, b) in b.parts().enumerate() {
                self.part_mut(power_a + power_b).add_product(row, factor, (a, row_a), (b, row_b));
            }
        }
    }

    /// `matrix · self` for a matrix given by its columns, one per row of `self`.
    ///
    /// # Panics
    /// If there are more or fewer columns than rows.
    #[must_use]
    pub fn contracted<const N: usize>(&self, columns: &[[f64; N]]) -> Self {
        assert_eq!(columns.len(), self.rows(), "one column per row");
        self.mapped(|part| part.contracted(columns))
    }

    /// Cross product of two maps of three rows.
    ///
    /// # Panics
    /// If either has other than three rows.
    #[must_use]
    pub fn cross(&self, other: &Self) -> Self {
        assert_eq!([self.rows(), other.rows()], [3, 3], "vectors have three rows");
        let mut product = Self::zero(self.degree() + other.degree(), 3);
        for axis in 0..3 {
            let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
            product.add_product(axis, 1.0, (self, next), (other, last));
            product.add_product(axis, -1.0, (self, last), (other, next));
        }
        product
    }

    /// Scalar product of two maps of as many rows, as a map of one row.
    ///
    /// # Panics
    /// If the rows differ.
    #[must_use]
    pub fn dot(&self, other: &Self) -> Self {
        assert_eq!(self.rows(), other.rows(), "a scalar product needs as many rows");
        let mut product = Self::zero(self.degree() + other.degree(), 1);
        for (power, part) in self.parts().enumerate() {
            for (power_other, other) in other.parts().enumerate() {
                product.part_mut(power + power_other).add_dot(part, other);
            }
        }
        product
    }

    /// Partial derivative with respect to a variable.
    #[must_use]
    pub fn partial(&self, axis: usize) -> Self {
        let mut derivative = self.mapped(|part| part.partial(axis));
        derivative.mixed.truncate(derivative.degree());
        derivative
    }

    /// Derivative along a vector field: `∇(self) · field`, row by row. (R6)
    #[must_use]
    pub fn along(&self, field: &Self) -> Self {
        let mut derivative = Self::zero(self.degree() + field.degree() - 1, self.rows());
        for (power, part) in self.parts().enumerate().filter(|(_, part)| part.degree() > 0) {
            for (lift, field) in field.parts().enumerate() {
                derivative.part_mut(power + lift).add_scaled(1.0, &part.along(field));
            }
        }
        derivative
    }

    /// Value at a point, row by row.
    ///
    /// ```
    /// use quasirigid_math::polynomial::Homogeneous;
    ///
    /// let doubled = Homogeneous::linear(&[[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]]);
    /// assert_eq!(doubled.value([1.0, -3.0, 0.5]), [2.0, -6.0, 1.0]);
    /// ```
    #[must_use]
    pub fn value<T: Scalar>(&self, x: [T; 3]) -> Vec<T> {
        let mut value = vec![T::from(0.0); self.rows()];
        self.add_value(x, &mut value);
        value
    }

    /// Value at a point, added to the first rows of `value`, which may be fewer than all.
    ///
    /// # Panics
    /// If there are more values than rows.
    pub fn add_value<T: Scalar>(&self, x: [T; 3], value: &mut [T]) {
        assert!(value.len() <= self.rows(), "{} values of {} rows", value.len(), self.rows());
        self.parts().for_each(|part| part.add_value(x, value));
    }

    fn parts(&self) -> impl Iterator<Item = &Ternary> {
        std::iter::once(&self.pure).chain(&self.mixed)
    }

    fn parts_mut(&mut self) -> impl Iterator<Item = &mut Ternary> {
        std::iter::once(&mut self.pure).chain(&mut self.mixed)
    }

    /// The part that a power of the constant multiplies, made if there is none yet.
    fn part_mut(&mut self, power: usize) -> &mut Ternary {
        if power == 0 {
            return &mut self.pure;
        }
        let (degree, rows) = (self.degree(), self.rows());
        for next in self.mixed.len() + 1..=power {
            self.mixed.push(Ternary::zero(degree - next, rows));
        }
        &mut self.mixed[power - 1]
    }

    fn mapped(&self, map: impl Fn(&Ternary) -> Ternary) -> Self {
        Self { pure: map(&self.pure), mixed: self.mixed.iter().map(map).collect() }
    }
}

impl From<Ternary> for Homogeneous {
    fn from(pure: Ternary) -> Self {
        Self { pure, mixed: Vec::new() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(degree: usize, constants: usize, rows: usize, seed: u64) -> Homogeneous {
        let mut state = seed;
        let mut map = Homogeneous::zero(degree, rows);
        map.part_mut(constants);
        for c in map.coefficients_mut().flatten() {
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
        let (a, b) = (sample(3, 1, 3, 1), sample(2, 2, 3, 2));
        let (va, vb) = (value(&a, X), value(&b, X));
        let cross = value(&a.cross(&b), X);
        let dot = value(&a.dot(&b), X)[0];
        assert!((cross[1] - (va[2] * vb[0] - va[0] * vb[2])).abs() < 1e-13);
        assert!((dot - (0..3).map(|i| va[i] * vb[i]).sum::<f64>()).abs() < 1e-13);
    }

    #[test]
    fn scalar_product_is_the_sum_of_the_products_of_rows() {
        let (a, b) = (sample(4, 2, 5, 6), sample(3, 1, 5, 7));
        let mut sum = Homogeneous::zero(7, 1);
        (0..5).for_each(|row| sum.add_product(0, 1.0, (&a, row), (&b, row)));
        sum.add_scaled(-1.0, &a.dot(&b));
        assert!(sum.amax() < 1e-14, "{:e}", sum.amax());
    }

    #[test]
    fn derivative_along_a_field_is_the_rate_of_the_value() {
        let (q, f) = (sample(4, 4, 2, 3), sample(2, 1, 3, 4));
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
