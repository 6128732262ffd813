//! Answers of the commands that quantities need, each run once on the text of a model, and a status in place of every failure.
//! A panic is our mistake and still no lost run.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use quasirigid::dynamics::PropagateError;
use quasirigid_io::model::{Model, PartialEvolve, PartialRun, PartialSpinManifold, PartialVerify, Source};
use quasirigid_io::study_file::{Answer, Command, Quantity};
use quasirigid_math::watch::cancellable;
use serde_json::{Value, json};

use super::{QuantityValue, Status, find};
use crate::error::StudyError;
use crate::histories::Table;
use crate::modes::SteadySpinSettings;
use crate::study::Study;
use crate::watch::{Flagging, Watch, panic_message, watched};
use crate::words::MAY_NOT_HOLD;

/// What a command answered in a row.
pub(crate) enum Answered {
    /// The object, one for each time of `simulate`; numbers in it count only if the status is answered.
    Objects(Vec<Value>, Status, String),
    /// No object.
    Nothing(Status, String),
}

/// Answers of the commands of a row, and notes.
pub(crate) struct Answers {
    pub(crate) commands: BTreeMap<Command, Answered>,
    pub(crate) notes: Vec<String>,
}

impl Answers {
    /// The number that a quantity is in the last object of its command, or why it is none.
    pub(crate) fn number(&self, quantity: &Quantity) -> Result<f64, (Status, String)> {
        let refused = |reason: String| (Status::Refused, reason);
        let no = |why: &str| refused(format!("`{}` is {why}", quantity.name));
        match self.commands.get(&quantity.command) {
            Some(Answered::Objects(objects, Status::Answered, _)) => {
                match find(quantity, objects.last().unwrap_or(&Value::Null)) {
                    QuantityValue::Value(value) => value.as_f64().ok_or_else(|| no("no number")),
                    QuantityValue::Infinite => Err(no("infinite")),
                    QuantityValue::Unknown => Err(no("not known")),
                    QuantityValue::Absent(reason) | QuantityValue::Unclear(reason) => Err(refused(reason)),
                }
            }
            Some(Answered::Objects(_, status, reason) | Answered::Nothing(status, reason)) => {
                Err((*status, reason.clone()))
            }
            None => Err(no("not answered")),
        }
    }
}

/// Relative error of a time of `evolve` from which a row notes it: that of a calibrated average is told to be this much.
const COARSE: f64 = 0.02;

/// Runs the commands that the quantities need on the text of a model; none if the work was cancelled.
pub(crate) fn answers(
    model: &Source,
    text: &str,
    asked: &Answer,
    cancelled: &Arc<AtomicBool>,
) -> Option<Answers> {
    let work = || cancellable(cancelled, || of_commands(model, text, asked, cancelled));
    let found = catch_unwind(AssertUnwindSafe(work));
    let failed = |reason: String| Answers {
        commands: commands(asked)
            .map(|command| (command, Answered::Nothing(Status::Failed, reason.clone())))
            .collect(),
        notes: Vec::new(),
    };
    match found {
        _ if cancelled.load(Ordering::Relaxed) => None,
        Ok(answers) => answers.ok(),
        Err(panic) => Some(failed(format!("internal error: {}", panic_message(&*panic)))),
    }
}

/// The same on another thread, while the watch is asked on this one.
pub(crate) fn answers_watched(
    model: &Source,
    text: &str,
    asked: &Answer,
    watch: &mut dyn Watch,
) -> Option<Answers> {
    let cancelled = Arc::default();
    let mut observer =
        Flagging { watch, cancelled: &cancelled, stage: "answering a first row", share: &|| 0.0 };
    watched(&mut observer, || Ok(answers(model, text, asked, &cancelled))).ok().flatten()
}

/// The commands that quantities need, each once.
fn commands(asked: &Answer) -> impl Iterator<Item = Command> {
    let all: std::collections::BTreeSet<Command> = asked.quantities.iter().map(|each| each.command).collect();
    all.into_iter()
}

fn of_commands(model: &Source, text: &str, asked: &Answer, cancelled: &AtomicBool) -> Answers {
    let mut watch = Remarks { cancelled, notes: Vec::new() };
    let study =
        Model::parse(&model.file, text).map_err(StudyError::from).and_then(|model| Study::new(model, None));
    let doubts =
        study.iter().flat_map(|study| &study.model.notes).filter(|note| note.starts_with(MAY_NOT_HOLD));
    watch.notes.extend(doubts.cloned());
    let commands = commands(asked).map(|command| {
        let answered = match &study {
            Ok(study) => command_of(command, study, asked, &mut watch),
            Err(error) => Answered::Nothing(status_of(error), first_line(error)),
        };
        (command, answered)
    });
    let commands = commands.collect();
    Answers { commands, notes: watch.notes }
}

fn command_of(command: Command, study: &Study, asked: &Answer, watch: &mut Remarks<'_>) -> Answered {
    let answered = match command {
        Command::Check => study.check().map(|report| whole(report.json())),
        Command::Modes => study.modes(SteadySpinSettings::default()).map(|modes| {
            let object = modes.json(&study.model.name);
            match modes.unfound() {
                Some(reason) => Answered::Objects(vec![object], Status::Refused, reason.to_owned()),
                None => whole(object),
            }
        }),
        // no quantity is read from the table, and its rows are most of the work
        Command::Evolve => study
            .evolve(PartialEvolve { samples: Some(2), ..PartialEvolve::default() }, watch)
            .map(|evolved| {
                let status = if evolved.holds() { Status::Answered } else { Status::Refused };
                let error = evolved.record.time_error.filter(|error| *error > COARSE);
                watch.notes.extend(
                    error.map(|error| format!("the time of evolve is good to {:.2} %", 100.0 * error)),
                );
                Answered::Objects(vec![evolved.json()], status, evolved.record.message.clone())
            }),
        Command::Simulate => simulated(study, asked, watch),
        Command::Verify => {
            study.verify(&study.verification_plan(PartialVerify::default()), watch).map(|record| match record
            {
                Some(record) => whole(json!(record)),
                None => Answered::Nothing(Status::Failed, "the verification was interrupted".to_owned()),
            })
        }
    };
    answered.unwrap_or_else(|error| Answered::Nothing(status_of(&error), first_line(&error)))
}

fn whole(object: Value) -> Answered {
    Answered::Objects(vec![object], Status::Answered, String::new())
}

/// The states at the times asked for, or at the end, with the columns of the history as entries.
fn simulated(study: &Study, asked: &Answer, watch: &mut Remarks<'_>) -> Result<Answered, StudyError> {
    let times: Vec<f64> = asked.times.iter().map(|(_, seconds)| *seconds).collect();
    let count = times.len().max(1);
    let table = Table {
        system: Some(asked.system),
        coordinates: false,
        displacements: false,
        times: (!times.is_empty()).then_some(times),
        manifold: PartialSpinManifold::default(),
    };
    let settings = PartialRun { samples: Some(2), ..PartialRun::default() };
    let history = study.simulate(&settings, &table, watch)?;
    watch.notes.extend(history.notes.iter().cloned());
    let rows = history.columns.first().map_or(0, |column| column.values.len());
    let first = if asked.times.is_empty() { rows.saturating_sub(1) } else { 0 };
    let object = |row: usize| {
        let mut object = history.json();
        for column in &history.columns {
            let value = column.values.get(row).copied().filter(|value| value.is_finite());
            object[column.name.as_str()] = json!(value);
        }
        object
    };
    let objects = (first..first + count).map(object).collect();
    Ok(match history.reason() {
        Some(reason) => Answered::Objects(objects, Status::Refused, reason.to_owned()),
        None => Answered::Objects(objects, Status::Answered, String::new()),
    })
}

/// Status of a row whose command gave this error.
fn status_of(error: &StudyError) -> Status {
    match error {
        StudyError::Model(_) => Status::Invalid,
        StudyError::Propagate(PropagateError::NoAngularMomentum) => Status::Refused,
        StudyError::Vibration(_) | StudyError::Propagate(_) | StudyError::Interrupted => Status::Failed,
        _ => Status::Refused,
    }
}

/// The error on one line.
fn first_line(error: &StudyError) -> String {
    let text = error.to_string();
    let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    match lines.next() {
        Some(line) => line.to_owned(),
        None => text,
    }
}

/// Watch of a row: ends where the work is cancelled, and keeps the remarks.
struct Remarks<'s> {
    cancelled: &'s AtomicBool,
    notes: Vec<String>,
}

impl Watch for Remarks<'_> {
    fn at(&mut self, _: &str, _: f64) -> ControlFlow<()> {
        if self.cancelled.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }

    fn remark(&mut self, sentence: &str) {
        self.notes.push(sentence.to_owned());
    }
}
