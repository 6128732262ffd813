//! Attitude files of records, and what stands beside every attitude file.

use std::io::Cursor;
use std::path::Path;

use quasirigid_io::attitude::{AttitudeFormat, Unwritten};
use quasirigid_io::record::{HistoryRecord, RecordError, RunRecord};
use serde_json::json;

use super::{beside, inputs_beside};
use crate::args::Report;
use crate::failure::Failure;
use crate::message::remark;
use crate::{ExitStatus, output};

/// Writes a history of a record as an attitude file.
pub fn of_record(arguments: &Report, path: &Path) -> Result<ExitStatus, Failure> {
    let Report { folders, format, system, labels, overwrite, quiet, .. } = arguments;
    let [folder] = folders.as_slice() else { return Err(Failure::OneAttitude) };
    let format = format.or_else(|| AttitudeFormat::of_ending(path));
    let format = format.ok_or_else(|| Failure::AttitudeEnding { path: path.into() })?;
    output::check_file(path, *overwrite)?;
    let record = RunRecord::read(folder)?;
    let columns = history(&record, folder, system.as_deref())?.whole_table(folder)?;
    let labels = labels.labels(&record.model.name);
    let inputs = record.inputs.as_ref().map(|inputs| json!(inputs).to_string());
    let mut bytes = Cursor::new(Vec::new());
    let written = format.write(&mut bytes, (&labels, inputs.as_deref()), (&columns, None));
    written.map_err(|error| unwritten(path, error))?;
    let placed = output::to_file(path, *overwrite, |out| out.write_all(bytes.get_ref()))?;
    let beside = match &record.inputs {
        Some(inputs) if !format.is_binary() => inputs_beside(inputs, &placed.path, *overwrite)?,
        _ => true,
    };
    let setup = setup_beside(|data| format.setup(&labels, &columns, data), (&placed.path, *overwrite))?;
    if !quiet && !output::is_stdout(path) {
        remark(&format!("wrote {}", placed.path.display()));
    }
    let in_place = placed.told(path) & beside & setup;
    Ok(if in_place { ExitStatus::Done } else { ExitStatus::CheckFailed })
}

/// The history of a system, or the first.
fn history<'r>(
    record: &'r RunRecord,
    folder: &Path,
    system: Option<&str>,
) -> Result<&'r HistoryRecord, Failure> {
    let mut histories = record.histories.iter();
    let found = histories.find(|history| system.is_none_or(|system| history.system == system));
    found.ok_or_else(|| Failure::NoHistory {
        folder: folder.into(),
        system: system.unwrap_or_default().to_owned(),
        known: record.histories.iter().map(|history| history.system.clone()).collect(),
    })
}

/// Writes the setup file that belongs to an attitude file, of a format that has one, beside it; returns whether it stands there.
pub fn setup_beside(
    setup: impl Fn(&str) -> Option<String>,
    (data, overwrite): (&Path, bool),
) -> Result<bool, Failure> {
    let name = data.file_name().unwrap_or_default().to_string_lossy();
    let Some(setup) = setup(&name).filter(|_| data.is_file()) else { return Ok(true) };
    let path = beside(data, ".setup");
    let placed = output::to_file(&path, overwrite, |out| out.write_all(setup.as_bytes()))?;
    Ok(placed.told(&path))
}

/// The failure of a history that could not be written.
pub fn unwritten(path: &Path, error: Unwritten) -> Failure {
    match error {
        Unwritten::Record(RecordError::File { kind, .. }) => {
            Failure::Write { path: path.into(), cause: kind.into() }
        }
        Unwritten::Record(other) => other.into(),
        Unwritten::File(cause) => Failure::Write { path: path.into(), cause },
        other => Failure::Unwritten(other),
    }
}
