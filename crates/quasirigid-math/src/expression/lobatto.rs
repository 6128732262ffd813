//! Whether a function over an interval is a polynomial: its values between the points of Lobatto, against those from the polynomial
//! through them.

use std::f64::consts::PI;

/// Points of the polynomial, and all points: those between are what it is compared at.
pub const COARSE: usize = 9;
pub const FINE: usize = 2 * COARSE - 1;

/// Points of an interval, denser to its ends, and the weights that take every second value to those between.
#[derive(Clone, Debug)]
pub struct Lobatto {
    /// Points of the interval from 0 to 1.
    pub points: [f64; FINE],
    weights: [[f64; COARSE]; COARSE - 1],
}

impl Default for Lobatto {
    fn default() -> Self {
        Self::new()
    }
}

impl Lobatto {
    /// Number of points.
    pub const POINTS: usize = FINE;

    /// Points and weights.
    #[must_use]
    pub fn new() -> Self {
        let last = (FINE - 1) as f64;
        let points: [f64; FINE] = std::array::from_fn(|i| 0.5 - 0.5 * (PI * i as f64 / last).cos());
        let weights = std::array::from_fn(|i| cardinal(&points, points[2 * i + 1]));
        Self { points, weights }
    }

    /// Weights of the values at all points for the polynomial through them at a place of the interval.
    #[must_use]
    pub fn weights_at(&self, x: f64) -> [f64; FINE] {
        if let Some(at) = self.points.iter().position(|point| *point == x) {
            return std::array::from_fn(|i| f64::from(u8::from(i == at)));
        }
        // Barycentric weights of these points: one in turn with each sign, half at the ends.
        let part = |i: usize| {
            let end = if i == 0 || i == FINE - 1 { 0.5 } else { 1.0 };
            (if i.is_multiple_of(2) { end } else { -end }) / (x - self.points[i])
        };
        let parts: [f64; FINE] = std::array::from_fn(part);
        let sum: f64 = parts.iter().sum();
        parts.map(|part| part / sum)
    }

    /// Largest distance of the values from the polynomial through every second of them; NaN if a value is not finite.
    pub fn defect(&self, values: &[f64; FINE]) -> f64 {
        if !values.iter().all(|value| value.is_finite()) {
            return f64::NAN;
        }
        // in units of the largest, so that sums of the largest numbers are finite
        let largest = values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        if largest == 0.0 {
            return 0.0;
        }
        let mut worst = 0.0_f64;
        for (i, row) in self.weights.iter().enumerate() {
            let polynomial: f64 =
                row.iter().enumerate().map(|(j, weight)| weight * (values[2 * j] / largest)).sum();
            worst = worst.max((polynomial - values[2 * i + 1] / largest).abs());
        }
        worst * largest
    }
}

/// Values at `x` of the polynomials that are one in one of the coarse points and zero in the others.
fn cardinal(points: &[f64; FINE], x: f64) -> [f64; COARSE] {
    std::array::from_fn(|j| {
        let others = (0..COARSE).filter(|k| *k != j);
        others.map(|k| (x - points[2 * k]) / (points[2 * j] - points[2 * k])).product()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_through_all_points_are_exact_to_degree_sixteen() {
        let lobatto = Lobatto::new();
        let f = |x: f64| 3.0 * x.powi(16) - x.powi(3) + 0.2;
        for x in [0.0, 0.013, 0.5, 0.77, 1.0] {
            let sum: f64 = lobatto
                .weights_at(x)
                .iter()
                .zip(lobatto.points)
                .map(|(weight, point)| weight * f(point))
                .sum();
            assert!((sum - f(x)).abs() < 1e-14, "{x}: {sum}");
        }
    }

    #[test]
    fn polynomials_of_degree_eight_have_no_defect_and_others_have() {
        let lobatto = Lobatto::new();
        let defect = |f: fn(f64) -> f64| lobatto.defect(&lobatto.points.map(f));
        assert!(defect(|x| 3.0 * x.powi(8) - x) < 1e-14);
        assert!(defect(|x| (x - 0.5).abs()) > 1e-2);
        assert!(defect(|x| x.ln()).is_nan());
        assert!(defect(|x| 1e308 * (x + 0.5)) < 1e-14 * f64::MAX);
        assert_eq!(defect(|_| 0.0), 0.0);
    }
}
