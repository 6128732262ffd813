//! Materials at the harmonics of a free rotation: their modulus and loss angle in the motion asked for.
//! The modulus of a law, that of very fast or of very slow strain, says nothing of a motion between; only the value at its own frequencies does.
//! Equation (G16), docs/theory/11-materials.md.

use super::{FreeRotation, Response};
use crate::model::{Dissipator, Rheology};

/// Material at a harmonic of a free rotation. (G16)
#[derive(Clone, Debug, PartialEq)]
pub struct DrivenMaterial {
    /// Name of the dissipator.
    pub name: String,
    /// Frequency of the harmonic (rad/s).
    pub frequency: f64,
    /// Modulus `|μ̃(ν)|`, relative to the modulus given.
    pub modulus: f64,
    /// Tangent of the loss angle, `1/Q`.
    pub loss: f64,
}

/// Share of the power of a dissipator from which its harmonic counts.
const NOTABLE: f64 = 0.01;

impl Response {
    /// Materials at the harmonics from which they take power, but for those of dashpots, and of Kelvin–Voigt materials that are more spring
    /// than dashpot at every harmonic. (G16)
    #[must_use]
    pub fn driven_materials(&self, motion: &FreeRotation) -> Vec<DrivenMaterial> {
        let frequencies: Vec<f64> = motion.harmonics().map(|harmonic| harmonic.frequency).collect();
        let fastest = frequencies.iter().fold(0.0, |most: f64, frequency| most.max(*frequency));
        let laws: Vec<_> = self.dissipators.iter().map(|part| law(part, fastest)).collect();
        let viscous = laws.iter().all(Option::is_none);
        let taken: Vec<Vec<f64>> = if viscous { Vec::new() } else { self.harmonic_budgets(motion).collect() };
        let mut driven = Vec::new();
        for (number, (part, law)) in self.dissipators.iter().zip(&laws).enumerate() {
            let Some(law) = law else { continue };
            let whole: f64 = taken.iter().map(|powers| powers[number]).sum();
            let notable =
                frequencies.iter().zip(&taken).filter(|(_, powers)| powers[number] > NOTABLE * whole);
            driven.extend(notable.map(|(frequency, _)| {
                let [re, im] = law.modulus(*frequency);
                DrivenMaterial {
                    name: part.name.clone(),
                    frequency: *frequency,
                    modulus: re.hypot(im),
                    loss: im / re,
                }
            }));
        }
        driven
    }
}

/// Law of a dissipator that may matter up to a frequency (rad/s).
fn law(part: &Dissipator, fastest: f64) -> Option<Rheology> {
    let viscous = part.kelvin_voigt.filter(|time| time * fastest > 1.0);
    part.loss
        .as_ref()
        .map(|loss| loss.rheology.clone())
        .or(viscous.map(|time| Rheology::KelvinVoigt { time }))
}
