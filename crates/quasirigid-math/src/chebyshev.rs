//! Chebyshev interpolation of smooth functions of one variable.

use std::f64::consts::PI;

/// Nodes of an interpolation.
pub const NODES: usize = 12;

/// `acos` of a node of the interval from −1 to 1.
fn node(k: usize) -> f64 {
    PI * (k as f64 + 0.5) / NODES as f64
}

/// Several functions on an interval, interpolated at Chebyshev nodes.
#[derive(Clone, Debug)]
pub struct Chebyshev<const N: usize> {
    ends: [f64; 2],
    coefficients: [[f64; NODES]; N],
}

impl<const N: usize> Chebyshev<N> {
    /// Nodes of the interpolation on an interval, descending.
    #[must_use]
    pub fn nodes(ends: [f64; 2]) -> [f64; NODES] {
        let (middle, half) = (0.5 * (ends[0] + ends[1]), 0.5 * (ends[1] - ends[0]));
        std::array::from_fn(|k| middle + half * node(k).cos())
    }

    /// Interpolates functions on an interval; none if one fails at a node.
    pub fn fit(ends: [f64; 2], mut function: impl FnMut(f64) -> Option<[f64; N]>) -> Option<Self> {
        let mut values = [[0.0; N]; NODES];
        for (values, place) in values.iter_mut().zip(Self::nodes(ends)) {
            *values = function(place)?;
        }
        Some(Self::through(ends, &values))
    }

    /// Interpolates values at the [`nodes`](Self::nodes).
    #[must_use]
    pub fn through(ends: [f64; 2], values: &[[f64; N]; NODES]) -> Self {
        let mut coefficients = [[0.0; NODES]; N];
        for (k, values) in values.iter().enumerate() {
            for (row, value) in coefficients.iter_mut().zip(values) {
                for (j, coefficient) in row.iter_mut().enumerate() {
                    let weight = if j == 0 { 1.0 } else { 2.0 };
                    *coefficient += weight / NODES as f64 * value * (j as f64 * node(k)).cos();
                }
            }
        }
        Self { ends, coefficients }
    }

    /// From the [`coefficients`](Self::coefficients) on an interval.
    #[must_use]
    pub fn of(ends: [f64; 2], coefficients: [[f64; NODES]; N]) -> Self {
        Self { ends, coefficients }
    }

    /// Coefficients of each function, from the constant one up.
    #[must_use]
    pub fn coefficients(&self) -> &[[f64; NODES]; N] {
        &self.coefficients
    }

    /// The interval.
    #[must_use]
    pub fn ends(&self) -> [f64; 2] {
        self.ends
    }

    /// Largest share of the last two polynomials: an estimate of the error of the interpolation.
    #[must_use]
    pub fn tail(&self) -> f64 {
        let shares = self.tails().map(|[tail, largest]| tail / largest.max(f64::MIN_POSITIVE));
        shares.into_iter().fold(0.0, f64::max)
    }

    /// Of each function the larger coefficient of the last two polynomials, and the largest of all.
    #[must_use]
    pub fn tails(&self) -> [[f64; 2]; N] {
        self.coefficients.map(|row| {
            let largest = row.iter().fold(0.0_f64, |largest, c| largest.max(c.abs()));
            [row[NODES - 2].abs().max(row[NODES - 1].abs()), largest]
        })
    }

    fn half(&self) -> f64 {
        0.5 * (self.ends[1] - self.ends[0])
    }

    /// `acos` of a place in the interval, from 1 to −1, by its distance from the start.
    fn angle(&self, distance: f64) -> f64 {
        (distance / self.half() - 1.0).clamp(-1.0, 1.0).acos()
    }

    /// Values at a place in the interval.
    #[must_use]
    pub fn at(&self, x: f64) -> [f64; N] {
        self.at_distance(x - self.ends[0])
    }

    /// Values at a place in the interval that is known by its distance from the start.
    #[must_use]
    pub fn at_distance(&self, distance: f64) -> [f64; N] {
        let angle = self.angle(distance);
        self.coefficients.map(|row| row.iter().enumerate().map(|(j, c)| c * (j as f64 * angle).cos()).sum())
    }

    /// Integrals from the start of the interval to a place in it.
    #[must_use]
    pub fn integral(&self, x: f64) -> [f64; N] {
        let angle = self.angle(x - self.ends[0]);
        self.coefficients.map(|row| self.half() * (primitive(&row, angle) - primitive(&row, PI)))
    }
}

/// `∫ Σ c_j T_j dx` at `x = cos θ`.
fn primitive(row: &[f64; NODES], angle: f64) -> f64 {
    let T = |j: usize| (j as f64 * angle).cos();
    let term = |(j, c): (usize, &f64)| match j {
        0 => c * T(1),
        1 => 0.25 * c * T(2),
        _ => 0.5 * c * (T(j + 1) / (j as f64 + 1.0) - T(j - 1) / (j as f64 - 1.0)),
    };
    row.iter().enumerate().map(term).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrals_of_smooth_functions_are_exact() {
        let ends = [-0.3, 1.4];
        let fit = Chebyshev::fit(ends, |x| Some([x.exp(), (2.0 * x).cos()])).unwrap();
        assert!(fit.tail() < 1e-7);
        for x in [-0.3, 0.2, 1.4] {
            let [exponential, cosine] = fit.at(x);
            assert!((exponential - x.exp()).abs() < 1e-8 && (cosine - (2.0 * x).cos()).abs() < 1e-7);
            let [exponential, cosine] = fit.integral(x);
            assert!((exponential - (x.exp() - ends[0].exp())).abs() < 1e-12);
            assert!((cosine - 0.5 * ((2.0 * x).sin() - (2.0 * ends[0]).sin())).abs() < 1e-9);
        }
        assert!(Chebyshev::fit(ends, |x| (x < 1.0).then_some([x])).is_none());
    }
}
