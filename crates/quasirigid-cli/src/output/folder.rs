use std::ffi::OsStr;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use quasirigid_io::record::RunRecord;
use tempfile::TempDir;

use super::{check_parent, parent, plain};
use crate::failure::Failure;

/// A folder of results that appears only when it is whole.
pub struct Folder {
    path: PathBuf,
    /// A folder beside it that holds the new folder until it is whole, and the old one until it is replaced.
    beside: TempDir,
}

/// The record's file, the report and the derived body; histories have names of their own.
const FILES: [&str; 5] = ["record.json", "evolution.csv", "report.html", "reduced.json", "sphere.svg"];

impl Folder {
    /// Refuses a folder that cannot be made, or may not be replaced, before the work for it starts.
    pub fn check(path: &Path, overwrite: bool) -> Result<(), Failure> {
        if path.symlink_metadata().is_ok() {
            if !is_record(path) {
                return Err(Failure::Foreign { path: path.into() });
            }
            if !overwrite {
                return Err(Failure::Exists { path: path.into(), option: "-o" });
            }
        }
        check_parent(path)
    }

    /// Starts a folder that [`check`](Self::check) accepted.
    pub fn new(path: &Path) -> Result<Self, Failure> {
        let wrote = |cause| Failure::Write { path: path.into(), cause: plain(cause) };
        let beside =
            tempfile::Builder::new().prefix(".quasirigid-").tempdir_in(parent(path)).map_err(wrote)?;
        let folder = Self { path: path.into(), beside };
        fs::create_dir(folder.building()).map_err(wrote)?;
        Ok(folder)
    }

    /// Where the files go until the folder is whole.
    pub fn building(&self) -> PathBuf {
        self.beside.path().join("new")
    }

    /// Writes a text file into the folder.
    pub fn write(&self, name: &str, text: &str) -> Result<(), Failure> {
        let written = File::create(self.building().join(name)).and_then(|mut f| f.write_all(text.as_bytes()));
        written.map_err(|cause| Failure::Write { path: self.path.join(name), cause })
    }

    /// Puts the folder in its place. An older one goes only when the new one stands there.
    pub fn finish(self) -> Result<(), Failure> {
        self.place().map_err(|cause| Failure::Write { path: self.path, cause })
    }

    fn place(&self) -> io::Result<()> {
        if self.path.symlink_metadata().is_err() {
            return fs::rename(self.building(), &self.path);
        }
        let old = self.beside.path().join("old");
        fs::rename(&self.path, &old)?;
        fs::rename(self.building(), &self.path).inspect_err(|_| {
            let _ = fs::rename(&old, &self.path); // nothing better can be done if this fails too
        })
    }
}

/// Whether a folder holds a record of ours and nothing else.
fn is_record(path: &Path) -> bool {
    let Ok(entries) = fs::read_dir(path) else {
        return false;
    };
    let ours = |name: &OsStr| {
        let name = name.to_string_lossy();
        FILES.contains(&&*name) || (name.starts_with("history-") && name.ends_with(".csv"))
    };
    let known = |entry: io::Result<fs::DirEntry>| entry.is_ok_and(|entry| ours(&entry.file_name()));
    entries.into_iter().all(known) && RunRecord::read(path).is_ok()
}
