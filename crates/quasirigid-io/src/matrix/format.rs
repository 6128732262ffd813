//! Format detection of matrix files and node files, from the first bytes and the ending of the name.
//! The beginning of a matrix file decides, since endings such as `.dat` are shared; node tables have no mark, so their name decides.

use std::path::Path;

use super::error::{Fault, MatrixProblem, Place};
use super::{coordinates, harwell, mat, op4};
use crate::nastran::{op2, printed};
use crate::text_file::kind_of;

/// Format of a matrix file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Market,
    Npy,
    Npz,
    Mat,
    CalculiX,
    Coordinates,
    Harwell,
    Dmig,
    Op4Text,
    Op4Binary {
        big_endian: bool,
    },
    Op2,
    /// A print file or a punch file with modes.
    Printed,
}

impl Format {
    /// The format of a file: where its beginning leaves a doubt, its name decides.
    pub(super) fn of(file: &Path, bytes: &[u8]) -> Result<Self, Fault> {
        if bytes.iter().all(u8::is_ascii_whitespace) {
            return Err((Place::File, MatrixProblem::Empty));
        }
        if let Some(format) = Self::by_beginning(bytes) {
            return Ok(format);
        }
        match ending(file).as_deref() {
            Some("f06" | "pch" | "out") if printed::has_modes(bytes) => Ok(Self::Printed),
            Some("sti" | "mas") => Ok(Self::CalculiX),
            _ if coordinates::is_text(bytes) => Ok(Self::Coordinates),
            Some("bdf" | "dat" | "nas" | "pch" | "dmig") => Ok(Self::Dmig),
            Some("op4") => Ok(Self::Op4Text),
            _ => Err((Place::File, MatrixProblem::NotAMatrix { kind: kind_of(bytes) })),
        }
    }

    fn by_beginning(bytes: &[u8]) -> Option<Self> {
        let begins =
            |word: &[u8]| bytes.get(..word.len()).is_some_and(|start| start.eq_ignore_ascii_case(word));
        if begins(b"%%MatrixMarket") {
            Some(Self::Market)
        } else if begins(b"\x93NUMPY") {
            Some(Self::Npy)
        } else if begins(b"PK\x03\x04") || begins(b"PK\x05\x06") {
            Some(Self::Npz)
        } else if mat::is_mat(bytes) {
            Some(Self::Mat)
        } else if harwell::is_text(bytes) {
            Some(Self::Harwell)
        } else if let Some(big_endian) = op4::byte_order(bytes) {
            Some(Self::Op4Binary { big_endian })
        } else if op2::Layout::of(bytes).is_some() {
            Some(Self::Op2)
        } else if first_line(bytes, b"$").is_some_and(|line| has_prefix(line, b"DMIG")) {
            Some(Self::Dmig)
        } else {
            op4::is_text(bytes).then_some(Self::Op4Text)
        }
    }
}

/// Format of a node file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NodeFormat {
    Table,
    Bulk,
    Input,
}

impl NodeFormat {
    /// The format of a file: its name decides, and its beginning where the name leaves a doubt.
    pub(super) fn of(file: &Path, bytes: &[u8]) -> Result<Self, Fault> {
        if op2::Layout::of(bytes).is_some() {
            return Ok(Self::Bulk);
        }
        let first = first_line(bytes, b"#").ok_or((Place::File, MatrixProblem::Empty))?;
        Ok(match ending(file).as_deref() {
            Some("inp") => Self::Input,
            Some("bdf" | "nas" | "pch" | "dat") => Self::Bulk,
            _ if first.starts_with(b"*") => Self::Input,
            _ if [&b"$"[..], b"GRID", b"GRDSET", b"CORD"].iter().any(|word| has_prefix(first, word)) => {
                Self::Bulk
            }
            _ => Self::Table,
        })
    }
}

fn ending(file: &Path) -> Option<String> {
    file.extension().and_then(|ending| ending.to_str()).map(str::to_ascii_lowercase)
}

fn has_prefix(line: &[u8], word: &[u8]) -> bool {
    line.get(..word.len()).is_some_and(|start| start.eq_ignore_ascii_case(word))
}

/// The first line that is neither blank nor a comment.
fn first_line<'a>(bytes: &'a [u8], comment: &[u8]) -> Option<&'a [u8]> {
    let mut lines = bytes.split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii);
    lines.find(|line| !line.is_empty() && !line.starts_with(comment))
}
