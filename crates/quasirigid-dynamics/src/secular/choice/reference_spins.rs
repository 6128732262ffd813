//! Steady spins at the angular momentum of the start, with their modes: the basis on which every method is judged.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::reason::{Instability, Reason, UnknownLiquid};
use super::span::MomentsOnly;
use crate::averaging::{Evolution, FreeRotation, MeanPower, RotationState};
use crate::dynamics::FullState;
use crate::model::{FlexibleBody, LiquidMemory, Mode};
use crate::modes::SpinMode;
use crate::secular::{AverageCriteria, EnergyRange, Poles, SettledStarts, apart, average_criteria};

/// Reference spins: the steady spins of a body at an angular momentum, with their modes. (Q3)
#[derive(Clone, Debug)]
pub struct ReferenceSpins<'a> {
    /// Body.
    pub body: &'a FlexibleBody,
    /// Range of the energy between the steady spins.
    pub range: EnergyRange,
    /// Steady spins about the axes of least and of greatest inertia, with their modes.
    pub poles: Poles,
    /// Liquids of unknown response about the axes of least and of greatest inertia.
    unknown_liquids: [Vec<UnknownLiquid>; 2],
}

/// Place `ξ` from which the modes about an axis are taken to describe a wobble that comes from the separatrix.
const BESIDE_SEPARATRIX: f64 = -6.0;

impl<'a> ReferenceSpins<'a> {
    /// The steady spins at an angular momentum (N·m·s); `unknown` lists the liquids whose response at a frequency (rad/s) about a spin (rad/s)
    /// is not known.
    ///
    /// # Errors
    /// [`Reason`] if the steady spin of greatest inertia or the modes are not found.
    pub fn compute(
        body: &'a FlexibleBody,
        angular_momentum: f64,
        unknown: impl Fn([f64; 3], f64) -> Vec<UnknownLiquid>,
    ) -> Result<Self, Reason> {
        let range = EnergyRange::compute(body, angular_momentum).map_err(Reason::Equilibrium)?;
        let poles = Poles::compute(body, &range).map_err(Reason::Modes)?;
        let unknown_liquids = [Mode::LongAxis, Mode::ShortAxis].map(|mode| {
            let Some(pole) = poles.of_mode(mode) else { return Vec::new() };
            let frequency = pole.modes.nutation().map_or(0.0, |nutation| nutation.frequency);
            unknown(pole.modes.equilibrium.omega, frequency)
        });
        Ok(Self { body, range, poles, unknown_liquids })
    }

    /// Rates (1/s) of small wobbles about the axes of least and of greatest inertia, by the modes; not a number where the response of a
    /// liquid is not known.
    #[must_use]
    pub fn rates(&self) -> [Option<f64>; 2] {
        let known = |mode: Mode| match self.unknown_liquid_response(mode) {
            _ if !mode.exists(self.range.moments()) => None,
            [_, ..] => Some(f64::NAN),
            [] => self.poles.rate(mode),
        };
        [Mode::LongAxis, Mode::ShortAxis].map(known)
    }

    /// Liquids of unknown response about the axis that a mode circles.
    #[must_use]
    pub fn unknown_liquid_response(&self, mode: Mode) -> &[UnknownLiquid] {
        &self.unknown_liquids[usize::from(mode == Mode::ShortAxis)]
    }

    /// The equivalent polhode at a rotation state.
    #[must_use]
    pub fn motion(&self, RotationState { mode, xi }: RotationState) -> FreeRotation {
        FreeRotation::at_logit(self.range.moments(), self.range.angular_momentum(), mode, xi)
    }

    /// Rotation state of a full state after its vibrations have died out, by the slow manifold about the spin, where a vibration is slower than ten
    /// spins; none elsewhere, where [`EnergyRange::settled`] has it. (Q21)
    #[must_use]
    pub fn projected(&self, start: &FullState) -> Option<RotationState> {
        let K = start.angular_momentum(self.body);
        let mode = self.range.settled(self.body, K)?.mode;
        let pole = self.poles.of_mode(mode)?;
        SettledStarts::about(self.body, (&self.range, pole), mode, K)?.rotation_state(start)
    }

    /// Evolution along the equivalent polhode without a power: enough to place a rotation state.
    #[must_use]
    pub fn evolution(&self) -> Evolution<MomentsOnly> {
        Evolution::new(MomentsOnly(self.range.moments()), self.range.angular_momentum())
    }

    /// Growing mode at the axis of greatest inertia; none if its spin is stable, or one of a plane of steady spins, whose wobble has
    /// no mode of its own. (Q13)
    #[must_use]
    pub fn unstable(&self) -> Option<Instability> {
        if !Mode::ShortAxis.exists(self.range.moments()) {
            return None;
        }
        let growing = self.poles.short.as_ref()?.unstable();
        growing.map(|mode| Instability::new(Some(Mode::ShortAxis), mode))
    }

    /// Whether a mode that was not looked for may grow at the axis of greatest inertia. (M24)
    #[must_use]
    pub fn may_be_unstable(&self) -> bool {
        self.poles.short.as_ref().is_some_and(|pole| !pole.modes.range.shows_stability())
    }

    /// Growing mode beside the nutation at the axis of least inertia; none if nothing grows.
    #[must_use]
    pub fn growing_internal_mode(&self) -> Option<Instability> {
        let pole = self.poles.long.as_ref()?;
        let growing = pole.modes.modes.iter().find(|mode| pole.grows(mode.decay_rate) && !mode.nutation);
        growing.map(|mode| Instability::new(Some(Mode::LongAxis), mode))
    }

    /// Whether a motion beside the nutation grows at an end of a span.
    #[must_use]
    pub fn internal_growth(&self, ends: [RotationState; 2]) -> bool {
        ends.iter().any(|state| {
            let pole = self.poles.of_mode(state.mode);
            pole.is_some_and(|pole| pole.modes.internal.iter().any(|[decay, _]| pole.grows(*decay)))
        })
    }

    /// Estimate of the relative error from the response of liquids about the mean spin on a span; the wobble is widest at an end or at the
    /// separatrix. (L19)
    #[must_use]
    pub fn liquid_error(&self, ends: [RotationState; 2]) -> f64 {
        let wobble = ends.map(|state| self.motion(state).nutation()[1]);
        let widest = if ends[0].mode == ends[1].mode { wobble[0].max(wobble[1]) } else { FRAC_PI_2 };
        let spin = self.range.angular_momentum() / self.range.moments()[0];
        let left_out = |memory: &LiquidMemory| memory.left_out(spin, widest);
        self.body.memories().iter().map(left_out).fold(0.0, f64::max)
    }

    /// Criteria of an average on a span.
    #[must_use]
    pub fn average_criteria(&self, power: &dyn MeanPower, ends: [RotationState; 2]) -> AverageCriteria {
        let criteria = average_criteria(power, &self.range, &self.poles, ends);
        AverageCriteria { liquids: self.liquid_error(ends), ..criteria }
    }

    /// Losses that the equations of motion leave out at the ends of a span, as a share of the rate of a small wobble: materials and
    /// liquids whose response is known at each frequency alone.
    #[must_use]
    pub fn left_out(&self, ends: [RotationState; 2]) -> f64 {
        if self.body.viscoelastic().is_empty() && self.body.memories().is_empty() {
            return 0.0; // dashpots and Kelvin-Voigt materials are in the equations; two eigenvalues of theirs differ by rounding alone
        }
        let share = |state: RotationState| self.nutation(state.mode).map_or(f64::INFINITY, loss_left_out);
        share(ends[0]).max(share(ends[1]))
    }

    /// Estimate of the revolutions of a span, from the rates of the modes; none if these are not known.
    #[must_use]
    pub fn revolutions(&self, ends: [RotationState; 2]) -> Option<f64> {
        let time: f64 = self.times(ends)?.iter().map(|(_, time)| time).sum();
        let spin = self.range.angular_momentum() / self.range.moments()[ends[1].mode.circled()];
        Some(time * spin / TAU)
    }

    /// Time of a span by a power, in the mean of the periods of the wobble at its ends. Beside a plane of steady spins the last period has no
    /// limit, and the modes about the axis far from it know neither the time nor the period. (Q7)
    #[must_use]
    pub fn periods(&self, power: &dyn MeanPower, ends: [RotationState; 2]) -> f64 {
        let [from, to] = ends.map(|state| self.motion(state).polhode_period());
        let time = Evolution::new(power, self.range.angular_momentum()).time(ends[0], ends[1]);
        2.0 * time.abs() / (from + to)
    }

    /// Decay in a period of the polhode at the ends of a span; infinite where there is no nutation.
    #[must_use]
    pub fn decay_per_period(&self, ends: [RotationState; 2]) -> f64 {
        let decay = |state: RotationState| {
            self.nutation(state.mode).map_or(f64::INFINITY, |mode| match mode.decay_rate {
                0.0 => 0.0,
                decay => decay.abs() * TAU / mode.frequency,
            })
        };
        decay(ends[0]).max(decay(ends[1]))
    }

    /// Estimate of the times in the modes on a span, from the rates of their nutation; none if these are not known.
    fn times(&self, [from, to]: [RotationState; 2]) -> Option<Vec<(Mode, f64)>> {
        let excess = |state: RotationState| self.motion(state).energy_from_axis();
        let middle = |mode: Mode| excess(RotationState { mode, xi: BESIDE_SEPARATRIX });
        let between = |mode: Mode, energies: [f64; 2]| {
            let rate = self.poles.rate(mode).filter(|rate| *rate > 0.0)?;
            Some((mode, (energies[0] / energies[1]).ln().abs() / (2.0 * rate)))
        };
        if from.mode == to.mode {
            return Some(vec![between(from.mode, [excess(from), excess(to)])?]);
        }
        let through = [from, to].map(|state| between(state.mode, [middle(state.mode), excess(state)]));
        through.into_iter().collect()
    }

    fn nutation(&self, mode: Mode) -> Option<&SpinMode> {
        self.poles.of_mode(mode).and_then(|pole| pole.modes.nutation())
    }
}

/// Share of the decay of a nutation that the equations of motion leave out; infinite where that share is not known.
#[must_use]
pub fn loss_left_out(nutation: &SpinMode) -> f64 {
    let [decay, _] = nutation.of_motion;
    apart(decay, nutation.decay_rate)
}
