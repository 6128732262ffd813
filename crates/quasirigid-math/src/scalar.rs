//! Scalars: types of numbers for formulas, plain ones and truncated Taylor series.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number a polynomial can be evaluated at: `f64`, or a truncated Taylor series in time.
pub trait Scalar: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + From<f64> {
    /// Product with a plain number.
    #[must_use]
    #[inline(always)]
    fn scaled(self, factor: f64) -> Self {
        self * Self::from(factor)
    }
}

/// A number that smooth functions can be evaluated at.
///
/// Each function of a series is the series of the function; where the function has no derivative the series holds
/// NaN, as `f64` does where the function has no value.
pub trait Smooth: Scalar + Div<Output = Self> + Neg<Output = Self> {
    /// Number of terms kept: one of a plain number.
    const TERMS: usize;

    /// Value: of a series, its first term.
    fn value(self) -> f64;
    /// Square root.
    fn sqrt(self) -> Self;
    /// Exponential.
    fn exp(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// Logarithm to base ten.
    fn log10(self) -> Self;
    /// Sine and cosine.
    fn sin_cos(self) -> (Self, Self);
    /// Tangent.
    fn tan(self) -> Self;
    /// Inverse sine.
    fn asin(self) -> Self;
    /// Inverse cosine.
    fn acos(self) -> Self;
    /// Inverse tangent.
    fn atan(self) -> Self;
    /// Angle of the point `(x, self)` from the x axis, from −π to π.
    fn atan2(self, x: Self) -> Self;
    /// Hyperbolic sine and cosine.
    fn sinh_cosh(self) -> (Self, Self);
    /// Hyperbolic tangent.
    fn tanh(self) -> Self;
    /// Power with a constant exponent; a whole one is a product and has its derivatives at every base.
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

/// Functions that a plain number has under the same names.
macro_rules! own {
    ($($function:ident)+) => {
        $(fn $function(self) -> f64 {
            self.$function()
        })+
    };
}

impl Smooth for f64 {
    const TERMS: usize = 1;

    own! { sqrt exp ln log10 tan asin acos atan tanh }

    fn value(self) -> f64 {
        self
    }

    fn sin_cos(self) -> (f64, f64) {
        self.sin_cos()
    }

    fn atan2(self, x: f64) -> f64 {
        self.atan2(x)
    }

    fn sinh_cosh(self) -> (f64, f64) {
        (self.sinh(), self.cosh())
    }

    fn powf(self, exponent: f64) -> f64 {
        whole(exponent).map_or_else(|| self.powf(exponent), |exponent| self.powi(exponent))
    }
}

/// Whole number that an exponent equals, if any.
pub(super) fn whole(exponent: f64) -> Option<i32> {
    let nearest = exponent as i32;
    (f64::from(nearest) == exponent).then_some(nearest)
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

/// Value and gradient: a function of three variables to the first degree about a point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gradient {
    /// Value.
    pub value: f64,
    /// Derivatives along each axis.
    pub slopes: [f64; 3],
}

impl Gradient {
    /// The three variables at a point.
    #[must_use]
    pub fn variables(x: [f64; 3]) -> [Self; 3] {
        let slopes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        [0, 1, 2].map(|axis| Self { value: x[axis], slopes: slopes[axis] })
    }

    fn slope_of_product(&self, other: &Self, axis: usize) -> f64 {
        self.slopes[axis] * other.value + self.value * other.slopes[axis]
    }
}

impl Scalar for Gradient {
    fn scaled(self, factor: f64) -> Self {
        Self { value: factor * self.value, slopes: self.slopes.map(|slope| factor * slope) }
    }
}

impl From<f64> for Gradient {
    fn from(value: f64) -> Self {
        Self { value, slopes: [0.0; 3] }
    }
}

impl Add for Gradient {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let slopes = [0, 1, 2].map(|axis| self.slopes[axis] + other.slopes[axis]);
        Self { value: self.value + other.value, slopes }
    }
}

impl Sub for Gradient {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + other.scaled(-1.0)
    }
}

impl Mul for Gradient {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let slopes = [0, 1, 2].map(|axis| self.slope_of_product(&other, axis));
        Self { value: self.value * other.value, slopes }
    }
}
