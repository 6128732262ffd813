//! By which road an evolution is followed, and what speaks for it. (Q7)

use std::cell::OnceCell;
use std::f64::consts::TAU;
use std::ops::ControlFlow;

use quasirigid::averaging::{
    Evolution, FreeRotation, HillResponse, LevelEnding, LevelEvolution, LevelPassage, MeanPower, Stage, Until,
};
use quasirigid::dynamics::{FullState, SpinState};
use quasirigid::math::sym::norm;
use quasirigid::model::{FlexibleBody, Mode, Principal};
use quasirigid::reduction::{frequencies, reduce};
use quasirigid::secular::{
    AverageCriteria, CalibratedPower, DirectEnding, DirectOptions, DirectRow, DirectRun, EnergyRange,
    MeasureError, MeasureOptions, MeasuredPower, Poles, Probes, average_criteria, follow_directly,
};
use quasirigid_io::model::{EvolveMethod, Target};

use super::ageing::Ageing;
use crate::commands::Loaded;
use crate::describe::{significant, time};
use crate::failure::Failure;
use crate::motion::Motion;

/// The road taken, and what it knows beside the power.
#[derive(Clone, Debug, Default)]
pub struct Verdict {
    /// `average`, `modes`, `micro-runs`, `direct`, or `none`.
    pub road: &'static str,
    /// Why, and how far it holds.
    pub sentence: String,
    /// Estimate of the relative error of the time.
    pub error: Option<f64>,
    /// Rates (1/s) of the modes: growth about the axis of least inertia, decay about that of greatest.
    pub rates: Option<[Option<f64>; 2]>,
    /// Power or energy that each dissipator takes, where the road measured it.
    pub budget: Option<Vec<(String, f64)>>,
    /// A vibration that grows from nothing on the way, in words.
    pub parametric: Option<String>,
    /// Whether the answer does not hold although it was asked for.
    pub fails: bool,
}

impl Verdict {
    /// The average, with an estimate of its error.
    pub fn average(error: Option<f64>) -> Self {
        Self { road: "average", error, ..Self::default() }
    }

    /// Time (s) in which a small wobble about the axis of a mode changes by e, from the modes; none if they were not asked.
    pub fn folding(&self, mode: Mode) -> Option<f64> {
        let rates = self.rates?;
        let rate = rates[usize::from(mode == Mode::ShortAxis)]?;
        Some(if rate > 0.0 { rate.recip() } else { f64::INFINITY })
    }

    /// How the power was found, in words; none of an average.
    pub fn method(&self) -> Option<String> {
        match self.road {
            "micro-runs" => Some("measured by short runs of the full system along the way".into()),
            "levels" => Some("mean of the power of the reduced equations along level curves of the slow energy".into()),
            "direct" => Some("the full system from start to end; the wobble is the envelope, that of a rigid body with the same energy".into()),
            _ => None,
        }
    }
}

/// What is followed beside a power.
pub enum History {
    /// Nothing: the power says it all.
    None,
    /// The full system until it has forgotten its start; from there on the power says it all.
    Settled(DirectRow, EnergyRange),
    /// The full system, with its range of energies.
    Full(Box<DirectRun>, EnergyRange),
    /// Levels of the slow energy.
    Levels(Box<LevelPassage>),
}

/// Why no road leads to an answer, in words, with the rates of the modes where these are known.
pub struct Refusal {
    pub message: String,
    pub rates: Option<[Option<f64>; 2]>,
}

/// A spin below this share of the slowest elastic frequency needs no more than the average.
const SLOW: f64 = 1e-3;
/// Moments whose relative difference is larger are distinct for so slow a spin.
const DISTINCT: f64 = 1e-3;

/// Chooses the road for a body on which no torque acts: the power that is followed from then on, or the history.
pub fn choose(
    loaded: &Loaded,
    start: SpinState,
    asked: &super::Asked,
    ageing: &mut Ageing,
    watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Result<History, Refusal>, Failure> {
    let body = &loaded.body;
    if asked.method.is_none() && plain(body, ageing, norm(start.omega)) {
        return Ok(Ok(History::None));
    }
    let full = Motion::new(loaded, start).full()?;
    let momentum = norm(full.momentum(body));
    if !(momentum.is_finite() && momentum > 0.0) {
        return Ok(Ok(History::None));
    }
    let ground = match Ground::of(body, momentum)? {
        Ok(ground) => ground,
        Err(message) => return Ok(Err(Refusal { message, rates: None })),
    };
    ageing.verdict.rates = Some([Mode::LongAxis, Mode::ShortAxis].map(|mode| ground.poles.rate(mode)));
    if let (None, Some(unstable)) = (asked.method, ground.unstable()) {
        return Ok(Err(Refusal { message: unstable, rates: ageing.verdict.rates }));
    }
    let way = Way::of(&ground, full, asked, ageing)?;
    let choice =
        Choice { body, ground: &ground, way: &way, duration: asked.duration, probes: OnceCell::new() };
    let refused = |message: String| Refusal { message, rates: ageing_rates(&ground) };
    let found = match asked.method {
        Some(EvolveMethod::Average) => Ok(choice.forced_average(ageing)),
        Some(EvolveMethod::Modes) => choice.calibrated(ageing),
        Some(EvolveMethod::MicroRuns) => match choice.measured(watch) {
            Err(MeasureError::Interrupted) => return Err(Failure::Interrupted),
            found => found.map_err(|error| error.to_string()),
        },
        Some(EvolveMethod::Direct) => choice.direct(f64::INFINITY, watch)?,
        None => match choice.average(ageing, watch)? {
            Some(road) => Ok(road),
            None => match choice.levels(loaded, asked) {
                Some(found) => found,
                None => choice.other(ageing, watch)?,
            },
        },
    };
    Ok(match found {
        Ok(road) => Ok(take(road, &ground, &way, ageing)),
        Err(message) => Err(refused(message)),
    })
}

/// Judges the average of a body under a slow torque, which no other road follows; why it does not hold, if it does not.
pub fn under_torque(
    loaded: &Loaded,
    start: SpinState,
    asked: &super::Asked,
    ageing: &mut Ageing,
) -> Result<Option<Refusal>, Failure> {
    let body = &loaded.body;
    if plain(body, ageing, norm(start.omega)) {
        return Ok(None);
    }
    let full = Motion::new(loaded, start).full()?;
    let momentum = norm(full.momentum(body));
    if !(momentum.is_finite() && momentum > 0.0) {
        return Ok(None);
    }
    let ground = match Ground::of(body, momentum)? {
        Ok(ground) => ground,
        Err(message) => return Ok(Some(Refusal { message, rates: None })),
    };
    let rates = ageing_rates(&ground);
    let Some(stage) = ground.range.stage(full.energy(body)) else { return Ok(None) };
    let judged = |ageing: &Ageing| average_criteria(ageing.power(), &ground.range, &ground.poles, [stage; 2]);
    let mut criteria = judged(ageing);
    if criteria.error() > UNDER_TORQUE && ageing.by_polynomial && !ageing.power_was_asked {
        ageing.take_harmonics();
        criteria = judged(ageing);
    }
    ageing.verdict = Verdict { rates, ..Verdict::average(Some(criteria.error())) };
    if criteria.error() <= UNDER_TORQUE {
        return Ok(None);
    }
    if asked.method == Some(EvolveMethod::Average) {
        ageing.verdict.sentence = format!("THE AVERAGE DOES NOT HOLD: {}.", unfounded(criteria));
        ageing.verdict.fails = true;
        return Ok(None);
    }
    let message = format!(
        "under a torque the average alone is followed, and it does not hold: {}",
        unfounded(criteria)
    );
    Ok(Some(Refusal { message, rates }))
}

fn ageing_rates(ground: &Ground) -> Option<[Option<f64>; 2]> {
    Some([Mode::LongAxis, Mode::ShortAxis].map(|mode| ground.poles.rate(mode)))
}

/// Whether a body is so stiff, with moments so distinct, that the average needs no judgement.
fn plain(body: &FlexibleBody, ageing: &Ageing, spin: f64) -> bool {
    let [I1, I2, I3] = ageing.principal.moments;
    let distinct = [I2 - I1, I3 - I2].iter().all(|gap| *gap > DISTINCT * I3 || *gap < 1e-9 * I3);
    let slowest = ageing.response.frequencies().next().map_or(f64::INFINITY, |(frequency, _)| frequency);
    body.cyclic().is_empty() && distinct && spin < SLOW * slowest
}

/// Takes a road: the power that is followed, or the history.
fn take(road: Road, ground: &Ground, way: &Way, ageing: &mut Ageing) -> History {
    let names = |budget: &[f64], names: &[String]| {
        names.iter().cloned().zip(budget.iter().copied()).collect::<Vec<_>>()
    };
    match road {
        Road::Average { error } => {
            ageing.begin(way.settled);
            ageing.verdict = Verdict {
                sentence: format!(
                    "Averaged along the polhode; by the modes about the steady spins the time is good to {} %.",
                    significant(100.0 * error.max(1e-6), 2)
                ),
                rates: ageing.verdict.rates,
                parametric: ageing.verdict.parametric.take(),
                ..Verdict::average(Some(error))
            };
            History::None
        }
        Road::Unfounded { criteria } => {
            ageing.begin(way.settled);
            ageing.verdict = Verdict {
                sentence: format!("THE AVERAGE DOES NOT HOLD: {}.", unfounded(criteria)),
                fails: true,
                rates: ageing.verdict.rates,
                parametric: ageing.verdict.parametric.take(),
                ..Verdict::average(Some(criteria.error()))
            };
            History::None
        }
        Road::Calibrated { power, error } => {
            ageing.begin(way.settled);
            ageing.source = power;
            ageing.verdict = Verdict {
                road: "modes",
                sentence: format!(
                    "Averaged at the rates that the modes about the steady spins have; the wobble is small enough for them; the time is good to {} %.",
                    significant(100.0 * error, 2)
                ),
                error: Some(error),
                rates: ageing.verdict.rates,
                parametric: ageing.verdict.parametric.take(),
                ..Verdict::default()
            };
            History::None
        }
        Road::Measured(power, settled) => {
            let first = power.measurements.first();
            let error = power.time_error(ground.revolutions(way.ends).unwrap_or(f64::INFINITY));
            ageing.verdict = Verdict {
                road: "micro-runs",
                sentence: format!(
                    "What moves inside is too heavy or too soft for an average: the mean power was measured in {} short runs of the \
                     full system; the time is good to {} %.",
                    power.measurements.len(),
                    significant(100.0 * error, 2)
                ),
                error: Some(error),
                budget: first.map(|first| names(&first.budget, &way.dissipators)),
                rates: ageing.verdict.rates,
                parametric: ageing.verdict.parametric.take(),
                fails: false,
            };
            ageing.take(power, &ground.range, way.energies[0]);
            if let Some(row) = settled {
                return History::Settled(row, ground.range.clone());
            }
            History::None
        }
        Road::Direct(run) => {
            ageing.verdict = Verdict {
                road: "direct",
                sentence: "The full system was followed from start to end; the wobble is its envelope."
                    .into(),
                error: Some(run.energy_drift.abs() / (way.energies[0] - way.energies[1]).abs()),
                budget: Some(names(&run.budget, &way.dissipators)),
                rates: ageing.verdict.rates,
                parametric: ageing.verdict.parametric.take(),
                fails: false,
            };
            ageing.take(Box::new(Levels(ground.range.moments())), &ground.range, way.energies[0]);
            History::Full(run, ground.range.clone())
        }
        Road::Levels(passage) => {
            ageing.verdict = Verdict {
                road: "levels",
                sentence: "The moments are nearly equal: averaged along the level curves of the slow energy, which elasticity bends.".into(),
                rates: ageing.verdict.rates,
                ..Verdict::default()
            };
            History::Levels(passage)
        }
    }
}

/// Why an average does not hold, in words.
fn unfounded(criteria: AverageCriteria) -> String {
    let AverageCriteria { poles, settling, moments, probed } = criteria;
    let percent = |share: f64| significant(100.0 * share, 2);
    if probed > poles.max(settling).max(moments) {
        return format!("its power is {} % off that of short runs of the full system", percent(probed));
    }
    if moments >= poles && moments >= settling {
        return format!(
            "the deformation changes the differences between the moments of inertia by {} %",
            percent(moments)
        );
    }
    if settling > poles {
        return format!(
            "the wobble changes at {} of the rate at which the inside follows it",
            significant(settling, 2)
        );
    }
    format!(
        "a small wobble changes at a rate that is {} % off that of the modes, which is exact",
        percent(poles)
    )
}

/// Effective moments alone: what places a stage, without a power.
struct Levels([f64; 3]);

impl MeanPower for Levels {
    fn moments(&self) -> [f64; 3] {
        self.0
    }

    fn mean_power(&self, _: &FreeRotation) -> f64 {
        0.0
    }
}

/// From where to where.
struct Way {
    start: FullState,
    /// Whether the start is a stage that was asked for, and not the file's.
    placed: bool,
    ends: [Stage; 2],
    /// The start when its vibrations have died out.
    settled: Option<Stage>,
    energies: [f64; 2],
    dissipators: Vec<String>,
}

impl Way {
    /// The way that is asked for, by the energies of the deformed body.
    fn of(ground: &Ground, full: FullState, asked: &super::Asked, ageing: &Ageing) -> Result<Self, Failure> {
        let body = ground.body;
        let range = &ground.range;
        let levels = Levels(range.moments());
        let evolution = Evolution::new(&levels, range.momentum());
        let energy = full.energy(body);
        let (start, from) = match asked.from {
            Some(target) => {
                let stage = ageing.stage(&evolution, target)?;
                (range.state(body, stage).ok_or(Failure::Steady)?, stage)
            }
            None => (full, range.stage(energy).ok_or(Failure::Steady)?),
        };
        let asked = super::Asked { duration: None, ..asked.clone() };
        let to = ageing.end(&evolution, from, &asked)?;
        let first = start.energy(body);
        Ok(Self {
            placed: asked.from.is_some(),
            ends: [from, to],
            settled: range.settled(body, start.momentum(body)),
            start,
            energies: [first, evolution.motion(to).energy()],
            dissipators: body.dissipators().iter().map(|each| each.name.clone()).collect(),
        })
    }
}

/// What every road is judged by: the steady spins at the angular momentum of the start, and their modes.
struct Ground<'a> {
    body: &'a FlexibleBody,
    range: EnergyRange,
    poles: Poles,
}

/// A road that leads to an answer.
enum Road {
    /// The average, with the estimate of its error.
    Average { error: f64 },
    /// The average that was asked for, although it does not hold.
    Unfounded { criteria: AverageCriteria },
    /// The average at the rates of the modes.
    Calibrated { power: Box<dyn MeanPower>, error: f64 },
    /// The power measured by short runs, after the full system has forgotten its start.
    Measured(Box<MeasuredPower>, Option<DirectRow>),
    /// The history of the full system.
    Direct(Box<DirectRun>),
    /// Averaged along levels of the slow energy.
    Levels(Box<LevelPassage>),
}

/// Revolutions of a history of the full system that is chosen at once, and that is tried where nothing else holds.
const FEW: f64 = 3_000.0;
const MANY: f64 = 200_000.0;
/// Steps of a history.
const STEPS: u64 = 30_000_000;
/// Error allowed per step of the full system, relative.
const TOLERANCE: f64 = 1e-10;
/// Decay in a period of the polhode up to which the power has a mean.
const DECAY: f64 = 0.05;
/// Share of a decay that materials and liquids without equations of motion may have in the full system's place.
const LEFT_OUT: f64 = 0.02;
/// Relative change of a difference of moments by elasticity from which levels are followed, largest ratio of spin to frequency, and
/// least order of the power there.
const BENT: f64 = 0.01;
const STIFF: f64 = 0.15;
const LEVEL_ORDER: usize = 5;
/// Places of the way at which parametric resonance is looked for.
const LOOKS: usize = 4;
/// Ratio of the spin to the slowest elastic frequency from which an average is held against short runs of the full system, and the
/// steps that each may take.
const PROBED: f64 = 0.1;
const PROBE_STEPS: u64 = 3_000_000;
/// Coordinates up to which the response in the spinning frame is tried.
const FEW_COORDINATES: usize = 120;
/// Revolutions in which no wobble dies out.
const ONE_TURN: f64 = 1.0;
/// Error of an average that is given under a torque, which has no other road.
const UNDER_TORQUE: f64 = 0.1;
/// Relaxation times in which a start is forgotten, and periods of the polhode at most.
const FORGOTTEN: f64 = 8.0;
const LONGEST: f64 = 400.0;
/// Error from which an answer is refused.
const REFUSED: f64 = 0.03;
/// Wobble (rad) at which the rates of the modes say no more than the average.
const WIDE: f64 = 0.6;
/// Least error that is claimed for the rates of the modes.
const LEAST: f64 = 1e-3;
/// The same of liquids whose boundary layer is that of a liquid at rest in a turned frame.
const OF_LIQUIDS: f64 = 0.02;

impl<'a> Ground<'a> {
    /// The ground at an angular momentum (N·m·s).
    fn of(body: &'a FlexibleBody, momentum: f64) -> Result<Result<Self, String>, Failure> {
        match EnergyRange::of(body, momentum) {
            Ok(range) => {
                let poles = Poles::of(body, &range).map_err(|error| format!("the steady spins: {error}"));
                Ok(poles.map(|poles| Self { body, range, poles }))
            }
            Err(error) => Ok(Err(error.to_string())),
        }
    }

    /// The equivalent polhode at a stage.
    fn motion(&self, Stage { mode, xi }: Stage) -> FreeRotation {
        FreeRotation::at_logit(self.range.moments(), self.range.momentum(), mode, xi)
    }

    /// What grows at the axis of greatest inertia, in words; none if its spin is stable.
    fn unstable(&self) -> Option<String> {
        let pole = self.poles.short.as_ref()?;
        let mode = pole.unstable()?;
        Some(format!(
            "the steady spin about the axis of greatest inertia is unstable: a motion of {} grows e-fold in {}",
            mode.name,
            time(-mode.time_constant())
        ))
    }

    /// Whether the equations of motion hold all that dissipates in the modes on the way.
    fn complete(&self, ends: [Stage; 2]) -> bool {
        let modes = ends.map(|stage| stage.mode);
        modes.iter().all(|mode| {
            let pole = self.poles.of_mode(*mode);
            let nutation = pole.and_then(|pole| pole.modes.nutation());
            nutation.is_some_and(|nutation| {
                let [decay, _] = nutation.of_motion;
                (decay - nutation.decay_rate).abs() <= LEFT_OUT * nutation.decay_rate.abs()
            })
        })
    }

    /// Estimate of the revolutions from one stage to another, from the rates of the modes; none if these do not say.
    fn revolutions(&self, ends: [Stage; 2]) -> Option<f64> {
        let [from, to] = ends;
        let excess = |stage: Stage| self.motion(stage).energy_from_axis();
        let middle = |mode: Mode| excess(Stage { mode, xi: -6.0 });
        let rate = |mode: Mode| self.poles.rate(mode).filter(|rate| *rate > 0.0);
        let time = if from.mode == to.mode {
            (excess(from) / excess(to)).ln().abs() / (2.0 * rate(from.mode)?)
        } else {
            let grown = (middle(from.mode) / excess(from)).ln() / (2.0 * rate(from.mode)?);
            grown + (middle(to.mode) / excess(to)).ln() / (2.0 * rate(to.mode)?)
        };
        let spin = self.range.momentum() / self.range.moments()[to.mode.circled()];
        Some(time * spin / TAU)
    }

    /// Decay in a period of the polhode at the poles of the way.
    fn haste(&self, ends: [Stage; 2]) -> f64 {
        let haste = |stage: Stage| {
            let nutation = self.poles.of_mode(stage.mode).and_then(|pole| pole.modes.nutation());
            nutation.map_or(f64::INFINITY, |mode| mode.decay_rate.abs() * TAU / mode.frequency)
        };
        haste(ends[0]).max(haste(ends[1]))
    }
}

/// A choice between the roads.
struct Choice<'a> {
    body: &'a FlexibleBody,
    ground: &'a Ground<'a>,
    way: &'a Way,
    /// Longest time (s).
    duration: Option<f64>,
    /// Short runs of the full system, once they were made; none where there are to be none.
    probes: OnceCell<Option<Probes>>,
}

impl Choice<'_> {
    fn criteria(&self, ageing: &Ageing) -> AverageCriteria {
        average_criteria(ageing.power(), &self.ground.range, &self.ground.poles, self.way.ends)
    }

    /// The average if it holds: from the reduced equations, from the harmonics, or from those of the spinning frame.
    fn average(
        &self,
        ageing: &mut Ageing,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Option<Road>, Failure> {
        let hill = self.spinning_frame();
        ageing.verdict.parametric = hill.as_ref().and_then(|hill| self.parametric(hill));
        if ageing.verdict.parametric.is_some() {
            return Ok(None);
        }
        if let Some(road) = self.accepted(self.criteria(ageing), ageing.power(), watch)? {
            return Ok(Some(road));
        }
        if ageing.by_polynomial && !ageing.power_was_asked {
            ageing.take_harmonics();
            if let Some(road) = self.accepted(self.criteria(ageing), ageing.power(), watch)? {
                return Ok(Some(road));
            }
        }
        let Some(hill) = hill.filter(|_| !ageing.power_was_asked) else { return Ok(None) };
        let Ground { range, poles, .. } = self.ground;
        let evolution = Evolution::new(&hill, range.momentum());
        let share = |stage: Stage| hill.share(&evolution.motion(stage)).unwrap_or(f64::INFINITY);
        let share = self.way.ends.map(share).into_iter().fold(0.0, f64::max);
        let criteria = average_criteria(&hill, range, poles, self.way.ends);
        let criteria = AverageCriteria { poles: criteria.poles.max(share), ..criteria };
        let road = self.accepted(criteria, &hill, watch)?;
        if road.is_some() {
            ageing.take_hill(hill);
        }
        Ok(road)
    }

    /// An average whose criteria hold and that short runs of the full system bear out.
    fn accepted(
        &self,
        criteria: AverageCriteria,
        power: &dyn MeanPower,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Option<Road>, Failure> {
        if !criteria.hold() {
            return Ok(None);
        }
        let probed = self.probes(watch)?.map_or(0.0, |probes| probes.error(power));
        let criteria = AverageCriteria { probed, ..criteria };
        Ok(criteria.hold().then(|| self.averaged(criteria)))
    }

    /// Short runs of the full system on the way; none of a body that is stiff, or has no equations of motion for what it loses.
    fn probes(&self, watch: &mut dyn FnMut(f64) -> ControlFlow<()>) -> Result<Option<&Probes>, Failure> {
        if let Some(probes) = self.probes.get() {
            return Ok(probes.as_ref());
        }
        let slowest = frequencies(self.body)?.first().copied().unwrap_or(f64::INFINITY);
        let stiff = self.body.cyclic().is_empty() && norm(self.way.start.omega) < PROBED * slowest;
        let mut found = None;
        if !stiff && self.ground.complete(self.way.ends) {
            let Ground { body, range, poles } = self.ground;
            let options = MeasureOptions { most_steps: PROBE_STEPS, ..MeasureOptions::default() };
            let probes = Probes::between(body, range, poles, self.way.ends, options, &mut || watch(0.0));
            match probes {
                Ok(probes) => found = Some(probes),
                Err(MeasureError::Interrupted) => return Err(Failure::Interrupted),
                Err(_) => {}
            }
        }
        Ok(self.probes.get_or_init(|| found).as_ref())
    }

    /// The average, with the error of its time.
    fn averaged(&self, criteria: AverageCriteria) -> Road {
        let revolutions = self.ground.revolutions(self.way.ends).unwrap_or(f64::INFINITY);
        Road::Average { error: criteria.time_error(revolutions) }
    }

    /// The response in the spinning frame; none of a body of many coordinates.
    fn spinning_frame(&self) -> Option<HillResponse> {
        let few = self.body.coordinates().len() <= FEW_COORDINATES;
        if few { HillResponse::of(self.body).ok() } else { None }
    }

    /// A vibration that grows from nothing on the way, in words; none if none does.
    fn parametric(&self, hill: &HillResponse) -> Option<String> {
        let evolution = Evolution::new(hill, self.ground.range.momentum());
        let [from, to] = self.way.ends;
        evolution.stages(from, to, LOOKS).find_map(|stage| {
            let motion = evolution.motion(stage);
            let resonance = hill.floquet(&motion).ok()?.resonance?;
            Some(format!(
                "Parametric resonance: at a wobble of {} degrees a vibration of {} at {} rad/s grows from nothing, e-fold in {}.",
                significant(motion.nutation()[1].to_degrees(), 3),
                resonance.coordinate,
                significant(resonance.frequency, 4),
                time(resonance.rate.recip())
            ))
        })
    }

    /// Averaged along levels of the slow energy, where elasticity changes the differences of the moments of a stiff body; none elsewhere.
    fn levels(&self, loaded: &Loaded, asked: &super::Asked) -> Option<Result<Road, String>> {
        let rigid = Principal::of(self.body.invariants().J).moments;
        let bent = self.ground.range.moments();
        let changed = [(0, 1), (1, 2)].iter().any(|(a, b)| {
            let (before, after) = (rigid[*b] - rigid[*a], bent[*b] - bent[*a]);
            (after - before).abs() > BENT * before.abs()
        });
        let slowest = frequencies(self.body).ok()?.first().copied()?;
        let omega = self.way.start.omega;
        if !changed
            || norm(omega) > STIFF * slowest
            || !self.body.cyclic().is_empty()
            || !self.body.lossy().is_empty()
        {
            return None;
        }
        let reduced = reduce(self.body, loaded.order.max(LEVEL_ORDER)).ok()?;
        let until = match (asked.until, self.duration) {
            (Some(Target::Wobble(angle)), _) => Until::Wobble(angle),
            (Some(Target::Ratio(_)), None) => {
                return Some(Err("the moments of this body are nearly equal, so that D/I3 says little; say how far to go by an angle".into()));
            }
            (_, Some(duration)) => Until::Duration(duration),
            (None, None) => Until::EnergyLeft(0.01),
        };
        let momentum = self.way.start.momentum(self.body);
        let found = LevelEvolution::new(&reduced, norm(momentum))
            .and_then(|levels| levels.follow(momentum, until, asked.samples));
        Some(match found {
            Ok(passage) => match passage.ending {
                LevelEnding::Reached | LevelEnding::Duration => Ok(Road::Levels(Box::new(passage))),
                LevelEnding::Undecided => Err(format!(
                    "the rotation comes to a saddle of the slow energy after {}, behind which the ways differ",
                    time(passage.rows.last().map_or(f64::NAN, |row| row.time))
                )),
                LevelEnding::Lossless => Err("nothing is dissipated".into()),
            },
            Err(error) => Err(error.to_string()),
        })
    }

    /// The average that was asked for.
    fn forced_average(&self, ageing: &Ageing) -> Road {
        let criteria = self.criteria(ageing);
        if criteria.hold() { self.averaged(criteria) } else { Road::Unfounded { criteria } }
    }

    /// The road that holds where the average does not.
    fn other(
        &self,
        ageing: &mut Ageing,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Result<Road, String>, Failure> {
        if !self.ground.complete(self.way.ends) {
            return Ok(self.calibrated(ageing));
        }
        let revolutions = self.ground.revolutions(self.way.ends);
        let fast = self.ground.haste(self.way.ends) > DECAY;
        if fast || self.whirls() || revolutions.is_none_or(|turns| turns <= FEW) {
            return self.direct(MANY, watch);
        }
        match self.measured(watch) {
            Ok(road) => Ok(Ok(road)),
            Err(MeasureError::Interrupted) => Err(Failure::Interrupted),
            Err(_) if revolutions.is_some_and(|turns| turns <= MANY) => self.direct(MANY, watch),
            Err(error) => Ok(Err(error.to_string())),
        }
    }

    /// The power measured by short runs.
    fn measured(&self, watch: &mut dyn FnMut(f64) -> ControlFlow<()>) -> Result<Road, MeasureError> {
        let Ground { range, poles, .. } = self.ground;
        let settled = self.settled(watch)?;
        let [from, to] = self.way.ends;
        let from = settled.as_ref().and_then(|row| range.stage(row.energy)).unwrap_or(from);
        let options = MeasureOptions::default();
        let power = MeasuredPower::along(self.body, range, poles, [from, to], options, watch)?;
        if power.error > REFUSED {
            return Err(MeasureError::Unsettled { change: power.error });
        }
        Ok(Road::Measured(Box::new(power), settled))
    }

    /// Where the full system has forgotten the start of the file; none where the start is a stage that was asked for.
    fn settled(
        &self,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Option<DirectRow>, MeasureError> {
        let Some(pole) = self.ground.poles.of_mode(self.way.ends[0].mode).filter(|_| !self.way.placed) else {
            return Ok(None);
        };
        let period = self.ground.motion(self.way.ends[0]).polhode_period();
        let duration = (FORGOTTEN / pole.settling_rate()).clamp(period, LONGEST * period);
        let options = DirectOptions {
            until: Some(self.way.energies[1]),
            duration,
            most_turns: f64::INFINITY,
            most_steps: STEPS,
            tolerance: TOLERANCE,
        };
        let run = follow_directly(self.body, &self.way.start, options, watch)?;
        match run.ending {
            DirectEnding::Finished => Ok(run.rows.last().copied()),
            DirectEnding::Interrupted => Err(MeasureError::Interrupted),
            _ => Err(MeasureError::LeftMode),
        }
    }

    /// The average at the rates of the modes, for small wobbles.
    fn calibrated(&self, ageing: &mut Ageing) -> Result<Road, String> {
        if !ageing.lossy {
            ageing.take_harmonics();
        }
        let Ground { range, poles, .. } = self.ground;
        let power = CalibratedPower::new(ageing.copied(), range.momentum(), |mode| poles.rate(mode));
        let off = self.way.ends.map(|stage| (power.factor(stage.mode) - 1.0).abs());
        let off = off[0].max(off[1]);
        let wobble = self.way.ends.map(|stage| self.ground.motion(stage).nutation()[1]);
        let widest = wobble[0].max(wobble[1]);
        let error = off * (widest / WIDE).powi(2).min(1.0);
        if let Some(unstable) = self.ground.unstable() {
            return Err(unstable);
        }
        if error > REFUSED {
            return Err(format!(
                "the average is off by {} % at the axis, where the modes are exact, and the wobble of {} degrees is too wide for them",
                significant(100.0 * off, 2),
                significant(widest.to_degrees(), 3)
            ));
        }
        let least = if self.body.memories().is_empty() { LEAST } else { OF_LIQUIDS };
        Ok(Road::Calibrated { power: Box::new(power), error: error.max(least) })
    }

    /// The history of the full system.
    fn direct(
        &self,
        most_turns: f64,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Result<Road, String>, Failure> {
        let options = DirectOptions {
            until: Some(self.way.energies[1]),
            duration: self.duration.unwrap_or(f64::MAX),
            most_turns,
            most_steps: STEPS,
            tolerance: TOLERANCE,
        };
        let run = follow_directly(self.body, &self.way.start, options, watch)?;
        let end = run.rows[run.rows.len() - 1];
        let told = |why: &str| {
            let unstable =
                self.ground.unstable().map_or_else(String::new, |unstable| format!("; {unstable}"));
            format!(
                "the full system was followed for {} ({} turns) and did not get there: {why}{unstable}",
                time(end.t),
                significant(end.turns, 3)
            )
        };
        Ok(match &run.ending {
            DirectEnding::Reached if end.turns < ONE_TURN => Err(format!(
                "the energy of the full system falls to the target within {}, less than a turn: that is the start coming into \
                 balance, not a wobble that dies out; see quasirigid simulate --system full",
                time(end.t)
            )),
            DirectEnding::Reached | DirectEnding::Finished => Ok(Road::Direct(Box::new(run))),
            DirectEnding::Interrupted => return Err(Failure::Interrupted),
            DirectEnding::TurnLimit => Err(told("that is more than may be followed turn by turn")),
            DirectEnding::StepLimit => Err(told("the steps allowed were used up")),
            DirectEnding::Failed { reason } => Err(told(reason)),
        })
    }

    /// Whether a motion beside the nutation grows at a pole of the way.
    fn whirls(&self) -> bool {
        self.way.ends.iter().any(|stage| {
            let pole = self.ground.poles.of_mode(stage.mode);
            pole.is_some_and(|pole| pole.modes.internal.iter().any(|[decay, _]| *decay < 0.0))
        })
    }
}
