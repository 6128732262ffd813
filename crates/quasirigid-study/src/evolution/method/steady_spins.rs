//! Steady spins at the angular momentum of the start, with their modes: the basis on which a method is judged.

use std::f64::consts::{FRAC_PI_2, TAU};

use quasirigid::averaging::{FreeRotation, MeanPower, RotationState};
use quasirigid::model::{FlexibleBody, LiquidMemory, Mode};
use quasirigid::secular::{AverageCriteria, EnergyRange, Poles, average_criteria};

use crate::evolution::reason::{Instability, Reason};
use crate::left_out::{LEFT_OUT, of_nutation};
use crate::liquids::unanswered;
use crate::study::Study;

/// Basis of every judgement of a method: the steady spins at the angular momentum of the start, and their modes.
pub struct Ground<'a> {
    pub body: &'a FlexibleBody,
    pub range: EnergyRange,
    pub poles: Poles,
    /// Liquids of unknown response about the axes of least and of greatest inertia, in words.
    silent: [Option<String>; 2],
}

impl<'a> Ground<'a> {
    /// The ground at an angular momentum (N·m·s).
    pub fn of(study: &'a Study, angular_momentum: f64) -> Result<Self, Reason> {
        let body = &study.body;
        let range = EnergyRange::compute(body, angular_momentum).map_err(Reason::Equilibrium)?;
        let poles = Poles::compute(body, &range).map_err(Reason::Modes)?;
        let silent = [Mode::LongAxis, Mode::ShortAxis].map(|mode| {
            let modes = &poles.of_mode(mode)?.modes;
            let frequency = modes.nutation().map_or(0.0, |nutation| nutation.frequency);
            unanswered(study, modes.equilibrium.omega, frequency)
        });
        Ok(Self { body, range, poles, silent })
    }

    /// Rates (1/s) of small wobbles about the axes of least and of greatest inertia, by the modes; not a number where the response of a
    /// liquid is not known.
    pub fn rates(&self) -> [Option<f64>; 2] {
        let known = |mode: Mode| match self.silent(mode) {
            _ if !mode.exists(self.range.moments()) => None,
            Some(_) => Some(f64::NAN),
            None => self.poles.rate(mode),
        };
        [Mode::LongAxis, Mode::ShortAxis].map(known)
    }

    /// Liquids of unknown response about the axis that a mode circles, in words.
    pub fn silent(&self, mode: Mode) -> Option<&String> {
        self.silent[usize::from(mode == Mode::ShortAxis)].as_ref()
    }

    /// The equivalent polhode at a rotation state.
    pub fn motion(&self, RotationState { mode, xi }: RotationState) -> FreeRotation {
        FreeRotation::at_logit(self.range.moments(), self.range.angular_momentum(), mode, xi)
    }

    /// Growing mode at the axis of greatest inertia; none if its spin is stable, or one of a plane of steady spins, whose wobble has
    /// no mode of its own. (Q13)
    pub fn unstable(&self) -> Option<Instability> {
        if !Mode::ShortAxis.exists(self.range.moments()) {
            return None;
        }
        let growing = self.poles.short.as_ref()?.unstable();
        growing.map(|mode| Instability::new(Some(Mode::ShortAxis), mode))
    }

    /// Growing mode beside the nutation at the axis of least inertia; none if nothing grows.
    pub fn whirl(&self) -> Option<Instability> {
        let pole = self.poles.long.as_ref()?;
        let growing = pole.modes.modes.iter().find(|mode| pole.grows(mode.decay_rate) && !mode.nutation);
        growing.map(|mode| Instability::new(Some(Mode::LongAxis), mode))
    }

    /// Estimate of the relative error from the response of liquids about the mean spin on a way; the wobble is widest at an end or at the
    /// separatrix. (L19)
    pub fn liquids(&self, ends: [RotationState; 2]) -> f64 {
        let wobble = ends.map(|stage| self.motion(stage).nutation()[1]);
        let widest = if ends[0].mode == ends[1].mode { wobble[0].max(wobble[1]) } else { FRAC_PI_2 };
        let spin = self.range.angular_momentum() / self.range.moments()[0];
        let left_out = |memory: &LiquidMemory| memory.left_out(spin, widest);
        self.body.memories().iter().map(left_out).fold(0.0, f64::max)
    }

    /// Criteria of an average on a way.
    pub fn criteria(&self, power: &dyn MeanPower, ends: [RotationState; 2]) -> AverageCriteria {
        let criteria = average_criteria(power, &self.range, &self.poles, ends);
        AverageCriteria { liquids: self.liquids(ends), ..criteria }
    }

    /// Whether the equations of motion have every loss in the modes on the way.
    pub fn complete(&self, ends: [RotationState; 2]) -> bool {
        self.left_out(ends) <= LEFT_OUT
    }

    /// Losses that the equations of motion leave out at the poles of the way, as a share of the rate of a small wobble: materials and
    /// liquids whose response is known at each frequency alone.
    pub fn left_out(&self, ends: [RotationState; 2]) -> f64 {
        if self.body.viscoelastic().is_empty() && self.body.memories().is_empty() {
            return 0.0; // dashpots and Kelvin-Voigt materials are in the equations; two eigenvalues of theirs differ by rounding alone
        }
        let share = |stage: RotationState| {
            let nutation = self.poles.of_mode(stage.mode).and_then(|pole| pole.modes.nutation());
            nutation.map_or(f64::INFINITY, of_nutation)
        };
        share(ends[0]).max(share(ends[1]))
    }

    /// Estimate of the revolutions from one state to another, from the rates of the modes; none if these are not known.
    pub fn revolutions(&self, ends: [RotationState; 2]) -> Option<f64> {
        let time: f64 = self.times(ends)?.iter().map(|(_, time)| time).sum();
        let spin = self.range.angular_momentum() / self.range.moments()[ends[1].mode.circled()];
        Some(time * spin / TAU)
    }

    /// Estimate of the periods of the wobble from one state to another; none if the modes are not known.
    pub fn periods(&self, ends: [RotationState; 2]) -> Option<f64> {
        let nutation = |mode| Some(self.poles.of_mode(mode)?.modes.nutation()?.frequency);
        let periods = |&(mode, time): &(Mode, f64)| Some(time * nutation(mode)? / TAU);
        self.times(ends)?.iter().map(periods).sum()
    }

    /// Estimate of the times in the modes from one state to another, from the rates of their nutation; none if these are not known.
    fn times(&self, [from, to]: [RotationState; 2]) -> Option<Vec<(Mode, f64)>> {
        let excess = |stage: RotationState| self.motion(stage).energy_from_axis();
        let middle = |mode: Mode| excess(RotationState { mode, xi: -6.0 });
        let between = |mode: Mode, energies: [f64; 2]| {
            let rate = self.poles.rate(mode).filter(|rate| *rate > 0.0)?;
            Some((mode, (energies[0] / energies[1]).ln().abs() / (2.0 * rate)))
        };
        if from.mode == to.mode {
            return Some(vec![between(from.mode, [excess(from), excess(to)])?]);
        }
        let through = [from, to].map(|stage| between(stage.mode, [middle(stage.mode), excess(stage)]));
        through.into_iter().collect()
    }

    /// Decay in a period of the polhode at the poles of the way.
    pub fn haste(&self, ends: [RotationState; 2]) -> f64 {
        let haste = |stage: RotationState| {
            let nutation = self.poles.of_mode(stage.mode).and_then(|pole| pole.modes.nutation());
            nutation.map_or(f64::INFINITY, |mode| match mode.decay_rate {
                0.0 => 0.0,
                decay => decay.abs() * TAU / mode.frequency,
            })
        };
        haste(ends[0]).max(haste(ends[1]))
    }
}
