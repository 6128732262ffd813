//! Files and folders put in their places: whole, on the disk, and over nothing that is not ours.

use std::ffi::OsString;
use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use quasirigid_io::disk::no_such_call;

/// Moves a file or folder to a free place.
///
/// # Errors
/// [`ErrorKind::AlreadyExists`] if something is there.
pub fn put(from: &Path, to: &Path) -> io::Result<()> {
    match exclusively(from, to) {
        Err(error) if no_such_call(&error) => plainly(from, to),
        other => other,
    }
}

/// Exchanges two files or folders in one step; both stay if it fails.
pub fn exchange(one: &Path, other: &Path) -> io::Result<()> {
    match at_once(one, other) {
        Err(error) if no_such_call(&error) => {
            let mut aside = one.as_os_str().to_owned();
            aside.push("-aside");
            fs::rename(other, &aside)?;
            let moved = fs::rename(one, other);
            moved.and_then(|()| fs::rename(&aside, one)).inspect_err(|_| {
                let _ = plainly(Path::new(&aside), other); // nothing better can be done if this fails too
            })
        }
        other => other,
    }
}

/// Tries a place, then `name-2`, `name-3` and so on until one is free; the place taken.
pub fn first_free(place: &Path, mut take: impl FnMut(&Path) -> io::Result<()>) -> io::Result<PathBuf> {
    let mut number = 1;
    loop {
        let candidate = if number == 1 { place.to_owned() } else { numbered(place, number) };
        match take(&candidate) {
            Ok(()) => return Ok(candidate),
            Err(error) if error.kind() == ErrorKind::AlreadyExists && number < 1000 => number += 1,
            Err(error) => return Err(error),
        }
    }
}

/// `folder/name.csv` as `folder/name-2.csv`.
fn numbered(place: &Path, number: usize) -> PathBuf {
    let mut name = place.file_stem().map(OsString::from).unwrap_or_default();
    name.push(format!("-{number}"));
    if let Some(extension) = place.extension() {
        name.push(".");
        name.push(extension);
    }
    place.with_file_name(name)
}

/// Move after a check that the place is free: something that appears in between is lost only if it is an empty folder, or a file.
fn plainly(from: &Path, to: &Path) -> io::Result<()> {
    match to.symlink_metadata() {
        Ok(_) => Err(ErrorKind::AlreadyExists.into()),
        Err(_) => fs::rename(from, to),
    }
}

#[cfg(any(target_vendor = "apple", target_os = "linux"))]
fn exclusively(from: &Path, to: &Path) -> io::Result<()> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    renameat_with(CWD, from, CWD, to, RenameFlags::NOREPLACE).map_err(io::Error::from)
}

#[cfg(any(target_vendor = "apple", target_os = "linux"))]
fn at_once(one: &Path, other: &Path) -> io::Result<()> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    renameat_with(CWD, one, CWD, other, RenameFlags::EXCHANGE).map_err(io::Error::from)
}

#[cfg(not(any(target_vendor = "apple", target_os = "linux")))]
fn exclusively(_: &Path, _: &Path) -> io::Result<()> {
    Err(ErrorKind::Unsupported.into())
}

#[cfg(not(any(target_vendor = "apple", target_os = "linux")))]
fn at_once(_: &Path, _: &Path) -> io::Result<()> {
    Err(ErrorKind::Unsupported.into())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn two(one: &str, other: &str) -> (tempfile::TempDir, PathBuf, PathBuf) {
        let folder = tempfile::TempDir::new().unwrap();
        let [a, b] = ["a", "b"].map(|name| folder.path().join(name));
        fs::write(&a, one).unwrap();
        fs::write(&b, other).unwrap();
        (folder, a, b)
    }

    #[test]
    fn nothing_is_put_over_something() {
        let (_folder, a, b) = two("new", "precious");
        for put in [put, plainly] {
            assert_eq!(put(&a, &b).unwrap_err().kind(), ErrorKind::AlreadyExists);
            assert_eq!(fs::read_to_string(&b).unwrap(), "precious");
        }
        fs::remove_file(&b).unwrap();
        put(&a, &b).unwrap();
        assert_eq!(fs::read_to_string(&b).unwrap(), "new");
    }

    #[test]
    fn exchange_keeps_both() {
        let (_folder, a, b) = two("one", "other");
        exchange(&a, &b).unwrap();
        assert_eq!([a, b].map(|file| fs::read_to_string(file).unwrap()), ["other", "one"]);
    }

    #[test]
    fn next_free_name_keeps_the_extension() {
        let taken = ["o.csv", "o-2.csv"].map(PathBuf::from);
        let free = |place: &Path| {
            if taken.contains(&place.to_owned()) { Err(ErrorKind::AlreadyExists.into()) } else { Ok(()) }
        };
        assert_eq!(first_free(Path::new("o.csv"), free).unwrap(), Path::new("o-3.csv"));
    }
}
