//! Folder of results that appears only when it is whole: built beside its place, put on the disk, then renamed or exchanged.
//! A folder is replaced only if it holds a record of ours and nothing else, since `--overwrite` must never delete other people's files.

use std::fs::{self, File};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

use quasirigid_io::disk::{parent, settle_files, settle_folder};
use quasirigid_io::record::{RecordError, RunRecord, TableFormat};
use tempfile::TempDir;

use super::leftover::{self, BUILDING, PREFIX};
use super::place::{exchange, first_free, put};
use super::{Placed, check_parent, plain};
use crate::failure::Failure;

/// A folder of results that appears only when it is whole.
pub struct Folder {
    path: PathBuf,
    overwrite: bool,
    /// Temporary folder beside the place: holds the new folder until it is whole, and the old one until its removal.
    beside: TempDir,
    /// Kept locked as long as this process lives.
    _lock: File,
}

/// The report and the derived body; the record knows its own files.
const FILES: [&str; 3] = ["report.html", "reduced.json", "sphere.svg"];

impl Folder {
    /// Refuses a folder that cannot be made, or may not be replaced, before the work for it starts.
    pub fn check(path: &Path, overwrite: bool) -> Result<(), Failure> {
        check_parent(path)?;
        match path.symlink_metadata() {
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(()),
            Err(cause) => Err(Failure::Write { path: path.into(), cause: plain(cause) }),
            Ok(_) if files_of(path).is_none() => Err(Failure::Foreign { path: path.into() }),
            Ok(_) if !overwrite => Err(Failure::Exists { path: path.into(), option: "-o" }),
            Ok(_) => Ok(()),
        }
    }

    /// Starts a folder that [`check`](Self::check) accepted.
    pub fn new(path: &Path, overwrite: bool) -> Result<Self, Failure> {
        let wrote = |cause| Failure::Write { path: path.into(), cause: plain(cause) };
        let beside = tempfile::Builder::new().prefix(PREFIX).tempdir_in(parent(path)).map_err(wrote)?;
        leftover::remember(beside.path());
        let lock = leftover::claim(beside.path(), path).map_err(wrote)?;
        let folder = Self { path: path.into(), overwrite, beside, _lock: lock };
        fs::create_dir(folder.building()).map_err(wrote)?;
        Ok(folder)
    }

    /// Folder of the files until all are whole.
    fn building(&self) -> PathBuf {
        self.beside.path().join(BUILDING)
    }

    /// Writes a record into the folder, with its tables in these formats. A file that cannot be written is named by its place.
    pub fn write_record(&self, record: &RunRecord, formats: &[TableFormat]) -> Result<(), Failure> {
        let building = self.building();
        record.write(&building, formats).map_err(|error| match error {
            RecordError::File { file, kind } if file.starts_with(&building) => {
                let name = file.file_name().unwrap_or_default();
                Failure::Write { path: self.path.join(name), cause: kind.into() }
            }
            other => other.into(),
        })
    }

    /// Writes a text file into the folder.
    pub fn write(&self, name: &str, text: &str) -> Result<(), Failure> {
        let written = File::create(self.building().join(name)).and_then(|mut f| f.write_all(text.as_bytes()));
        written.map_err(|cause| Failure::Write { path: self.path.join(name), cause: plain(cause) })
    }

    /// Puts the folder in its place. An older record goes only when the new one stands there and is on the disk; anything else that
    /// has appeared there stays, and the new one goes beside it.
    pub fn finish(self) -> Result<Placed, Failure> {
        let settled = settle_files(&self.building());
        let undisturbed = leftover::undisturbed();
        let placed = settled.and_then(|()| self.place());
        drop(undisturbed);
        let path = placed.map_err(|cause| Failure::Write { path: self.path.clone(), cause: plain(cause) })?;
        settle_folder(parent(&path)).map_err(|cause| Failure::Unsettled { path: path.clone(), cause })?;
        Ok(Placed { beside: path != self.path, path })
    }

    /// The place taken: the one asked for, or the first free one beside it.
    fn place(&self) -> io::Result<PathBuf> {
        let new = self.building();
        if self.overwrite && files_of(&self.path).is_some() {
            exchange(&new, &self.path)?;
            let settled = settle_folder(parent(&self.path));
            if let (Ok(()), Some(files)) = (&settled, files_of(&new)) {
                files.iter().for_each(|file| drop(fs::remove_file(new.join(file))));
                return Ok(self.path.clone());
            }
            exchange(&new, &self.path)?; // something was put into it meanwhile, or the new one is not on the disk
            settled?;
        }
        first_free(&self.path, |place| put(&new, place))
    }
}

/// The files of a folder that holds a record of ours and nothing else; none of any other.
fn files_of(path: &Path) -> Option<Vec<String>> {
    if !path.symlink_metadata().ok()?.is_dir() {
        return None;
    }
    let entries: Vec<fs::DirEntry> = fs::read_dir(path).ok()?.collect::<io::Result<_>>().ok()?;
    let regular = |entry: &fs::DirEntry| entry.file_type().is_ok_and(|kind| kind.is_file());
    if !entries.iter().all(regular) {
        return None; // so that nothing is read that is no file
    }
    let mut ours = RunRecord::read(path).ok()?.files();
    ours.extend(FILES.map(String::from));
    let names = entries.iter().map(|entry| entry.file_name().into_string().ok());
    names.map(|name| name.filter(|name| ours.contains(name))).collect()
}
