//! Secular evolution: request, method, times and record.

mod answer;
mod approach;
mod columns;
mod eddy;
mod ends;
mod gyrostat;
mod hanging;
mod inputs;
mod method;
mod outlook;
mod reason;
mod record;
mod refusals;
mod table;
mod verdict;
mod words;

use std::ops::ControlFlow;
use std::sync::Arc;

use quasirigid::averaging::{
    DAMPING_ESTIMATES, DampingEstimate, DriftLimits, Evolution, MeanPower, PolynomialPower, Response,
    RotationState, SlowTorque, SmallBody, ball_radius,
};
use quasirigid::dynamics::Start;
use quasirigid::elements::Assembly;
use quasirigid::model::force::{Force, ForceLaw};
use quasirigid::model::{Marker, Rheology, Support};
use quasirigid::reduction::reduce;
use quasirigid::secular::choice::{ChoiceObserver, Method};
use quasirigid_io::model::{EvolveMethod, PartialEvolve, Rotation};
use quasirigid_io::record::{EstimateRecord, EvolutionRecord, HomogeneousRecord};
use quasirigid_math::vec3::norm;
use serde_json::{Value, json};

use crate::error::StudyError;
use crate::liquids::{NOTABLE, unresolved};
use crate::materials::flowing;
use crate::settings::EvolveSettings;
use crate::start::slaved_order;
use crate::study::Study;
use crate::tanks;
use crate::watch::Watch;
use answer::{Answer, History};
use inputs::Inputs;
use method::NotFollowed;
use outlook::Outlook;
use reason::Reason;
use table::EvolutionTable;
use verdict::Verdict;

pub use words::text;

/// Mode of a body with momentum wheels, which circles no principal axis.
const STEADY_SPIN: &str = "steady-spin";

/// An evolution that was followed.
#[derive(Clone, Debug)]
pub struct Evolved {
    /// The record; its status and message say whether it holds.
    pub record: EvolutionRecord,
    /// Notes to read before the numbers.
    pub notes: Vec<String>,
}

impl Evolved {
    /// Whether the evolution was followed to the end asked for, by a method that holds.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.record.status == "finished"
    }

    /// Whether the numbers of the record are those of the body: a method holds, whether or not the end was reached.
    #[must_use]
    pub fn has_numbers(&self) -> bool {
        !matches!(self.record.status.as_str(), "refused" | "does-not-hold")
    }

    /// The answer without its rows, for machines.
    #[must_use]
    pub fn json(&self) -> Value {
        let record = &self.record;
        let mut object = json!(record);
        object.as_object_mut().map(|entries| entries.remove("columns"));
        object["mode"] = json!({ "start": record.mode_start, "end": record.mode_end });
        object
    }
}

impl Study {
    /// Follows the averaged rotation from the start of the model.
    ///
    /// # Errors
    /// [`StudyError`] for an invalid start, for targets that are not ahead, for a duration shorter than a revolution, and for bodies that are
    /// not followed so.
    pub fn evolve(&self, asked: PartialEvolve, watch: &mut dyn Watch) -> Result<Evolved, StudyError> {
        let elsewhere = EvolveSettings::resolve(asked.clone(), self)?.start.is_some();
        let mut evolved = self.evolve_from(self.initial()?, asked, watch)?;
        if let (Some(Rotation::Wobble { angle, .. }), false) = (self.model.initial.rotation, elsewhere) {
            evolved.notes.extend(words::other_nutation(angle, self.model.kind, &evolved.record));
        }
        Ok(evolved)
    }

    /// Follows the averaged rotation from a rotation in place of the model's own.
    ///
    /// # Errors
    /// As [`evolve`](Self::evolve).
    pub fn evolve_from(
        &self,
        start: Start,
        asked: PartialEvolve,
        watch: &mut dyn Watch,
    ) -> Result<Evolved, StudyError> {
        self.left_alone("evolve")?;
        if let Some(sprung) = hanging::sprung(self, start)? {
            let mut evolved = sprung.evolve_from(start, asked, watch)?;
            evolved.notes.extend(hanging::note(self).filter(|_| evolved.has_numbers()));
            return Ok(evolved);
        }
        let asked = EvolveSettings::resolve(asked, self)?;
        let revolution = std::f64::consts::TAU / norm(start.omega);
        match asked.duration.filter(|duration| revolution.is_finite() && *duration < revolution) {
            Some(duration) => Err(StudyError::WithinARevolution { duration, revolution }),
            None => {
                let mut evolved = follow(self, start, &asked, watch)?;
                evolved.notes.extend(words::ended_before(&asked, &evolved.record));
                Ok(evolved)
            }
        }
    }
}

/// Follows the averaged rotation from a start.
pub(crate) fn follow(
    study: &Study,
    start: Start,
    asked: &EvolveSettings,
    observer: &mut dyn Watch,
) -> Result<Evolved, StudyError> {
    study.without_slugs("evolve")?;
    let Study { model, body, order, .. } = study;
    if matches!(body.support(), Support::Prescribed { .. }) {
        return Err(StudyError::DrivenPole);
    }
    if !body.wheels().is_empty() {
        return gyrostat::follow(study, start, asked, observer);
    }
    let torque = slow_torque(study)?;
    let reduced = study.reduced(*order)?;
    let slaved = slaved_order(study, *order, start.omega)?;
    let state = study.reduced(slaved)?;
    let inputs = Inputs::new(body, [&reduced, &state], start, asked.power)?;
    let inputs = Inputs { observed: study.observed, kind: model.kind, ..inputs };
    eddy::check(&torque, &inputs)?;
    let flow = flowing(&inputs.powers.response, &inputs.initial);
    if let (Some(message), true) = (&flow, asked.method != Some(EvolveMethod::Average)) {
        let record =
            record::refused_from(&inputs.initial, &Reason::NoSolid(message.clone()), None, model.kind);
        return Ok(Evolved { record, notes: Vec::new() });
    }
    let mut outlook = Outlook::new(observer, asked.method.is_some());
    let chosen = if torque.is_zero() {
        method::chosen(study, start, asked, &inputs, &mut outlook)
    } else {
        method::chosen_under_torque(study, start, asked, &inputs)
    };
    let chosen = match chosen {
        Ok(chosen) => chosen,
        Err(not_followed) => {
            let NotFollowed { stop, initial, rates } = *not_followed;
            let record = record::refused_from(&initial, &outlook.reason(stop)?, rates, model.kind);
            return Ok(Evolved { record, notes: Vec::new() });
        }
    };
    let verdict = Verdict::of(&chosen.followed, model.kind);
    let answer = Answer::new(&inputs, body, chosen);
    let mut watch = |share: f64| outlook.observe(share);
    let evolution = answer.evolution();
    let from = match &answer.history {
        History::Levels(passage) => {
            EvolutionTable::of_levels(passage, &answer.principal).first.rotation_state
        }
        _ => answer.start(&evolution, asked.start, torque.is_zero())?,
    };
    let mut rows = table_of(&answer, torque, from, asked, &mut watch)?;
    let verdict = match answer.ages(from, &rows) {
        true => verdict.with_shape_error(approximated(study)),
        false => verdict.without_time(),
    };
    let ended = evolution.motion(rows.last().rotation_state);
    let verdict = match flow.or_else(|| flowing(&inputs.powers.response, &ended)) {
        Some(why) => verdict.of_no_solid(&why),
        None => verdict,
    };
    let columns = answer.columns(&mut rows, &mut watch);
    let ends = [from, rows.last().rotation_state];
    let drifted = rows.drift.as_ref().map(|drift| drift.end.angular_momentum);
    let spin =
        |G: f64, rotation_state: RotationState| G / answer.principal.moments[rotation_state.mode.circled()];
    let G = answer.initial.angular_momentum();
    let spins = [spin(G, from), spin(drifted.unwrap_or(G), rows.last().rotation_state)];
    let axes = ends.map(|end| answer.principal.axes[end.mode.circled()]);
    let verdict = match tanks::left(study, axes, spins) {
        Some(why) => verdict.of_other_spin(&why),
        None => verdict,
    };
    let averaged = matches!(answer.method, Method::Average(_) | Method::SpinningFrame);
    let time_range = match &model.extremes {
        Some(extremes) if rows.steady() && averaged => Some(range(extremes, &answer, ends)?),
        _ => None,
    };
    let unranged = time_range.is_none() && model.extremes.is_some();
    let mut notes: Vec<String> = words::beyond_gravity(homogeneous(study), spins).into_iter().collect();
    notes.extend(words::notes(&answer, ends, unranged));
    notes.extend(words::uncertain(&rows));
    notes.extend(eddy::turned(&rows));
    notes.extend(eddy::unprecessed(&torque, &rows));
    let record = answer.record(verdict, from, &rows, asked, time_range, columns);
    let estimates = estimates(study, record.angular_momentum / answer.principal.moments[2]);
    Ok(Evolved { record: EvolutionRecord { estimates, homogeneous: homogeneous(study), ..record }, notes })
}

/// Slow torque on a body; uniform gravity has none about the center of mass, about which a free body turns. (A8)
fn slow_torque(study: &Study) -> Result<SlowTorque, StudyError> {
    let free = study.body.translation().is_some();
    let turns = |force: &&Force<Marker>| !(free && matches!(force.law, ForceLaw::UniformGravity { .. }));
    let forces: Vec<_> = study.forces.iter().filter(turns).cloned().collect();
    Ok(SlowTorque::from_forces(&forces)?)
}

/// Table of an answer from a rotation state on.
fn table_of(
    answer: &Answer,
    torque: SlowTorque,
    from: RotationState,
    asked: &EvolveSettings,
    watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<EvolutionTable, StudyError> {
    let evolution = answer.evolution();
    Ok(match &answer.history {
        History::Full(run, range) => EvolutionTable::of_run(run, range, from, asked.samples),
        History::Levels(passage) => EvolutionTable::of_levels(passage, &answer.principal),
        History::Settled(row, range) => {
            let rotation_state = range.rotation_state(row.energy).unwrap_or(from);
            let to = answer.end(&evolution, rotation_state, &asked.after(row.t))?;
            let rows =
                EvolutionTable::of_evolution(&evolution, rotation_state, to, asked.samples).behind(from, row);
            rows.staying(asked.stays())
        }
        History::None if torque.is_zero() => {
            let to = answer.end(&evolution, from, asked)?;
            EvolutionTable::of_evolution(&evolution, from, to, asked.samples).staying(asked.stays())
        }
        History::None => {
            let limits = DriftLimits {
                slowest: eddy::slowest(&torque, answer.principal.moments),
                ..answer.limits(&evolution, asked)?
            };
            let start = answer.drifting(from);
            EvolutionTable::of_drift(answer, torque, start, limits, asked.samples, watch)
        }
    })
}

/// Approximated shape or flow with a significant error: a solid, or the flow of liquids.
fn approximated(study: &Study) -> Option<(&'static str, f64)> {
    let solid = study.resolution.as_ref().map(|resolution| ("the solid", resolution.error));
    let liquids = study.liquids.iter().map(unresolved).fold(0.0, f64::max);
    solid.or((liquids > NOTABLE).then_some(("the flow", liquids)))
}

/// The body and its material, of a homogeneous one.
fn homogeneous(Study { model, body, .. }: &Study) -> Option<HomogeneousRecord> {
    let material = model.assembly.homogeneous()?;
    let (mass, density) = (body.invariants().mass, material.density);
    let radius = ball_radius(mass, density);
    let quality = match material.rheology {
        Rheology::QualityFactor { factor } => Some(factor),
        _ => None,
    };
    Some(HomogeneousRecord { mass, radius, density, shear: material.shear(), quality })
}

/// Published estimates of the time in which the nutation is damped, at a spin (rad/s) about the axis of greatest inertia.
fn estimates(study: &Study, spin: f64) -> Vec<EstimateRecord> {
    let Some(HomogeneousRecord { mass, density, shear, quality: Some(quality), .. }) = homogeneous(study)
    else {
        return Vec::new();
    };
    let unit = SmallBody { mass, density, shear, quality }.damping_unit(spin);
    let estimate = |DampingEstimate { source, factors: [least, greatest] }: DampingEstimate| EstimateRecord {
        source: source.into(),
        least: least * unit,
        greatest: greatest * unit,
    };
    DAMPING_ESTIMATES.map(estimate).into()
}

/// Times (s) of an average between two states, at both ends of the ranges of the materials.
fn range(
    extremes: &[Assembly; 2],
    answer: &Answer,
    [from, to]: [RotationState; 2],
) -> Result<[f64; 2], StudyError> {
    let time = |assembly: &Assembly| -> Result<f64, StudyError> {
        let body = assembly.body().map_err(|cause| StudyError::Extreme { cause: Box::new(cause) })?;
        let power: Arc<dyn MeanPower> = if answer.by_polynomial() {
            Arc::new(PolynomialPower::from_reduced(&reduce(&body, answer.inputs.order)?))
        } else {
            Arc::new(Response::compute(&body)?)
        };
        Ok(Evolution::new(power, answer.initial.angular_momentum()).time(from, to))
    };
    let [one, other] = [time(&extremes[0])?, time(&extremes[1])?];
    Ok([one.min(other), one.max(other)])
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use std::path::Path;

    use super::*;

    const BOOM: &str = include_str!("../../../../examples/boom-satellite/model.toml");

    /// Ends the work at its first report, or at a later one.
    struct Stopped(usize);

    impl Watch for Stopped {
        fn at(&mut self, _: &str, _: f64) -> ControlFlow<()> {
            self.0 = self.0.saturating_sub(1);
            if self.0 == 0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        }
    }

    #[test]
    fn an_evolution_that_is_ended_at_any_report_says_so() {
        let study = Study::read_from(Path::new("boom"), BOOM.as_bytes(), None).unwrap();
        let start = Start::new([0.345, 0.822, 0.330], [1.0, 0.0, 0.0, 0.0]);
        for method in [None, Some(EvolveMethod::Full), Some(EvolveMethod::MicroRuns)] {
            for reports in [1, 2, 7] {
                let asked = PartialEvolve { method, ..PartialEvolve::default() };
                match study.evolve_from(start, asked, &mut Stopped(reports)) {
                    Ok(evolved) => {
                        assert!(!evolved.holds(), "{method:?}, {reports}: {}", evolved.record.message)
                    }
                    Err(error) => {
                        assert!(matches!(error, StudyError::Interrupted), "{method:?}, {reports}: {error}")
                    }
                }
            }
        }
    }
}
