//! Results on standard output, and in files and folders that appear only when they are whole.

mod folder;
mod leftover;
mod place;

use std::io::{self, BufWriter, ErrorKind, IsTerminal, Write};
use std::path::{Path, PathBuf};

use quasirigid_io::disk::{parent, settle, settle_folder};
use tempfile::NamedTempFile;

pub use folder::Folder;
pub use leftover::abandon;

use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::message::remark;
use quasirigid_io::visible::visible;

/// Place of a result.
pub struct Placed {
    pub path: PathBuf,
    /// Whether this place is beside the one asked for, because something has appeared there.
    pub beside: bool,
}

impl Placed {
    /// Prints a remark if the result stands elsewhere than asked for; returns whether it stands as asked for.
    pub fn told(&self, asked: &Path) -> bool {
        if self.beside {
            remark(&format!(
                "{} was created in the meantime, and is left as it is; the result is in {}",
                asked.display(),
                self.path.display()
            ));
        }
        !self.beside
    }
}

/// Prints a text on standard output.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    out.write_all(visible(text).as_bytes()).and_then(|()| out.flush()).map_err(|cause| printed(cause.kind()))
}

/// Prints an answer on standard output: as a JSON object for machines, or as text.
pub fn print_answer(
    for_machines: bool,
    object: impl FnOnce() -> serde_json::Value,
    text: impl FnOnce() -> String,
) -> Result<(), Failure> {
    print(&if for_machines { format!("{:#}\n", object()) } else { text() })
}

/// Prints a text on standard output whose first line is a verdict: `holds`, `marginal` or `fails`. On a terminal that line is coloured.
pub fn print_verdict(text: &str, verdict: &str) -> Result<(), Failure> {
    let colour = match verdict {
        "holds" => 32,
        "marginal" => 33,
        _ => 31,
    };
    let text = visible(text);
    let (first, rest) = text.split_once('\n').unwrap_or((&text, ""));
    let painted =
        if in_colour() { format!("\u{1b}[1;{colour}m{first}\u{1b}[0m\n{rest}") } else { text.to_string() };
    let mut out = io::stdout().lock();
    out.write_all(painted.as_bytes()).and_then(|()| out.flush()).map_err(|cause| printed(cause.kind()))
}

/// Whether standard output takes colours: a terminal, or forced, unless the user wants none.
fn in_colour() -> bool {
    let set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    !set("NO_COLOR") && (io::stdout().is_terminal() || set("CLICOLOR_FORCE"))
}

/// Opens a page in the browser, without waiting for it.
pub fn open(page: &Path) -> Result<(), Failure> {
    open::that_detached(page).map_err(|cause| Failure::Browser { path: page.into(), cause: plain(cause) })
}

/// Writes to standard output, buffered, until Ctrl-C.
pub fn to_stdout(
    interrupt: &Interrupt,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Failure> {
    let out = unbuffered().map_err(|cause| printed(cause.kind()))?;
    let mut out = BufWriter::new(Watched { out, interrupt, failed: None });
    write(&mut out).and_then(|()| out.flush()).map_err(|error| {
        if interrupt.pressed() {
            Failure::Interrupted
        } else {
            printed(out.get_ref().failed.unwrap_or(error.kind()))
        }
    })
}

/// Standard output without a buffer: emptying one at the end of the program would wait for ever where nobody reads the pipe.
#[cfg(unix)]
fn unbuffered() -> io::Result<impl Write> {
    use std::os::fd::AsFd;
    io::stdout().as_fd().try_clone_to_owned().map(std::fs::File::from)
}

#[cfg(not(unix))]
fn unbuffered() -> io::Result<impl Write> {
    Ok(io::stdout().lock())
}

/// Whether a file asked for is standard output, as `-` says to most programs; a file of that name is `./-`.
pub fn is_stdout(path: &Path) -> bool {
    path == Path::new("-")
}

/// Refuses a file that cannot be written, before the work for it starts.
pub fn check_file(path: &Path, overwrite: bool) -> Result<(), Failure> {
    if is_stdout(path) {
        return Ok(());
    }
    if path.is_dir() {
        return Err(Failure::IsFolder { path: path.into() });
    }
    if is_device(path) {
        return Ok(());
    }
    check_parent(path)?;
    match path.symlink_metadata() {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(()),
        Err(cause) => Err(Failure::Write { path: path.into(), cause: plain(cause) }),
        Ok(_) if !overwrite => Err(Failure::Exists { path: path.into(), option: "--out" }),
        Ok(_) => Ok(()),
    }
}

/// Writes a file that appears only when it is whole, and over nothing unless that is asked for: a file that has appeared meanwhile
/// stays, and the new one goes beside it. A pipe, a device or standard output is written directly.
pub fn to_file(
    path: &Path,
    overwrite: bool,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<Placed, Failure> {
    if is_stdout(path) {
        let mut out = unbuffered().map(BufWriter::new).map_err(|cause| printed(cause.kind()))?;
        write(&mut out).and_then(|()| out.flush()).map_err(|cause| printed(cause.kind()))?;
        return Ok(Placed { beside: false, path: path.to_owned() });
    }
    let whole = || {
        if is_device(path) {
            filled(&mut std::fs::OpenOptions::new().write(true).open(path)?, write)?;
            return Ok(path.to_owned());
        }
        let mut file = temporary().tempfile_in(parent(path))?;
        leftover::remember(file.path());
        let _ = file.as_file().try_lock(); // where the file system has no locks nothing is ever taken for a leftover
        filled(file.as_file_mut(), write)?;
        settle(file.as_file())?;
        let undisturbed = leftover::undisturbed();
        let placed = placed(file, path, overwrite)?;
        drop(undisturbed);
        Ok(placed)
    };
    let placed = whole().map_err(|cause| Failure::Write { path: path.into(), cause: plain(cause) })?;
    if !is_device(&placed) {
        settle_folder(parent(&placed)).map_err(|cause| Failure::Unsettled { path: placed.clone(), cause })?;
    }
    Ok(Placed { beside: placed != path, path: placed })
}

/// A temporary file that goes with its guard: beside a result, or among the temporary files of the system for standard output and devices.
pub fn spool(beside: Option<&Path>) -> Result<NamedTempFile, Failure> {
    let folder = match beside.filter(|path| !is_device(path)) {
        Some(path) if !is_stdout(path) => parent(path).to_owned(),
        _ => std::env::temp_dir(),
    };
    let file = temporary()
        .tempfile_in(&folder)
        .map_err(|cause| Failure::Write { path: folder, cause: plain(cause) })?;
    leftover::remember(file.path());
    let _ = file.as_file().try_lock();
    Ok(file)
}

/// Puts a file in its place, or beside it if something is there that may not be replaced.
fn placed(file: NamedTempFile, path: &Path, overwrite: bool) -> io::Result<PathBuf> {
    let mut file = Some(file);
    place::first_free(path, |place| {
        let Some(new) = file.take() else { return Err(ErrorKind::NotFound.into()) };
        let over = overwrite && place == path && !path.is_dir();
        let persisted = if over { new.persist(place) } else { new.persist_noclobber(place) };
        persisted.map(drop).map_err(|error| {
            file = Some(error.file);
            error.error
        })
    })
}

fn filled(file: &mut std::fs::File, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut out = BufWriter::new(file);
    write(&mut out)?;
    out.flush()
}

/// Whether something is there that is neither file nor folder.
fn is_device(path: &Path) -> bool {
    path.metadata().is_ok_and(|metadata| !metadata.is_file() && !metadata.is_dir())
}

/// Refuses a path whose folder is missing or takes no files.
fn check_parent(path: &Path) -> Result<(), Failure> {
    let folder = parent(path);
    if !folder.is_dir() {
        return Err(Failure::NoFolder { path: path.into(), folder: folder.into() });
    }
    leftover::sweep(folder);
    let probe: io::Result<NamedTempFile> = temporary().tempfile_in(folder);
    probe.map(drop).map_err(|cause| Failure::Write { path: path.into(), cause: plain(cause) })
}

/// Temporary files with the access that files usually have, not the private one.
fn temporary() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(leftover::PREFIX);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666)); // less what the umask takes away
    }
    builder
}

/// The error without the name of a temporary file, which says nothing to a user.
fn plain(error: io::Error) -> io::Error {
    error.raw_os_error().map_or_else(|| error.kind().into(), io::Error::from_raw_os_error)
}

/// Failure of standard output: none that matters where its reader went away.
pub fn printed(cause: io::ErrorKind) -> Failure {
    match cause {
        io::ErrorKind::BrokenPipe => Failure::BrokenPipe,
        _ => Failure::Write { path: "standard output".into(), cause: cause.into() },
    }
}

/// A writer that Ctrl-C ends, and that keeps the reason of a failure: the writer of a table hides it in its own.
struct Watched<'a, W> {
    out: W,
    interrupt: &'a Interrupt,
    failed: Option<io::ErrorKind>,
}

impl<W: Write> Write for Watched<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.interrupt.pressed() {
            return Err(io::Error::other("Ctrl-C"));
        }
        self.out.write(bytes).inspect_err(|error| self.failed = Some(error.kind()))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush().inspect_err(|error| self.failed = Some(error.kind()))
    }
}
