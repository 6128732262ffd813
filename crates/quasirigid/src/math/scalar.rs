//! Numbers that formulas are written for: plain ones, and truncated Taylor series.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number a polynomial can be evaluated at: `f64`, or a truncated Taylor series in time.
pub trait Scalar: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + From<f64> {}

/// A number that smooth functions can be evaluated at.
///
/// Of a series, each function gives the series of the function; where the function has no derivative the series holds
/// NaN, as `f64` does where the function has no value.
pub trait Smooth: Scalar + Div<Output = Self> + Neg<Output = Self> {
    /// The number itself: of a series, its first term.
    fn value(self) -> f64;
    /// Square root.
    fn sqrt(self) -> Self;
    /// Exponential.
    fn exp(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// Sine and cosine.
    fn sin_cos(self) -> (Self, Self);
    /// Inverse tangent.
    fn atan(self) -> Self;
    /// Power with a constant exponent.
    fn powf(self, exponent: f64) -> Self;

    /// Sine.
    #[must_use]
    fn sin(self) -> Self {
        self.sin_cos().0
    }

    /// Cosine.
    #[must_use]
    fn cos(self) -> Self {
        self.sin_cos().1
    }
}

impl Scalar for f64 {}

impl Smooth for f64 {
    fn value(self) -> f64 {
        self
    }

    fn sqrt(self) -> f64 {
        self.sqrt()
    }

    fn exp(self) -> f64 {
        self.exp()
    }

    fn ln(self) -> f64 {
        self.ln()
    }

    fn sin_cos(self) -> (f64, f64) {
        self.sin_cos()
    }

    fn atan(self) -> f64 {
        self.atan()
    }

    fn powf(self, exponent: f64) -> f64 {
        self.powf(exponent)
    }
}

/// Truncated Taylor series in time: value, first and second derivative.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Jet {
    /// Value.
    pub value: f64,
    /// First derivative.
    pub first: f64,
    /// Second derivative.
    pub second: f64,
}

impl Scalar for Jet {}

impl From<f64> for Jet {
    fn from(value: f64) -> Self {
        Self { value, first: 0.0, second: 0.0 }
    }
}

impl Add for Jet {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            first: self.first + other.first,
            second: self.second + other.second,
        }
    }
}

impl Sub for Jet {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + other * Self::from(-1.0)
    }
}

impl Mul for Jet {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            first: self.first * other.value + self.value * other.first,
            second: self.second * other.value + 2.0 * self.first * other.first + self.value * other.second,
        }
    }
}
