//! Amplitudes of the fields of curved paths on polynomials, with their first and second derivatives.
//! Equations (K12), docs/theory/12-structures.md; (I12), docs/theory/02-invariants.md; (W1), docs/theory/18-submanifolds.md.

use super::Follower;
use super::gimbal::{Gimbal, Rows, cross_matrix};
use crate::math::submanifold::{Ring, Truncated};

/// Amplitude of a field, with its derivatives over the coordinates that the field follows.
pub(super) struct Series {
    pub value: Truncated,
    pub slopes: Vec<Truncated>,
    /// Second derivatives, row by row.
    pub second: Vec<Truncated>,
}

/// Matrix of polynomials, row by row.
type Matrix = Vec<Truncated>;

impl Follower {
    /// Amplitudes of the fields at displacements of all coordinates. (K12), (I12)
    pub(super) fn series(&self, ring: &Ring, q: &[Truncated]) -> Vec<Series> {
        match self {
            Self::Quadratic { coordinates, forms } => {
                forms.iter().map(|form| quadratic(ring, &q[coordinates.clone()], form)).collect()
            }
            Self::Rotation { gimbal, duals } => {
                let turned = Turned::of(ring, gimbal, q);
                duals.iter().map(|W| turned.contracted(ring, gimbal, q, W)).collect()
            }
        }
    }
}

fn quadratic(ring: &Ring, q: &[Truncated], form: &[f64]) -> Series {
    let along = |row: &[f64]| {
        let mut sum = ring.zero();
        row.iter().zip(q).for_each(|(form, q)| sum.add_scaled(*form, q));
        sum
    };
    let slopes: Vec<Truncated> = form.chunks_exact(q.len().max(1)).map(along).collect();
    let mut value = ring.zero();
    slopes.iter().zip(q).for_each(|(slope, q)| ring.add_product(&mut value, 0.5, slope, q));
    Series { value, slopes, second: form.iter().map(|form| ring.constant(*form)).collect() }
}

/// Rotation with its first derivatives, and its second ones row by row.
struct Turned {
    turn: Matrix,
    first: Vec<Matrix>,
    second: Vec<Matrix>,
}

impl Turned {
    fn of(ring: &Ring, gimbal: &Gimbal, q: &[Truncated]) -> Self {
        let factors: Vec<_> = gimbal.axes.iter().map(|(at, axis)| factor(ring, *axis, &q[*at])).collect();
        let count = factors.len();
        let product = |orders: &dyn Fn(usize) -> usize| {
            let chosen = factors.iter().enumerate().map(|(at, factor)| &factor[orders(at)]);
            let product = |product: Option<Matrix>, factor: &Matrix| {
                Some(product.map_or_else(|| factor.clone(), |product| times(ring, &product, factor)))
            };
            chosen.fold(None, product).expect("a hinge has an axis")
        };
        let order = |at: usize, one: usize| usize::from(at == one);
        let mut second: Vec<Matrix> = Vec::with_capacity(count * count);
        for (j, k) in (0..count).flat_map(|j| (0..count).map(move |k| (j, k))) {
            let known = (k < j).then(|| second[k * count + j].clone());
            second.push(known.unwrap_or_else(|| product(&|at| order(at, j) + order(at, k))));
        }
        Self {
            turn: product(&|_| 0),
            first: (0..count).map(|j| product(&|at| order(at, j))).collect(),
            second,
        }
    }

    /// `W : (R − 1 − q_j [a_j])`.
    fn contracted(&self, ring: &Ring, gimbal: &Gimbal, q: &[Truncated], W: &Rows<f64>) -> Series {
        let contracted = |matrix: &Matrix| {
            let mut sum = ring.zero();
            W.as_flattened().iter().zip(matrix).for_each(|(W, entry)| sum.add_scaled(*W, entry));
            sum
        };
        let mut value = contracted(&self.turn);
        value.add_scaled(-(W[0][0] + W[1][1] + W[2][2]), &ring.constant(1.0));
        let mut slopes = Vec::with_capacity(self.first.len());
        for ((at, axis), first) in gimbal.axes.iter().zip(&self.first) {
            let axis = cross_matrix(*axis);
            let straight: f64 =
                W.as_flattened().iter().zip(axis.as_flattened()).map(|(W, entry)| W * entry).sum();
            let mut slope = contracted(first);
            slope.add_scaled(-straight, &ring.constant(1.0));
            value.add_scaled(-straight, &q[*at]);
            slopes.push(slope);
        }
        Series { value, slopes, second: self.second.iter().map(contracted).collect() }
    }
}

/// Rotation about one axis by an angle, with its first and second derivative.
fn factor(ring: &Ring, axis: [f64; 3], angle: &Truncated) -> [Matrix; 3] {
    let A = cross_matrix(axis);
    let (sine, cosine) = sin_cos(ring, angle);
    let entry = |row: usize, column: usize| -> [Truncated; 3] {
        let once = A[row][column];
        let twice: f64 = (0..3).map(|k| A[row][k] * A[k][column]).sum();
        let mut value = ring.constant(twice + f64::from(u8::from(row == column)));
        let (mut first, mut second) = (ring.zero(), ring.zero());
        value.add_scaled(once, &sine);
        value.add_scaled(-twice, &cosine);
        first.add_scaled(once, &cosine);
        first.add_scaled(twice, &sine);
        second.add_scaled(-once, &sine);
        second.add_scaled(twice, &cosine);
        [value, first, second]
    };
    let mut factors: [Matrix; 3] = Default::default();
    for place in 0..9 {
        for (matrix, entry) in factors.iter_mut().zip(entry(place / 3, place % 3)) {
            matrix.push(entry);
        }
    }
    factors
}

/// Sine and cosine of a polynomial: exact to the degree of the ring.
fn sin_cos(ring: &Ring, angle: &Truncated) -> (Truncated, Truncated) {
    let constant = angle.coefficient(0)[0];
    let mut rest = angle.clone();
    rest.add_scaled(-constant, &ring.constant(1.0));
    let (s, c) = constant.sin_cos();
    let (mut sine, mut cosine) = (ring.zero(), ring.zero());
    let mut power = ring.constant(1.0);
    let derivatives = [[s, c], [c, -s], [-s, -c], [-c, s]];
    for degree in 0..=ring.degree() {
        let [of_sine, of_cosine] = derivatives[degree % 4];
        sine.add_scaled(of_sine, &power);
        cosine.add_scaled(of_cosine, &power);
        power = ring.product(&power, &rest).scaled(((degree + 1) as f64).recip());
    }
    (sine, cosine)
}

fn times(ring: &Ring, a: &Matrix, b: &Matrix) -> Matrix {
    let entry = |place: usize| {
        let mut sum = ring.zero();
        (0..3).for_each(|k| ring.add_product(&mut sum, 1.0, &a[3 * (place / 3) + k], &b[3 * k + place % 3]));
        sum
    };
    (0..9).map(entry).collect()
}
