//! Numbers that are polynomials along a ray: the degrees of a composition, one by one.

use std::ops::{Add, Mul, Sub};

use quasirigid_math::scalar::Scalar;

/// Degrees kept.
const DEGREES: usize = 12;

/// A polynomial in the distance `s` along a ray, degrees from 0.
#[derive(Clone, Copy, Debug)]
pub struct Ray(pub [f64; DEGREES]);

impl Scalar for Ray {
    fn scaled(self, factor: f64) -> Self {
        Self(self.0.map(|part| factor * part))
    }
}

impl From<f64> for Ray {
    fn from(value: f64) -> Self {
        Self(std::array::from_fn(|d| if d == 0 { value } else { 0.0 }))
    }
}

impl Add for Ray {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(std::array::from_fn(|d| self.0[d] + other.0[d]))
    }
}

impl Sub for Ray {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self(std::array::from_fn(|d| self.0[d] - other.0[d]))
    }
}

impl Mul for Ray {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let mut product = [0.0; DEGREES];
        for (a, own) in self.0.iter().enumerate().filter(|(_, own)| **own != 0.0) {
            for b in 0..DEGREES - a {
                product[a + b] += own * other.0[b];
            }
        }
        Self(product)
    }
}

/// The point `s u`.
pub fn along(u: [f64; 3]) -> [Ray; 3] {
    u.map(|x| Ray(std::array::from_fn(|d| if d == 1 { x } else { 0.0 })))
}
