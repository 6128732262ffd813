use nalgebra::Complex;

/// Terms of the continued fraction in addition to the size of its argument.
const TERMS: usize = 30;
/// Argument from which the asymptotic series is exact to rounding.
const LARGE: f64 = 400.0;

/// Bessel index of the flow along a slender ring, and of the flow in a ball without spin.
pub(super) const RING: f64 = 0.0;
pub(super) const BALL: f64 = 1.5;

/// Force per rate of a flow without Coriolis force, `σ/(1 − χ)` of the frequency `σ = s a²/ν`, per `I ν/a²`. (C11)
pub(super) fn drag(index: f64, sigma: Complex<f64>) -> Complex<f64> {
    if sigma.norm() == 0.0 {
        return Complex::from(4.0 * (index + 1.0) * (index + 2.0));
    }
    let z = sigma.sqrt();
    let beyond = ratio(index + 1.0, z);
    sigma * (2.0 * (index + 1.0) / z + beyond) / beyond
}

/// `I_{ν+1}(z)/I_ν(z)` of modified Bessel functions, in the right half-plane.
fn ratio(index: f64, z: Complex<f64>) -> Complex<f64> {
    if z.norm() > LARGE {
        return asymptotic(index + 1.0, z) / asymptotic(index, z);
    }
    let terms = TERMS + (1.5 * z.norm()).ceil() as usize;
    let lowest = Complex::from(0.0);
    (1..=terms).rev().fold(lowest, |rest, k| (2.0 * (index + k as f64) / z + rest).inv())
}

/// `I_ν(z)` over `e^z/√(2πz)`, for large arguments.
fn asymptotic(index: f64, z: Complex<f64>) -> Complex<f64> {
    let square = 4.0 * index * index;
    let (mut term, mut sum) = (Complex::from(1.0), Complex::from(1.0));
    for k in 1..8_u32 {
        let odd = f64::from(2 * k - 1);
        term *= -(square - odd * odd) / (z * 8.0 * f64::from(k));
        sum += term;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Poiseuille's flow, with the rule that small arguments join the limit, and the boundary layer `σ + 2√σ`.
    #[test]
    fn a_ring_is_slow_as_poiseuille_has_it_and_fast_as_stokes_has_it() {
        let drag = |sigma: Complex<f64>| drag(RING, sigma);
        assert!((drag(Complex::new(0.0, 1e-9)) / drag(Complex::from(0.0)) - 1.0).norm() < 1e-9);
        for size in [1e4, 1e6, 1e8] {
            let sigma = Complex::new(0.0, size);
            let layer = sigma + 2.0 * sigma.sqrt();
            assert!((drag(sigma) - layer).norm() < 3.5, "curvature adds a constant");
        }
    }

    /// `χ = (5/z²)(z i₁′/i₁ − 1)` of a ball, with hyperbolic functions.
    #[test]
    fn a_ball_follows_its_wall_as_the_hyperbolic_functions_have_it() {
        for frequency in [3.0, 40.0, 900.0, 1.0e5, 1.0e6, 3.0e7] {
            let s = Complex::new(0.0, frequency);
            let z: Complex<f64> = s.sqrt();
            let fading = (-2.0 * z).exp();
            let tanh = (Complex::from(1.0) - fading) / (Complex::from(1.0) + fading);
            // i₁ = (z cosh z − sinh z)/z², hence z i₁′/i₁ = (z² tanh z − 2z + 2 tanh z)/(z − tanh z).
            let slope = (z * z * tanh - 2.0 * z + 2.0 * tanh) / (z - tanh);
            let expected = s / (1.0 - 5.0 / (z * z) * (slope - 1.0));
            assert!((drag(BALL, s) / expected - 1.0).norm() < 1e-11, "{frequency}");
        }
    }
}
