//! Backbone of the nutation: time constant and frequency as functions of the amplitude, and what dissipates there.

use std::f64::consts::TAU;

use super::range::Defect;
use super::spin_manifold::SpinManifold;

/// Backbone: the motion along the spin manifold at a row of amplitudes. (W12)
#[derive(Clone, Debug, PartialEq)]
pub struct Backbone {
    /// Points by ascending amplitude.
    pub points: Vec<BackbonePoint>,
}

/// Motion along the spin manifold at an amplitude of the nutation. (W12)
#[derive(Clone, Debug, PartialEq)]
pub struct BackbonePoint {
    /// Amplitude (rad).
    pub amplitude: f64,
    /// Greatest nutation angle over a period (rad).
    pub nutation: f64,
    /// Decay rate of the amplitude (1/s), negative for growth.
    pub decay_rate: f64,
    /// Frequency (rad/s), body axes.
    pub frequency: f64,
    /// Mean power of each dissipator (W), by name.
    pub power: Vec<(String, f64)>,
    /// Defect of the reduced equations.
    pub defect: Defect,
}

/// Phases of the means.
const PHASES: usize = 32;

impl SpinManifold<'_> {
    /// Motion at an amplitude of the nutation (rad), the other masters at rest. (W12)
    #[must_use]
    pub fn backbone_point(&self, amplitude: f64) -> BackbonePoint {
        let [decay_rate, frequency] = self.mean_rates(amplitude);
        let mut z = vec![[0.0; 2]; self.manifold.free()];
        z[0] = [amplitude, 0.0];
        let monomials = self.manifold.monomials(&z);
        let names = self.body.dissipators().iter().map(|dissipator| dissipator.name.clone());
        let powers = self.observables.dissipated.iter().map(|accrued| accrued.at(&monomials)[0]);
        BackbonePoint {
            amplitude,
            nutation: self.nutation(amplitude),
            decay_rate,
            frequency,
            power: names.zip(powers).collect(),
            defect: self.defect(amplitude),
        }
    }

    /// Decay rate (1/s) and frequency (rad/s) of the amplitude, means over the phases.
    pub(crate) fn mean_rates(&self, amplitude: f64) -> [f64; 2] {
        let (mut decay, mut turned) = (0.0, 0.0);
        for i in 0..PHASES {
            let (sine, cosine) = (TAU * i as f64 / PHASES as f64).sin_cos();
            let mut z = vec![[0.0; 2]; self.manifold.free()];
            z[0] = [amplitude * cosine, amplitude * sine];
            let [re, im] = self.manifold.rates_at(&z)[0];
            decay -= (re * cosine + im * sine) / amplitude;
            turned += (im * cosine - re * sine) / amplitude;
        }
        [decay / PHASES as f64, turned / PHASES as f64]
    }

    /// Motion at amplitudes from nearly zero up to one (rad), equally spaced.
    #[must_use]
    pub fn backbone(&self, widest: f64, count: usize) -> Backbone {
        let amplitude =
            |i: usize| widest * (i.max(1) as f64 - if i == 0 { 0.999 } else { 0.0 }) / count as f64;
        Backbone { points: (0..=count).map(|i| self.backbone_point(amplitude(i))).collect() }
    }
}
