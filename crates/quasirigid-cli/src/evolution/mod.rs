//! The averaged rotation: how it is asked for, followed and recorded.

mod words;

use std::f64::consts::TAU;

use quasirigid::averaging::{
    Drift, DriftEnding, DriftState, Evolution, FreeRotation, MeanPower, Passage, PolynomialPower, Response,
    SlowTorque, Stage,
};
use quasirigid::dynamics::SpinState;
use quasirigid::math::sym::{add, dot, norm, scale};
use quasirigid::model::force::{Axes, Force, Law};
use quasirigid::model::{FlexibleBody, Marker, Mode, Principal, ReducedBody, Support};
use quasirigid::reduction::reduce;
use quasirigid_io::model::{Model, Power, Target};
use quasirigid_io::record::{Column, CrossingRecord, EvolutionRecord, HarmonicRecord};

use crate::commands::Loaded;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::progress::Bar;

pub use words::text;

/// What is asked for, by the file or on the command line.
pub struct Asked {
    /// Where to start; the initial state if it is not said.
    pub from: Option<Target>,
    /// Where to end.
    pub until: Option<Target>,
    /// When to end (s).
    pub duration: Option<f64>,
    /// Rows of the history.
    pub samples: usize,
    /// Where the power comes from; from the harmonics only where a material needs them, if nobody says.
    pub power: Option<Power>,
}

/// Rows of the history unless somebody says how many.
const SAMPLES: usize = 201;
/// Share of the wobble's energy that is left where nothing says how far to go.
const LEFT: f64 = 0.01;
/// Shares of harmonics below this are not listed, nor more than so many of them.
const FAINT: f64 = 1e-4;
const MOST_HARMONICS: usize = 12;
/// Resonances listed.
const MOST_CROSSINGS: usize = 12;

/// What the file asks for.
pub fn asked(model: &Model) -> Asked {
    let evolve = model.run.evolve.unwrap_or_default();
    Asked {
        from: None,
        until: evolve.until,
        duration: evolve.duration,
        samples: evolve.samples.unwrap_or(SAMPLES),
        power: evolve.power,
    }
}

/// Follows the averaged rotation; the record, and what the reader should know before the numbers.
pub fn follow(
    loaded: &Loaded,
    start: SpinState,
    asked: &Asked,
    interrupt: &Interrupt,
    quiet: bool,
) -> Result<(EvolutionRecord, Vec<String>), Failure> {
    let Loaded { model, body, forces, order } = loaded;
    let torque = slow_torque(body, forces)?;
    let reduced = reduce(body, *order)?;
    let ageing = Ageing::new(body, &reduced, start, asked.power)?;
    let evolution = ageing.evolution();
    let from = match asked.from {
        Some(target) => ageing.stage(&evolution, target)?,
        None => Stage::of(&ageing.initial).ok_or(Failure::Steady)?,
    };
    let bar = Bar::new("averaging", quiet);
    let mut rows = if torque == SlowTorque::default() {
        let to = ageing.end(&evolution, from, asked)?;
        Rows::of_evolution(&evolution, from, to, asked.samples)
    } else {
        let duration = asked.duration.ok_or(Failure::NoEvolutionDuration)?;
        let ending = asked.until.map(|target| ageing.stage(&evolution, target)).transpose()?;
        let start = ageing.drifting(from, start);
        Rows::of_drift(&ageing, torque, start, duration, ending, asked.samples)
    };
    let columns = ageing.columns(&mut rows, interrupt, &bar);
    bar.clear();
    let time_range = match &model.extremes {
        Some(extremes) if torque == SlowTorque::default() => Some(range(extremes, &ageing, from, rows.to())?),
        _ => None,
    };
    let notes = words::notes(&ageing, from, &rows, time_range.is_none() && model.extremes.is_some());
    Ok((ageing.record(&evolution, from, &rows, time_range, columns), notes))
}

/// A body whose rotation ages.
pub struct Ageing {
    principal: Principal,
    response: Response,
    polynomial: PolynomialPower,
    /// Whether the polynomial's power is the one followed.
    by_polynomial: bool,
    /// Angular momentum at the start (N·m·s).
    momentum: f64,
    /// Rotation of the frozen body with the momentum at the start.
    initial: FreeRotation,
    order: usize,
    /// Whether a material loses energy by a law that the polynomial does not hold.
    lossy: bool,
    measured: Vec<[f64; 2]>,
}

impl Ageing {
    fn new(
        body: &FlexibleBody,
        reduced: &ReducedBody,
        start: SpinState,
        power: Option<Power>,
    ) -> Result<Self, Failure> {
        let lossy = !body.lossy().is_empty();
        let principal = Principal::of(reduced.J);
        let K = reduced.momentum(start.omega);
        let frozen = [0, 1, 2].map(|i| dot(principal.axes[i], K) / principal.moments[i]);
        let measured = body.lossy().iter().filter_map(|part| part.rheology.measured_between());
        Ok(Self {
            principal,
            response: Response::of(body)?,
            polynomial: PolynomialPower::of(reduced),
            by_polynomial: !lossy && power.is_none() || power == Some(Power::Polynomial),
            momentum: norm(K),
            initial: FreeRotation::through(principal.moments, frozen),
            order: reduced.order,
            lossy,
            measured: measured.collect(),
        })
    }

    fn power(&self) -> &dyn MeanPower {
        if self.by_polynomial { &self.polynomial } else { &self.response }
    }

    fn evolution(&self) -> Evolution<'_> {
        Evolution::new(self.power(), self.momentum)
    }

    fn stage(&self, evolution: &Evolution, target: Target) -> Result<Stage, Failure> {
        let [I1, _, I3] = self.principal.moments;
        let ratio = match target {
            Target::Ratio(ratio) => ratio,
            Target::Wobble(angle) => {
                let motion =
                    FreeRotation::at_nutation(self.principal.moments, self.momentum, Mode::ShortAxis, angle);
                self.momentum * self.momentum / (2.0 * motion.energy() * I3)
            }
        };
        evolution.stage(ratio).ok_or(Failure::NoStage { ratio, least: I1 / I3 })
    }

    /// Where the evolution ends: the target, the time, or what is left of the wobble, whichever comes first.
    fn end(&self, evolution: &Evolution, from: Stage, asked: &Asked) -> Result<Stage, Failure> {
        let target = match asked.until {
            Some(target) => self.stage(evolution, target)?,
            None => self.faded(evolution, from)?,
        };
        let back = evolution.ratio(target) < evolution.ratio(from);
        if back {
            let [from, to] = [from, target].map(|stage| evolution.ratio(stage));
            return Err(Failure::Backwards { from, to });
        }
        let Some(duration) = asked.duration else { return Ok(target) };
        if evolution.time(from, target) <= duration {
            return Ok(target);
        }
        Ok(evolution.after(from, duration).unwrap_or(from))
    }

    /// Where one part in a hundred is left of the energy above that of the steady spin.
    fn faded(&self, evolution: &Evolution, from: Stage) -> Result<Stage, Failure> {
        let I3 = self.principal.moments[2];
        let least = self.momentum * self.momentum / (2.0 * I3);
        let energy = least + LEFT * (evolution.motion(from).energy() - least);
        evolution.stage(least / energy).ok_or(Failure::Steady)
    }

    fn drifting(&self, stage: Stage, start: SpinState) -> DriftState {
        let axis = self.principal.axes[stage.mode.circled()];
        let side = if dot(axis, start.omega) < 0.0 { -1.0 } else { 1.0 };
        DriftState { t: 0.0, stage, momentum: self.momentum, side, turns: 0.0 }
    }

    /// The table of the rows; fewer of them if Ctrl-C ends the work.
    fn columns(&self, rows: &mut Rows, interrupt: &Interrupt, bar: &Bar) -> Vec<Column> {
        let names = [
            ("t", "s"),
            ("D_over_I3", "1"),
            ("circled_axis", "1"),
            ("nutation_min", "rad"),
            ("nutation_max", "rad"),
            ("energy", "J"),
            ("momentum", "N m s"),
            ("polhode_period", "s"),
            ("precession_period", "s"),
            ("power", "W"),
            ("polynomial_power", "W"),
            ("turns", "1"),
        ];
        let mut columns: Vec<Column> = names
            .map(|(name, unit)| Column { name: name.into(), unit: unit.into(), values: Vec::new() })
            .into();
        let I3 = self.principal.moments[2];
        for i in 0..rows.states.len() {
            if interrupt.pressed() {
                rows.states.truncate(i);
                rows.status = "interrupted";
                break;
            }
            bar.show(i as f64 / rows.states.len() as f64);
            if let Some(evolution) = &rows.evolution {
                rows.states[i] = advanced(evolution, &rows.states, i);
            }
            let state = rows.states[i];
            let motion = Evolution::new(self.power(), state.momentum).motion(state.stage);
            let ratio = motion.momentum().powi(2) / (2.0 * motion.energy() * I3);
            let [least, greatest] = motion.nutation();
            let values = [
                state.t,
                ratio,
                (motion.mode().circled() + 1) as f64,
                least,
                greatest,
                motion.energy(),
                motion.momentum(),
                motion.polhode_period(),
                TAU / motion.long_axis_precession_rate(),
                self.power().mean_power(&motion),
                self.polynomial.mean_power(&motion),
                state.turns,
            ];
            columns.iter_mut().zip(values).for_each(|(column, value)| column.values.push(value));
        }
        columns
    }

    fn record(
        &self,
        evolution: &Evolution,
        from: Stage,
        rows: &Rows,
        time_range: Option<[f64; 2]>,
        columns: Vec<Column>,
    ) -> EvolutionRecord {
        let last = rows.states.last().copied().unwrap_or(rows.first);
        let to = last.stage;
        let steady = rows.evolution.is_some();
        let power = evolution.power(from);
        let ages = power > 0.0 || !steady;
        let final_motion = Evolution::new(self.power(), last.momentum).motion(to);
        let I3 = self.principal.moments[2];
        let mut record = EvolutionRecord {
            sentence: String::new(),
            method: self.method(),
            status: rows.status.into(),
            momentum: self.momentum,
            mode_start: mode(from.mode).into(),
            mode_end: mode(to.mode).into(),
            ratio_start: evolution.ratio(from),
            ratio_end: last.momentum.powi(2) / (2.0 * final_motion.energy() * I3),
            time: if ages { last.t } else { f64::INFINITY },
            time_range,
            turns: if ages { last.turns } else { f64::INFINITY },
            power,
            separatrix_time: if steady { evolution.separatrix_time(from, to) } else { rows.crossing() },
            lingering: if steady { evolution.lingering(from, to) } else { None },
            damping_time: folding(evolution, Mode::ShortAxis),
            growth_time: folding(evolution, Mode::LongAxis),
            harmonics: self.harmonics(&evolution.motion(from)),
            resonances: self.resonances(evolution, from, to),
            columns,
        };
        record.sentence = words::sentence(&record);
        record
    }

    fn method(&self) -> String {
        if self.by_polynomial {
            format!("mean of the power of the reduced equations of order {} along the polhode", self.order)
        } else {
            "sum over the harmonics of the polhode, with every elastic mode, dashpot and material".into()
        }
    }

    fn harmonics(&self, motion: &FreeRotation) -> Vec<HarmonicRecord> {
        let powers: Vec<(f64, f64)> = self.response.harmonic_powers(motion).collect();
        let sum: f64 = powers.iter().map(|(_, power)| power).sum();
        let record = |(i, (frequency, power)): (usize, &(f64, f64))| HarmonicRecord {
            number: i + 1,
            frequency: *frequency,
            share: if sum > 0.0 { power / sum } else { 0.0 },
        };
        powers
            .iter()
            .enumerate()
            .map(record)
            .filter(|harmonic| harmonic.share > FAINT)
            .take(MOST_HARMONICS)
            .collect()
    }

    fn resonances(&self, evolution: &Evolution, from: Stage, to: Stage) -> Vec<CrossingRecord> {
        let way = evolution.ratio(from)..=evolution.ratio(to);
        self.response
            .crossings(evolution)
            .into_iter()
            .filter(|crossing| way.contains(&evolution.ratio(crossing.stage)))
            .take(MOST_CROSSINGS)
            .map(|crossing| CrossingRecord {
                harmonic: crossing.harmonic,
                frequency: crossing.frequency,
                ratio: evolution.ratio(crossing.stage),
                mode: mode(crossing.stage.mode).into(),
                coordinate: crossing.coordinate,
                share: crossing.share,
            })
            .collect()
    }
}

/// The stages of an evolution, or the states of a drift.
struct Rows<'e> {
    first: DriftState,
    states: Vec<DriftState>,
    /// What the times of the states are still to be found from.
    evolution: Option<Evolution<'e>>,
    status: &'static str,
}

impl<'e> Rows<'e> {
    fn of_evolution(evolution: &Evolution<'e>, from: Stage, to: Stage, samples: usize) -> Self {
        let momentum = evolution.motion(from).momentum();
        let state = |stage| DriftState { t: 0.0, stage, momentum, side: 1.0, turns: 0.0 };
        let samples = if evolution.power(from) > 0.0 { samples } else { 1 };
        let states: Vec<_> = evolution.stages(from, to, samples).map(state).collect();
        Self { first: state(from), states, evolution: Some(*evolution), status: "finished" }
    }

    /// Even times; the rows end where the target is reached.
    fn of_drift(
        ageing: &Ageing,
        torque: SlowTorque,
        start: DriftState,
        duration: f64,
        ending: Option<Stage>,
        samples: usize,
    ) -> Self {
        let last = samples.saturating_sub(1).max(1);
        let times: Vec<f64> = (0..samples).map(|i| duration * i as f64 / last as f64).collect();
        let drift = Drift::new(ageing.power(), &ageing.principal, torque);
        let (mut states, outcome) = drift.follow(start, &times);
        if let Some(target) = ending {
            let evolution = ageing.evolution();
            let wanted = evolution.ratio(target);
            let reached = states.iter().position(|state| evolution.ratio(state.stage) >= wanted);
            states.truncate(reached.map_or(states.len(), |reached| reached + 1));
        }
        let status = match outcome {
            DriftEnding::Finished => "finished",
            DriftEnding::Held => "held",
            DriftEnding::Failed(_) => "failed",
        };
        Self { first: start, states, evolution: None, status }
    }

    fn to(&self) -> Stage {
        self.states.last().unwrap_or(&self.first).stage
    }

    /// Time (s) of the first row in another mode than the first one.
    fn crossing(&self) -> Option<f64> {
        let crossed = self.states.iter().find(|state| state.stage.mode != self.first.stage.mode);
        crossed.map(|state| state.t)
    }
}

/// A row with its time and turns, from the row before it.
fn advanced(evolution: &Evolution, states: &[DriftState], i: usize) -> DriftState {
    let state = states[i];
    let Some(before) = i.checked_sub(1).map(|before| states[before]) else { return state };
    let Passage { time, turns } = evolution.passage(before.stage, state.stage);
    DriftState { t: before.t + time, turns: before.turns + turns, ..state }
}

/// Times (s) of the same way at both ends of what is known of the materials.
fn range(
    extremes: &[quasirigid::elements::Assembly; 2],
    ageing: &Ageing,
    from: Stage,
    to: Stage,
) -> Result<[f64; 2], Failure> {
    let time = |assembly: &quasirigid::elements::Assembly| -> Result<f64, Failure> {
        let body = assembly.body().map_err(|cause| Failure::Extreme { cause: Box::new(cause) })?;
        let response = Response::of(&body)?;
        let polynomial = PolynomialPower::of(&reduce(&body, ageing.order)?);
        let power: &dyn MeanPower = if ageing.by_polynomial { &polynomial } else { &response };
        Ok(Evolution::new(power, ageing.momentum).time(from, to))
    };
    let [one, other] = [time(&extremes[0])?, time(&extremes[1])?];
    Ok([one.min(other), one.max(other)])
}

/// The torques that can be averaged with the rest.
fn slow_torque(body: &FlexibleBody, forces: &[Force<Marker>]) -> Result<SlowTorque, Failure> {
    if matches!(body.support(), Support::Prescribed { .. }) {
        return Err(Failure::DrivenPole);
    }
    let mut sum = SlowTorque::default();
    for Force { name, law } in forces {
        match law {
            Law::SpinDrag { coefficient } => sum.drag += coefficient,
            Law::Torque { torque, axes: Axes::Body, wave } if wave.frequency == 0.0 => {
                sum.constant = add(sum.constant, scale(wave.phase.cos(), *torque));
            }
            _ => return Err(Failure::Unaveraged { force: name.clone() }),
        }
    }
    Ok(sum)
}

/// Time (s) in which a small wobble about the axis of a mode changes by e; infinite where the axis is none, or nothing is lost.
fn folding(evolution: &Evolution, mode: Mode) -> f64 {
    let rate = evolution.wobble_rate(mode);
    if rate > 0.0 { rate.recip() } else { f64::INFINITY }
}

/// The name of a mode.
fn mode(mode: Mode) -> &'static str {
    match mode {
        Mode::ShortAxis => "short-axis",
        Mode::LongAxis => "long-axis",
    }
}
