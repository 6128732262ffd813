//! Identity of a study: one checksum of everything that its results depend on.
//! A run goes on only in a folder of the same identity, so that a changed mesh never meets the rows of the old one.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{self, Write};
use std::path::Path;

use quasirigid_io::model::Source;
use quasirigid_io::study_file::StudyFile;
use sha2::{Digest, Sha256};

use super::SweepError;
use super::bodies::Bodies;

/// SHA-256, in hexadecimal, of the version of the program, the study, the model, the table, and the files that any of them names for the
/// model.
pub(super) fn identity(
    study: &StudyFile,
    model: &Source,
    bodies: Option<&Bodies>,
) -> Result<String, SweepError> {
    let mut hash = Hashed(Sha256::new());
    for text in [env!("CARGO_PKG_VERSION"), &study.source.sha256, &model.sha256] {
        hash.text(text);
    }
    if let Some(table) = &study.table {
        hash.file(&table.file)?;
    }
    let folder = model.file.parent().unwrap_or(Path::new(""));
    let mut files = model.files_in(folder);
    files.append(&mut study.source.files_in(folder));
    let cells: BTreeSet<&str> = bodies.into_iter().flat_map(Bodies::texts).collect();
    files.extend(cells.into_iter().filter(|name| folder.join(name).is_file()).map(str::to_owned));
    for name in files {
        hash.text(&name);
        hash.file(&folder.join(name))?;
    }
    Ok(hash.0.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
}

/// A checksum as a writer.
struct Hashed(Sha256);

impl Hashed {
    fn text(&mut self, text: &str) {
        self.0.update(text.as_bytes());
        self.0.update([0]);
    }

    fn file(&mut self, path: &Path) -> Result<(), SweepError> {
        let mut file = File::open(path).map_err(SweepError::io(path))?;
        io::copy(&mut file, self).map(drop).map_err(SweepError::io(path))
    }
}

impl Write for Hashed {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.update(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
