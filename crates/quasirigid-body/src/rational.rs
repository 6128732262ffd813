//! Rational modulus of a material: springs, a dashpot and Maxwell elements in parallel, which states can follow.
//! The parts are not negative, so that no motion takes energy from the material.
//! Equation (M21), docs/theory/15-modes.md.

use nalgebra::Complex;

use crate::math::nonnegative::nonnegative_least_squares;
use crate::rheology::Rheology;

/// Rational modulus `μ(s) = μ₀ + μ₁ s + Σ μᵢ s/(s + rᵢ)`, relative to the modulus of the material. (M21)
#[derive(Clone, Debug, PartialEq)]
pub struct RationalModulus {
    /// `μ₀`.
    pub spring: f64,
    /// `μ₁` (s).
    pub dashpot: f64,
    /// `rᵢ` (1/s) and `μᵢ` of each Maxwell element.
    pub maxwell: Vec<[f64; 2]>,
}

/// Maxwell elements offered to the fit in each decade, and decades beyond the ends of the band where they are offered.
const ELEMENTS_PER_DECADE: f64 = 3.0;
const DECADES_BEYOND: f64 = 1.5;
/// Frequencies of the fit in each decade.
const SAMPLES_PER_DECADE: f64 = 15.0;
/// Share of the largest modulus below which an element is dropped.
const NEGLIGIBLE: f64 = 1e-12;

impl RationalModulus {
    /// The modulus of a law: itself where it is rational, else fitted between two frequencies (rad/s), modulus and loss each to a share of
    /// its own.
    #[must_use]
    pub fn of(law: &Rheology, band: [f64; 2]) -> Self {
        let exact = |spring, dashpot, maxwell| Self { spring, dashpot, maxwell };
        match *law {
            Rheology::Elastic => exact(1.0, 0.0, Vec::new()),
            Rheology::KelvinVoigt { time } => exact(1.0, time, Vec::new()),
            Rheology::Maxwell { time } => exact(0.0, 0.0, vec![[time.recip(), 1.0]]),
            Rheology::StandardLinear { time, strength } => exact(1.0, 0.0, vec![[time.recip(), strength]]),
            Rheology::QualityFactor { .. } | Rheology::Andrade { .. } | Rheology::Table(_) => {
                Self::fitted(law, band)
            }
        }
    }

    fn fitted(law: &Rheology, [low, high]: [f64; 2]) -> Self {
        let beyond = 10.0_f64.powf(DECADES_BEYOND);
        let rates = spaced([low / beyond, high * beyond], ELEMENTS_PER_DECADE);
        let frequencies = spaced([low, high], SAMPLES_PER_DECADE);
        let wanted: Vec<_> = frequencies.iter().map(|frequency| law.modulus(*frequency)).collect();
        let part = |column: usize, frequency: f64| match column {
            0 => Complex::from(1.0),
            1 => Complex::new(0.0, frequency / high),
            _ => relaxed(Complex::new(0.0, frequency), rates[column - 2]),
        };
        let row = |frequency: f64, [modulus, loss]: [f64; 2]| {
            let values: Vec<_> = (0..2 + rates.len()).map(|column| part(column, frequency)).collect();
            [
                values.iter().map(|value| value.re / modulus).collect(),
                values.iter().map(|value| value.im / loss).collect(),
            ]
        };
        let rows: Vec<Vec<f64>> =
            frequencies.iter().zip(wanted).flat_map(|(frequency, wanted)| row(*frequency, wanted)).collect();
        let found = nonnegative_least_squares(&rows, &vec![1.0; rows.len()]);
        let elements = rates.iter().zip(found.iter().skip(2)).map(|(rate, strength)| [*rate, *strength]);
        let least = NEGLIGIBLE * found.iter().copied().fold(0.0, f64::max);
        Self {
            spring: found[0],
            dashpot: found[1] / high,
            maxwell: elements.filter(|[_, strength]| *strength > least).collect(),
        }
    }

    /// Value at a complex frequency (1/s), real and imaginary part.
    #[must_use]
    pub fn at(&self, [re, im]: [f64; 2]) -> [f64; 2] {
        let s = Complex::new(re, im);
        let elements = self.maxwell.iter().map(|[rate, strength]| relaxed(s, *rate) * *strength);
        let value = elements.sum::<Complex<f64>>() + s * self.dashpot + self.spring;
        [value.re, value.im]
    }

    /// Modulus of fast strain without the dashpot, `μ₀ + Σ μᵢ`.
    #[must_use]
    pub fn fast(&self) -> f64 {
        self.spring + self.maxwell.iter().map(|[_, strength]| strength).sum::<f64>()
    }
}

/// `s/(s + r)`.
fn relaxed(s: Complex<f64>, rate: f64) -> Complex<f64> {
    s / (s + rate)
}

/// Numbers evenly spaced in their logarithm between two, the ends among them.
fn spaced([low, high]: [f64; 2], per_decade: f64) -> Vec<f64> {
    let steps = ((high / low).log10() * per_decade).ceil().max(1.0);
    (0..=steps as usize).map(|k| low * (high / low).powf(k as f64 / steps)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rheology::Measured;

    /// Relative error of the modulus and of the loss, the largest over a band.
    fn error(law: &Rheology, band: [f64; 2]) -> f64 {
        let model = RationalModulus::of(law, band);
        let gaps = spaced(band, 47.0).into_iter().map(|frequency| {
            let ([modulus, loss], wanted) = (model.at([0.0, frequency]), law.modulus(frequency));
            (modulus / wanted[0] - 1.0).abs().max((loss / wanted[1] - 1.0).abs())
        });
        gaps.fold(0.0, f64::max)
    }

    #[test]
    fn rational_laws_are_themselves() {
        for law in [
            Rheology::KelvinVoigt { time: 0.3 },
            Rheology::Maxwell { time: 7.0 },
            Rheology::StandardLinear { time: 0.2, strength: 0.4 },
        ] {
            assert!(error(&law, [1e-3, 1e3]) < 1e-13, "{law:?}");
        }
    }

    /// Laws that are not rational, in any unit of time, for light and heavy losses.
    #[test]
    fn other_laws_are_met_over_the_band() {
        for unit in [1e-6, 1.0, 1e5] {
            let band = [2e-3 / unit, 50.0 / unit];
            // of constant loss, over a decade: the modulus of what takes energy rises by 2/(πQ) for each factor e
            for factor in [3.0, 100.0, 1e4] {
                let gap = error(&Rheology::QualityFactor { factor }, [0.3 / unit, 3.0 / unit]);
                assert!(gap < 2e-3 + 1.0 / factor, "{unit} {factor}: {gap}");
            }
            for exponent in [0.2, 0.33] {
                let law = Rheology::Andrade { time: 30.0 * unit, creep_time: 9.0 * unit, exponent };
                assert!(error(&law, band) < 5e-3, "{unit} {exponent}: {}", error(&law, band));
            }
            let rows = vec![[0.01 / unit, 0.9, 0.02], [1.0 / unit, 1.0, 0.08], [30.0 / unit, 1.1, 0.03]];
            let law = Rheology::Table(Measured::new(rows).unwrap());
            assert!(error(&law, band) < 0.2, "{unit}: {}", error(&law, band));
        }
    }
}
