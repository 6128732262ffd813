//! Polynomials of several variables with complex coefficients, truncated above a degree.
//! Monomials are graded: those up to a lower degree are a prefix, so that a polynomial of a lower truncation is a prefix too.

use std::collections::HashMap;

use nalgebra::Complex;
use smallvec::{SmallVec, smallvec};

/// Ring of polynomials truncated above a degree: their monomials and tables of products.
#[derive(Clone, Debug)]
pub struct Ring {
    variables: usize,
    degree: usize,
    /// Exponents of each monomial, ascending in degree.
    exponents: Vec<Vec<u8>>,
    /// Number of monomials up to each degree.
    counts: Vec<usize>,
    /// Monomial of each product: a row for each first factor, over the second factors up to the degree left.
    products: Vec<Vec<u32>>,
    /// A factor of each monomial and the monomial without that factor; none of the constant.
    parents: Vec<(usize, usize)>,
}

/// Polynomial of a [`Ring`]. Most are of a low degree: coefficients beyond the last one stored are zero, and cost nothing; those of a line
/// need no memory of their own.
#[derive(Clone, Debug, Default)]
pub struct Truncated {
    coefficients: SmallVec<[Complex<f64>; 2]>,
}

impl Ring {
    /// Ring of polynomials of so many variables up to a degree.
    #[must_use]
    pub fn new(variables: usize, degree: usize) -> Self {
        let mut exponents = vec![vec![0u8; variables]];
        let mut parents = vec![(0, 0)];
        let mut counts = vec![1];
        let mut start = 0;
        for _ in 0..degree {
            let end = exponents.len();
            for parent in start..end {
                let last = exponents[parent].iter().rposition(|exponent| *exponent > 0).unwrap_or(0);
                for variable in last..variables {
                    let mut next = exponents[parent].clone();
                    next[variable] += 1;
                    exponents.push(next);
                    parents.push((variable, parent));
                }
            }
            start = end;
            counts.push(exponents.len());
        }
        let index: HashMap<&[u8], u32> =
            exponents.iter().enumerate().map(|(i, exponents)| (exponents.as_slice(), i as u32)).collect();
        let row = |first: &Vec<u8>| {
            let left = degree - total(first);
            let product = |second: &Vec<u8>| {
                let sum: Vec<u8> = first.iter().zip(second).map(|(a, b)| a + b).collect();
                index[sum.as_slice()]
            };
            exponents[..counts[left]].iter().map(product).collect()
        };
        let products = exponents.iter().map(row).collect();
        Self { variables, degree, products, counts, parents, exponents }
    }

    /// Number of variables.
    #[must_use]
    pub fn variables(&self) -> usize {
        self.variables
    }

    /// Highest degree.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Exponents of each monomial, ascending in degree.
    #[must_use]
    pub fn exponents(&self) -> &[Vec<u8>] {
        &self.exponents
    }

    /// Indices of the monomials of a degree.
    pub(super) fn of_degree(&self, degree: usize) -> std::ops::Range<usize> {
        let below = degree.checked_sub(1).map_or(0, |below| self.counts[below]);
        below..self.counts[degree]
    }

    /// Number of monomials.
    #[must_use]
    pub fn size(&self) -> usize {
        self.exponents.len()
    }

    /// Index of the monomial with these exponents; none above the degree.
    #[must_use]
    pub fn index(&self, exponents: &[u8]) -> Option<usize> {
        let first = |(at, exponent): (usize, &u8)| std::iter::repeat_n(1 + at, usize::from(*exponent));
        if total(exponents) > self.degree {
            return None;
        }
        let factors = exponents.iter().enumerate().flat_map(first);
        Some(factors.fold(0, |product, factor| self.products[factor][product] as usize))
    }

    /// Zero.
    #[must_use]
    pub fn zero(&self) -> Truncated {
        Truncated::default()
    }

    /// Constant.
    #[must_use]
    pub fn constant(&self, value: f64) -> Truncated {
        Truncated { coefficients: smallvec![value.into()] }
    }

    /// Constant plus a multiple of a variable.
    #[must_use]
    pub fn shifted(&self, constant: f64, variable: usize, factor: f64) -> Truncated {
        let mut shifted = self.constant(constant);
        shifted.set(1 + variable, factor.into());
        shifted
    }

    /// Degree of a polynomial; 0 of zero.
    fn degree_of(&self, a: &Truncated) -> usize {
        self.counts.partition_point(|count| *count < a.coefficients.len())
    }

    /// Adds `factor · a · b` to a polynomial.
    pub fn add_product(&self, sum: &mut Truncated, factor: f64, a: &Truncated, b: &Truncated) {
        let zero = Complex::default();
        if b.coefficients.is_empty() || a.coefficients.is_empty() {
            return;
        }
        sum.extend_to(self.counts[(self.degree_of(a) + self.degree_of(b)).min(self.degree)]);
        for (a, row) in a.coefficients.iter().zip(&self.products) {
            if *a == zero {
                continue;
            }
            let a = a * factor;
            for (product, b) in row.iter().zip(&b.coefficients) {
                sum.coefficients[*product as usize] += a * b;
            }
        }
    }

    /// Product.
    #[must_use]
    pub fn product(&self, a: &Truncated, b: &Truncated) -> Truncated {
        let mut product = self.zero();
        self.add_product(&mut product, 1.0, a, b);
        product
    }

    /// Derivative by a variable; what lies above the degree less one is not known and is zero.
    pub(super) fn derivative(&self, a: &Truncated, variable: usize) -> Truncated {
        let Some(below) = self.degree_of(a).checked_sub(1) else { return self.zero() };
        let uppers = self.products[1 + variable][..self.counts[below]].iter().map(|upper| *upper as usize);
        let coefficient = |upper: usize| a.at(upper) * f64::from(self.exponents[upper][variable]);
        Truncated { coefficients: uppers.map(coefficient).collect() }
    }

    /// Values of all monomials at a point.
    pub(super) fn values(&self, z: &[Complex<f64>]) -> Vec<Complex<f64>> {
        let mut values = vec![Complex::from(1.0); self.size()];
        for (i, (variable, parent)) in self.parents.iter().enumerate().skip(1) {
            values[i] = values[*parent] * z[*variable];
        }
        values
    }

    /// Rates of all monomials at a point whose coordinates have these rates.
    pub(super) fn changes(
        &self,
        values: &[Complex<f64>],
        z: &[Complex<f64>],
        rates: &[Complex<f64>],
    ) -> Vec<Complex<f64>> {
        let mut changes = vec![Complex::default(); self.size()];
        for (i, (variable, parent)) in self.parents.iter().enumerate().skip(1) {
            changes[i] = changes[*parent] * z[*variable] + values[*parent] * rates[*variable];
        }
        changes
    }

    /// Polynomial with the coefficients of one of a lower truncation, or cut off to this degree.
    pub(super) fn resized(&self, a: &Truncated) -> Truncated {
        let kept = a.coefficients.len().min(self.size());
        Truncated { coefficients: a.coefficients[..kept].into() }
    }
}

impl Truncated {
    /// Coefficient of a monomial, real and imaginary part.
    #[must_use]
    pub fn coefficient(&self, monomial: usize) -> [f64; 2] {
        let Complex { re, im } = self.at(monomial);
        [re, im]
    }

    /// Coefficient of a monomial.
    pub(super) fn at(&self, monomial: usize) -> Complex<f64> {
        self.coefficients.get(monomial).copied().unwrap_or_default()
    }

    /// Sets the coefficient of a monomial.
    pub(super) fn set(&mut self, monomial: usize, value: Complex<f64>) {
        self.extend_to(monomial + 1);
        self.coefficients[monomial] = value;
    }

    fn extend_to(&mut self, size: usize) {
        if size > self.coefficients.len() {
            self.coefficients.resize(size, Complex::default());
        }
    }

    /// Adds a multiple of another polynomial.
    pub fn add_scaled(&mut self, factor: f64, other: &Self) {
        if factor != 0.0 {
            self.extend_to(other.coefficients.len());
            for (sum, part) in self.coefficients.iter_mut().zip(&other.coefficients) {
                *sum += part * factor;
            }
        }
    }

    /// Multiple of the polynomial.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self { coefficients: self.coefficients.iter().map(|coefficient| coefficient * factor).collect() }
    }

    /// Value from the values of the monomials.
    pub(super) fn value(&self, monomials: &[Complex<f64>]) -> Complex<f64> {
        self.coefficients.iter().zip(monomials).map(|(a, b)| a * b).sum()
    }
}

/// Degree of a monomial.
pub(super) fn total(exponents: &[u8]) -> usize {
    exponents.iter().map(|exponent| usize::from(*exponent)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dense(ring: &Ring, seed: f64) -> Truncated {
        let coefficient =
            |i: usize| Complex::new((seed + 1.7 * i as f64).sin(), (seed - 0.9 * i as f64).cos());
        Truncated { coefficients: (0..ring.size()).map(coefficient).collect() }
    }

    fn at(ring: &Ring, a: &Truncated, z: &[Complex<f64>]) -> Complex<f64> {
        a.value(&ring.values(z))
    }

    const POINT: [Complex<f64>; 3] =
        [Complex::new(0.3, -0.2), Complex::new(-0.7, 0.4), Complex::new(0.1, 0.9)];

    #[test]
    fn monomials_are_counted_and_found() {
        let ring = Ring::new(3, 4);
        assert_eq!(ring.size(), 35);
        assert!(ring.exponents().iter().enumerate().all(|(i, m)| ring.index(m) == Some(i)));
        assert_eq!(ring.index(&[3, 1, 1]), None);
    }

    #[test]
    fn the_product_of_polynomials_without_truncation_is_the_product_of_values() {
        let (whole, half) = (Ring::new(3, 6), Ring::new(3, 3));
        let (a, b) = (whole.resized(&dense(&half, 0.4)), whole.resized(&dense(&half, 2.1)));
        let product = at(&whole, &whole.product(&a, &b), &POINT);
        let expected = at(&whole, &a, &POINT) * at(&whole, &b, &POINT);
        assert!((product - expected).norm() < 1e-13 * expected.norm());
    }

    #[test]
    fn coefficients_that_are_not_stored_are_zero() {
        let ring = Ring::new(3, 5);
        let full = |a: &Truncated| {
            let mut full = a.clone();
            full.extend_to(ring.size());
            full
        };
        let short =
            [ring.zero(), ring.constant(0.7), ring.shifted(0.2, 1, -1.5), dense(&Ring::new(3, 3), 0.6)];
        for (a, b) in short.iter().flat_map(|a| short.iter().map(move |b| (a, b))) {
            let mut sum = a.clone();
            sum.add_scaled(0.3, b);
            ring.add_product(&mut sum, -1.2, a, b);
            let mut expected = full(a);
            expected.add_scaled(0.3, &full(b));
            ring.add_product(&mut expected, -1.2, &full(a), &full(b));
            let slopes = (0..3)
                .map(|variable| (ring.derivative(&sum, variable), ring.derivative(&expected, variable)));
            for (short, long) in slopes.chain([(sum.clone(), expected.clone())]) {
                assert!((0..ring.size()).all(|monomial| short.at(monomial) == long.at(monomial)));
            }
        }
    }

    #[test]
    fn truncation_drops_what_is_above_the_degree_alone() {
        let (whole, cut) = (Ring::new(2, 6), Ring::new(2, 4));
        let (a, b) = (dense(&whole, 0.3), dense(&whole, 1.3));
        let long = whole.product(&a, &b);
        let short = cut.product(&cut.resized(&a), &cut.resized(&b));
        assert!(short.coefficients.iter().zip(&long.coefficients).all(|(a, b)| (a - b).norm() < 1e-13));
    }

    #[test]
    fn derivatives_are_those_by_differences() {
        let ring = Ring::new(3, 5);
        let a = dense(&ring, 0.8);
        for variable in 0..3 {
            let step = Complex::from(1e-6);
            let [mut before, mut after] = [POINT; 2];
            before[variable] -= step;
            after[variable] += step;
            let slope = (at(&ring, &a, &after) - at(&ring, &a, &before)) / (step + step);
            let found = at(&ring, &ring.derivative(&a, variable), &POINT);
            assert!((slope - found).norm() < 1e-8 * found.norm(), "{slope} {found}");
        }
    }
}
