//! Truncated Fourier series of real functions: products, derivatives and values.
//! Real and imaginary parts are columns of one real matrix, so that modal matrices act on whole series by one product; negative harmonics
//! are conjugates and never stored.
//! Equation (H4), docs/theory/14-spinning-frame.md.

use nalgebra::{Complex, DMatrix};

/// Fourier amplitudes of real functions of period `T`, harmonics 0 to `N`: row by row, columns in pairs of real and imaginary part.
/// Amplitudes of negative harmonics are the conjugates. (H4)
pub(super) type Amplitudes = DMatrix<f64>;

/// Number of harmonics beside the mean.
pub(super) fn harmonics(amplitudes: &Amplitudes) -> usize {
    amplitudes.ncols() / 2 - 1
}

/// Amplitude of a row at a harmonic.
pub(super) fn at(amplitudes: &Amplitudes, row: usize, harmonic: usize) -> Complex<f64> {
    Complex::new(amplitudes[(row, 2 * harmonic)], amplitudes[(row, 2 * harmonic + 1)])
}

/// Adds the product with a function whose amplitudes `factor` are given from the first harmonic on, and whose mean is zero. (H4)
pub(super) fn add_product(sum: &mut Amplitudes, factor: &[Complex<f64>], function: &Amplitudes) {
    let last = harmonics(function);
    for (index, c) in factor.iter().enumerate().take(2 * last) {
        let shift = index + 1;
        if c.norm_sqr() == 0.0 {
            continue;
        }
        for n in 0..=last {
            if n + shift <= last {
                add_column(sum, n, c.conj(), function, n + shift, 1.0);
            }
            if n >= shift {
                add_column(sum, n, *c, function, n - shift, 1.0);
            } else if shift - n <= last {
                add_column(sum, n, *c, function, shift - n, -1.0);
            }
        }
    }
}

/// Adds `c` times a column, or its conjugate where `sign` is −1, to a column.
fn add_column(
    sum: &mut Amplitudes,
    to: usize,
    c: Complex<f64>,
    function: &Amplitudes,
    from: usize,
    sign: f64,
) {
    let rows = function.nrows();
    let source = &function.as_slice()[2 * from * rows..2 * (from + 1) * rows];
    let target = &mut sum.as_mut_slice()[2 * to * rows..2 * (to + 1) * rows];
    let ((real, imaginary), (re, im)) = (source.split_at(rows), target.split_at_mut(rows));
    for row in 0..rows {
        let (x, y) = (real[row], sign * imaginary[row]);
        re[row] += c.re * x - c.im * y;
        im[row] += c.re * y + c.im * x;
    }
}

/// Value at a phase `Ω_p t`.
pub(super) fn value(amplitudes: &Amplitudes, row: usize, phase: f64) -> f64 {
    let term = |n: usize| (at(amplitudes, row, n) * Complex::from_polar(1.0, n as f64 * phase)).re;
    amplitudes[(row, 0)] + 2.0 * (1..=harmonics(amplitudes)).map(term).sum::<f64>()
}

/// Derivative: `iν_n` times the amplitudes, of functions with the frequency `frequency` (rad/s).
pub(super) fn derivative(amplitudes: &Amplitudes, frequency: f64) -> Amplitudes {
    let mut rates = amplitudes.clone();
    for n in 0..=harmonics(amplitudes) {
        let nu = n as f64 * frequency;
        for row in 0..amplitudes.nrows() {
            let c = at(amplitudes, row, n);
            rates[(row, 2 * n)] = -nu * c.im;
            rates[(row, 2 * n + 1)] = nu * c.re;
        }
    }
    rates
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Product of two trigonometric polynomials, compared at some phases.
    #[test]
    fn amplitudes_of_a_product_are_those_of_its_values() {
        let function =
            Amplitudes::from_row_slice(1, 12, &[0.3, 0.0, 0.2, -0.7, 1.1, 0.4, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let factor = [Complex::new(0.5, 0.1), Complex::new(-0.2, 0.6), Complex::new(0.0, 0.9)];
        let mut product = Amplitudes::zeros(1, 12);
        add_product(&mut product, &factor, &function);
        for phase in [0.0, 0.4, 1.9, 4.0] {
            let wave = |(i, c): (usize, &Complex<f64>)| {
                2.0 * (c * Complex::from_polar(1.0, (i + 1) as f64 * phase)).re
            };
            let expected = factor.iter().enumerate().map(wave).sum::<f64>() * value(&function, 0, phase);
            assert!((value(&product, 0, phase) - expected).abs() < 1e-14);
        }
    }
}
