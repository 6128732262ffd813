//! Hysteresis rods: bars of a soft magnetic material, whose magnetisation lags behind the field. (Y10), (Y11)

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

use super::SensedField;
use crate::force::MAGNETIC_CONSTANT;
use crate::math::vec3::{dot, scale};

/// Halvings of the interval in which a rod without a past has its state: as many as a number has digits.
const HALVINGS: usize = 100;

/// Major loop of a soft magnetic material. (Y10)
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HysteresisLoop {
    /// Induction at saturation `B_s` (T).
    pub saturation: f64,
    /// Remanence `B_r` (T), less than the saturation.
    pub remanence: f64,
    /// Coercivity `H_c` (A/m).
    pub coercivity: f64,
}

/// Hysteresis rod. (Y11)
///
/// Its state is the lagging field `u` (A/m): that at which the middle of the major loop has the induction of the rod.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct HysteresisRod {
    /// Name.
    pub name: String,
    /// Axis, a unit vector, body axes.
    pub axis: [f64; 3],
    /// Volume (m³).
    pub volume: f64,
    /// Demagnetisation factor `N` along the axis, from 0 to below 1.
    pub demagnetization: f64,
    /// Material.
    pub material: HysteresisLoop,
}

impl HysteresisLoop {
    /// Steepness `k` of the limiting curves (m/A).
    #[must_use]
    pub fn steepness(&self) -> f64 {
        (FRAC_PI_2 * self.remanence / self.saturation).tan() / self.coercivity
    }

    /// Induction (T) at a lagging field (A/m). (Y10)
    #[must_use]
    pub fn induction(&self, lagging: f64) -> f64 {
        FRAC_2_PI * self.saturation * (self.steepness() * lagging).atan()
    }

    /// Slope of the induction by the lagging field (T·m/A).
    #[must_use]
    pub fn slope(&self, lagging: f64) -> f64 {
        let k = self.steepness();
        FRAC_2_PI * self.saturation * k / (1.0 + (k * lagging).powi(2))
    }

    /// Rate of the lagging field per rate of a field (A/m) that rises, or falls. (Y10)
    #[must_use]
    pub fn following(&self, field: f64, lagging: f64, rises: bool) -> f64 {
        let ahead = if rises { field - lagging } else { lagging - field };
        (0.5 * (1.0 + ahead / self.coercivity)).max(0.0).powi(2)
    }
}

impl HysteresisRod {
    /// Magnetising force along the axis outside (A/m), and its rate (A/m/s).
    fn outside(&self, field: &SensedField) -> [f64; 2] {
        [field.field, field.rate].map(|vector| dot(self.axis, vector) / MAGNETIC_CONSTANT)
    }

    /// Field inside (A/m) at one outside and a state (A/m). (Y11)
    fn inside(&self, outside: f64, lagging: f64) -> f64 {
        let N = self.demagnetization;
        (outside - N * self.material.induction(lagging) / MAGNETIC_CONSTANT) / (1.0 - N)
    }

    /// Rate (A/m/s) of a state (A/m). (Y11)
    #[must_use]
    pub fn rate(&self, field: &SensedField, lagging: f64) -> f64 {
        let [outside, change] = self.outside(field);
        let follows = self.material.following(self.inside(outside, lagging), lagging, change > 0.0);
        let N = self.demagnetization;
        let opposed = N * self.material.slope(lagging) / MAGNETIC_CONSTANT;
        follows * change / (1.0 - N + follows * opposed)
    }

    /// Dipole moment (A·m², body axes) at a state (A/m). (Y11)
    #[must_use]
    pub fn moment(&self, field: &SensedField, lagging: f64) -> [f64; 3] {
        let [outside, _] = self.outside(field);
        let magnetization =
            self.material.induction(lagging) / MAGNETIC_CONSTANT - self.inside(outside, lagging);
        scale(self.volume * magnetization, self.axis)
    }

    /// State (A/m) without a past: on the middle of the major loop, where the lagging field is that inside.
    #[must_use]
    pub fn without_past(&self, field: &SensedField) -> f64 {
        let [outside, _] = self.outside(field);
        let mut ends = [0.0, outside / (1.0 - self.demagnetization)];
        for _ in 0..HALVINGS {
            let middle = 0.5 * (ends[0] + ends[1]);
            let short = (self.inside(outside, middle) - middle) * outside.signum() > 0.0;
            ends[usize::from(!short)] = middle;
        }
        0.5 * (ends[0] + ends[1])
    }
}

/// Demagnetisation factor along the axis of a prolate spheroid, longer than wide by a ratio above one: that of an ellipsoid, in elementary
/// terms. (Y11)
#[must_use]
pub fn demagnetization_of_spheroid(ratio: f64) -> f64 {
    let square = 1.0 - 1.0 / (ratio * ratio);
    let e = square.sqrt();
    if e < 0.05 {
        // the series of the expression below
        return (1.0 - square) * (1.0 / 3.0 + square / 5.0 + square * square / 7.0 + square.powi(3) / 9.0);
    }
    (1.0 - square) * (e.atanh() - e) / (e * square)
}

#[cfg(test)]
mod tests {
    use super::*;

    const MATERIAL: HysteresisLoop = HysteresisLoop { saturation: 0.74, remanence: 0.35, coercivity: 1.59 };

    fn rod(demagnetization: f64) -> HysteresisRod {
        let axis = [0.6, 0.0, 0.8];
        HysteresisRod { name: String::new(), axis, volume: 7e-8, demagnetization, material: MATERIAL }
    }

    fn sensed(outside: f64, change: f64) -> SensedField {
        let along = |value: f64| scale(MAGNETIC_CONSTANT * value, [0.6, 0.0, 0.8]);
        SensedField { field: along(outside), rate: along(change) }
    }

    /// State after the field outside has gone to another value, by the classical method of Runge and Kutta; `∫ H dB` and `∫ μ₀M dH` are added.
    fn swept(rod: &HysteresisRod, lagging: f64, [from, to]: [f64; 2], sums: &mut [f64; 2]) -> f64 {
        let steps = 4000;
        let h = (to - from) / f64::from(steps);
        let slope = |outside: f64, u: f64| {
            let rate = rod.rate(&sensed(outside, h.signum()), u) * h.signum();
            let induced = rate * rod.material.slope(u);
            let moment = dot(rod.axis, rod.moment(&sensed(outside, 0.0), u));
            [rate, rod.inside(outside, u) * induced, MAGNETIC_CONSTANT * moment / rod.volume]
        };
        let mut u = lagging;
        for step in 0..steps {
            let H = from + h * f64::from(step);
            let k1 = slope(H, u);
            let k2 = slope(H + 0.5 * h, u + 0.5 * h * k1[0]);
            let k3 = slope(H + 0.5 * h, u + 0.5 * h * k2[0]);
            let k4 = slope(H + h, u + h * k3[0]);
            let mean: [f64; 3] = std::array::from_fn(|i| (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]) / 6.0);
            u += h * mean[0];
            sums.iter_mut().zip(&mean[1..]).for_each(|(sum, mean)| *sum += h * mean);
        }
        u
    }

    /// Within the loop the distance from its middle follows a hyperbolic tangent, in the field inside: `s = tanh((H − H₁)/2H_c + artanh s₁)`.
    #[test]
    fn the_lag_is_a_hyperbolic_tangent() {
        let (rod, Hc) = (rod(0.0), MATERIAL.coercivity);
        for (from, to, start) in [(-0.4, 2.9, -0.9), (1.0, -3.0, 1.2), (0.0, 30.0, 0.3)] {
            let u = swept(&rod, start, [from, to], &mut [0.0; 2]);
            let sign = f64::signum(to - from);
            let s = |H: f64, u: f64| 0.5 * (1.0 + sign * (H - u) / Hc);
            let known = ((to - from).abs() / (2.0 * Hc) + s(from, start).atanh()).tanh();
            assert!((s(to, u) - known).abs() < 1e-11, "{} {known}", s(to, u));
        }
    }

    /// Remanence, coercivity and saturation of the major loop, and its area `4 B_s H_c`.
    #[test]
    fn the_major_loop_is_that_of_its_three_numbers() {
        let HysteresisLoop { saturation, remanence, coercivity } = MATERIAL;
        let close =
            |found: f64, known: f64, by: f64| assert!((found / known - 1.0).abs() < by, "{found} {known}");
        let rod = rod(0.0);
        let top = swept(&rod, 0.0, [0.0, 2000.0], &mut [0.0; 2]);
        close(MATERIAL.induction(top), saturation, 1e-3);
        let left = swept(&rod, top, [2000.0, 0.0], &mut [0.0; 2]);
        close(MATERIAL.induction(left), remanence, 1e-12);
        let crossed = swept(&rod, left, [0.0, -coercivity], &mut [0.0; 2]);
        assert!(MATERIAL.induction(crossed).abs() < 1e-12 * saturation);
        let mut sums = [0.0; 2];
        let mut u = top;
        for ends in
            [[2000.0, 20.0], [20.0, -20.0], [-20.0, -2000.0], [-2000.0, -20.0], [-20.0, 20.0], [20.0, 2000.0]]
        {
            u = swept(&rod, u, ends, &mut sums);
        }
        // the ends of the loop, where the lag changes its side in saturation
        close(sums[0], 4.0 * saturation * coercivity, 2e-3);
    }

    /// What a closed loop takes from the field outside is its area by the field inside, also of a short rod; and it is never negative.
    #[test]
    fn a_closed_loop_takes_its_area() {
        for (N, most) in [(0.0, 1.0), (0.0, 12.0), (4e-4, 6.0), (2e-3, 25.0)] {
            let rod = rod(N);
            let mut u = rod.without_past(&sensed(0.0, 0.0));
            u = swept(&rod, u, [0.0, most], &mut [0.0; 2]);
            for _ in 0..40 {
                u = swept(&rod, u, [most, -most], &mut [0.0; 2]);
                u = swept(&rod, u, [-most, most], &mut [0.0; 2]);
            }
            let (from, mut sums) = (u, [0.0; 2]);
            u = swept(&rod, u, [most, -most], &mut sums);
            u = swept(&rod, u, [-most, most], &mut sums);
            assert!((u - from).abs() < 1e-9 * most, "{u} {from}");
            assert!(sums[0] > 0.0 && (sums[0] + sums[1]).abs() < 1e-7 * sums[0], "{N} {most}: {sums:?}");
        }
    }

    /// In the middle of the loop, with the field that the rod itself takes from that outside.
    #[test]
    fn a_rod_without_a_past_is_in_the_middle_of_its_loop() {
        for (N, outside) in [(0.0, 7.0), (0.01, 25.0), (0.3, -25.0), (1e-3, 0.0)] {
            let rod = rod(N);
            let u = rod.without_past(&sensed(outside, 0.0));
            assert!((rod.inside(outside, u) - u).abs() <= 1e-12 * outside.abs(), "{N} {outside}: {u}");
        }
    }

    /// The factors of the three axes add up to one: across, half of the rest. Of a ball a third; of a long rod `(ln 2m − 1)/m²`.
    #[test]
    fn the_factor_of_a_spheroid_has_its_limits() {
        assert!((demagnetization_of_spheroid(1.0 + 1e-9) - 1.0 / 3.0).abs() < 1e-8);
        let m: f64 = 300.0;
        let long = ((2.0 * m).ln() - 1.0) / (m * m);
        assert!((demagnetization_of_spheroid(m) / long - 1.0).abs() < 1e-4);
        let [near, far] = [1.00125, 1.001255].map(demagnetization_of_spheroid);
        assert!((near - far).abs() < 2e-6 && near > far, "{near} {far}");
        // by the integral ½ m ∫ ds / ((s + m²)^{3/2} (s + 1)), s = x/(1 − x), by Simpson's rule
        let m: f64 = 2.5;
        let integrand = |x: f64| {
            let s = x / (1.0 - x);
            0.5 * m / ((s + m * m).powf(1.5) * (s + 1.0)) / (1.0 - x).powi(2)
        };
        let n = 20_000;
        let h = 1.0 / f64::from(n);
        let weight = |i: i32| if i == 0 { 1.0 } else { 2.0 + 2.0 * f64::from(i % 2) };
        let sum: f64 = (0..n).map(|i| weight(i) * integrand(h * f64::from(i))).sum();
        assert!((demagnetization_of_spheroid(m) / (h / 3.0 * sum) - 1.0).abs() < 1e-4);
    }
}
