//! Truncated Taylor series in time, and smooth functions of them.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::scalar::{Scalar, Smooth, whole};

/// Taylor series in time, cut off after `N` terms: `x(t + s) = Σ c_k s^k`, `c_k = x⁽ᵏ⁾(t) / k!`, `k < N`.
///
/// Terms beyond the last never enter the others, so every coefficient is exact to rounding. The operations are calls, not inlined: a
/// formula on series would otherwise unroll to hundreds of times its length and take minutes to compile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taylor<const N: usize> {
    coefficients: [f64; N],
}

/// Divisor by which what is divided is nothing, with all its derivatives.
const HUGE: f64 = 1e140;

impl<const N: usize> Taylor<N> {
    /// The series with these coefficients.
    #[must_use]
    pub fn new(coefficients: [f64; N]) -> Self {
        const { assert!(N > 0, "a series has a value") }
        Self { coefficients }
    }

    /// Time itself, at the time `time`.
    #[must_use]
    pub fn variable(time: f64) -> Self {
        Self::new(std::array::from_fn(|k| [time, 1.0].get(k).copied().unwrap_or(0.0)))
    }

    /// Coefficient of the power `k < N`.
    #[must_use]
    pub fn coefficient(&self, k: usize) -> f64 {
        self.coefficients[k]
    }

    /// The value and its first `N − 1` derivatives.
    #[must_use]
    pub fn derivatives(&self) -> [f64; N] {
        let mut factorial = 1.0;
        std::array::from_fn(|k| {
            factorial *= k.max(1) as f64;
            factorial * self.coefficients[k]
        })
    }

    /// Series of the time derivative; its last coefficient is not known and is zero.
    #[must_use]
    #[inline(never)]
    pub fn derivative(&self) -> Self {
        let above = |k: usize| self.coefficients.get(k + 1).map_or(0.0, |c| (k + 1) as f64 * c);
        Self::new(std::array::from_fn(above))
    }

    /// Series of the integral over time that begins with `constant`.
    #[must_use]
    #[inline(never)]
    pub fn integral(&self, constant: f64) -> Self {
        let below = |k: usize| if k == 0 { constant } else { self.coefficients[k - 1] / k as f64 };
        Self::new(std::array::from_fn(below))
    }

    /// Series of the integrals of a few rates that begin with these constants.
    #[must_use]
    pub fn integrals<const M: usize>(rates: [Self; M], constants: [f64; M]) -> [Self; M] {
        std::array::from_fn(|i| rates[i].integral(constants[i]))
    }

    fn with_value(mut self, value: f64) -> Self {
        self.coefficients[0] = value;
        self
    }

    /// A value without derivatives.
    fn irregular(value: f64) -> Self {
        Self::new([f64::NAN; N]).with_value(value)
    }

    /// `f(x)` from its value and the series of `f′(x)`, both finite where `f` has derivatives.
    fn composed(self, value: f64, slope: Self) -> Self {
        if value.is_finite() && slope.value().is_finite() {
            (slope * self.derivative()).integral(value)
        } else {
            Self::irregular(value)
        }
    }

    /// Coefficient `k ≥ 1` of the function whose time derivative is `rate · dx/dt`.
    fn next(&self, rate: &[f64; N], k: usize) -> f64 {
        (1..=k).map(|j| j as f64 * self.coefficients[j] * rate[k - j]).sum::<f64>() / k as f64
    }

    /// The pair with `ds = c dx` and `dc = sign · s dx`, from its values.
    fn circular(self, (sine, cosine): (f64, f64), sign: f64) -> (Self, Self) {
        let (mut s, mut c) = ([0.0; N], [0.0; N]);
        (s[0], c[0]) = (sine, cosine);
        for k in 1..N {
            (s[k], c[k]) = (self.next(&c, k), sign * self.next(&s, k));
        }
        (Self::new(s), Self::new(c))
    }

    fn convolved(&self, other: &Self) -> Self {
        let mut product = [-0.0; N]; // so that a product that is −0 keeps its sign
        for (j, own) in self.coefficients.iter().enumerate() {
            product[j..].iter_mut().zip(&other.coefficients).for_each(|(sum, other)| *sum += own * other);
        }
        Self::new(product)
    }

    fn quotient(&self, divisor: &Self) -> Self {
        let mut quotient = [0.0; N];
        let value = self.value() / divisor.value();
        if divisor.value().abs() > HUGE && value.abs() < HUGE.recip() {
            quotient[0] = value; // the derivatives of an exponential beyond all numbers are no numbers
            return Self::new(quotient);
        }
        for k in 0..N {
            let known = |rest, j| rest - quotient[j] * divisor.coefficients[k - j];
            quotient[k] = (0..k).fold(self.coefficients[k], known) / divisor.coefficients[0];
        }
        Self::new(quotient)
    }

    /// Power of a positive series: `x dp = r p dx`.
    fn broken_power(self, exponent: f64) -> Self {
        let mut power = [0.0; N];
        power[0] = self.value().powf(exponent);
        for k in 1..N {
            let weight = |j: usize| exponent * j as f64 - (k - j) as f64;
            let sum: f64 = (1..=k).map(|j| weight(j) * self.coefficients[j] * power[k - j]).sum();
            power[k] = sum / (k as f64 * self.value());
        }
        Self::new(power)
    }

    /// Power of a series that begins with zero: derivatives below the exponent vanish.
    fn vanishing(exponent: f64) -> Self {
        Self::new(std::array::from_fn(|k| if (k as f64) < exponent { 0.0 } else { f64::NAN }))
    }

    fn product(self, exponent: u32) -> Self {
        let (mut product, mut square, mut rest) = (Self::from(1.0), self, exponent);
        while rest > 0 {
            if rest % 2 == 1 {
                product = product * square;
            }
            square = square * square;
            rest /= 2;
        }
        product
    }
}

impl<const N: usize> From<f64> for Taylor<N> {
    fn from(value: f64) -> Self {
        Self::new([0.0; N]).with_value(value)
    }
}

impl<const N: usize> Add for Taylor<N> {
    type Output = Self;

    #[inline(never)]
    fn add(self, other: Self) -> Self {
        Self::new(std::array::from_fn(|k| self.coefficients[k] + other.coefficients[k]))
    }
}

impl<const N: usize> Sub for Taylor<N> {
    type Output = Self;

    #[inline(never)]
    fn sub(self, other: Self) -> Self {
        Self::new(std::array::from_fn(|k| self.coefficients[k] - other.coefficients[k]))
    }
}

impl<const N: usize> Neg for Taylor<N> {
    type Output = Self;

    #[inline(never)]
    fn neg(self) -> Self {
        Self::new(self.coefficients.map(|c| -c))
    }
}

impl<const N: usize> Mul for Taylor<N> {
    type Output = Self;

    #[inline(never)]
    fn mul(self, other: Self) -> Self {
        let constant = |series: &Self| series.coefficients[1..].iter().all(|c| *c == 0.0);
        if constant(&self) {
            Self::new(other.coefficients.map(|c| self.coefficients[0] * c))
        } else if constant(&other) {
            Self::new(self.coefficients.map(|c| c * other.coefficients[0]))
        } else {
            self.convolved(&other)
        }
    }
}

impl<const N: usize> Div for Taylor<N> {
    type Output = Self;

    #[inline(never)]
    fn div(self, other: Self) -> Self {
        self.quotient(&other)
    }
}

impl<const N: usize> Scalar for Taylor<N> {
    #[inline(never)]
    fn scaled(self, factor: f64) -> Self {
        Self::new(self.coefficients.map(|coefficient| coefficient * factor))
    }
}

impl<const N: usize> Smooth for Taylor<N> {
    const TERMS: usize = N;

    fn value(self) -> f64 {
        self.coefficients[0]
    }

    fn sqrt(self) -> Self {
        self.powf(0.5).with_value(self.value().sqrt())
    }

    fn exp(self) -> Self {
        let mut exponential = [0.0; N];
        exponential[0] = self.value().exp();
        for k in 1..N {
            exponential[k] = self.next(&exponential, k);
        }
        Self::new(exponential)
    }

    fn ln(self) -> Self {
        self.composed(self.value().ln(), Self::from(1.0) / self)
    }

    fn log10(self) -> Self {
        (self.ln() * Self::from(std::f64::consts::LOG10_E)).with_value(self.value().log10())
    }

    fn sin_cos(self) -> (Self, Self) {
        self.circular(self.value().sin_cos(), -1.0)
    }

    fn tan(self) -> Self {
        let (sine, cosine) = self.sin_cos();
        (sine / cosine).with_value(self.value().tan())
    }

    fn asin(self) -> Self {
        let one = Self::from(1.0);
        self.composed(self.value().asin(), one / ((one - self) * (one + self)).sqrt())
    }

    fn acos(self) -> Self {
        (-self.asin()).with_value(self.value().acos())
    }

    fn atan(self) -> Self {
        let one = Self::from(1.0);
        self.composed(self.value().atan(), one / (one + self * self))
    }

    fn atan2(self, x: Self) -> Self {
        let steep = self.value().abs() > x.value().abs();
        let angle = if steep { -(x / self).atan() } else { (self / x).atan() };
        angle.with_value(self.value().atan2(x.value()))
    }

    fn sinh_cosh(self) -> (Self, Self) {
        self.circular((self.value().sinh(), self.value().cosh()), 1.0)
    }

    fn tanh(self) -> Self {
        let (mut tangent, mut slope) = ([0.0; N], [0.0; N]);
        (tangent[0], slope[0]) = (self.value().tanh(), self.value().cosh().powi(-2));
        for k in 1..N {
            tangent[k] = self.next(&slope, k);
            slope[k] = -(0..=k).map(|j| tangent[j] * tangent[k - j]).sum::<f64>();
        }
        Self::new(tangent)
    }

    fn powf(self, exponent: f64) -> Self {
        match whole(exponent) {
            Some(n) if n >= 0 => self.product(n.unsigned_abs()),
            Some(n) => Self::from(1.0) / self.product(n.unsigned_abs()),
            None if self.value() > 0.0 => self.broken_power(exponent),
            None if self.value() == 0.0 && exponent > 0.0 => Self::vanishing(exponent),
            None => Self::irregular(self.value().powf(exponent)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Order in the step at which the series of a function of `x` departs from the function.
    fn order<const N: usize>(
        series: impl Fn(Taylor<N>) -> Taylor<N>,
        function: impl Fn(f64) -> f64,
        x: [f64; 3],
        step: f64,
    ) -> f64 {
        let found = series(Taylor::new(std::array::from_fn(|k| x.get(k).copied().unwrap_or(0.0))));
        let gap = |s: f64| {
            let sum = (0..N).rev().fold(0.0, |sum, k| sum * s + found.coefficient(k));
            (sum - function(x[0] + s * (x[1] + s * x[2]))).abs()
        };
        (gap(step) / gap(step / 2.0)).log2()
    }

    fn close<const N: usize>(left: Taylor<N>, right: Taylor<N>) {
        for k in 0..N {
            let (found, expected) = (left.coefficient(k), right.coefficient(k));
            let gap = (found - expected).abs();
            assert!(gap <= 1e-13 * (1.0 + expected.abs()), "{k}: {found} for {expected}");
        }
    }

    const WAVY: Taylor<12> =
        Taylor { coefficients: [0.37, -0.8, 0.3, 0.71, -0.2, 0.05, 0.4, -0.33, 0.12, 0.9, -0.6, 0.27] };

    /// A pulse `2/(e^x + e^−x)` far from its middle is zero with all its derivatives, where the exponential and then its derivatives are beyond all
    /// numbers, and itself before.
    #[test]
    fn what_is_divided_by_an_exponential_beyond_all_numbers_is_nothing() {
        for place in [1.0, 400.0, 700.0, 709.9, 710.0, 1e5, 1e300] {
            let x = Taylor::<6>::variable(place / 100.0) * Taylor::from(100.0);
            let pulse = Taylor::from(2.0) / (x.exp() + (-x).exp());
            for k in 0..6 {
                assert!(pulse.coefficient(k).is_finite(), "{place} {k}: {}", pulse.coefficient(k));
            }
        }
        let x = Taylor::<3>::variable(3.0) * Taylor::from(100.0);
        let pulse = Taylor::from(2.0) / (x.exp() + (-x).exp());
        assert!((pulse.coefficient(1) / (-200.0 * (-300.0_f64).exp()) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_first_term_left_out_is_the_first_that_differs() {
        macro_rules! leaves {
            ($($series:expr, $function:expr, $x:expr, $step:expr;)*) => {$(
                let low = order::<3>($series, $function, $x, 0.03 * $step);
                let high = order::<8>($series, $function, $x, $step);
                assert!((low - 3.0).abs() < 0.3, "{}: {low}", stringify!($function));
                assert!((high - 8.0).abs() < 0.5, "{}: {high}", stringify!($function));
            )*};
        }
        leaves! {
            |x| x.sqrt(), f64::sqrt, [0.7, 0.9, -0.31], 0.07;
            |x| x.exp(), f64::exp, [-0.7, 1.9, 0.43], 0.3;
            |x| x.ln(), f64::ln, [0.7, 0.9, -0.31], 0.07;
            |x| x.sin(), f64::sin, [-0.7, 1.9, 0.43], 0.3;
            |x| x.tan(), f64::tan, [0.7, 0.9, -0.31], 0.07;
            |x| x.asin(), f64::asin, [-0.3, 0.9, 0.31], 0.07;
            |x| x.atan(), f64::atan, [-1.3, 0.9, 0.31], 0.15;
            |x| x.atan2(x + 1.7.into()), |x| x.atan2(x + 1.7), [-0.3, 0.9, 0.31], 0.1;
            |x| (x + 2.0.into()).atan2(x + 0.3.into()), |x| (x + 2.0).atan2(x + 0.3), [-0.3, 0.9, 0.31], 0.15;
            |x| x.sinh_cosh().0, f64::sinh, [-0.7, 1.9, 0.43], 0.3;
            |x| x.tanh(), f64::tanh, [-0.7, 0.9, 0.43], 0.15;
            |x| x.powf(-1.37), |x| x.powf(-1.37), [0.7, 0.9, -0.31], 0.07;
            |x| x.powf(-3.0), |x| x.powi(-3), [-0.7, 0.9, -0.31], 0.07;
            |x| x.powf(11.0), |x| x.powi(11), [-0.7, 0.9, -0.31], 0.07;
            |x| -(x / (x * x - 2.0.into())), |x| x / (2.0 - x * x), [-0.7, 0.9, -0.31], 0.07;
        }
    }

    #[test]
    fn coefficients_of_known_series() {
        let t0 = 0.83;
        let t = Taylor::<12>::variable(t0);
        let (mut factorial, mut falling) = (1.0, 1.0);
        for k in 0..12 {
            let n = k as f64;
            let quarter = [t0.sin(), t0.cos(), -t0.sin(), -t0.cos()][k % 4];
            let logarithm = if k == 0 { t0.ln() } else { -(-t0).powi(-(k as i32)) / n };
            let pairs = [
                (t.exp(), t0.exp() / factorial),
                (t.sin(), quarter / factorial),
                (t.ln(), logarithm),
                (t.powf(2.7), falling / factorial * t0.powf(2.7 - n)),
            ];
            for (found, expected) in pairs {
                assert!((found.coefficient(k) - expected).abs() <= 1e-13 * expected.abs(), "{k}");
            }
            factorial *= n + 1.0;
            falling *= 2.7 - n;
        }
    }

    #[test]
    fn functions_undo_their_inverses() {
        let x = WAVY;
        let one = Taylor::from(1.0);
        close(x.ln().exp(), x);
        close(x.sqrt() * x.sqrt(), x);
        close(x.powf(1.7).powf(1.0 / 1.7), x);
        close(x.asin().sin(), x);
        close(x.acos().cos(), x);
        close(x.atan().tan(), x);
        close((x.sin() * x.exp()).atan2(x.cos() * x.exp()), x);
        let ((sin, cos), (sinh, cosh)) = (x.sin_cos(), x.sinh_cosh());
        close(sin * sin + cos * cos, one);
        close(cosh * cosh - sinh * sinh, one);
        close(sinh / cosh, x.tanh());
    }

    #[test]
    fn powers_have_derivatives_at_zero_and_below() {
        let t = Taylor::<4>::variable(0.0);
        assert_eq!(t.powf(2.0).derivatives(), [0.0, 0.0, 2.0, 0.0]);
        assert_eq!(t.powf(0.0).derivatives(), [1.0, 0.0, 0.0, 0.0]);
        assert_eq!(Taylor::<4>::variable(-2.0).powf(3.0).derivatives(), [-8.0, 12.0, -12.0, 6.0]);
        assert_eq!(Taylor::<3>::variable(-2.0).powf(-1.0).derivatives(), [-0.5, -0.25, -0.25]);
        assert_eq!((Smooth::powf(-3.0, 3.0), Smooth::powf(-3.0, 0.5).is_nan()), (-27.0, true));
    }

    #[test]
    fn where_there_is_no_derivative_it_is_not_a_number() {
        let t = Taylor::<3>::variable;
        let at = [
            (t(0.0).sqrt(), 0.0),
            (t(0.0).powf(0.3), 0.0),
            (t(0.0).ln(), f64::NEG_INFINITY),
            (t(1.0).asin(), 0.5 * std::f64::consts::PI),
            (t(0.0).atan2(t(0.0)), 0.0),
        ];
        for (found, value) in at {
            assert_eq!(found.value(), value);
            assert!(found.coefficient(1).is_nan() && found.coefficient(2).is_nan(), "{found:?}");
        }
        assert!(t(-1.0).ln().derivatives().iter().all(|d| d.is_nan()));
        assert_eq!(t(0.0).powf(1.5).derivatives().map(f64::is_nan), [false, false, true]);
    }

    #[test]
    fn extreme_arguments_do_no_harm() {
        assert_eq!(Taylor::<4>::variable(-800.0).tanh().derivatives(), [-1.0, 0.0, 0.0, 0.0]);
        let steep = Taylor::<3>::new([3e-200, 1e-200, 0.0]).atan2(Taylor::from(4e-200));
        assert!((steep.coefficient(1) - 0.16).abs() < 1e-15);
    }

    #[test]
    fn integral_and_derivative_are_inverse() {
        close(WAVY.derivative().integral(WAVY.value()), WAVY);
        assert_eq!(WAVY.derivative().coefficient(11), 0.0);
    }
}
