//! Steady spin that attracts from a state, with its modes, its separatrix and the goal: what methods are judged by.

use quasirigid::averaging::{LevelError, LevelEvolution, Until};
use quasirigid::dynamics::FullState;
use quasirigid::model::{FlexibleBody, Principal};
use quasirigid::modes::{RelativeEquilibrium, SpinMagnitude, SpinMode, SpinModes};
use quasirigid::reduction::frequencies;
use quasirigid::secular::choice::{GyrostatCriteria, Instability, Reason, Stop, loss_left_out};
use quasirigid::secular::{GyrostatSpins, GyrostatWobble, Pole};
use quasirigid_io::model::Target;
use quasirigid_math::vec3::norm;

use crate::error::StudyError;
use crate::evolution::ends::LEFT;
use crate::liquids::unknown_liquids;
use crate::settings::EvolveSettings;
use crate::study::Study;

/// Energy of a wobble, relative to the whole, that is rounding.
const ROUNDING: f64 = 1e-13;

/// Steady spin that attracts from a state, with its modes and the wobble about it.
pub struct AttractingSpin<'a> {
    pub study: &'a Study,
    pub body: &'a FlexibleBody,
    /// Angular momentum `K` (N·m·s, body axes) and energy (J) of the state.
    pub angular_momentum: [f64; 3],
    pub energy: f64,
    pub pole: Pole,
    pub wobble: GyrostatWobble,
    /// Energy (J) below which the state stays about this spin.
    pub barrier: f64,
}

impl<'a> AttractingSpin<'a> {
    /// The steady spin that attracts from a state.
    pub fn of(study: &'a Study, state: &FullState) -> Result<Self, Stop<StudyError>> {
        let body = &study.body;
        let K = state.angular_momentum(body);
        let rigid = study.reduced(0)?;
        let levels = LevelEvolution::new(&rigid, norm(K)).map_err(Reason::Levels)?;
        let spins = GyrostatSpins::compute(body, norm(K));
        let downhill = match levels.follow(K, Until::Duration(f64::MAX), 1) {
            Ok(passage) => passage.attractor,
            Err(LevelError::Steady) => return Err(StudyError::Steady.into()),
            Err(error) => return Err(Reason::Levels(error).into()),
        };
        let spin = spins.attracting(downhill).cloned().ok_or(Reason::NoAttractor)?;
        Self::about(study, state, spin, spins.barrier())
    }

    /// The steady spin that a body has come to from a state.
    pub fn come_to(&self, start: &FullState, last: &FullState) -> Result<Self, Stop<StudyError>> {
        let given = SpinMagnitude::AngularMomentum(norm(self.angular_momentum));
        let spin =
            RelativeEquilibrium::beside(self.body, last.omega, given).map_err(|_| Reason::NoAttractor)?;
        Self::about(self.study, start, spin, self.barrier)
    }

    fn about(
        study: &'a Study,
        state: &FullState,
        spin: RelativeEquilibrium,
        barrier: f64,
    ) -> Result<Self, Stop<StudyError>> {
        let (body, K) = (&study.body, state.angular_momentum(&study.body));
        let wobble = GyrostatWobble::about(body, &spin);
        let pole = Pole { modes: SpinModes::about(body, spin).map_err(Reason::Modes)? };
        let energy = state.energy(body);
        let spin = Self { study, body, angular_momentum: K, energy, pole, wobble, barrier };
        Ok(spin.judged()?)
    }

    fn judged(self) -> Result<Self, Reason> {
        if let Some(mode) = self.pole.unstable() {
            return Err(Reason::Unstable(Instability::new(None, mode)));
        }
        let spin = &self.pole.modes.equilibrium;
        let frequency = self.pole.modes.nutation().map_or(0.0, |nutation| nutation.frequency);
        let unknown = unknown_liquids(self.study, spin.omega, frequency);
        if unknown.is_empty() { Ok(self) } else { Err(Reason::UnknownLiquidResponse(unknown)) }
    }

    /// Mode of the small wobble.
    pub fn nutation(&self) -> Option<&SpinMode> {
        self.pole.modes.nutation()
    }

    /// Rate (1/s) at which a small wobble falls.
    pub fn rate(&self) -> Option<f64> {
        self.nutation().map(|mode| mode.decay_rate)
    }

    /// Energy (J) of the steady spin.
    pub fn steady(&self) -> f64 {
        self.pole.modes.equilibrium.energy
    }

    /// Criteria of the methods.
    pub fn criteria(&self) -> GyrostatCriteria {
        let body = self.body;
        // dashpots and Kelvin-Voigt materials are in the equations of motion
        let complete = body.viscoelastic().is_empty() && body.memories().is_empty();
        let left_out = || self.nutation().map_or(f64::INFINITY, loss_left_out);
        GyrostatCriteria {
            spin_ratio: self.spin_ratio(),
            internal_rotation: !body.cyclic().is_empty(),
            viscoelastic: !body.viscoelastic().is_empty(),
            left_out: if complete { 0.0 } else { left_out() },
            settled: self.settled(),
            coordinates: body.coordinates().len(),
        }
    }

    /// Bound of the ratio of any spin at the energy of the start to the slowest elastic frequency.
    pub fn spin_ratio(&self) -> f64 {
        let slowest = frequencies(self.body).ok().and_then(|all| all.first().copied());
        let least = Principal::compute(self.body.invariants().J).moments[0];
        (2.0 * self.energy / least).sqrt() / slowest.unwrap_or(f64::INFINITY)
    }

    /// Whether the state is below the separatrix, so that it stays about the steady spin.
    pub fn settled(&self) -> bool {
        self.energy < self.barrier
    }

    /// Energy (J) at which the evolution ends; none where only the time does.
    pub fn goal(&self, asked: &EvolveSettings) -> Result<Option<f64>, StudyError> {
        let (own, steady) = (self.energy, self.steady());
        if own - steady <= ROUNDING * own.abs() {
            return Err(StudyError::Steady);
        }
        match (asked.until, self.goal_from(own, asked)) {
            (Some(Target::Wobble(to)), Some(goal)) if goal >= own => {
                Err(StudyError::Calmer { from: self.wobble.nutation(own)[1], to, kind: asked.kind })
            }
            (_, goal) => Ok(goal),
        }
    }

    /// Energy (J) at which an evolution from an energy ends; none where only the time does.
    pub fn goal_from(&self, energy: f64, asked: &EvolveSettings) -> Option<f64> {
        match asked.until {
            Some(Target::Wobble(to)) => Some(self.wobble.energy_of(to)),
            _ if asked.duration.is_some() => None,
            _ => Some(self.steady() + LEFT * (energy - self.steady())),
        }
    }
}
