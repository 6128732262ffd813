use crate::model::{Polhode, Principal};

/// Resonance: a harmonic of the polhode frequency near an elastic frequency. (V8)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resonance {
    /// Number of the harmonic.
    pub harmonic: usize,
    /// Frequency of the harmonic (rad/s).
    pub forcing: f64,
    /// Elastic frequency, with the body free to recoil (rad/s).
    pub frequency: f64,
    /// Strength of the harmonic relative to the load, about the power `n/2` of the nome.
    pub strength: f64,
}

/// Relative distance within which a harmonic is near a frequency.
const NEAR_RESONANCE: f64 = 0.1;
/// Strength below which harmonics are negligible.
const ALIVE: f64 = 1e-9;
/// Highest harmonic looked at; next to the separatrix none is weak.
const MOST_HARMONICS: usize = 200;

/// Harmonics of the polhode that come near an elastic frequency, strongest first.
#[must_use]
pub fn resonances(principal: &Principal, free_frequencies: &[f64], omega: [f64; 3]) -> Vec<Resonance> {
    let Some(Polhode { frequency: step, nome }) = principal.polhode(omega) else {
        return Vec::new();
    };
    let strength = |n: usize| nome.powf(0.5 * n as f64);
    let mut found: Vec<_> = (1..=MOST_HARMONICS)
        .take_while(|n| strength(*n) > ALIVE)
        .flat_map(|n| {
            let forcing = n as f64 * step;
            let near = free_frequencies
                .iter()
                .filter(move |frequency| (forcing / **frequency - 1.0).abs() < NEAR_RESONANCE);
            near.map(move |&frequency| Resonance { harmonic: n, forcing, frequency, strength: strength(n) })
        })
        .collect();
    found.sort_by(|a, b| b.strength.total_cmp(&a.strength));
    found
}
