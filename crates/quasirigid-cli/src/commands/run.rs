use std::fmt::{self, Write};
use std::path::PathBuf;

use quasirigid::dynamics::{Options, Outcome, PropagateError, SpinState, propagate};
use quasirigid::math::rotation::angle;
use quasirigid::math::sym::norm;
use quasirigid::model::{Principal, ReducedBody};
use quasirigid::reduction::{Validity, Verdict, reduce};
use quasirigid_io::export::Derived;
use quasirigid_io::model::Model;
use quasirigid_io::record::{HistoryRecord, RunRecord};

use super::{Loaded, duration, even_times, initial, load, options};
use crate::args::Run;
use crate::describe::{significant, time};
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::layout::paragraph;
use crate::message::remark;
use crate::output::Folder;
use crate::progress::Collector;
use crate::{Ending, output, record};

/// Rows of a history when nothing says how many: enough for smooth curves, within limits.
const ROWS_PER_TURN: f64 = 24.0;
const ROWS: [f64; 2] = [2_001.0, 20_001.0];

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
    let plan = Plan::new(arguments, &model, &reduced, start)?;
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
    let frequencies = Some(validity.vibrations.frequencies.as_slice());
    let derived = Derived { name: &model.name, body: &body, reduced: &reduced, frequencies };
    folder.write("reduced.json", &derived.json())?;
    folder.write("report.html", &quasirigid_report::page(&record))?;
    folder.finish()?;
    if arguments.common.json {
        output::print(&format!("{:#}\n", serde_json::json!(record)))?;
    } else if !arguments.common.quiet {
        output::print(&summary(&record, &path))?;
    }
    let interrupted = record.notes.iter().any(|note| note == INTERRUPTED);
    let finished = !interrupted && record.histories.iter().all(|history| history.status == "finished");
    let holds = validity.verdict() != Verdict::Fails;
    Ok(if finished && holds { Ending::Done } else { Ending::CheckFailed })
}

fn default_folder(model: &Model) -> PathBuf {
    let stem = model.source.file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    PathBuf::from(format!("{stem}-run"))
}

/// What the histories of a run have in common.
struct Plan {
    start: SpinState,
    times: Vec<f64>,
    options: Options,
    /// The principal axis nearest to the initial momentum, on its side; nutation is counted from it.
    axis: [f64; 3],
    interrupt: Interrupt,
    quiet: bool,
}

impl Plan {
    fn new(arguments: &Run, model: &Model, reduced: &ReducedBody, start: SpinState) -> Result<Self, Failure> {
        let duration = duration(model, &arguments.propagation, start.omega)?;
        let turns = duration * norm(start.omega) / std::f64::consts::TAU;
        let rows = (ROWS_PER_TURN * turns).ceil().clamp(ROWS[0], ROWS[1]) as usize;
        let rows = arguments.propagation.samples.or(model.run.samples).unwrap_or(rows);
        Ok(Self {
            start,
            times: even_times(rows, duration)?,
            options: options(model, &arguments.propagation),
            axis: nearest_axis(reduced, start.omega),
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

fn nearest_axis(reduced: &ReducedBody, omega: [f64; 3]) -> [f64; 3] {
    let K = reduced.momentum(omega);
    let axes = Principal::of(reduced.J).axes;
    let both = axes.iter().flat_map(|axis| [*axis, axis.map(|entry| -entry)]);
    both.min_by(|a, b| angle(K, *a).total_cmp(&angle(K, *b))).unwrap_or([0.0, 0.0, 1.0])
}

/// The answer for a terminal of 80 columns.
fn summary(record: &RunRecord, path: &std::path::Path) -> String {
    let mut text = String::new();
    write(&mut text, record, path).expect("a string takes any text");
    text
}

fn write(out: &mut String, record: &RunRecord, path: &std::path::Path) -> fmt::Result {
    writeln!(out, "{}", paragraph(&format!("{}: {}", record.model.name, record.validity.verdict), "", "  "))?;
    for criterion in record.validity.criteria.iter().filter(|each| each.verdict == "fails") {
        writeln!(out, "{}", paragraph(&criterion.sentence, "  - ", "    "))?;
    }
    for note in &record.notes {
        writeln!(out, "{}", paragraph(note, "  Note: ", "  "))?;
    }
    for history in &record.histories {
        write_history(out, history)?;
    }
    writeln!(out, "\nRecord and report: {}", path.join("report.html").display())
}

fn write_history(out: &mut String, history: &HistoryRecord) -> fmt::Result {
    let last = |name: &str| {
        let column = history.columns.iter().find(|column| column.name == name);
        column.and_then(|column| column.values.last().copied()).unwrap_or(f64::NAN)
    };
    let first = |name: &str| {
        let column = history.columns.iter().find(|column| column.name == name);
        column.and_then(|column| column.values.first().copied()).unwrap_or(f64::NAN)
    };
    let spin = ["wx", "wy", "wz"];
    let vector = |value: &dyn Fn(&str) -> f64| {
        spin.map(|name| format!("{:>12}", significant(value(name), 6))).join("")
    };
    let turns = significant(history.turns, 6);
    let title = format!("{} body, {} ({turns} turns; {})", history.system, time(last("t")), history.message);
    writeln!(out, "\n{}", paragraph(&title, "", "  "))?;
    writeln!(out, "  spin at the start  {} rad/s", vector(&first))?;
    writeln!(out, "  spin at the end    {} rad/s", vector(&last))?;
    let degrees = |value: f64| significant(value.to_degrees(), 5);
    writeln!(
        out,
        "  nutation           {:>12} to {} degrees",
        degrees(first("nutation")),
        degrees(last("nutation"))
    )?;
    writeln!(
        out,
        "  energy dissipated  {:>12} J of {} J",
        significant(history.dissipated, 5),
        significant(history.energy, 6)
    )?;
    writeln!(
        out,
        "  numerical drift    {:>12} J; {} of |K|",
        significant(history.energy_drift, 2),
        significant(history.momentum_drift, 2)
    )
}
