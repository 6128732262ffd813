use std::path::{Path, PathBuf};

use quasirigid::dynamics::{Options, Outcome, PropagateError, SpinState, propagate};
use quasirigid::math::sym::{dot, norm};
use quasirigid::model::{Principal, ReducedBody};
use quasirigid::reduction::{Validity, Verdict, reduce};
use quasirigid_io::export::Derived;
use quasirigid_io::model::Model;
use quasirigid_io::record::{HistoryRecord, RunRecord};

use super::{Loaded, duration, even_times, initial, load, options, summary};
use crate::args::Run;
use crate::describe::drift_note;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::message::remark;
use crate::output::Folder;
use crate::progress::Collector;
use crate::{Ending, output, record};

/// Rows of a history when nothing says how many: enough for smooth curves, within limits.
const ROWS_PER_TURN: f64 = 24.0;
const ROWS: [f64; 2] = [2_001.0, 50_001.0];

/// Note on a spin outside the range of the series.
const NO_MOMENTUM: &str = "The truncated series has no momentum for this spin, so the reduced equations were not \
                           propagated; the history is that of the rigid body.";
/// Note on a run that Ctrl-C ended.
const INTERRUPTED: &str = "The run was interrupted, so the history of the rigid body was left out.";

/// The main job: check, reduce, propagate, and write the record with its report.
pub fn run(arguments: &Run) -> Result<Ending, Failure> {
    let Loaded { model, body, order } = load(&arguments.common)?;
    let start = initial(&model, &arguments.common.model)?;
    let path = arguments.out.clone().unwrap_or_else(|| default_folder(&model));
    Folder::check(&path, arguments.overwrite)?;
    let validity = Validity::of(&body, order, start.omega)?;
    let reduced = reduce(&body, order)?;
    let rigid = reduce(&body, 1)?;
    let mut notes = model.notes.clone();
    let plan = Plan::new(arguments, &model, &rigid, start)?;
    let histories = plan.histories(&reduced, &rigid, &mut notes)?;
    let record = RunRecord {
        version: env!("CARGO_PKG_VERSION").into(),
        model: record::model(&model),
        notes,
        body: record::body(&body),
        validity: record::validity(&validity),
        reduction: record::reduction(&body, &reduced, &validity, start.omega),
        histories,
    };
    let folder = Folder::new(&path)?;
    record.write(&folder.building())?;
    let frequencies = &validity.vibrations.frequencies;
    let derived = Derived { name: &model.name, body: &body, reduced: &reduced, frequencies };
    folder.write("reduced.json", &derived.json())?;
    folder.write("report.html", &quasirigid_report::page(&record))?;
    if let Some(picture) = quasirigid_report::sphere_picture(&record) {
        folder.write("sphere.svg", &picture)?;
    }
    folder.finish()?;
    if arguments.common.json {
        output::print(&format!("{:#}\n", serde_json::json!(record)))?;
    } else if !arguments.common.quiet {
        output::print(&summary::text(&record, &path))?;
    }
    let interrupted = record.notes.iter().any(|note| note == INTERRUPTED);
    let finished = !interrupted && record.histories.iter().all(|history| history.status == "finished");
    let holds = validity.verdict() != Verdict::Fails;
    Ok(if finished && holds { Ending::Done } else { Ending::CheckFailed })
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
struct Plan {
    start: SpinState,
    times: Vec<f64>,
    options: Options,
    /// The principal axis that the momentum of the rigid body circles; nutation is counted from it.
    axis: [f64; 3],
    interrupt: Interrupt,
    quiet: bool,
}

impl Plan {
    fn new(arguments: &Run, model: &Model, rigid: &ReducedBody, start: SpinState) -> Result<Self, Failure> {
        let duration = duration(model, &arguments.propagation, start.omega)?;
        let turns = duration * norm(start.omega) / std::f64::consts::TAU;
        let rows = (ROWS_PER_TURN * turns).ceil().clamp(ROWS[0], ROWS[1]) as usize;
        let rows = arguments.propagation.samples.or(model.run.samples).unwrap_or(rows);
        Ok(Self {
            start,
            times: even_times(rows, duration)?,
            options: options(model, &arguments.propagation),
            axis: circled_axis(rigid, start.omega),
            interrupt: Interrupt::listen()?,
            quiet: arguments.common.quiet,
        })
    }

    /// The histories of both systems, the reduced body first; `notes` says why one is missing.
    fn histories(
        &self,
        reduced: &ReducedBody,
        rigid: &ReducedBody,
        notes: &mut Vec<String>,
    ) -> Result<Vec<HistoryRecord>, Failure> {
        let mut histories = Vec::new();
        match self.history("reduced", reduced) {
            Ok(history) => histories.push(history),
            Err(Failure::Propagate(PropagateError::NoMomentum)) => notes.push(NO_MOMENTUM.into()),
            Err(failure) => return Err(failure),
        }
        if self.interrupted() {
            notes.push(INTERRUPTED.into());
        } else {
            histories.push(self.history("rigid", rigid)?);
        }
        notes.extend(
            histories.iter().filter_map(|each| drift_note(&each.system, each.energy_drift, each.dissipated)),
        );
        Ok(histories)
    }

    fn interrupted(&self) -> bool {
        self.interrupt.pressed()
    }

    fn history(&self, system: &str, body: &ReducedBody) -> Result<HistoryRecord, Failure> {
        let end = self.times.last().copied().unwrap_or(0.0);
        let mut collector = Collector::new(&self.interrupt, system, end, self.quiet);
        let run = propagate(body, self.start, &self.times, self.options, &mut collector)?;
        let samples = collector.finish();
        if !self.quiet && matches!(run.outcome, Outcome::Failed(_) | Outcome::StepLimit) {
            remark(&format!("{system}: {}", record::status(run.outcome, run.last.t).1));
        }
        Ok(record::history(system, &self.options, &samples, &run, self.axis))
    }
}

/// The axis of least or of greatest inertia, on the side of the momentum: the one that the rigid body's momentum circles.
fn circled_axis(rigid: &ReducedBody, omega: [f64; 3]) -> [f64; 3] {
    let K = rigid.momentum(omega);
    let Principal { moments, axes } = Principal::of(rigid.J);
    let long_axis_mode = 2.0 * rigid.energy(omega) * moments[1] > dot(K, K);
    let axis = axes[if long_axis_mode { 0 } else { 2 }];
    axis.map(|entry| entry * dot(axis, K).signum())
}
