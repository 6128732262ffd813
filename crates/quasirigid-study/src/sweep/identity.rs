//! Identity of a study: one checksum of everything that its results depend on.
//! A run goes on only in a folder of the same identity, so that a changed mesh never meets the rows of the old one.

use std::collections::BTreeSet;
use std::path::Path;

use quasirigid_io::model::Source;
use quasirigid_io::record::InputFileRecord;
use quasirigid_io::study_file::StudyFile;

use super::SweepError;
use super::bodies::Bodies;
use crate::hashed::Hashed;

/// SHA-256, in hexadecimal, of the version of the program, the study, the model, the table, and the files that any of them names for the
/// model; and each of these files.
pub(super) fn identity(
    study: &StudyFile,
    model: &Source,
    bodies: Option<&Bodies>,
) -> Result<(String, Vec<InputFileRecord>), SweepError> {
    let mut hash = Hashed::default();
    for text in [env!("CARGO_PKG_VERSION"), &study.source.sha256, &model.sha256] {
        hash.text(text);
    }
    let mut all: Vec<InputFileRecord> = [&study.source, model].map(of_text).into();
    if let Some(table) = &study.table {
        let name = table.file.strip_prefix(study.source.file.parent().unwrap_or(Path::new("")));
        let name = name.unwrap_or(&table.file).to_string_lossy().into_owned();
        all.push(add(&mut hash, name, &table.file)?);
    }
    let folder = model.file.parent().unwrap_or(Path::new(""));
    let mut files = model.files_in(folder);
    files.append(&mut study.source.files_in(folder));
    let cells: BTreeSet<&str> = bodies.into_iter().flat_map(Bodies::texts).collect();
    files.extend(cells.into_iter().filter(|name| folder.join(name).is_file()).map(str::to_owned));
    for name in files {
        hash.text(&name);
        let file = folder.join(&name);
        let record = add(&mut hash, name, &file)?;
        if all.iter().all(|known| known.name != record.name) {
            all.push(record);
        }
    }
    Ok((hash.finish(), all))
}

/// A file whose text is at hand.
fn of_text(source: &Source) -> InputFileRecord {
    InputFileRecord {
        name: source.file.file_name().unwrap_or_default().to_string_lossy().into_owned(),
        bytes: source.text.len() as u64,
        sha256: source.sha256.clone(),
    }
}

/// Adds a file to the checksum, and says what it is.
fn add(hash: &mut Hashed, name: String, file: &Path) -> Result<InputFileRecord, SweepError> {
    hash.file(file).map_err(SweepError::io(file))?;
    let mut own = Hashed::default();
    let bytes = own.file(file).map_err(SweepError::io(file))?;
    Ok(InputFileRecord { name, bytes, sha256: own.finish() })
}
