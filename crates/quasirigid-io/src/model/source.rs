use std::collections::BTreeSet;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

use super::{Diagnostic, FileProblem, ModelError};
use crate::files_read::sha256;
use crate::text_file::{Unread, all_of, stream_of};

/// Largest model file that is read (bytes): ten times the size of one with 10⁵ points.
const MAX_FILE: u64 = 64 * 1024 * 1024;

/// Source: the text of a model, with its file and its checksum.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// Path as the user gave it.
    pub file: PathBuf,
    /// Whole text of the file.
    pub text: String,
    /// SHA-256 of the text, in hexadecimal.
    pub sha256: String,
}

impl Source {
    /// The text of a model, for which `file` stands in messages.
    #[must_use]
    pub fn new(file: &Path, text: String) -> Self {
        let sha256 = sha256(text.as_bytes());
        Self { file: file.to_owned(), text, sha256 }
    }

    /// Reads a file, up to the size that a model file may have.
    pub(crate) fn read(file: &Path) -> Result<Self, ModelError> {
        Self::of(file, stream_of(file, MAX_FILE))
    }

    /// Reads a stream, up to the size that a model file may have.
    pub(super) fn read_from(file: &Path, input: impl Read) -> Result<Self, ModelError> {
        Self::of(file, all_of(input, MAX_FILE))
    }

    /// Names in the values of the text, of this model or of a study of it, under which a file stands in a folder: meshes and matrices.
    #[must_use]
    pub fn files_in(&self, folder: &Path) -> BTreeSet<String> {
        let mut names = BTreeSet::new();
        if let Ok(tree) = self.text.parse::<toml::Table>() {
            tree.values().for_each(|value| texts(value, &mut names));
        }
        names.retain(|name| !name.is_empty() && folder.join(name).is_file());
        names
    }

    fn of(file: &Path, bytes: Result<Vec<u8>, Unread>) -> Result<Self, ModelError> {
        let problem = |unread: Unread| match unread {
            Unread::Unreadable(ErrorKind::NotFound) => FileProblem::Missing,
            Unread::Unreadable(kind) => FileProblem::Refused { kind },
            Unread::Folder | Unread::NoFile => FileProblem::Folder,
            Unread::TooLarge => FileProblem::TooLarge { limit: MAX_FILE },
        };
        let bytes = bytes
            .map_err(|unread| ModelError::Unreadable { file: file.to_owned(), problem: problem(unread) })?;
        String::from_utf8(bytes)
            .map(|text| Self::new(file, text))
            .map_err(|error| Self::not_text(file, &error))
    }

    fn not_text(file: &Path, error: &std::string::FromUtf8Error) -> ModelError {
        let start = error.utf8_error().valid_up_to();
        let byte = error.as_bytes().get(start).copied().unwrap_or_default();
        let message = format!("the file is not UTF-8 text: the byte 0x{byte:02X} is not allowed here");
        let help = "a model file is a TOML text; save it with the encoding UTF-8";
        let text = String::from_utf8_lossy(error.as_bytes()).into_owned();
        let end = start + char::REPLACEMENT_CHARACTER.len_utf8();
        ModelError::Invalid {
            model: Self::new(file, text),
            diagnostics: vec![Diagnostic::new(start..end, message, "not UTF-8").help(help)],
        }
    }
}

fn texts(value: &toml::Value, names: &mut BTreeSet<String>) {
    match value {
        toml::Value::String(text) => {
            names.insert(text.clone());
        }
        toml::Value::Array(values) => values.iter().for_each(|value| texts(value, names)),
        toml::Value::Table(entries) => entries.values().for_each(|value| texts(value, names)),
        _ => {}
    }
}
