//! Identity of a study: one checksum of everything that its results depend on.
//! A run goes on only in a folder of the same identity, so that a changed mesh never meets the rows of the old one.

use std::collections::BTreeSet;
use std::path::Path;

use quasirigid_io::model::Source;
use quasirigid_io::study_file::StudyFile;

use super::SweepError;
use super::bodies::Bodies;
use crate::hashed::Hashed;

/// SHA-256, in hexadecimal, of the version of the program, the study, the model, the table, and the files that any of them names for the
/// model.
pub(super) fn identity(
    study: &StudyFile,
    model: &Source,
    bodies: Option<&Bodies>,
) -> Result<String, SweepError> {
    let mut hash = Hashed::default();
    for text in [env!("CARGO_PKG_VERSION"), &study.source.sha256, &model.sha256] {
        hash.text(text);
    }
    if let Some(table) = &study.table {
        hash.file(&table.file).map_err(SweepError::io(&table.file))?;
    }
    let folder = model.file.parent().unwrap_or(Path::new(""));
    let mut files = model.files_in(folder);
    files.append(&mut study.source.files_in(folder));
    let cells: BTreeSet<&str> = bodies.into_iter().flat_map(Bodies::texts).collect();
    files.extend(cells.into_iter().filter(|name| folder.join(name).is_file()).map(str::to_owned));
    for name in files {
        hash.text(&name);
        let file = folder.join(name);
        hash.file(&file).map_err(SweepError::io(&file))?;
    }
    Ok(hash.finish())
}
