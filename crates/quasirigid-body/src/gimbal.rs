//! Rotation of a rigid appendage on the axes of its hinge, exact at any angles, with its derivatives.
//! Generic over the scalar, so that the same code gives values, Taylor series in time and first variations.
//! Equations (I8) and (I12), docs/theory/02-invariants.md.

use crate::math::scalar::Smooth;

/// Rows of a 3×3 matrix.
pub(crate) type Rows<T> = [[T; 3]; 3];

/// Axes of a hinge, one inside the other: outermost first. (I8)
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Gimbal {
    /// Unit vectors of the axes at equilibrium, by coordinate.
    pub axes: Vec<(usize, [f64; 3])>,
}

/// Rotation of an appendage at given angles, with its first derivatives. (I12)
#[derive(Clone, Debug)]
pub(crate) struct Rotated<T> {
    /// `R = e^{q₁[a₁]} e^{q₂[a₂]} e^{q₃[a₃]}`.
    pub turn: Rows<T>,
    /// `∂R/∂q_j`, axis by axis.
    pub first: Vec<Rows<T>>,
}

/// Rotations about single axes, each with its first and second derivative.
struct Factors<T>(Vec<[Rows<T>; 3]>);

impl<T: Smooth> Factors<T> {
    fn of(gimbal: &Gimbal, q: &[T]) -> Self {
        Self(gimbal.axes.iter().map(|(at, axis)| factor(*axis, q[*at])).collect())
    }

    /// Product of the factors, each differentiated as often as it is named.
    fn product(&self, named: &[usize]) -> Rows<T> {
        let order = |at: usize| named.iter().filter(|one| **one == at).count();
        let each = self.0.iter().enumerate().map(|(at, factor)| factor[order(at)]);
        each.reduce(times).unwrap_or_else(identity)
    }
}

impl Gimbal {
    /// Rotation and its first derivatives at displacements of all coordinates. (I12)
    pub(crate) fn rotated<T: Smooth>(&self, q: &[T]) -> Rotated<T> {
        let factors = Factors::of(self, q);
        let first = (0..self.axes.len()).map(|j| factors.product(&[j])).collect();
        Rotated { turn: factors.product(&[]), first }
    }

    /// Second derivatives of the rotation, `∂²R/∂q_j∂q_k`, row by row. (I12)
    pub(super) fn curved(&self, q: &[f64]) -> Vec<Rows<f64>> {
        let (factors, count) = (Factors::of(self, q), self.axes.len());
        (0..count * count).map(|pair| factors.product(&[pair / count, pair % count])).collect()
    }

    /// A vector that turns with the appendage, `R v`. (I12)
    pub(crate) fn turned<T: Smooth>(&self, q: &[T], [x, y, z]: [T; 3]) -> [T; 3] {
        Factors::of(self, q)
            .product(&[])
            .map(|[along_x, along_y, along_z]| along_x * x + along_y * y + along_z * z)
    }

    /// Displacement `(R − 1)s` of a place at `s` (m) from the hinge, and its slopes, `∂R/∂q_j s`, by coordinate. (I12)
    pub(crate) fn displaced<T: Smooth>(&self, q: &[T], s: [f64; 3]) -> ([T; 3], Vec<(usize, [T; 3])>) {
        let Rotated { turn, first } = self.rotated(q);
        let along = |rows: &Rows<T>| rows.map(|row| applied(row, s));
        let [x, y, z] = along(&turn);
        let slopes = self.axes.iter().zip(&first).map(|((at, _), rows)| (*at, along(rows)));
        ([x - T::from(s[0]), y - T::from(s[1]), z - T::from(s[2])], slopes.collect())
    }

    /// Gimbal with its coordinates renumbered; none where one has no new number.
    pub(super) fn renumbered(&self, place: &dyn Fn(usize) -> Option<usize>) -> Option<Self> {
        let axes: Option<Vec<_>> = self.axes.iter().map(|(j, axis)| Some((place(*j)?, *axis))).collect();
        axes.map(|axes| Self { axes })
    }
}

/// Rotation about one axis by an angle, with its first and second derivative.
fn factor<T: Smooth>(axis: [f64; 3], angle: T) -> [Rows<T>; 3] {
    let A = cross_matrix(axis);
    let square = times(A, A);
    let (sine, cosine) = angle.sin_cos();
    let part = |constant: f64, along: T, twice: T| -> Rows<T> {
        std::array::from_fn(|row| {
            std::array::from_fn(|column| {
                let one = T::from(if row == column { constant } else { 0.0 });
                one + along * T::from(A[row][column]) + twice * T::from(square[row][column])
            })
        })
    };
    let one = T::from(1.0);
    [part(1.0, sine, one - cosine), part(0.0, cosine, sine), part(0.0, -sine, cosine)]
}

/// `[a]ₓ`.
pub(crate) fn cross_matrix([x, y, z]: [f64; 3]) -> Rows<f64> {
    [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]
}

fn identity<T: Smooth>() -> Rows<T> {
    std::array::from_fn(|row| std::array::from_fn(|column| T::from(f64::from(u8::from(row == column)))))
}

fn times<T: Smooth>(a: Rows<T>, b: Rows<T>) -> Rows<T> {
    a.map(|[x, y, z]| std::array::from_fn(|column| x * b[0][column] + y * b[1][column] + z * b[2][column]))
}

fn applied<T: Smooth>([x, y, z]: [T; 3], s: [f64; 3]) -> T {
    x * T::from(s[0]) + y * T::from(s[1]) + z * T::from(s[2])
}
