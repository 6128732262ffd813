//! Inputs on disk: the corpus and the regressions of each target, a file each.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::mutation::MAX_INPUT;
use crate::targets::Target;

/// Folder of the crate.
pub const HOME: &str = env!("CARGO_MANIFEST_DIR");

/// Files of a target, in the order of their names: those of its folders in `corpus` and `regressions`, and its seeds elsewhere in the
/// repository that are not longer than an input may be.
#[must_use]
pub fn files(target: &Target) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for kind in ["corpus", "regressions"] {
        below(&Path::new(HOME).join(kind).join(target.name), "", &mut files);
    }
    for (folder, ending) in target.seeds {
        below(&Path::new(HOME).join("../..").join(folder), ending, &mut files);
    }
    files.sort();
    files
}

/// Files in a folder and the folders inside it, with an ending where one is given.
fn below(folder: &Path, ending: &str, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            below(&path, ending, files);
        } else if ending.is_empty() || path.extension().is_some_and(|found| found == ending) {
            let short = entry.metadata().is_ok_and(|metadata| metadata.len() <= MAX_INPUT as u64);
            files.extend(short.then_some(path));
        }
    }
}

/// Contents of the [`files`] of a target.
///
/// # Errors
/// What the file system says.
pub fn inputs(target: &Target) -> io::Result<Vec<Vec<u8>>> {
    files(target).iter().map(fs::read).collect()
}

/// Keeps a failing input under the name of its place, unless a shorter one is there.
///
/// # Errors
/// What the file system says.
pub fn keep(findings: &Path, target: &str, place: &str, input: &[u8]) -> io::Result<PathBuf> {
    let folder = findings.join(target);
    fs::create_dir_all(&folder)?;
    let plain = |letter: char| if letter.is_ascii_alphanumeric() || letter == '.' { letter } else { '-' };
    let name: String = place.chars().map(plain).collect();
    let path = folder.join(name.trim_matches('-'));
    let kept = fs::metadata(&path).map(|kept| kept.len());
    if kept.is_err() || kept.is_ok_and(|length| length > input.len() as u64) {
        fs::write(&path, input)?;
    }
    Ok(path)
}
