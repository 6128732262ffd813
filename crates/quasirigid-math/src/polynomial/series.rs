//! Graded series: polynomial maps of three variables degree by degree, with products and rates of one degree at a time.
//! Recursions need single degrees of a product; parts above the last are unknown, not zero, so nothing above is ever returned.
//! Equations (R2) and (R3), docs/theory/03-reduction.md.

use super::Homogeneous;
use super::monomial::index;
use crate::scalar::Scalar;
use crate::sparse::SparseRows;

/// A polynomial map of three variables, kept degree by degree; degrees above the last are zero or unknown.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    rows: usize,
    parts: Vec<Homogeneous>,
}

impl Series {
    /// Zero with parts of the degrees `0..=degree`.
    #[must_use]
    pub fn zero(degree: usize, rows: usize) -> Self {
        Self { rows, parts: (0..=degree).map(|d| Homogeneous::zero(d, rows)).collect() }
    }

    /// Maps of one row as the rows of one map.
    #[must_use]
    pub fn stacked(maps: &[&Self]) -> Self {
        let degree = maps.iter().map(|map| map.degree()).max().unwrap_or_default();
        let mut stacked = Self::zero(degree, maps.len());
        for (row, map) in maps.iter().enumerate() {
            map.parts.iter().for_each(|part| stacked.add_row(part.degree(), row, 1.0, (part, 0)));
        }
        stacked
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Highest degree kept.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.parts.len() - 1
    }

    /// The part of one degree.
    ///
    /// # Panics
    /// If `degree` is above [`Self::degree`].
    #[must_use]
    pub fn part(&self, degree: usize) -> &Homogeneous {
        &self.parts[degree]
    }

    /// Sets the part of one degree.
    ///
    /// # Panics
    /// If the part has another number of rows, or its degree is above [`Self::degree`].
    pub fn set(&mut self, part: Homogeneous) {
        assert_eq!(part.rows(), self.rows);
        let degree = part.degree();
        self.parts[degree] = part;
    }

    /// Adds a multiple of a row of a polynomial of at most this degree to a row of the part of the degree.
    pub fn add_row(&mut self, degree: usize, row: usize, factor: f64, other: (&Homogeneous, usize)) {
        self.parts[degree].add_row(row, factor, other);
    }

    /// `matrix · self`, degree by degree.
    #[must_use]
    pub fn times(&self, matrix: &SparseRows<f64>) -> Self {
        let mut product = Self::zero(self.degree(), self.rows);
        for (part, own) in product.parts.iter_mut().zip(&self.parts).filter(|(_, own)| own.amax() > 0.0) {
            matrix.iter().for_each(|(row, column, entry)| part.add_row(row, *entry, (own, column)));
        }
        product
    }

    /// Some rows of the map.
    #[must_use]
    pub fn picked(&self, rows: &[usize]) -> Self {
        let mut picked = Self::zero(self.degree(), rows.len());
        for (part, own) in picked.parts.iter_mut().zip(&self.parts) {
            rows.iter().enumerate().for_each(|(place, row)| part.add_row(place, 1.0, (own, *row)));
        }
        picked
    }

    /// The map without the parts above a degree.
    #[must_use]
    pub fn truncated(&self, degree: usize) -> Self {
        Self { rows: self.rows, parts: self.parts.iter().take(degree + 1).cloned().collect() }
    }

    /// The map multiplied by a number.
    #[must_use]
    pub fn scaled(mut self, factor: f64) -> Self {
        self.parts.iter_mut().for_each(|part| part.scale(factor));
        self
    }

    /// The map with its argument multiplied by a number, degree by degree.
    #[must_use]
    pub fn stretched(&self, factor: f64) -> Self {
        let mut stretched = self.clone();
        for part in &mut stretched.parts {
            let degree = part.degree();
            for (power, coefficients) in part.coefficients_mut().enumerate() {
                let scaled = factor.powi((degree - power) as i32);
                coefficients.iter_mut().for_each(|c| *c *= scaled);
            }
        }
        stretched
    }

    /// The parts of even degree.
    #[must_use]
    pub fn even(&self) -> Self {
        self.of_parity(0)
    }

    /// The parts of odd degree.
    #[must_use]
    pub fn odd(&self) -> Self {
        self.of_parity(1)
    }

    fn of_parity(&self, remainder: usize) -> Self {
        let mut kept = Self::zero(self.degree(), self.rows);
        for part in self.parts.iter().filter(|part| part.degree() % 2 == remainder) {
            kept.set(part.clone());
        }
        kept
    }

    /// Gradient of a map with one row, three rows.
    #[must_use]
    pub fn gradient(&self) -> Self {
        let mut gradient = Self::zero(self.degree().saturating_sub(1), 3);
        for degree in 1..=self.degree() {
            let mut part = Homogeneous::zero(degree - 1, 3);
            for axis in 0..3 {
                part.add_row(axis, 1.0, (&self.part(degree).partial(axis), 0));
            }
            gradient.set(part);
        }
        gradient
    }

    /// Coefficient of a monomial in a row, over all degrees: a constant brings low monomials into high ones.
    #[must_use]
    pub fn coefficient(&self, row: usize, exponents: [usize; 3]) -> f64 {
        let degree: usize = exponents.iter().sum();
        let rows = self.parts.iter().filter_map(|part| part.row_of(degree, row));
        rows.map(|coefficients| coefficients[index(exponents)]).sum()
    }

    /// Value at a point.
    #[must_use]
    pub fn value<T: Scalar>(&self, x: [T; 3]) -> Vec<T> {
        let mut value = vec![T::from(0.0); self.rows];
        for part in &self.parts {
            part.add_value(x, &mut value);
        }
        value
    }

    /// Value at a point of a map with three rows.
    ///
    /// # Panics
    /// If the map has other than three rows.
    #[must_use]
    pub fn vector<T: Scalar>(&self, x: [T; 3]) -> [T; 3] {
        assert_eq!(self.rows, 3, "a vector has three rows");
        let mut value = [T::from(0.0); 3];
        for part in &self.parts {
            part.add_value(x, &mut value);
        }
        value
    }

    /// Value at a point of a symmetric tensor, a map with six rows.
    ///
    /// # Panics
    /// If the map has other than six rows.
    #[must_use]
    pub fn tensor<T: Scalar>(&self, x: [T; 3]) -> [T; 6] {
        assert_eq!(self.rows, 6, "a symmetric tensor has six rows");
        let mut value = [T::from(0.0); 6];
        for part in &self.parts {
            part.add_value(x, &mut value);
        }
        value
    }

    /// Value at a point of a map with one row.
    ///
    /// # Panics
    /// If the map has other than one row.
    #[must_use]
    pub fn scalar<T: Scalar>(&self, x: [T; 3]) -> T {
        assert_eq!(self.rows, 1, "a scalar has one row");
        let mut value = [T::from(0.0)];
        for part in &self.parts {
            part.add_value(x, &mut value);
        }
        value[0]
    }

    /// The part of one degree of the derivative along a field, as far as the known parts give it:
    /// `Σ ∇self_a · field_b` over `a + b = degree + 1`. (R3)
    #[must_use]
    pub fn rate(&self, field: &Self, degree: usize) -> Homogeneous {
        let mut rate = Homogeneous::zero(degree, self.rows);
        for (a, b) in pairs(1, self.degree(), degree + 1, field.degree()) {
            if b > 0 && self.part(a).amax() > 0.0 && field.part(b).amax() > 0.0 {
                rate.add_scaled(1.0, &self.part(a).along(field.part(b)));
            }
        }
        rate
    }

    /// The part of one degree of the cross product with another map.
    #[must_use]
    pub fn cross(&self, other: &Self, degree: usize) -> Homogeneous {
        let mut sum = Homogeneous::zero(degree, 3);
        for (a, b) in pairs(0, self.degree(), degree, other.degree()) {
            sum.add_scaled(1.0, &self.part(a).cross(other.part(b)));
        }
        sum
    }

    /// The part of one degree of the product of a row with a row of another map, as a map of one row.
    #[must_use]
    pub fn row_product(&self, row: usize, other: &Self, other_row: usize, degree: usize) -> Homogeneous {
        let mut sum = Homogeneous::zero(degree, 1);
        for (a, b) in pairs(0, self.degree(), degree, other.degree()) {
            sum.add_product(0, 1.0, (self.part(a), row), (other.part(b), other_row));
        }
        sum
    }

    /// The part of one degree of the scalar product with another map.
    #[must_use]
    pub fn dot(&self, other: &Self, degree: usize) -> Homogeneous {
        let mut sum = Homogeneous::zero(degree, 1);
        for (a, b) in pairs(0, self.degree(), degree, other.degree()) {
            sum.add_scaled(1.0, &self.part(a).dot(other.part(b)));
        }
        sum
    }
}

/// Pairs of degrees `(a, b)` with `a + b = sum`, `lowest ≤ a ≤ highest_a` and `b ≤ highest_b`.
fn pairs(
    lowest: usize,
    highest_a: usize,
    sum: usize,
    highest_b: usize,
) -> impl Iterator<Item = (usize, usize)> {
    (lowest..=highest_a.min(sum)).map(move |a| (a, sum - a)).filter(move |(_, b)| *b <= highest_b)
}
