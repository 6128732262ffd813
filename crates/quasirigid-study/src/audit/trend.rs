//! Straight line through a quantity against time, with its error: least squares, weighted by the resolution of each row.
//! The residuals may oscillate with the wobble, so that rows are no independent draws: their effective number is that of the changes of sign
//! of the residual, of which white noise has one in every second row.

/// Slope of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trend {
    /// Slope (1/s).
    pub slope: f64,
    /// Standard error of the slope (1/s).
    pub error: f64,
    /// Root mean square of the resolution of the rows.
    pub resolution: f64,
    /// Time (s) from the first row to the last.
    pub span: f64,
}

/// Standard errors beyond which a slope is not chance.
const SIGNIFICANT: f64 = 3.0;

impl Trend {
    /// Line through rows `(t, y, σ)`; none where fewer than two have a value. The weight of a row is `1/σ²`, of exact ones 1.
    pub fn of(rows: impl Iterator<Item = (f64, f64, f64)> + Clone) -> Option<Self> {
        let rows = rows.filter(|(_, y, sigma)| y.is_finite() && sigma.is_finite());
        let (first, last) = (rows.clone().next()?.0, rows.clone().last()?.0);
        let (middle, span) = (0.5 * (first + last), last - first);
        let weight = |sigma: f64| if sigma > 0.0 { (sigma * sigma).recip() } else { 1.0 };
        let (mut w0, mut w1, mut w2, mut y0, mut y1, mut noise, mut count) =
            (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0_u64);
        for (t, y, sigma) in rows.clone() {
            let (w, t) = (weight(sigma), t - middle);
            w0 += w;
            w1 += w * t;
            w2 += w * t * t;
            y0 += w * y;
            y1 += w * t * y;
            noise += sigma * sigma;
            count += 1;
        }
        let (mean, level) = (w1 / w0, y0 / w0);
        let spread = w2 / w0 - mean * mean;
        if count < 2 || !(spread > 0.0) {
            return None;
        }
        let slope = (y1 / w0 - mean * level) / spread;
        let (mut square, mut signs, mut before) = (0.0, 1_u64, 0.0_f64);
        for (t, y, sigma) in rows {
            let residual = y - level - slope * (t - middle - mean);
            square += weight(sigma) * residual * residual;
            signs += u64::from(residual * before < 0.0);
            before = residual;
        }
        let error = (square / w0 / spread / signs as f64).sqrt();
        Some(Self { slope, error, resolution: (noise / count as f64).sqrt(), span })
    }

    /// Whether the quantity changes by more than the resolution of a row, and not by chance.
    pub fn is_seen(&self) -> bool {
        self.slope.abs() > SIGNIFICANT * self.error && self.change().abs() > self.resolution
    }

    /// Change from the first row to the last.
    pub fn change(&self) -> f64 {
        self.slope * self.span
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(y: impl Fn(f64) -> f64 + Clone, sigma: f64) -> Trend {
        Trend::of((0..=1000).map(move |k| (5.0 + 0.3 * f64::from(k), y(f64::from(k) / 1000.0), sigma)))
            .unwrap()
    }

    #[test]
    fn a_line_is_found_and_an_oscillation_is_none() {
        let line = of(|x| 3.0 - 2.0 * x, 1e-3);
        assert!((line.slope * 300.0 + 2.0).abs() < 1e-12 && line.is_seen());
        for periods in [1.0, 2.5, 40.2] {
            for phase in [0.0, 1.0, 2.0] {
                let wave = of(move |x: f64| (std::f64::consts::TAU * periods * x + phase).sin(), 1e-3);
                assert!(!wave.is_seen(), "{periods} {phase} {wave:?}");
            }
        }
    }

    #[test]
    fn a_line_below_the_resolution_is_not_seen() {
        assert!(!of(|x| 0.9e-3 * x, 1e-3).is_seen());
        assert!(of(|x| 1.1e-3 * x, 1e-3).is_seen());
    }

    #[test]
    fn the_error_is_that_of_the_scatter() {
        // a fixed sequence without correlation, uniform in ±1/2
        let noise = |x: f64| ((x * 1000.0 + 1.0) * 0.618_033_988_749_895).fract() - 0.5;
        let found = of(move |x| 0.2 * x + noise(x), 1e-9);
        let expected = (12.0_f64 / 12.0 / 1000.0).sqrt() / 300.0;
        assert!(found.error > 0.7 * expected && found.error < 2.0 * expected, "{found:?}");
    }
}
