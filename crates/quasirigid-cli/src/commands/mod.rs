//! Commands, one a file: each takes its arguments to the study and prints the answer.

mod attitude;
pub mod audit;
mod certificate;
pub mod check;
pub mod cite;
mod curve_files;
pub mod derive;
pub mod diff;
pub mod evolve;
pub mod export;
pub mod fills;
pub mod infer;
pub mod keys;
pub mod lightcurve;
pub mod linear;
pub mod modes;
pub mod new;
mod picture;
pub mod plot;
pub mod report;
pub mod run;
pub mod schema;
pub mod sensitivity;
pub mod simulate;
pub mod sweep;
pub mod verify;
pub mod yorp;

use std::path::{Path, PathBuf};

use quasirigid_io::model::Model;
use quasirigid_io::record::InputsRecord;
use quasirigid_study::{LeftOut, MAY_NOT_HOLD, Study, StudyError, watched};
use serde_json::json;

use crate::args::Common;
use crate::failure::Failure;
use crate::message::remark;
use crate::output;
use crate::progress::Terminal;
use picture::Picture;

/// Width of a PNG picture (pixels): 170 mm at 240 per inch.
const PIXELS: u32 = 1600;
/// Name in messages of a model that is read from standard input; paths in it are relative to the current folder.
const STANDARD_INPUT: &str = "standard input";

/// Whether the model is read from the standard input.
fn is_standard_input(common: &Common) -> bool {
    common.model == Path::new("-")
}

/// Opens the study of a model, and prints the notes on suspect values and former names on standard error.
fn open(common: &Common) -> Result<Study, Failure> {
    open_with(common, |_, _| true)
}

/// The same with those notes alone that are wanted.
fn open_with(common: &Common, wanted: impl Fn(&Study, &String) -> bool) -> Result<Study, Failure> {
    let study = whole(common, || Study::new(model(common)?, common.order))?;
    former_names(&study.model.former_names, common.quiet);
    let told = |note: &&String| (!common.quiet || note.starts_with(MAY_NOT_HOLD)) && wanted(&study, note);
    study.model.notes.iter().filter(told).for_each(|note| remark(&format!("note: {note}")));
    Ok(study)
}

fn model(common: &Common) -> Result<Model, StudyError> {
    Ok(if is_standard_input(common) {
        Model::read_from(Path::new(STANDARD_INPUT), std::io::stdin().lock())?
    } else {
        Model::read(&common.model)?
    })
}

/// Folder for the results of a file: its name with an ending; a file of the usual name has that of its folder.
fn default_folder(file: &Path, usual: &str, ending: &str) -> PathBuf {
    let folder = file.parent().and_then(Path::file_name).filter(|_| file.file_stem() == Some(usual.as_ref()));
    let mut name = folder.or(file.file_stem()).unwrap_or_default().to_owned();
    name.push(ending); // of whatever bytes the name is
    PathBuf::from(name)
}

/// Writes what went into a table in CSV, which has no place for it, beside the table: `table.csv.inputs.json`. Returns whether it stands there.
fn inputs_beside(inputs: &InputsRecord, table: &Path, overwrite: bool) -> Result<bool, Failure> {
    if output::is_stdout(table) || !table.is_file() {
        return Ok(true);
    }
    let path = beside(table, ".inputs.json");
    let placed = output::to_file(&path, overwrite, |out| writeln!(out, "{:#}", json!(inputs)))?;
    Ok(placed.told(&path))
}

/// The file beside another whose name has this ending more.
fn beside(file: &Path, ending: &str) -> PathBuf {
    let mut name = file.as_os_str().to_owned();
    name.push(ending);
    PathBuf::from(name)
}

/// Does work that has no partial result.
fn whole<T: Send>(
    common: &Common,
    work: impl FnOnce() -> Result<T, StudyError> + Send,
) -> Result<T, Failure> {
    Ok(watched(&mut Terminal::of_whole(common.quiet), work)?)
}

/// Prints on standard error the losses that the equations of motion leave out; returns whether their results may be false.
fn note_left_out(study: &Study, omega: [f64; 3], common: &Common) -> bool {
    let left_out = LeftOut::at(study, omega, None);
    left_out.flow.iter().for_each(|wrong| remark(wrong));
    if let (Some(note), false) = (left_out.materials, common.quiet) {
        remark(&format!("note: {note}"));
    }
    left_out.liquids.iter().for_each(|wrong| remark(wrong));
    left_out.wrong().is_some()
}

/// Prints the notes on former names in a file, on standard error.
fn former_names(notes: &[String], quiet: bool) {
    notes.iter().filter(|_| !quiet).for_each(|note| remark(&format!("note: {note}")));
}
