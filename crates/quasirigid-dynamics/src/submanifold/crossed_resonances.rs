//! Resonances crossed as the nutation changes: angles at which one of its harmonics has the frequency of another mode.
//! There a mode is excited and may be captured, and the reduced equations without it end; with it among their masters they go on.

use std::f64::consts::FRAC_PI_2;

use crate::averaging::FreeRotation;
use crate::math::bisection::bisected;
use crate::math::vec3::norm;
use crate::model::Principal;

use super::spin_manifold::SpinManifold;

/// Resonance crossed on the way. (W15)
#[derive(Clone, Debug, PartialEq)]
pub struct CrossedResonance {
    /// Name of what moves in the other mode.
    pub name: String,
    /// Harmonic of the nutation.
    pub harmonic: usize,
    /// Greatest nutation angle there (rad).
    pub nutation: f64,
    /// Frequency of the other mode (rad/s).
    pub frequency: f64,
}

/// Highest harmonic, and angles examined.
const HARMONICS: usize = 3;
const ANGLES_EXAMINED: usize = 64;
/// Damping ratio above which a mode has no resonance to speak of.
const DAMPED: f64 = 0.3;
/// Least angle (rad), whose frequency is that of the mode.
const SMALLEST_ANGLE: f64 = 1e-3;

impl SpinManifold<'_> {
    /// Resonances with lightly damped modes left out, met up to a greatest nutation angle (rad), by ascending angle. (W15)
    ///
    /// The frequency changes with the angle as that of the rigid body: a series of the spin manifold ends where it meets one. None are known
    /// of a body with momentum wheels.
    #[must_use]
    pub fn crossed_resonances(&self, widest: f64) -> Vec<CrossedResonance> {
        let mut crossed = Vec::new();
        let Some(frequency) = self.frequency() else { return crossed };
        let angles: Vec<f64> =
            (0..=ANGLES_EXAMINED).map(|i| widest * i as f64 / ANGLES_EXAMINED as f64).collect();
        let rates: Vec<f64> = angles.iter().map(|angle| frequency(*angle)).collect();
        for mode in self.outer.iter().filter(|mode| mode.decay_rate.abs() < DAMPED * mode.frequency) {
            for harmonic in 1..=HARMONICS {
                let wanted = mode.frequency / harmonic as f64;
                for (pair, ends) in rates.windows(2).zip(angles.windows(2)) {
                    if (pair[0] - wanted) * (pair[1] - wanted) > 0.0 || pair[0] == pair[1] {
                        continue;
                    }
                    crossed.push(CrossedResonance {
                        name: mode.name.clone(),
                        harmonic,
                        nutation: bisected([ends[0], ends[1]], &frequency, wanted, pair[1] > pair[0]),
                        frequency: mode.frequency,
                    });
                }
            }
        }
        crossed.sort_by(|a, b| a.nutation.total_cmp(&b.nutation));
        crossed
    }

    /// Frequency of the nutation (rad/s) as a function of its greatest angle (rad): that of the mode, changed as in the rigid body.
    fn frequency(&self) -> Option<impl Fn(f64) -> f64> {
        if self.body.wheels().constant != [0.0; 3] {
            return None;
        }
        let moments = Principal::compute(self.body.invariants().J).moments;
        let (G, mode) = (norm(self.spin.angular_momentum), self.mode);
        let period = move |angle: f64| {
            let angle = angle.clamp(SMALLEST_ANGLE, FRAC_PI_2 - SMALLEST_ANGLE);
            let rigid = FreeRotation::at_nutation(moments, G, mode, angle);
            rigid.map_or(f64::NAN, |rigid| rigid.polhode_period())
        };
        let turn = self.masters[0].frequency * period(SMALLEST_ANGLE);
        turn.is_finite().then_some(move |angle| turn / period(angle))
    }
}
