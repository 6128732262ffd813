//! Symmetric 3×3 matrices as their six entries xx, yy, zz, yz, zx, xy.

use super::scalar::{Scalar, Smooth};
use super::vec3::dot;

/// Entries xx, yy, zz, yz, zx, xy of a symmetric matrix.
pub type Sym = [f64; 6];

/// Rows and columns of the entries.
pub const COMPONENTS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (1, 2), (2, 0), (0, 1)];

/// Rows of the matrix.
#[inline]
#[must_use]
pub fn rows([xx, yy, zz, yz, zx, xy]: Sym) -> [[f64; 3]; 3] {
    [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]]
}

/// Matrix times vector.
#[inline(always)]
#[must_use]
pub fn times<T: Scalar>([xx, yy, zz, yz, zx, xy]: Sym, x: [T; 3]) -> [T; 3] {
    // closures would not be compiled into one vector arithmetic
    smooth_times([T::from(xx), T::from(yy), T::from(zz), T::from(yz), T::from(zx), T::from(xy)], x)
}

/// Inverse of a symmetric positive definite matrix.
#[inline]
#[must_use]
pub fn inverse(matrix: Sym) -> Sym {
    smooth_inverse(matrix)
}

/// Inverse of a symmetric matrix of numbers or series.
#[inline(always)]
#[must_use]
pub fn smooth_inverse<T: Smooth>(matrix: [T; 6]) -> [T; 6] {
    let [xx, .., zx, xy] = matrix;
    let adjugate = adjugate(matrix);
    let determinant = xx * adjugate[0] + xy * adjugate[5] + zx * adjugate[4];
    adjugate.map(|cofactor| cofactor / determinant)
}

/// Adjugate of a symmetric matrix of numbers or series: its cofactors.
#[inline(always)]
#[must_use]
pub fn adjugate<T: Scalar>([xx, yy, zz, yz, zx, xy]: [T; 6]) -> [T; 6] {
    [
        yy * zz - yz * yz,
        zz * xx - zx * zx,
        xx * yy - xy * xy,
        zx * xy - yz * xx,
        xy * yz - zx * yy,
        yz * zx - xy * zz,
    ]
}

/// Matrix of numbers or series times vector.
#[inline(always)]
#[must_use]
pub fn smooth_times<T: Scalar>([xx, yy, zz, yz, zx, xy]: [T; 6], x: [T; 3]) -> [T; 3] {
    [dot([xx, xy, zx], x), dot([xy, yy, yz], x), dot([zx, yz, zz], x)]
}

/// Inertia tensor of a unit mass at a place.
#[inline]
#[must_use]
pub fn of_unit_mass(place: [f64; 3]) -> Sym {
    let [xx, yy, zz, yz, zx, xy] = products(place);
    [yy + zz, zz + xx, xx + yy, -yz, -zx, -xy]
}

/// Products `xx, yy, zz, yz, zx, xy` of the components of a vector.
#[inline]
#[must_use]
pub fn products([x, y, z]: [f64; 3]) -> Sym {
    [x * x, y * y, z * z, y * z, z * x, x * y]
}
