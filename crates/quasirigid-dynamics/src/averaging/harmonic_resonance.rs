use super::evolution::{Evolution, RotationState};
use super::power::MeanPower;
use super::response::Response;
use crate::math::bisection::bisected;
use crate::model::Mode;

/// Resonance met by a secular evolution: a rotation state where a harmonic of the polhode has the frequency of an elastic mode. (G8)
#[derive(Clone, Debug, PartialEq)]
pub struct HarmonicResonance {
    /// Rotation state at resonance.
    pub rotation_state: RotationState,
    /// Number of the harmonic.
    pub harmonic: usize,
    /// Frequency of both (rad/s), the body free to recoil.
    pub frequency: f64,
    /// Coordinate with the largest share in the mode.
    pub coordinate: String,
    /// Share of the harmonic in the mean power there.
    pub share: f64,
}

/// Highest harmonic looked at.
const MOST_HARMONICS: usize = 40;
/// Share of the mean power below which a resonance is not listed.
const FAINT: f64 = 1e-9;
/// Places of a mode between which the polhode frequency is bisected, as `ξ`.
const ENDS: [f64; 2] = [-30.0, 30.0];

impl Response {
    /// Resonances of the polhode's harmonics at one angular momentum, the strongest first. (G8)
    #[must_use]
    pub fn resonances(&self, evolution: &Evolution<impl MeanPower>) -> Vec<HarmonicResonance> {
        let mut found = Vec::new();
        for mode in [Mode::LongAxis, Mode::ShortAxis] {
            let step = |xi: f64| {
                std::f64::consts::TAU / evolution.motion(RotationState { mode, xi }).polhode_period()
            };
            let [slow, fast] = ENDS.map(step);
            for (frequency, coordinate) in self.frequencies() {
                for harmonic in 1..=MOST_HARMONICS {
                    let wanted = frequency / harmonic as f64;
                    if !(slow.min(fast)..slow.max(fast)).contains(&wanted) {
                        continue;
                    }
                    let rotation_state =
                        RotationState { mode, xi: bisected(ENDS, step, wanted, fast > slow) };
                    let share = self.share(evolution, rotation_state, harmonic);
                    if share > FAINT {
                        let coordinate = coordinate.to_owned();
                        found.push(HarmonicResonance {
                            rotation_state,
                            harmonic,
                            frequency,
                            coordinate,
                            share,
                        });
                    }
                }
            }
        }
        found.sort_by(|a, b| b.share.total_cmp(&a.share));
        found
    }

    fn share(
        &self,
        evolution: &Evolution<impl MeanPower>,
        rotation_state: RotationState,
        harmonic: usize,
    ) -> f64 {
        let powers: Vec<f64> =
            self.harmonic_powers(&evolution.motion(rotation_state)).map(|(_, power)| power).collect();
        powers.get(harmonic - 1).copied().unwrap_or(0.0) / powers.iter().sum::<f64>()
    }
}
