use std::ops::{Add, Mul, Sub};

use crate::math::scalar::{Scalar, Smooth};

/// A number with its rate.
#[derive(Clone, Copy)]
pub(super) struct Rated<T>(pub T, pub T);

impl<T: Smooth> Rated<T> {
    pub fn reciprocal(self) -> Self {
        let value = T::from(1.0) / self.0;
        Self(value, -(value * value * self.1))
    }

    pub fn sqrt(self) -> Self {
        let value = self.0.sqrt();
        Self(value, T::from(0.5) * self.1 / value)
    }
}

impl<T: Smooth> Add for Rated<T> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0, self.1 + other.1)
    }
}

impl<T: Smooth> Sub for Rated<T> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0, self.1 - other.1)
    }
}

impl<T: Smooth> Mul for Rated<T> {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0, self.0 * other.1 + self.1 * other.0)
    }
}

impl<T: Smooth> From<f64> for Rated<T> {
    fn from(value: f64) -> Self {
        Self(T::from(value), T::from(0.0))
    }
}

impl<T: Smooth> Scalar for Rated<T> {}
