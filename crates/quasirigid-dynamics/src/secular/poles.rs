use super::energy_range::EnergyRange;
use crate::model::{FlexibleBody, Mode};
use crate::modes::{ModesError, SpinModes};

/// Pole: a steady spin with its modes, at one end of the evolution. (Q3)
#[derive(Clone, Debug)]
pub struct Pole {
    /// Modes about the steady spin.
    pub modes: SpinModes,
}

/// Steady spins about the axes of least and of greatest inertia with their modes.
#[derive(Clone, Debug)]
pub struct Poles {
    /// Axis of least inertia; none if no steady spin was found.
    pub long: Option<Pole>,
    /// Axis of greatest inertia.
    pub short: Option<Pole>,
}

/// Growth, as a share of the fastest rate of the body, below which it is rounding: the eigenvalues have errors of some `ε` times the norm of
/// their matrix.
const GROWTH_ROUNDING: f64 = 1e-12;

impl Poles {
    /// Poles of an energy range.
    ///
    /// # Errors
    /// [`ModesError`] if the modes about a pole are not found.
    pub fn compute(body: &FlexibleBody, range: &EnergyRange) -> Result<Self, ModesError> {
        let pole = |mode: Mode| -> Result<Option<Pole>, ModesError> {
            let equilibrium = range.equilibrium(mode).cloned();
            equilibrium.map(|spin| Ok(Pole { modes: SpinModes::about(body, spin)? })).transpose()
        };
        Ok(Self { long: pole(Mode::LongAxis)?, short: pole(Mode::ShortAxis)? })
    }

    /// Pole that a mode circles.
    #[must_use]
    pub fn of_mode(&self, mode: Mode) -> Option<&Pole> {
        match mode {
            Mode::LongAxis => self.long.as_ref(),
            Mode::ShortAxis => self.short.as_ref(),
        }
    }

    /// Rate (1/s) at which a small wobble decays about the axis of greatest inertia, or grows about that of least; none if the
    /// pole is unknown or has no nutation.
    #[must_use]
    pub fn rate(&self, mode: Mode) -> Option<f64> {
        let decay = self.of_mode(mode)?.modes.nutation()?.decay_rate;
        Some(if mode == Mode::ShortAxis { decay } else { -decay })
    }
}

impl Pole {
    /// Slowest decay (1/s) of the internal modes, that of the transient of a start; infinite without internal modes. (Q3)
    #[must_use]
    pub fn settling_rate(&self) -> f64 {
        self.modes.internal.iter().map(|[decay, _]| *decay).fold(f64::INFINITY, f64::min)
    }

    /// Distance `min |λ_j − iν|` (1/s) of the internal modes from the nutation: the rate at which they follow a wobble that changes; a bound
    /// of it where those beyond a rate are not known. (Q3)
    #[must_use]
    pub fn following_rate(&self) -> f64 {
        let Some(nutation) = self.modes.nutation() else { return f64::INFINITY };
        let distance = |[decay, frequency]: &[f64; 2]| decay.hypot(frequency - nutation.frequency);
        let others = self.modes.range.complete_below().unwrap_or(f64::INFINITY) - nutation.frequency;
        self.modes.internal.iter().map(distance).fold(others.max(0.0), f64::min)
    }

    /// Fastest rate (1/s) of any motion about the spin, decaying or oscillating.
    fn fastest(&self) -> f64 {
        let modes = self.modes.modes.iter().map(|mode| [mode.decay_rate, mode.frequency]);
        let all = modes.chain(self.modes.internal.iter().copied());
        all.map(|[decay, frequency]| decay.hypot(frequency)).fold(0.0, f64::max)
    }

    /// Whether a motion of this decay rate (1/s) grows by more than the rounding of an eigenvalue. (Q13)
    #[must_use]
    pub fn grows(&self, decay_rate: f64) -> bool {
        decay_rate < -GROWTH_ROUNDING * self.fastest()
    }

    /// First mode that grows; none if no mode grows. About the axis of greatest inertia such a mode contradicts the evolution towards
    /// that axis. (Q3)
    #[must_use]
    pub fn unstable(&self) -> Option<&crate::modes::SpinMode> {
        self.modes.modes.iter().find(|mode| self.grows(mode.decay_rate))
    }
}
