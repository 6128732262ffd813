//! Choice of the method of an evolution that is asked for: the criteria of the library, with the start, the target and the liquids of the model.

use quasirigid::averaging::{FreeRotation, PowerSource};
use quasirigid::dynamics::{FullState, Start};
use quasirigid::secular::EnergyRange;
use quasirigid::secular::choice::{
    AverageBasis, Case, ChoiceObserver, Followed, GrowingVibration, Limits, Method, Reason, ReferenceSpins,
    Span, Stop, average_under_torque, choose, follow, stiff_average,
};
use quasirigid_io::model::EvolveMethod;
use quasirigid_math::vec3::norm;

use super::ends;
use super::inputs::Inputs;
use crate::error::StudyError;
use crate::liquids::unknown_liquids;
use crate::motion::Motion;
use crate::settings::EvolveSettings;
use crate::study::Study;

/// Rates (1/s) of small wobbles about the axes of least and of greatest inertia; not a number where they are not known.
pub type Rates = [Option<f64>; 2];

/// Method that was chosen, with what it found.
pub struct Chosen {
    pub followed: Followed,
    /// Rotation of the frozen body with the angular momentum at the start.
    pub initial: FreeRotation,
    /// Rates of the modes; none where they were not computed.
    pub rates: Option<Rates>,
    /// Span that was followed, with the range of its energies; none where the method was not judged on one.
    pub span: Option<(Span, EnergyRange)>,
    /// Vibration that grows on the span.
    pub parametric: Option<GrowingVibration>,
    /// Whether a vibration that was not looked for may grow.
    pub may_be_unstable: bool,
}

/// Choice without an answer.
pub struct NotFollowed {
    pub stop: Stop<StudyError>,
    /// Rotation of the frozen body with the angular momentum at the start.
    pub initial: FreeRotation,
    /// Rates of the modes; none where they were not computed.
    pub rates: Option<Rates>,
}

/// Method of the library for one that is asked for; an average takes the power that is averaged first.
pub fn asked_method(method: EvolveMethod, power: PowerSource) -> Method {
    match method {
        EvolveMethod::Average => Method::Average(power),
        EvolveMethod::Levels => Method::LevelCurves,
        EvolveMethod::ModalRates => Method::ModalRates,
        EvolveMethod::PeriodicMotions => Method::PeriodicMotions,
        EvolveMethod::MicroRuns => Method::MicroRuns,
        EvolveMethod::Full => Method::FullSystem,
        EvolveMethod::SpinManifold => Method::SpinManifold,
    }
}

/// Basis of a judgement: the full system at the start, and the steady spins at its angular momentum.
struct Basis<'a> {
    full: FullState,
    spins: ReferenceSpins<'a>,
    /// Rotation of the frozen body with that angular momentum.
    initial: FreeRotation,
}

/// Chooses the method for a body on which no torque acts, and follows it.
pub fn chosen(
    study: &Study,
    start: Start,
    asked: &EvolveSettings,
    inputs: &Inputs,
    observer: &mut dyn ChoiceObserver,
) -> Result<Chosen, Box<NotFollowed>> {
    let free = asked.method.is_none();
    if let Some(source) = free.then(|| inputs.stiff_average(study, start)).flatten() {
        if asked.start.is_none() && inputs.initial.is_steady() {
            return Err(NotFollowed::new(StudyError::Steady.into(), inputs.initial, None));
        }
        return Ok(inputs.unjudged(source, inputs.initial));
    }
    let Some(Basis { full, spins, initial }) = inputs.basis(study, start)? else {
        return Ok(inputs.unjudged(inputs.powers.first, inputs.initial));
    };
    let rates = Some(spins.rates());
    let found = followed(study, full, asked, inputs, &spins, observer);
    let (followed, span, parametric) = found.map_err(|stop| NotFollowed::new(stop, initial, rates))?;
    Ok(Chosen {
        followed,
        initial,
        rates,
        may_be_unstable: spins.may_be_unstable(),
        span: Some((span, spins.range)),
        parametric,
    })
}

/// Chooses the method by the steady spins of a body, and follows it.
fn followed(
    study: &Study,
    full: FullState,
    asked: &EvolveSettings,
    inputs: &Inputs,
    spins: &ReferenceSpins,
    observer: &mut dyn ChoiceObserver,
) -> Result<(Followed, Span, Option<GrowingVibration>), Stop<StudyError>> {
    if let (None, Some(unstable)) = (asked.method, spins.unstable()) {
        return Err(Reason::Unstable(unstable).into());
    }
    let span = ends::span(spins, full, asked, inputs.principal.moments)?;
    let limits = Limits::default();
    let method = asked.method.map(|method| asked_method(method, inputs.powers.first));
    let case = match method {
        Some(Method::LevelCurves) => {
            Case::asked(spins, &span, &inputs.powers)?.with_level_equations(study.order)
        }
        Some(_) => Case::asked(spins, &span, &inputs.powers)?,
        None => Case::unasked(spins, &span, &inputs.powers, study.order, &limits)?,
    };
    let decision = choose(&case.criteria, method, &limits);
    let followed =
        follow(&case, decision, &limits, observer).map_err(|stop| stop.map_error(StudyError::from))?;
    let parametric = case.criteria.parametric;
    Ok((followed, span, parametric))
}

/// Judges the average of a body under a slow torque, which no other method follows.
pub fn chosen_under_torque(
    study: &Study,
    start: Start,
    asked: &EvolveSettings,
    inputs: &Inputs,
) -> Result<Chosen, Box<NotFollowed>> {
    if let Some(source) = inputs.stiff_average(study, start) {
        return Ok(inputs.unjudged(source, inputs.initial));
    }
    let Some(Basis { full, spins, initial }) = inputs.basis(study, start)? else {
        return Ok(inputs.unjudged(inputs.powers.first, inputs.initial));
    };
    let Some(state) = spins.range.rotation_state(full.energy(&study.body)) else {
        return Ok(inputs.unjudged(inputs.powers.first, initial));
    };
    let rates = Some(spins.rates());
    let average = asked.method == Some(EvolveMethod::Average);
    let followed = average_under_torque(&spins, &inputs.powers, state, average, &Limits::default());
    let followed = followed.map_err(|reason| NotFollowed::new(reason.into(), initial, rates))?;
    Ok(Chosen { followed, initial, rates, span: None, parametric: None, may_be_unstable: false })
}

impl Inputs {
    /// Source of the average of a body so stiff and slow that it needs no judgement; none of another body.
    fn stiff_average(&self, study: &Study, start: Start) -> Option<PowerSource> {
        stiff_average(&study.body, &self.powers, &self.initial, norm(start.omega))
    }

    /// The average of a source without a judgement.
    fn unjudged(&self, source: PowerSource, initial: FreeRotation) -> Chosen {
        let followed = Followed::average(self.powers.of(source), source, AverageBasis::Stiff, None);
        Chosen { followed, initial, rates: None, span: None, parametric: None, may_be_unstable: false }
    }

    /// Basis of a judgement; none where the angular momentum says nothing of a motion.
    fn basis<'a>(&self, study: &'a Study, start: Start) -> Result<Option<Basis<'a>>, Box<NotFollowed>> {
        let failed = |error: StudyError| NotFollowed::new(error.into(), self.initial, None);
        let full = Motion::new(study, start).full().map_err(failed)?;
        let K = full.angular_momentum(&study.body);
        if !(norm(K).is_finite() && norm(K) > 0.0) {
            return Ok(None);
        }
        let initial = self.turning_with(K).map_err(failed)?;
        let unknown = |spin: [f64; 3], frequency: f64| unknown_liquids(study, spin, frequency);
        let spins = ReferenceSpins::compute(&study.body, norm(K), unknown);
        let spins = spins.map_err(|reason| NotFollowed::new(reason.into(), initial, None))?;
        Ok(Some(Basis { full, spins, initial }))
    }
}

impl NotFollowed {
    fn new(stop: Stop<StudyError>, initial: FreeRotation, rates: Option<Rates>) -> Box<Self> {
        Box::new(Self { stop, initial, rates })
    }
}
