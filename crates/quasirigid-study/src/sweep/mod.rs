//! Studies of many bodies: plan of the rows, answers of each, folder of results, summary.
//! A row is a pure function of the study and its number, so that threads, shards and resumed runs give the same bytes.
//! The study file is read by `quasirigid_io::study_file`; this folder is the only place that knows how rows become models.

mod bodies;
mod by_body;
mod cell;
mod checks;
mod collect;
mod design;
mod distribution;
mod error;
mod folder;
mod generator;
mod identity;
mod journal;
mod page;
mod part;
mod plan;
mod rank;
mod results;
mod row;
mod run;
mod summary;
mod text;
mod uncertainty;

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use quasirigid_io::model::{KeyPath, KeyValue, ModelError, Source, Template};
use quasirigid_io::record::InputFileRecord;
use quasirigid_io::study_file::{StudyFile, Values};
use quasirigid_io::table_file::CellKind;

pub use crate::asked::Status;
pub use cell::Cell;
pub use collect::Collector;
pub use error::SweepError;
pub use results::{Results, read};
pub use row::RowAnswer;
pub use run::{Finished, RunOptions, Shard};
pub use text::text;
pub use uncertainty::text as uncertainty_text;

use crate::asked::{Answered, QuantityValue, answers, find};
use bodies::Bodies;
use design::Design;
use identity::identity;

/// Most rows of a study.
const MOST_ROWS: u64 = 100_000_000_000;

/// Study of many bodies, ready to answer any of its rows.
///
/// ```
/// use quasirigid_study::sweep::Sweep;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let folder = tempfile::tempdir()?;
/// # let model = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/axial-mass/model.toml");
/// let study = folder.path().join("study.toml");
/// std::fs::write(&study, format!("model = {model:?}\n[vary]\n\"run.order\" = {{ list = [1, 3] }}\n[answer]\nquantities = [\"check.valid\"]\n"))?;
/// let sweep = Sweep::open(&study, &mut ())?;
/// assert_eq!(sweep.rows(), 2);
/// println!("{:?}", sweep.answer(1)?.outputs);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct Sweep {
    /// The study.
    pub study: StudyFile,
    /// The model that is varied.
    pub model: Source,
    /// Columns of the inputs.
    pub inputs: Vec<Column>,
    /// Columns of the answers.
    pub outputs: Vec<Output>,
    /// SHA-256 of everything that the results depend on, in hexadecimal.
    pub sha256: String,
    /// Files that the results depend on: study, model, table, and those that they name.
    pub files: Vec<InputFileRecord>,
    /// Time that a row took (s), by the first rows on this machine.
    pub row_time: f64,
    template: Template,
    bodies: Option<Bodies>,
    design: Design,
    rows: u64,
}

/// Column of the inputs of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Name: the path of the key, or the name of a column that is carried through.
    pub name: String,
    /// Unit of the numbers; empty for plain ones.
    pub unit: String,
    /// Kind of the values.
    pub kind: CellKind,
    /// Whether the values are keys of the model.
    pub key: bool,
}

/// Column of the answers of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    /// Name: the quantity, with its time where several are asked for.
    pub name: String,
    /// Unit of the numbers; empty for pure numbers, truth values and texts.
    pub unit: String,
    /// Kind of the values.
    pub kind: CellKind,
    /// Number of the quantity in the study.
    quantity: usize,
    /// Number of the time.
    time: usize,
}

impl Sweep {
    /// Opens a study: reads its files, checks its keys against the model, and answers a first row to check its quantities.
    ///
    /// # Errors
    /// [`SweepError`] for files that cannot be read, keys and quantities that do not exist, and distributions and units that are impossible.
    pub fn open(path: &Path, watch: &mut dyn crate::Watch) -> Result<Self, SweepError> {
        let study = StudyFile::read(path).map_err(SweepError::File)?;
        let model = read_model(&study)?;
        Self::new(study, model, watch)
    }

    /// Opens the text of a study; `file` stands for it in messages, and the files that it names are looked for beside it. The text of its
    /// model, if given, stands for the file of the model.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn parse(
        file: &Path,
        text: &str,
        model: Option<&str>,
        watch: &mut dyn crate::Watch,
    ) -> Result<Self, SweepError> {
        let study = StudyFile::parse(file, text).map_err(SweepError::File)?;
        let model = match model {
            Some(text) => Source::new(&study.model, text.to_owned()),
            None => read_model(&study)?,
        };
        Self::new(study, model, watch)
    }

    fn new(study: StudyFile, model: Source, watch: &mut dyn crate::Watch) -> Result<Self, SweepError> {
        let template = Template::new(&model.text).map_err(|_| {
            SweepError::Model(
                quasirigid_io::model::Model::parse(&model.file, &model.text)
                    .err()
                    .unwrap_or_else(|| not_toml(&study)),
            )
        })?;
        for varied in &study.vary {
            template
                .find(&varied.key)
                .map_err(|error| bodies::nowhere(&study, varied.span.clone(), &error))?;
        }
        let bodies = study.table.as_ref().map(|table| Bodies::read(&study, table, &template)).transpose()?;
        let rows = plan::rows(&study, bodies.as_ref()).ok_or(SweepError::TooLarge { most: MOST_ROWS })?;
        let design = Design { sampling: study.sampling, seed: study.seed, samples: study.samples as u64 };
        let inputs = plan::inputs(&study, bodies.as_ref());
        let (sha256, files) = identity(&study, &model, bodies.as_ref())?;
        let mut sweep = Self {
            study,
            model,
            inputs,
            outputs: Vec::new(),
            sha256,
            files,
            row_time: 0.0,
            template,
            bodies,
            design,
            rows,
        };
        let former_names = checks::keys(&sweep)?;
        sweep.study.former_names.extend(former_names);
        checks::names(&sweep)?;
        (sweep.outputs, sweep.row_time) = checks::outputs(&sweep, watch)?;
        checks::names(&sweep)?;
        Ok(sweep)
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// What was made of the table, where that is not plain: its layout, units, columns left out, values that are missing.
    #[must_use]
    pub fn notes(&self) -> &[String] {
        self.bodies.as_ref().map_or(&[], |bodies| &bodies.notes)
    }

    /// Index of a row whose number, from 1, a user gives.
    ///
    /// # Errors
    /// [`SweepError::NoRow`], of zero with the number that the row has now.
    pub fn index(&self, row: u64) -> Result<u64, SweepError> {
        let index = row.checked_sub(1).filter(|index| *index < self.rows);
        index.ok_or(SweepError::NoRow { row, rows: self.rows })
    }

    /// Keys with their values in a row, by its index.
    ///
    /// # Errors
    /// The reason for which the row has no values, in words.
    pub fn changes(&self, row: u64) -> Result<Vec<(KeyPath, KeyValue)>, String> {
        plan::changes(self, row)
    }

    /// Text of the model of a row, by its index.
    ///
    /// # Errors
    /// The reason for which the row has no model, in words.
    pub fn model_text(&self, row: u64) -> Result<String, String> {
        let changes = self.changes(row)?;
        self.template.changed(&changes).map_err(|error| error.to_string())
    }

    /// Answers one row, alone, by its index.
    ///
    /// # Errors
    /// [`SweepError::NoRow`].
    pub fn answer(&self, row: u64) -> Result<RowAnswer, SweepError> {
        if row >= self.rows {
            return Err(SweepError::NoRow { row: row.saturating_add(1), rows: self.rows });
        }
        self.answer_until(row, &Arc::default()).ok_or(SweepError::Interrupted)
    }

    /// Answers one row; none if the work was cancelled.
    fn answer_until(&self, row: u64, cancelled: &Arc<AtomicBool>) -> Option<RowAnswer> {
        let outputs = &self.outputs;
        let text = match self.model_text(row) {
            Ok(text) => text,
            Err(reason) => {
                let outputs = vec![Cell::Missing; outputs.len()];
                return Some(RowAnswer {
                    row,
                    outputs,
                    status: Status::Invalid,
                    reason,
                    note: String::new(),
                });
            }
        };
        let answers = answers(&self.model, &text, &self.study.answer, cancelled)?;
        let mut notes = answers.notes;
        let cells = outputs.iter().map(|output| {
            let quantity = &self.study.answer.quantities[output.quantity];
            match answers.commands.get(&quantity.command) {
                Some(Answered::Objects(objects, status, _)) => {
                    let object =
                        objects.get(output.time).or(objects.last()).unwrap_or(&serde_json::Value::Null);
                    output.cell(find(quantity, object), *status, &mut notes)
                }
                _ => Cell::Missing,
            }
        });
        let outputs = cells.collect();
        let (status, reason) = worst(&answers.commands);
        notes.dedup();
        Some(RowAnswer { row, outputs, status, reason, note: notes.join("; ") })
    }
}

impl Output {
    /// The cell of a value; a number of a command that refuses is no answer.
    fn cell(&self, found: QuantityValue<'_>, status: Status, notes: &mut Vec<String>) -> Cell {
        let cell = match found {
            QuantityValue::Value(value) => cell_of(value),
            QuantityValue::Infinite => Cell::Number(f64::INFINITY),
            QuantityValue::Unknown => Cell::Missing,
            QuantityValue::Absent(reason) | QuantityValue::Unclear(reason) => {
                notes.push(reason);
                return Cell::Missing;
            }
        };
        match cell {
            Cell::Number(_) if status != Status::Answered => Cell::Missing,
            Cell::Missing if status != Status::Answered => Cell::Missing,
            Cell::Missing => {
                notes.push(format!("`{}` is not known", self.name));
                Cell::Missing
            }
            cell if cell.fits(self.kind) => cell,
            _ => {
                notes.push(format!("`{}` has another type here than in the first rows", self.name));
                Cell::Missing
            }
        }
    }
}

/// The cell of a JSON value; none of lists and objects.
fn cell_of(value: &serde_json::Value) -> Cell {
    match value {
        serde_json::Value::Bool(truth) => Cell::Boolean(*truth),
        serde_json::Value::Number(number) => number.as_f64().map_or(Cell::Missing, Cell::Number),
        serde_json::Value::String(text) => Cell::Text(text.clone()),
        _ => Cell::Missing,
    }
}

/// The worst status of the commands of a row, with its reason.
fn worst(
    commands: &std::collections::BTreeMap<quasirigid_io::study_file::Command, Answered>,
) -> (Status, String) {
    let mut worst = (Status::Answered, String::new());
    for (command, answered) in commands {
        let (status, reason) = match answered {
            Answered::Objects(_, status, reason) | Answered::Nothing(status, reason) => (*status, reason),
        };
        if status > worst.0 {
            let several = commands.len() > 1 && status == Status::Refused;
            let name = <quasirigid_io::study_file::Command as quasirigid_io::model::Named>::name(*command);
            worst = (status, if several { format!("{name}: {reason}") } else { reason.clone() });
        }
    }
    worst
}

/// The model of a study, at the place where the study names it.
fn read_model(study: &StudyFile) -> Result<Source, SweepError> {
    match quasirigid_io::model::Model::read(&study.model) {
        Ok(model) => Ok(model.source),
        // a model that is valid in its rows alone is one all the same
        Err(ModelError::Invalid { model, .. }) => Ok(model),
        Err(error) => Err(SweepError::Model(error)),
    }
}

fn not_toml(study: &StudyFile) -> ModelError {
    study.refuse(0..0, "the model is not valid TOML".to_owned(), "this study", None)
}

/// Whether a key is drawn from a distribution.
fn is_drawn(values: &Values) -> bool {
    matches!(values, Values::Drawn(_))
}
