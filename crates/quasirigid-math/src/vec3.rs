//! Vectors of three components as arrays.

use super::scalar::Scalar;

/// Scalar product.
#[inline(always)]
#[must_use]
pub fn dot<T: Scalar>(a: [T; 3], b: [T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Vector product.
#[inline(always)]
#[must_use]
pub fn cross<T: Scalar>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Sum of two vectors.
#[inline(always)]
#[must_use]
pub fn add<T: Scalar>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Multiple of a vector.
#[inline]
#[must_use]
pub fn scale<T: Scalar>(factor: T, a: [T; 3]) -> [T; 3] {
    a.map(|entry| factor * entry)
}

/// Difference `a − b`.
#[inline]
#[must_use]
pub fn minus<T: Scalar>(a: [T; 3], b: [T; 3]) -> [T; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Length.
#[inline]
#[must_use]
pub fn norm(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

/// Unit vector along a vector that is not zero.
#[inline]
#[must_use]
pub fn unit(a: [f64; 3]) -> [f64; 3] {
    scale(norm(a).recip(), a)
}
