use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::{NamedTempFile, TempDir};

use crate::failure::Failure;

/// Prints a text on standard output.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes())
        .and_then(|()| out.flush())
        .map_err(|cause| wrote(Path::new("standard output"), cause))
}

/// Writes to standard output, buffered.
pub fn to_stdout(write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), Failure> {
    let mut out = BufWriter::new(io::stdout().lock());
    write(&mut out).and_then(|()| out.flush()).map_err(|cause| wrote(Path::new("standard output"), cause))
}

/// Writes a file that appears only when it is whole.
pub fn to_file(
    path: &Path,
    overwrite: bool,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Failure> {
    refuse(path, overwrite, "--out")?;
    let whole = || {
        let mut file = NamedTempFile::new_in(parent(path))?;
        let mut out = BufWriter::new(file.as_file_mut());
        write(&mut out)?;
        out.flush()?;
        drop(out);
        file.persist(path)?;
        Ok(())
    };
    whole().map_err(|cause| wrote(path, cause))
}

/// A folder that appears only when it is whole.
pub struct Folder {
    path: PathBuf,
    overwrite: bool,
    building: TempDir,
}

/// A file that only a record of ours has.
const MARK: &str = "record.json";

impl Folder {
    /// Starts a folder; refuses one that is there.
    pub fn new(path: &Path, overwrite: bool) -> Result<Self, Failure> {
        refuse(path, overwrite, "-o")?;
        if path.exists() && !path.join(MARK).exists() {
            return Err(Failure::Foreign { path: path.into() });
        }
        let building = tempfile::Builder::new()
            .prefix(".quasirigid-")
            .tempdir_in(parent(path))
            .map_err(|cause| wrote(path, cause))?;
        Ok(Self { path: path.into(), overwrite, building })
    }

    /// Where the files go until the folder is whole.
    pub fn building(&self) -> &Path {
        self.building.path()
    }

    /// Writes a text file into the folder.
    pub fn write(&self, name: &str, text: &str) -> Result<(), Failure> {
        let path = self.building().join(name);
        let written = File::create(&path).and_then(|mut file| file.write_all(text.as_bytes()));
        written.map_err(|cause| wrote(&self.path.join(name), cause))
    }

    /// Puts the folder in its place.
    pub fn finish(self) -> Result<(), Failure> {
        let Self { path, overwrite, building } = self;
        let place = || {
            if overwrite && path.exists() {
                fs::remove_dir_all(&path)?;
            }
            let whole = building.keep();
            readable(&whole)?;
            fs::rename(whole, &path)
        };
        place().map_err(|cause| wrote(&path, cause))
    }
}

/// Gives a folder the access that folders usually have; temporary ones are private.
fn readable(folder: &Path) -> io::Result<()> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        fs::set_permissions(folder, fs::Permissions::from_mode(0o755))?;
    }
    let _ = folder;
    Ok(())
}

/// Refuses to overwrite without being asked to.
pub fn refuse(path: &Path, overwrite: bool, option: &'static str) -> Result<(), Failure> {
    if path.exists() && !overwrite { Err(Failure::Exists { path: path.into(), option }) } else { Ok(()) }
}

fn parent(path: &Path) -> &Path {
    path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

fn wrote(path: &Path, cause: io::Error) -> Failure {
    if cause.kind() == io::ErrorKind::BrokenPipe {
        Failure::BrokenPipe
    } else {
        Failure::Write { path: path.into(), cause }
    }
}
