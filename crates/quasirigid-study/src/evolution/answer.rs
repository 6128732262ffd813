//! Answer of an evolution: the power that is followed, or the history, with the moments and the start of the polhode that describes it.
//! The moments change with the method, since the polhode of the deformed body is not that of the frozen one.
//! Equations (G5) to (G8), docs/theory/11-materials.md; effective moments (Q1), docs/theory/16-methods.md.

use std::sync::Arc;

use quasirigid::averaging::{
    DriftLimits, DriftState, Evolution, FreeRotation, LevelPassage, MeanPower, PowerSource, RotationState,
};
use quasirigid::model::{FlexibleBody, Mode, Principal};
use quasirigid::secular::choice::{Followed, GrowingVibration, Method, MomentsOnly, Outcome, Span};
use quasirigid::secular::{DirectRow, DirectRun, EnergyRange};
use quasirigid_io::model::Target;

use super::ends;
use super::inputs::Inputs;
use super::method::{Chosen, Rates};
use crate::error::StudyError;
use crate::settings::EvolveSettings;

/// Answer of an evolution, before its rows are computed.
pub struct Answer<'a> {
    pub inputs: &'a Inputs,
    pub method: Method,
    /// Principal axes, with the moments of the polhode that is followed.
    pub principal: Principal,
    /// Rotation of a rigid body with these moments at the start.
    pub initial: FreeRotation,
    /// Power that is followed.
    power: Arc<dyn MeanPower>,
    /// Source of the average along the frozen polhode that was taken, or tried last.
    pub source: PowerSource,
    /// History that is followed beside the power.
    pub history: History,
    /// Rates of the modes; none where they were not computed.
    pub rates: Option<Rates>,
    /// Power or energy that each dissipator takes, where the method measures them.
    pub budget: Option<Vec<(String, f64)>>,
    /// Vibration that grows from nothing on the way.
    pub parametric: Option<GrowingVibration>,
    /// Whether a vibration that was not looked for may grow.
    pub may_be_unstable: bool,
}

/// History that is followed beside a power.
pub enum History {
    /// No history: the power determines the evolution.
    None,
    /// The full system until it has forgotten its start; from there on the power determines the evolution.
    Settled(DirectRow, EnergyRange),
    /// The full system, or reduced equations about a spin, with its range of energies.
    Full(Box<DirectRun>, EnergyRange),
    /// Levels of the slow energy.
    Levels(Box<LevelPassage>),
}

impl<'a> Answer<'a> {
    /// Answer of a method that was chosen for a body.
    pub fn new(inputs: &'a Inputs, body: &FlexibleBody, chosen: Chosen) -> Self {
        let Chosen { followed, initial, rates, span, parametric, may_be_unstable } = chosen;
        let frozen = Self {
            inputs,
            method: followed.method(),
            principal: inputs.principal,
            initial,
            power: inputs.powers.of(followed.source),
            source: followed.source,
            history: History::None,
            rates,
            budget: None,
            parametric,
            may_be_unstable,
        };
        match span {
            Some((span, range)) => frozen.following(followed, body, &span, range),
            None => frozen,
        }
    }

    /// The answer with what a method found on a span.
    fn following(self, followed: Followed, body: &FlexibleBody, span: &Span, range: EnergyRange) -> Self {
        let named = |budget: &[f64]| {
            let names = body.dissipators().iter().map(|each| each.name.clone());
            Some(names.zip(budget.iter().copied()).collect())
        };
        match followed.outcome {
            Outcome::Average { power, .. } | Outcome::ModalRates(power) => {
                self.along_frozen(power, span, &range)
            }
            Outcome::SpinningFrame(power) => self.along_frozen(power, span, &range),
            Outcome::LevelCurves(passage) => Self { history: History::Levels(passage), ..self },
            Outcome::Measured { power, settled } => {
                let budget = power.measurements.first().and_then(|first| named(&first.budget));
                let answer = self.along_deformed(Arc::new(*power), span, &range);
                let history = settled.map_or(History::None, |row| History::Settled(row, range));
                Self { history, budget, ..answer }
            }
            Outcome::SpinManifold(history) => self.with_run(Box::new(history.run), span, range, named),
            Outcome::FullSystem(run) => self.with_run(run, span, range, named),
        }
    }

    /// A power along the polhode of the frozen body, from the state in which the vibrations of the start have died out: with the wobble that
    /// it has there.
    fn along_frozen(self, power: Arc<dyn MeanPower>, span: &Span, range: &EnergyRange) -> Self {
        let (G, frozen) = (self.initial.angular_momentum(), self.principal.moments);
        let begun = |RotationState { mode, xi }| {
            let [own, deformed] =
                [frozen, range.moments()].map(|moments| moments[1] / moments[mode.circled()]);
            FreeRotation::at_logit(frozen, G, mode, xi + (own / deformed).ln())
        };
        Self { power, initial: span.settled.map_or(self.initial, begun), ..self }
    }

    /// A power along the equivalent polhode of the deformed body.
    fn along_deformed(self, power: Arc<dyn MeanPower>, span: &Span, range: &EnergyRange) -> Self {
        let principal = Principal { moments: range.moments(), ..self.principal };
        let RotationState { mode, xi } = span.ends[0];
        let initial = FreeRotation::at_logit(range.moments(), range.angular_momentum(), mode, xi);
        Self { power, principal, initial, ..self }
    }

    /// A history, described by the equivalent polhodes of the deformed body.
    fn with_run(
        self,
        run: Box<DirectRun>,
        span: &Span,
        range: EnergyRange,
        named: impl Fn(&[f64]) -> Option<Vec<(String, f64)>>,
    ) -> Self {
        let answer = self.along_deformed(Arc::new(MomentsOnly(range.moments())), span, &range);
        Self { budget: named(&run.budget), history: History::Full(run, range), ..answer }
    }

    pub fn power(&self) -> &dyn MeanPower {
        &*self.power
    }

    /// Whether the power that is averaged, or was tried last, is that of the reduced equations.
    pub fn by_polynomial(&self) -> bool {
        self.method != Method::SpinningFrame && self.source == PowerSource::Polynomial
    }

    pub fn evolution(&self) -> Evolution {
        Evolution::new(Arc::clone(&self.power), self.initial.angular_momentum())
    }

    /// Start of the evolution: a target, or the initial state.
    pub fn start(
        &self,
        evolution: &Evolution,
        from: Option<Target>,
        free: bool,
    ) -> Result<RotationState, StudyError> {
        let energy = self.initial.energy();
        if energy == 0.0 {
            return Err(StudyError::AtRest);
        }
        if !energy.is_finite() {
            return Err(StudyError::BoundlessSpin);
        }
        match from {
            Some(target) => ends::state(evolution, target, self.principal.moments),
            None if free => RotationState::from_motion(&self.initial).ok_or(StudyError::Steady),
            None if !Mode::any_exists(self.principal.moments) => Ok(RotationState::steady(Mode::ShortAxis)),
            None => Ok(RotationState::from_motion(&self.initial)
                .unwrap_or(RotationState::steady(self.initial.mode()))),
        }
    }

    /// End of the evolution.
    pub fn end(
        &self,
        evolution: &Evolution,
        from: RotationState,
        asked: &EvolveSettings,
    ) -> Result<RotationState, StudyError> {
        ends::end(evolution, from, asked, self.principal.moments)
    }

    /// Limits of a drift: time, target, and the slowest elastic frequency.
    pub fn limits(&self, evolution: &Evolution, asked: &EvolveSettings) -> Result<DriftLimits, StudyError> {
        let duration = asked.duration.ok_or(StudyError::NoEvolutionDuration)?;
        let state = |target| ends::state(evolution, target, self.principal.moments);
        let target = asked.until.map(state).transpose()?;
        let slowest = self.inputs.powers.response.frequencies().next();
        let fastest = slowest.map_or(f64::INFINITY, |(frequency, _)| frequency);
        Ok(DriftLimits { target, fastest, ..DriftLimits::until(duration) })
    }

    pub fn drifting(&self, rotation_state: RotationState) -> DriftState {
        let circled = self.initial.omega(0.0)[rotation_state.mode.circled()];
        let side = if circled < 0.0 { -1.0 } else { 1.0 };
        DriftState {
            t: 0.0,
            rotation_state,
            angular_momentum: self.initial.angular_momentum(),
            side,
            direction: self.inputs.direction,
            revolutions: 0.0,
        }
    }
}

/// Time (s) in which a small wobble about the axis of a mode changes by e, at the rates of the modes; none if these were not computed, not a number
/// where they are not known.
pub fn modal_folding(rates: Option<Rates>, mode: Mode) -> Option<f64> {
    Some(folding(rates?[usize::from(mode == Mode::ShortAxis)]?))
}

/// Time (s) in which a small wobble changes by e at a rate (1/s); infinite where it does not, not a number where that is not known.
pub fn folding(rate: f64) -> f64 {
    if rate > 0.0 || rate.is_nan() { rate.recip() } else { f64::INFINITY }
}
