//! Resonances met along the backbone: nutations at which a harmonic of the nutation has the frequency of another mode.
//! There a mode may be captured; the reduced equations then need it among their masters.

use super::spin_manifold::SpinManifold;
use crate::math::bisection::bisected;

/// Resonance met along the backbone. (W15)
#[derive(Clone, Debug, PartialEq)]
pub struct MetResonance {
    /// Name of what moves in the other mode.
    pub name: String,
    /// Harmonic of the nutation.
    pub harmonic: usize,
    /// Amplitude of the nutation (rad).
    pub amplitude: f64,
    /// Greatest nutation angle there (rad).
    pub nutation: f64,
    /// Frequency of the other mode (rad/s).
    pub frequency: f64,
}

/// Highest harmonic, and amplitudes examined.
const HARMONICS: usize = 3;
const EXAMINED: usize = 64;
/// Damping ratio above which a mode has no resonance to speak of.
const DAMPED: f64 = 0.3;

impl SpinManifold<'_> {
    /// Resonances of lightly damped modes met up to an amplitude of the nutation (rad), by ascending amplitude. (W15)
    #[must_use]
    pub fn resonances_met(&self, widest: f64) -> Vec<MetResonance> {
        let mut met = Vec::new();
        let rates: Vec<f64> = (0..=EXAMINED)
            .map(|i| self.frequency_at(widest * (i as f64).max(1e-3) / EXAMINED as f64))
            .collect();
        for mode in self.outer.iter().filter(|mode| mode.decay_rate.abs() < DAMPED * mode.frequency) {
            for harmonic in 1..=HARMONICS {
                let wanted = mode.frequency / harmonic as f64;
                for (i, pair) in rates.windows(2).enumerate() {
                    if (pair[0] - wanted) * (pair[1] - wanted) > 0.0 || pair[0] == pair[1] {
                        continue;
                    }
                    let ends = [i, i + 1].map(|i| widest * i as f64 / EXAMINED as f64);
                    let amplitude = bisected(ends, |a| self.frequency_at(a), wanted, pair[1] > pair[0]);
                    met.push(MetResonance {
                        name: mode.name.clone(),
                        harmonic,
                        amplitude,
                        nutation: self.nutation(amplitude),
                        frequency: mode.frequency,
                    });
                }
            }
        }
        met.sort_by(|a, b| a.amplitude.total_cmp(&b.amplitude));
        met
    }

    /// Frequency of the nutation (rad/s) at an amplitude (rad), the other masters at rest.
    fn frequency_at(&self, amplitude: f64) -> f64 {
        self.mean_rates(amplitude.max(f64::MIN_POSITIVE.sqrt()))[1]
    }
}
