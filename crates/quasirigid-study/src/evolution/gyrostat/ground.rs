//! Ground on which a method is judged: the steady spin that attracts from a state, with its modes, its separatrix and the goal.

use quasirigid::averaging::{LevelError, LevelEvolution, Until};
use quasirigid::dynamics::FullState;
use quasirigid::model::FlexibleBody;
use quasirigid::modes::{SpinMode, SpinModes};
use quasirigid::secular::{GyrostatSpins, GyrostatWobble, Pole};
use quasirigid_io::model::Target;
use quasirigid_math::vec3::norm;

use crate::error::StudyError;
use crate::evolution::reason::{Instability, Reason, Stop};
use crate::evolution::secular::LEFT;
use crate::left_out::{LEFT_OUT, of_nutation};
use crate::liquids::unanswered;
use crate::settings::EvolveSettings;
use crate::study::Study;

/// Energy of a wobble, relative to the whole, that is rounding.
const ROUNDING: f64 = 1e-13;

/// Basis on which a method is judged: the steady spin that attracts from a state, with its modes and the wobble about it.
pub struct Ground<'a> {
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

impl<'a> Ground<'a> {
    /// The ground of a state.
    pub fn of(study: &'a Study, state: &FullState) -> Result<Self, Stop> {
        let body = &study.body;
        let K = state.angular_momentum(body);
        let rigid = study.reduced(0)?;
        let levels = LevelEvolution::new(&rigid, norm(K)).map_err(Reason::Levels)?;
        let spins = GyrostatSpins::compute(body, &rigid, norm(K)).map_err(Reason::Levels)?;
        let downhill = match levels.follow(K, Until::Duration(f64::MAX), 1) {
            Ok(passage) => passage.attractor,
            Err(LevelError::Steady) => return Err(StudyError::Steady.into()),
            Err(error) => return Err(Reason::Levels(error).into()),
        };
        let spin = spins.attracting(downhill).cloned().ok_or(Reason::NoAttractor)?;
        let wobble = GyrostatWobble::about(body, &spin);
        let pole = Pole { modes: SpinModes::about(body, spin).map_err(Reason::AttractorModes)? };
        let (angular_momentum, energy, barrier) = (K, state.energy(body), spins.barrier());
        let ground = Self { study, body, angular_momentum, energy, pole, wobble, barrier };
        Ok(ground.judged()?)
    }

    fn judged(self) -> Result<Self, Reason> {
        if let Some(mode) = self.pole.unstable() {
            return Err(Reason::Unstable(Instability::new(None, mode)));
        }
        let spin = &self.pole.modes.equilibrium;
        let frequency = self.pole.modes.nutation().map_or(0.0, |nutation| nutation.frequency);
        match unanswered(self.study, spin.omega, frequency) {
            Some(silent) => Err(Reason::UnknownLiquids(silent)),
            None => Ok(self),
        }
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

    /// Whether the equations of motion have every loss of the small wobble.
    pub fn complete(&self) -> bool {
        if self.body.viscoelastic().is_empty() && self.body.memories().is_empty() {
            return true;
        }
        self.nutation().is_some_and(|mode| of_nutation(mode) <= LEFT_OUT)
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
                Err(StudyError::Calmer { from: self.wobble.nutation(own)[1], to })
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
