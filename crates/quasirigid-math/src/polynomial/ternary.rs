//! Homogeneous polynomials of three variables: rows of coefficients in one order of the monomials.
//! The index of a monomial depends on `(j + k, k)` alone, so products and derivatives are sums over contiguous blocks.
//! Order of [`monomial`](super::monomial); derivative along a field (R6), docs/theory/03-reduction.md.

use smallvec::SmallVec;

use super::monomial::{count, exponents, index};
use crate::scalar::Scalar;

/// Highest degree whose values take no memory from the heap: values are asked for millions of times.
const USUAL: usize = 7;

/// Rows of homogeneous polynomials of one degree in three variables. Coefficients stand row by row, in the order of
/// [`exponents`].
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Ternary {
    degree: usize,
    rows: usize,
    coefficients: Vec<f64>,
}

impl Ternary {
    /// Zero.
    pub fn zero(degree: usize, rows: usize) -> Self {
        Self { degree, rows, coefficients: vec![0.0; rows * count(degree)] }
    }

    /// The linear map with these rows.
    pub fn linear(rows: &[[f64; 3]]) -> Self {
        Self { degree: 1, rows: rows.len(), coefficients: rows.concat() }
    }

    /// Quadratic forms `½ xᵀ S x`, one per row, from symmetric matrices given as xx, yy, zz, yz, zx, xy.
    pub fn half_quadratic(matrices: &[[f64; 6]]) -> Self {
        let mut forms = Self::zero(2, matrices.len());
        for (row, [xx, yy, zz, yz, zx, xy]) in matrices.iter().enumerate() {
            forms.row_mut(row).copy_from_slice(&[0.5 * xx, *xy, *zx, 0.5 * yy, *yz, 0.5 * zz]);
        }
        forms
    }

    /// Degree.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Coefficients of a row.
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

    /// All coefficients, row by row, to change.
    pub fn coefficients_mut(&mut self) -> &mut [f64] {
        &mut self.coefficients
    }

    /// Adds a multiple of a row of another map of the same degree to a row.
    pub fn add_row(&mut self, row: usize, factor: f64, (other, other_row): (&Self, usize)) {
        assert_eq!(self.degree, other.degree);
        axpy(self.row_mut(row), factor, other.row(other_row));
    }

    /// Largest coefficient, in absolute value.
    pub fn amax(&self) -> f64 {
        self.coefficients.iter().fold(0.0, |largest, c| largest.max(c.abs()))
    }

    /// Whether every coefficient is a finite number.
    pub fn is_finite(&self) -> bool {
        self.coefficients.iter().all(|c| c.is_finite())
    }

    /// Adds a multiple of another map of the same degree and rows.
    pub fn add_scaled(&mut self, factor: f64, other: &Self) {
        assert_eq!((self.degree, self.rows), (other.degree, other.rows));
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
        assert_eq!(self.degree, a.degree + b.degree);
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

    /// Adds `Σ aᵢ bᵢ` over all rows of two maps, whose degrees add up to this one, to the only row.
    ///
    /// The products of all pairs of coefficients are summed over the rows before they are sorted by monomials: one pass over the rows.
    pub fn add_dot(&mut self, a: &Self, b: &Self) {
        assert_eq!((self.degree, self.rows), (a.degree + b.degree, 1));
        let (deep, wide) = (count(a.degree), count(b.degree));
        let mut sums = vec![0.0; deep * wide];
        for (a, b) in a.coefficients.chunks_exact(deep).zip(b.coefficients.chunks_exact(wide)) {
            for (sum, c) in sums.chunks_exact_mut(wide).zip(a).filter(|(_, c)| **c != 0.0) {
                axpy(sum, *c, b);
            }
        }
        let rows = (0..=a.degree).flat_map(|r| (0..=r).map(move |k| (r, k)));
        for ((r, k), sum) in rows.zip(sums.chunks_exact(wide)) {
            for (other, along) in blocks(b.degree, sum) {
                let start = index([0, r + other - k, k]);
                axpy(&mut self.coefficients[start..start + along.len()], 1.0, along);
            }
        }
    }

    /// `matrix · self` for a matrix given by its columns, one per row of `self`.
    pub fn contracted<const N: usize>(&self, columns: &[[f64; N]]) -> Self {
        let mut sum = Self::zero(self.degree, N);
        for (row, column) in columns.iter().enumerate() {
            for (axis, weight) in column.iter().enumerate().filter(|(_, weight)| **weight != 0.0) {
                axpy(sum.row_mut(axis), *weight, self.row(row));
            }
        }
        sum
    }

    /// Partial derivative with respect to a variable.
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
    pub fn along(&self, field: &Self) -> Self {
        let degree = self.degree + field.degree - 1;
        let (width, length) = (count(degree), count(self.degree));
        let mut monomial = Self::zero(self.degree, 1);
        let mut images = Vec::with_capacity(length * width);
        for term in 0..length {
            monomial.coefficients.fill(0.0);
            monomial.coefficients[term] = 1.0;
            let mut image = Self::zero(degree, 1);
            for axis in 0..3 {
                image.add_product(0, 1.0, (&monomial.partial(axis), 0), (field, axis));
            }
            images.extend(image.coefficients);
        }
        let mut derivative = Self::zero(degree, self.rows);
        let rows =
            derivative.coefficients.chunks_exact_mut(width).zip(self.coefficients.chunks_exact(length));
        for (sum, weights) in rows {
            for (image, weight) in
                images.chunks_exact(width).zip(weights).filter(|(_, weight)| **weight != 0.0)
            {
                axpy(sum, *weight, image);
            }
        }
        derivative
    }

    /// Value at a point, added to `value` row by row.
    pub fn add_value<T: Scalar>(&self, x: [T; 3], value: &mut [T]) {
        let powers = powers(x, self.degree);
        let monomials: SmallVec<[T; count(USUAL)]> =
            exponents(self.degree).map(|[i, j, k]| powers[0][i] * powers[1][j] * powers[2][k]).collect();
        for (row, sum) in value.iter_mut().enumerate() {
            for (c, monomial) in self.row(row).iter().zip(&monomials) {
                *sum = *sum + monomial.scaled(*c);
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

fn powers<T: Scalar>(x: [T; 3], degree: usize) -> [SmallVec<[T; USUAL + 1]>; 3] {
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
