//! Conic of any eccentricity by its periapsis: a flyby on a hyperbola or a parabola, or an ellipse however narrow.
//! Kepler's equation in a universal anomaly has no singular eccentricity; it is solved from above its root, where Newton's method descends
//! without overshoot, and Newton's steps in series arithmetic then give the derivatives.
//! Equations (F23) and (F24), docs/theory/07-forces.md.

use std::f64::consts::{PI, TAU};

use super::OrbitPoint;
use super::orbit::axes;
use crate::math::scalar::Smooth;
use crate::math::vec3::{add, scale};

/// Keplerian orbit of any eccentricity about a centre of attraction, the origin of the inertial axes, by its periapsis. (F23)
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conic {
    /// Gravitational parameter `μ₀` of the centre (m³/s²).
    pub mu: f64,
    /// Distance of the periapsis from the centre (m).
    pub periapsis_distance: f64,
    /// Eccentricity: below 1 of an ellipse, 1 of a parabola, above of a hyperbola.
    pub eccentricity: f64,
    /// Inclination (rad).
    pub inclination: f64,
    /// Right ascension of the ascending node (rad).
    pub raan: f64,
    /// Argument of the periapsis (rad).
    pub argument_of_periapsis: f64,
    /// Time of the passage of the periapsis (s).
    pub time_of_periapsis: f64,
}

impl Conic {
    /// Speed at the periapsis (m/s).
    #[must_use]
    pub fn greatest_speed(&self) -> f64 {
        (self.mu * (1.0 + self.eccentricity) / self.periapsis_distance).sqrt()
    }

    /// Time (s) in which the body would pass the distance of the periapsis at its speed there.
    #[must_use]
    pub fn passing_time(&self) -> f64 {
        self.periapsis_distance / self.greatest_speed()
    }

    /// Period (s) of an ellipse.
    #[must_use]
    pub fn period(&self) -> Option<f64> {
        let flatness = 1.0 - self.eccentricity;
        (flatness > 0.0).then(|| TAU / (self.rate() * flatness * flatness.sqrt()))
    }

    /// Place and velocity at a time (s), which may be a series. (F23)
    #[must_use]
    pub fn at<T: Smooth>(&self, t: T) -> OrbitPoint<T> {
        let (q, e, rate) = (self.periapsis_distance, self.eccentricity, self.rate());
        let mut passed = t - T::from(self.time_of_periapsis);
        if let Some(period) = self.period() {
            passed = passed - T::from(period * (passed.value() / period).round());
        }
        let [G0, G1, G2, _] = anomalies(1.0 - e, universal_anomaly(e, T::from(rate) * passed));
        let radius = T::from(1.0) + T::from(e) * G2; // r/q
        let across = (1.0 + e).sqrt();
        let [P, Q] = axes(self.inclination, self.raan, self.argument_of_periapsis);
        let at = |size: f64, x: T, y: T| {
            add(scale(T::from(size) * x, P.map(T::from)), scale(T::from(size) * y, Q.map(T::from)))
        };
        OrbitPoint {
            place: at(q, T::from(1.0) - G2, T::from(across) * G1),
            velocity: at(q * rate, -G1 / radius, T::from(across) * G0 / radius),
            radius: T::from(q) * radius,
        }
    }

    /// `√(μ₀/q³)` (1/s).
    fn rate(&self) -> f64 {
        (self.mu / self.periapsis_distance).sqrt() / self.periapsis_distance
    }
}

/// Root `s` of Kepler's equation `s + e G₃(s) = τ`. (F24)
fn universal_anomaly<T: Smooth>(e: f64, tau: T) -> T {
    let mut s = T::from(root(e, tau.value()));
    // Each step doubles the number of terms that are exact.
    let doublings = T::TERMS.next_power_of_two().ilog2();
    for _ in 0..doublings {
        let [.., G2, G3] = anomalies(1.0 - e, s);
        s = s - (s + T::from(e) * G3 - tau) / (T::from(1.0) + T::from(e) * G2);
    }
    s
}

/// Root of Kepler's equation for a number, of an ellipse within half a period.
///
/// For a positive `τ` the equation is convex up to the root, so Newton's steps from above it descend to it; they end where rounding stops
/// the descent. The start is the least of bounds of the root: `G₃ ≥ 0`; `G₃ ≥ s³/π²` of an ellipse up to its apoapsis, `G₃ ≥ s³/6` of the others;
/// `e sinh x − x ≥ (e − 1) sinh x` of a hyperbola.
fn root(e: f64, tau: f64) -> f64 {
    let height = tau.abs();
    let beta = 1.0 - e;
    let mut s = height;
    if beta > 0.0 {
        s = (height / beta).min((PI * PI * height).cbrt()).min(PI / beta.sqrt());
    } else if e > 0.0 {
        s = s.min((6.0 * height / e).cbrt());
    }
    if beta < 0.0 {
        let kappa = (-beta).sqrt();
        s = s.min((kappa * height).asinh() / kappa);
    }
    loop {
        let [.., G2, G3] = anomalies(beta, s);
        let next = s - (s + e * G3 - height) / (1.0 + e * G2);
        if !(next < s) {
            return s.copysign(tau);
        }
        s = next;
    }
}

/// Terms of the series of `c₂` and `c₃`, whose first left out is below `10⁻³⁰` within their range.
const TERMS: u32 = 14;

/// Functions `G₀` to `G₃` of the universal anomaly, `Gₙ = sⁿ cₙ(β s²)`. (F24)
fn anomalies<T: Smooth>(beta: f64, s: T) -> [T; 4] {
    let one = T::from(1.0);
    let z = T::from(beta) * s * s;
    let [c2, c3] = if z.value().abs() < 1.0 {
        series(z)
    } else if z.value() > 0.0 {
        let x = z.sqrt();
        let (sin, cos) = x.sin_cos();
        [(one - cos) / z, (x - sin) / (z * x)]
    } else {
        let x = (-z).sqrt();
        let (sinh, cosh) = x.sinh_cosh();
        [(one - cosh) / z, (sinh - x) / (-z * x)]
    };
    let (G2, G3) = (s * s * c2, s * s * s * c3);
    [one - T::from(beta) * G2, s - T::from(beta) * G3, G2, G3]
}

/// Stumpff's `c₂(z)` and `c₃(z)` by their series.
fn series<T: Smooth>(z: T) -> [T; 2] {
    [2, 3].map(|n| {
        let outer = (0..TERMS).rev().map(|k| f64::from((2 * k + n + 1) * (2 * k + n + 2)));
        let sum = outer.fold(T::from(1.0), |sum, factor| T::from(1.0) - z * sum * T::from(1.0 / factor));
        sum * T::from(if n == 2 { 0.5 } else { 1.0 / 6.0 })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against sums of the series in all their terms, on both sides of the place where the closed form takes over.
    #[test]
    fn stumpff_functions_are_continuous_at_the_change_of_form() {
        for beta in [1.0, -1.0] {
            for s in [1e-9, 0.3, 1.0 - 1e-12, 1.0 + 1e-12, 1.9] {
                let z: f64 = beta * s * s;
                let term = |n: u32, k: u32| {
                    let factorial: f64 = (1..=2 * k + n).map(f64::from).product();
                    (-z).powi(k as i32) / factorial
                };
                let c = |n: u32| (0..20).rev().map(|k| term(n, k)).sum::<f64>();
                let found = anomalies(beta, s);
                for (n, G) in (0u32..).zip(found) {
                    let known = s.powi(n as i32) * c(n);
                    assert!(
                        (G - known).abs() < 4e-15 * known.abs().max(0.1 * s.powi(n as i32)),
                        "{beta} {s} {n}: {G} {known}"
                    );
                }
            }
        }
    }

    /// Kepler's equation is solved to the rounding of its largest term, from circles to lines, near the periapsis and far from it.
    #[test]
    fn the_universal_anomaly_is_found_at_any_eccentricity() {
        let near = [1e-15, 1e-12, 1e-8, 1e-4].iter().flat_map(|d| [1.0 - d, 1.0 + d]);
        for e in [0.0, 0.3, 0.9, 1.0, 1.5, 4.23, 1e3, 1e9].into_iter().chain(near) {
            for exponent in -40..40 {
                for sign in [1.0, -1.0] {
                    let mut tau = sign * 10f64.powf(f64::from(exponent) / 4.0);
                    if e < 1.0 {
                        let half = PI / (1.0 - e).powf(1.5);
                        tau = tau.clamp(-half, half);
                    }
                    let s = root(e, tau);
                    let G3 = anomalies(1.0 - e, s)[3];
                    assert!((s + e * G3 - tau).abs() < 2e-14 * tau.abs(), "e = {e}, tau = {tau:e}: {s:e}");
                }
            }
        }
    }
}
