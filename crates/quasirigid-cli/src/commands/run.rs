use std::path::{Path, PathBuf};

use quasirigid::dynamics::{Options, Outcome, PropagateError, SpinState};
use quasirigid::math::sym::norm;
use quasirigid::model::ReducedBody;
use quasirigid::reduction::{Validity, Verdict, reduce};
use quasirigid_io::export::Derived;
use quasirigid_io::model::Model;
use quasirigid_io::record::{EvolutionRecord, HistoryRecord, RunRecord, VerificationRecord};

use super::derive::acting;
use super::{
    Loaded, circled_axis, duration, even_times, initial, is_standard_input, load, options, room, summary,
};
use crate::args::{Run, System};
use crate::describe::drift_note;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::left_out::LeftOut;
use crate::liquids::{Liquid, liquids};
use crate::message::remark;
use crate::motion::{DISPLACED, Motion};
use crate::output::Folder;
use crate::progress::Collector;
use crate::{Ending, evolution, output, record, steady, verification};

/// Rows of a history when nothing says how many: enough for smooth curves, within limits.
const ROWS_PER_TURN: f64 = 24.0;
const ROWS: [f64; 2] = [2_001.0, 50_001.0];

/// Note on a spin outside the range of the series.
const NO_MOMENTUM: &str = "The truncated series has no momentum for this spin, so the full system was followed \
                           in the place of the reduced equations.";
/// Note on a run that Ctrl-C ended.
const INTERRUPTED: &str = "The run was interrupted, so the history of the {system} body was left out.";
const UNPROVED: &str = "The run was interrupted, so the verification against the full system was left out.";
/// What a start off the slow manifold means for the histories.
const SETTLES: &str = "the full system moves until its friction has stilled it, and the reduced body starts from the state that it \
                       settles on";

/// The main job: check, reduce, propagate, and write the record with its report.
pub fn run(arguments: &Run) -> Result<Ending, Failure> {
    if arguments.out.is_none() && is_standard_input(&arguments.common) {
        return Err(Failure::NamelessRun);
    }
    let loaded = load(&arguments.common)?;
    let Loaded { model, body, order, .. } = &loaded;
    let order = *order;
    let start = initial(model, body, order)?;
    let path = arguments.out.clone().unwrap_or_else(|| default_folder(model));
    Folder::check(&path, arguments.overwrite)?;
    let motion = Motion::new(&loaded, start);
    let reduced = reduce(body, order)?;
    let judged = match motion.settled_spin(&reduced) {
        Err(Failure::Propagate(PropagateError::NoMomentum)) => start.omega,
        other => other?,
    };
    let validity = Validity::of_reduced(body, &reduced, judged)?;
    let rigid = reduce(body, 0)?;
    let holds = validity.verdict() != Verdict::Fails;
    let nutating = Nutating { rigid: &rigid, nearly_rigid: if holds { &reduced } else { &rigid } };
    let mut notes = model.notes.clone();
    let poles = steady::at_start(&motion, &loaded)?;
    let left_out = LeftOut::at(&loaded, start.omega, poles.nearest);
    notes.extend(left_out.notes());
    let plan = Plan::new(arguments, &loaded, &motion, nutating)?;
    let evolution = plan.evolution(&loaded, start, &mut notes)?;
    let histories = plan.histories(&mut notes)?;
    let verification = plan.verification(model, order, &mut notes)?;
    let record = RunRecord {
        version: env!("CARGO_PKG_VERSION").into(),
        model: record::model(model),
        notes,
        body: record::body(&loaded),
        liquids: liquids(&loaded, norm(start.omega)).iter().map(Liquid::record).collect(),
        validity: record::validity(&validity),
        steady_spins: poles.records,
        reduction: record::reduction(body, &reduced, &validity, start.omega),
        histories,
        verification,
        evolution,
    };
    let folder = Folder::new(&path, arguments.overwrite)?;
    record.write(&folder.building())?;
    let frequencies = &validity.vibrations.frequencies;
    let forces = acting(&loaded, Some(start));
    let derived = Derived {
        name: &model.name,
        body,
        reduced: &reduced,
        frequencies,
        mechanisms: &[],
        forces: forces.as_ref(),
    };
    folder.write("reduced.json", &derived.json())?;
    folder.write("report.html", &quasirigid_report::page(&record))?;
    if let Some(picture) = quasirigid_report::sphere_picture(&record) {
        folder.write("sphere.svg", &picture)?;
    }
    let placed = folder.finish()?;
    let in_place = placed.told(&path);
    if arguments.common.json {
        output::print(&format!("{:#}\n", serde_json::json!(record)))?;
    } else if !arguments.common.quiet {
        output::print(&summary::text(&record, &placed.path))?;
    }
    let complete = record.histories.len() == plan.systems.len()
        && record.verification.is_some() == model.run.verify.is_some();
    let ended = |status: &str| matches!(status, "finished" | "event");
    let finished = complete && record.histories.iter().all(|history| ended(&history.status));
    let proved = record.verification.as_ref().is_none_or(|verification| verification.reached);
    let aged = record.evolution.as_ref().is_none_or(|evolution| evolution.status == "finished");
    let finished = finished && aged;
    let holds = validity.verdict() != Verdict::Fails && proved && left_out.liquids.is_none();
    Ok(if finished && holds && in_place { Ending::Done } else { Ending::CheckFailed })
}

/// The file's name with `-run`; a file called `model.toml` has the name of its folder.
fn default_folder(model: &Model) -> PathBuf {
    let file = &model.source.file;
    let folder =
        file.parent().and_then(Path::file_name).filter(|_| file.file_stem() == Some("model".as_ref()));
    let name = folder.or(file.file_stem()).unwrap_or_default().to_string_lossy();
    PathBuf::from(format!("{name}-run"))
}

/// What the histories of a run have in common.
struct Plan<'a> {
    motion: &'a Motion<'a>,
    systems: Vec<System>,
    times: Vec<f64>,
    options: Options,
    nutating: Nutating<'a>,
    interrupt: Interrupt,
    quiet: bool,
}

/// The bodies by which nutation is counted. (P8)
struct Nutating<'a> {
    rigid: &'a ReducedBody,
    /// The reduced body where it holds, else the rigid one.
    nearly_rigid: &'a ReducedBody,
}

impl Nutating<'_> {
    fn of(&self, system: System) -> &ReducedBody {
        if system == System::Rigid { self.rigid } else { self.nearly_rigid }
    }
}

impl<'a> Plan<'a> {
    fn new(
        arguments: &Run,
        loaded: &Loaded,
        motion: &'a Motion<'a>,
        nutating: Nutating<'a>,
    ) -> Result<Self, Failure> {
        let Loaded { model, .. } = loaded;
        let omega = motion.start.omega;
        let duration = duration(model, &arguments.propagation, omega)?;
        let turns = duration * norm(omega) / std::f64::consts::TAU;
        let rows = (ROWS_PER_TURN * turns).ceil().clamp(ROWS[0], ROWS[1]) as usize;
        let rows = arguments.propagation.samples.or(model.run.samples).unwrap_or(rows);
        let systems = systems(model);
        room(rows, systems.len() + 1, 0)?;
        Ok(Self {
            motion,
            systems,
            times: even_times(rows, duration)?,
            options: options(loaded, &arguments.propagation, circled_axis(nutating.nearly_rigid, omega))?,
            nutating,
            interrupt: Interrupt::listen()?,
            quiet: arguments.common.quiet,
        })
    }

    /// The histories, in the order asked for; `notes` says why one is missing.
    fn histories(&self, notes: &mut Vec<String>) -> Result<Vec<HistoryRecord>, Failure> {
        let mut histories = Vec::new();
        for system in &self.systems {
            if self.interrupted() {
                notes.push(INTERRUPTED.replace("{system}", record::name(*system)));
                continue;
            }
            match self.history(*system) {
                Ok(history) => histories.push(history),
                Err(Failure::Propagate(PropagateError::NoMomentum)) if *system == System::Reduced => {
                    notes.push(NO_MOMENTUM.into());
                    if !self.systems.contains(&System::Full) {
                        histories.push(self.history(System::Full)?);
                    }
                }
                Err(failure) => return Err(failure),
            }
        }
        if self.motion.starts_displaced() {
            notes.push(format!("{DISPLACED}: {SETTLES}."));
        }
        let forced = self.motion.system().acts();
        let note = |each: &HistoryRecord| {
            drift_note(&each.system, forced, each.energy, [each.energy_drift, each.dissipated])
        };
        notes.extend(histories.iter().filter_map(note));
        Ok(histories)
    }

    /// The proof against the full system, where the file asks for it.
    fn verification(
        &self,
        model: &Model,
        order: usize,
        notes: &mut Vec<String>,
    ) -> Result<Option<VerificationRecord>, Failure> {
        if model.run.verify.is_none() {
            return Ok(None);
        }
        let plan = verification::plan(model, self.motion.body, order);
        let found = verification::follow(self.motion, &plan, &self.interrupt, self.quiet)?;
        if found.is_none() {
            notes.push(UNPROVED.into());
        }
        Ok(found.map(|found| record::verification(&plan, &found)))
    }

    /// The averaged rotation, where the file asks for it.
    fn evolution(
        &self,
        loaded: &Loaded,
        start: SpinState,
        notes: &mut Vec<String>,
    ) -> Result<Option<EvolutionRecord>, Failure> {
        if loaded.model.run.evolve.is_none() {
            return Ok(None);
        }
        let asked = evolution::asked(&loaded.model);
        let (record, remarks) = evolution::follow(loaded, start, &asked, &self.interrupt, self.quiet)?;
        notes.extend(remarks);
        if record.status != "finished" {
            notes.push(format!("Over many turns: {}", record.message));
        }
        Ok(Some(record))
    }

    fn interrupted(&self) -> bool {
        self.interrupt.pressed()
    }

    fn history(&self, system: System) -> Result<HistoryRecord, Failure> {
        let end = self.times.last().copied().unwrap_or(0.0);
        let name = record::name(system);
        let mut collector = Collector::new(&self.interrupt, name, end, self.quiet);
        let run = self.motion.follow(system, &self.times, self.options.clone(), &mut collector)?;
        let budget = collector.budget().to_vec();
        let (samples, _) = collector.finish();
        if !self.quiet
            && matches!(run.outcome, Outcome::Failed(_) | Outcome::StepLimit | Outcome::LeftRange(_))
        {
            remark(&format!(
                "{name}: {}",
                record::status(self.motion.system().body, run.outcome, run.last.t).1
            ));
        }
        let equations = self.motion.equations(system, self.options.form);
        Ok(record::history(
            system,
            equations,
            &self.options,
            (&samples, &budget),
            (self.motion.system().body, &run),
            self.nutating.of(system),
        ))
    }
}

/// The systems to follow: the file's, or the reduced body beside the rigid one.
fn systems(model: &Model) -> Vec<System> {
    use quasirigid_io::model::System as Named;
    let named = model.run.systems.clone().unwrap_or_else(|| vec![Named::Reduced, Named::Rigid]);
    let system = |named: Named| match named {
        Named::Full => System::Full,
        Named::Reduced => System::Reduced,
        Named::Rigid => System::Rigid,
    };
    named.into_iter().map(system).collect()
}
