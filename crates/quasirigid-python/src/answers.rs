//! Answers of the study, each as one object: the JSON of the program, its text, the verdict, notes and tables.
//! Infinite and unknown numbers are both `null` in JSON, so that numbers which may be either go beside it.

use std::collections::BTreeMap;
use std::convert::Infallible;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use pyo3::prelude::*;
use quasirigid_io::disk::{parent, replace, settle_files, settle_folder};
use quasirigid_io::export::{Exported, Target, identifier};
use quasirigid_io::model::KeyPath;
use quasirigid_io::record::{HistoryRecord, TableFormat};
use quasirigid_io::study_file::Quantity;
use quasirigid_study::certificate::Certificate;
use quasirigid_study::evolution;
use quasirigid_study::fill_map::{self, FillMapSettings};
use quasirigid_study::histories::Table;
use quasirigid_study::layout::paragraph;
use quasirigid_study::light_curve::LightCurveSettings;
use quasirigid_study::linear::{LinearObject, LinearSettings};
use quasirigid_study::modes::{PrincipalAxis, SteadySpinSettings};
use quasirigid_study::report::page;
use quasirigid_study::run::RunOutcome;
use quasirigid_study::settings::{
    PartialEvolve, PartialRun, PartialSpinManifold, PartialVerify, uncertainty_samples,
};
use quasirigid_study::sweep::uncertainty_text;
use quasirigid_study::{Keeping, LeftOut, Setting, Study, StudyError, beyond, summary, verification};
use serde_json::json;

use crate::columns::Columns;
use crate::failure::Failure;
use crate::values::Json;
use crate::watching::Shared;

/// An answer: a dictionary in Python.
#[derive(IntoPyObject)]
pub struct Answer {
    /// The object that the program prints with `--json`.
    json: Json,
    /// The text that the program prints.
    text: String,
    /// The verdict or the result in a sentence.
    sentence: String,
    /// Whether the answer holds.
    holds: bool,
    /// Notes to read before the numbers.
    notes: Vec<String>,
    /// Numbers that may be infinite; NaN where they are not known.
    numbers: BTreeMap<&'static str, f64>,
    /// The table, where the answer has one.
    columns: Option<Columns>,
}

impl Answer {
    /// An answer without a table and without numbers that may be infinite.
    pub fn plain(
        json: serde_json::Value,
        text: String,
        sentence: String,
        holds: bool,
        notes: Vec<String>,
    ) -> Self {
        Self { json: Json(json), text, sentence, holds, notes, numbers: BTreeMap::new(), columns: None }
    }
}

/// Validity of the reduced equations.
pub fn check(study: &Study) -> Result<Answer, Failure> {
    let report = study.check()?;
    let validity = &report.validity;
    Ok(Answer {
        json: Json(study.with_inputs(report.json())),
        text: report.text(),
        sentence: report.sentence(),
        holds: report.holds(),
        notes: study.model.notes.iter().cloned().chain(report.left_out.notes()).collect(),
        numbers: BTreeMap::from([("T1", validity.T1), ("T2", validity.T2), ("T3", validity.T3)]),
        columns: None,
    })
}

/// Modes about steady spins, with a certificate in a file if one is asked for.
pub fn modes(
    study: &Study,
    asked: SteadySpinSettings,
    certificate: Option<&Path>,
) -> Result<Answer, Failure> {
    certificate.map_or(Ok(()), vacant)?;
    let found = study.modes(asked)?;
    if let Some(path) = certificate {
        write_certificate(&study.certify_modes(&found)?, path)?;
    }
    let name = &study.model.name;
    let sentences: Vec<&str> = found.spins.iter().map(|spin| spin.sentence.as_str()).collect();
    Ok(Answer {
        json: Json(study.with_inputs(found.json(name))),
        text: found.text(name, true),
        sentence: sentences.join(" "),
        holds: found.found(),
        notes: study.model.notes.clone(),
        numbers: BTreeMap::new(),
        columns: None,
    })
}

/// Effective modal masses of the parts on a held carrier.
pub fn effective_masses(study: &Study, about: Option<[f64; 3]>) -> Result<Answer, Failure> {
    let found = study.effective_masses(about)?;
    Ok(Answer {
        json: Json(study.with_inputs(found.json())),
        text: found.text(true),
        sentence: found.sentence.clone(),
        holds: true,
        notes: study.model.notes.clone(),
        numbers: BTreeMap::new(),
        columns: None,
    })
}

/// Time constants over fill and spin.
pub fn fills(study: &Study, asked: &FillMapSettings, mut shared: &Shared) -> Result<Answer, Failure> {
    let found = study.fill_map(asked, &mut shared)?;
    Ok(Answer {
        json: Json(study.with_inputs(serde_json::json!(found))),
        text: fill_map::text(&found),
        sentence: found.sentence.clone(),
        holds: found.holds,
        notes: study.model.notes.clone(),
        numbers: BTreeMap::new(),
        columns: None,
    })
}

/// The light curve of the rotating body.
pub fn light_curve(
    study: &Study,
    run: &PartialRun,
    asked: &LightCurveSettings,
    mut shared: &Shared,
) -> Result<Answer, Failure> {
    let found = study.light_curve(run, asked, &mut shared)?;
    Ok(Answer {
        json: Json(study.with_inputs(found.json())),
        text: found.text(),
        sentence: found.sentence.clone(),
        holds: found.holds,
        notes: [shared.remarks(), study.model.notes.clone(), found.notes.clone()].concat(),
        numbers: BTreeMap::new(),
        columns: Some(Columns::of_record(found.columns())),
    })
}

/// Derivatives of an answer with respect to keys of the model.
pub fn sensitivity(
    study: &Study,
    of: &str,
    keys: &[KeyPath],
    mut shared: &Shared,
) -> Result<Answer, Failure> {
    let of = of.parse::<Quantity>().map_err(|error| Failure::Input(error.to_string()))?;
    let found = study.sensitivity(&of, keys, &mut shared)?;
    Ok(Answer {
        json: Json(study.with_inputs(found.json())),
        text: found.text(true),
        sentence: found.sentence.clone(),
        holds: found.not_known.is_empty(),
        notes: study.model.notes.clone(),
        numbers: BTreeMap::new(),
        columns: None,
    })
}

/// Keys by their paths.
pub fn keys(paths: &[String]) -> Result<Vec<KeyPath>, Failure> {
    let keys = paths.iter().map(|key| key.parse::<KeyPath>()).collect::<Result<Vec<_>, _>>();
    keys.map_err(|error| Failure::Input(error.to_string()))
}

/// Linear model about a steady state.
pub fn linear(study: &Study, asked: &LinearSettings) -> Result<Answer, Failure> {
    Ok(of_linear(&study.linear(asked)?, study.model.notes.clone()))
}

/// A linear model.
pub fn of_linear(found: &LinearObject, notes: Vec<String>) -> Answer {
    Answer {
        json: Json(found.json()),
        text: found.text(),
        sentence: found.verdict(),
        holds: found.holds(),
        notes,
        numbers: BTreeMap::new(),
        columns: None,
    }
}

/// The reduced equations as source of another language, in a new file, over an older one if that is wanted, or in a new folder.
pub fn export(study: &Study, target: &str, path: &Path, overwrite: bool) -> Result<Answer, Failure> {
    let names: Vec<_> = Target::ALL.iter().map(|(_, name, _)| *name).collect();
    let unknown = || Failure::Input(format!("to = {target:?} is no target; there are {}", names.join(", ")));
    let target = Target::named(target).ok_or_else(unknown)?;
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let name = identifier(&stem);
    if target.names_its_file() && name != stem {
        let shown = path.display();
        return Err(Failure::Input(format!(
            "{shown}: what stands in this file has the name of the file; name it {name} with the same ending"
        )));
    }
    if target.is_folder() || !overwrite {
        vacant(path)?;
    }
    let found = study.export(target, &name)?;
    let failed = |cause: std::io::Error| Failure::File(format!("cannot write {}: {cause}", path.display()));
    match &found.exported {
        Exported::Source(files) if target.is_folder() => new_folder(path, |building| {
            files.iter().try_for_each(|file| fs::write(building.join(&file.name), &file.text)).map_err(failed)
        })?,
        Exported::Source(files) => {
            replace(path, |out| files.iter().try_for_each(|file| out.write_all(file.text.as_bytes())))
                .map_err(failed)?
        }
        Exported::Unit(unit) => replace(path, |out| out.write_all(&unit.bytes)).map_err(failed)?,
    }
    Ok(Answer {
        json: Json(study.with_inputs(found.json())),
        text: format!("Wrote {}. {}\n", path.display(), found.sentence()),
        sentence: found.sentence(),
        holds: found.wrong.is_none(),
        notes: study.model.notes.iter().chain(&found.notes).cloned().collect(),
        numbers: BTreeMap::new(),
        columns: None,
    })
}

/// Reduced equations about the spin; the table is the backbone.
pub fn about_spin(
    study: &Study,
    asked: PartialSpinManifold,
    axis: Option<PrincipalAxis>,
) -> Result<Answer, Failure> {
    let found = study.about_spin(asked, axis)?;
    Ok(Answer {
        json: Json(study.with_inputs(found.json())),
        text: found.text(),
        sentence: found.sentence(),
        holds: found.holds(),
        notes: study.model.notes.iter().cloned().chain(found.left_out.notes()).collect(),
        numbers: BTreeMap::new(),
        columns: Some(Columns::of_record(found.columns().0)),
    })
}

/// A history of the spin.
pub fn simulate(
    study: &Study,
    asked: &PartialRun,
    table: &Table,
    certificate: Option<&Path>,
    mut shared: &Shared,
) -> Result<Answer, Failure> {
    certificate.map_or(Ok(()), vacant)?;
    let history = study.simulate(asked, table, &mut shared)?;
    if let Some(path) = certificate {
        write_certificate(&study.certify_history(&history)?, path)?;
    }
    let json = study.with_inputs(history.json());
    let (holds, sentence) = match history.reason() {
        Some(reason) => (false, reason.to_owned()),
        None => (true, history.message),
    };
    let notes = [shared.remarks(), study.model.notes.clone(), history.notes].concat();
    Ok(Answer {
        json: Json(json),
        text: format!("{}: {sentence}\n", study.model.name),
        sentence,
        holds,
        notes,
        numbers: BTreeMap::new(),
        columns: Some(Columns::of_record(history.columns)),
    })
}

/// The secular evolution.
pub fn evolve(
    study: &Study,
    asked: PartialEvolve,
    draws: Option<usize>,
    mut shared: &Shared,
) -> Result<Answer, Failure> {
    let draws = uncertainty_samples(draws).map_err(StudyError::from)?;
    let evolved = study.evolve(asked, &mut shared)?;
    let (holds, answers, mut json) =
        (evolved.holds(), evolved.has_numbers(), study.with_inputs(evolved.json()));
    let mut text = evolution::text(&study.model.name, study.model.kind, &evolved.record);
    if let Some(draws) = draws {
        let uncertainty = study.uncertainty(draws, &mut shared)?.ok_or(StudyError::Interrupted)?;
        text.push_str(&uncertainty_text(&uncertainty));
        json["uncertainty"] = json!(uncertainty);
    }
    let undrawn = study.undrawn(&Setting::name).filter(|_| draws.is_none());
    let record = evolved.record;
    let number = |value: f64| if answers { value } else { f64::NAN };
    Ok(Answer {
        json: Json(json),
        text,
        // What does not hold is not told as if it did.
        sentence: if answers || record.status == "refused" {
            record.sentence.clone()
        } else {
            record.message.clone()
        },
        holds,
        notes: [shared.remarks(), study.model.notes.clone(), evolved.notes, undrawn.into_iter().collect()]
            .concat(),
        numbers: BTreeMap::from([
            ("time", number(record.time)),
            ("turns", number(record.revolutions)),
            ("power", number(record.power)),
            ("damping_time", record.damping_time),
            ("growth_time", record.growth_time),
        ]),
        columns: Some(Columns::of_record(record.columns)),
    })
}

/// The reduced equations against the full system.
pub fn verify(study: &Study, asked: PartialVerify, mut shared: &Shared) -> Result<Answer, Failure> {
    let plan = study.verification_plan(asked);
    let highest = plan.orders.iter().copied().max().unwrap_or_default();
    let left_out = LeftOut::at(study, study.initial()?.omega, None);
    let Some(record) = study.verify(&plan, &mut shared)? else {
        return Err(StudyError::Interrupted.into());
    };
    let beyond = beyond(&study.model.assembly, highest);
    let mut text = verification::text(&study.model.name, &record);
    if let Some(note) = &beyond {
        text.push_str(&format!("{}\n", paragraph(note, "", "  ")));
    }
    let sentence = text.lines().find(|line| line.contains("is reached") || line.contains("IS REACHED"));
    let mut notes = [left_out.notes(), shared.remarks(), study.model.notes.clone()].concat();
    notes.extend(beyond.filter(|note| !study.model.notes.contains(note)));
    Ok(Answer {
        sentence: sentence.unwrap_or_default().trim().to_owned(),
        json: Json(study.with_inputs(json!(record))),
        holds: record.reached,
        text,
        notes,
        numbers: BTreeMap::new(),
        columns: None,
    })
}

/// The record of a run.
#[pyclass(frozen, module = "quasirigid._core")]
#[derive(Debug)]
pub struct RunAnswer {
    outcome: RunOutcome,
    /// Folder of the record, which has the rows of long histories.
    folder: Option<PathBuf>,
}

/// Place of the record of a run.
pub struct RunPlace {
    /// New folder.
    pub folder: PathBuf,
    /// Formats of the tables, where they are not the usual ones.
    pub tables: Option<Vec<TableFormat>>,
    /// Whether a run that was cut off goes on.
    pub resume: bool,
}

/// The main job; the record goes into a new folder, if one is named, beside which the run is kept while it is in work.
pub fn run(
    study: &Study,
    asked: &PartialRun,
    place: Option<&RunPlace>,
    mut shared: &Shared,
) -> Result<RunAnswer, Failure> {
    place.map_or(Ok(()), |place| vacant(&place.folder))?;
    let keeping = place.map(|place| Keeping::beside(&place.folder, place.resume));
    let outcome = study.run_kept(asked, keeping.as_ref(), &mut shared)?;
    let mut answer = RunAnswer { outcome, folder: None };
    if shared.stopped() {
        answer.outcome.release();
        return Err(StudyError::Interrupted.into());
    }
    if let Some(RunPlace { folder, tables, .. }) = place {
        answer.place(folder, tables.as_deref())?;
        answer.folder = Some(folder.clone());
        answer.outcome.release();
    }
    Ok(answer)
}

/// Writes a certificate where nothing stands.
fn write_certificate(certificate: &Certificate, path: &Path) -> Result<(), Failure> {
    replace(path, |out| out.write_all(certificate.text().as_bytes()))
        .map_err(|cause| Failure::File(format!("cannot write {}: {cause}", path.display())))
}

/// Refuses a folder that is there.
fn vacant(folder: &Path) -> Result<(), Failure> {
    if folder.symlink_metadata().is_ok() {
        let shown = folder.display();
        return Err(Failure::File(format!(
            "{shown} already exists; choose another name, or remove it first"
        )));
    }
    Ok(())
}

impl RunAnswer {
    /// Writes the record into a folder that appears only when it is complete and on the disk.
    fn place(&self, folder: &Path, tables: Option<&[TableFormat]>) -> Result<(), Failure> {
        let formats = tables.unwrap_or(self.outcome.record.usual_formats());
        new_folder(folder, |building| Ok(self.outcome.write_tables(building, formats)?))
    }
}

/// A folder that appears only when it is complete and on the disk.
fn new_folder(folder: &Path, fill: impl FnOnce(&Path) -> Result<(), Failure>) -> Result<(), Failure> {
    vacant(folder)?;
    let Some(name) = folder.file_name() else {
        return Err(Failure::File(format!("{} is not a folder name", folder.display())));
    };
    let building = folder.with_file_name(format!(".{}.{}", name.to_string_lossy(), std::process::id()));
    let failed = |cause: std::io::Error| {
        let advice =
            if cause.kind() == ErrorKind::NotFound { "; create the folder above it first" } else { "" };
        Failure::File(format!("cannot write {}: {cause}{advice}", folder.display()))
    };
    fs::create_dir(&building).map_err(failed)?;
    let settled = fill(&building).and_then(|()| settle_files(&building).map_err(failed));
    let placed = settled.and_then(|()| fs::rename(&building, folder).map_err(failed));
    if placed.is_err() {
        // The failure that is told matters more than a folder left over.
        let _ = fs::remove_dir_all(&building);
    }
    placed?;
    settle_folder(parent(folder)).map_err(failed)
}

impl RunAnswer {
    /// Writes the report over an older file, which stays until the new one is on the disk; a pipe or a device is written directly.
    fn replace_report(&self, path: &Path) -> Result<(), Failure> {
        let page = page(&self.outcome.record);
        let place = path.canonicalize().unwrap_or_else(|_| path.to_owned());
        let written = match place.metadata() {
            Ok(there) if !there.is_file() => fs::write(&place, page),
            _ => replace(&place, |out| out.write_all(page.as_bytes())),
        };
        written.map_err(|cause| Failure::File(format!("cannot write {}: {cause}", path.display())))
    }

    /// A history with every row; of a long one they are in the folder of the record.
    fn history(&self, history: &HistoryRecord) -> Result<(String, Columns), Failure> {
        let columns = match &self.folder {
            Some(folder) if !history.is_whole() => history.whole_table(folder).map_err(StudyError::from)?,
            _ => history.columns.clone(),
        };
        Ok((history.system.clone(), Columns::of_record(columns)))
    }
}

#[pymethods]
impl RunAnswer {
    #[getter]
    fn json(&self) -> Json {
        Json(json!(self.outcome.record))
    }

    #[getter]
    fn text(&self) -> String {
        summary::answer(&self.outcome.record)
    }

    #[getter]
    fn sentence(&self) -> &str {
        &self.outcome.record.validity.verdict
    }

    #[getter]
    fn holds(&self) -> bool {
        self.outcome.holds
    }

    #[getter]
    fn notes(&self) -> Vec<String> {
        self.outcome.record.notes.clone()
    }

    /// The histories: the name of each system, and its table.
    #[getter]
    fn histories(&self) -> PyResult<Vec<(String, Columns)>> {
        let histories = self.outcome.record.histories.iter();
        Ok(histories.map(|each| self.history(each)).collect::<Result<_, _>>()?)
    }

    /// The table of the secular evolution, where the model asks for it.
    #[getter]
    fn evolution(&self) -> Option<Columns> {
        let evolution = self.outcome.record.evolution.as_ref();
        evolution.map(|each| Columns::of_record(each.columns.clone()))
    }

    /// The files beside the record: the reduced equations, the report and its picture.
    fn files(&self, py: Python<'_>) -> Vec<(&'static str, String)> {
        py.detach(|| self.outcome.files())
    }

    /// Writes record and report into a new folder.
    fn write(&self, py: Python<'_>, folder: PathBuf) -> PyResult<()> {
        Ok(py.detach(|| self.place(&folder, None))?)
    }

    /// Writes the report, over a file of that name.
    fn report(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        Ok(py.detach(|| self.replace_report(&path))?)
    }
}

/// Numbers never fail to become Python's.
impl From<Infallible> for Failure {
    fn from(never: Infallible) -> Self {
        match never {}
    }
}
