use std::path::Path;

use super::error::{Fault, MeshProblem, Place};
use super::stl;
use crate::text_file::kind_of;

/// Format of a surface file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Obj,
    StlText,
    StlBinary,
    Ply,
    Plates,
}

impl Format {
    /// The format of a file: where its beginning leaves a doubt, its name decides.
    pub(super) fn of(file: &Path, bytes: &[u8]) -> Result<Self, Fault> {
        if bytes.iter().all(u8::is_ascii_whitespace) {
            return Err((Place::File, MeshProblem::Empty));
        }
        if bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r\n") {
            return Ok(Self::Ply);
        }
        if stl::has_exact_size(bytes) {
            return Ok(Self::StlBinary);
        }
        let ending = file.extension().and_then(|ending| ending.to_str()).map(str::to_ascii_lowercase);
        let is_text = stl::is_text(bytes);
        match (ending.as_deref(), Self::by_first_word(bytes)) {
            (Some("stl"), _) if !is_text => Ok(Self::StlBinary),
            (Some("stl"), Some(Self::StlText)) => Ok(Self::StlText),
            (Some("obj"), _) if is_text => Ok(Self::Obj),
            (Some("tab" | "plt"), _) if is_text => Ok(Self::Plates),
            (_, Some(format)) if is_text => Ok(format),
            _ => Err((Place::File, MeshProblem::NotAMesh { kind: kind_of(bytes) })),
        }
    }

    fn by_first_word(bytes: &[u8]) -> Option<Self> {
        let comment = |line: &&[u8]| line.starts_with(b"#");
        let mut lines =
            bytes.split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii).filter(|line| !line.is_empty());
        let first = lines.find(|line| !comment(line))?;
        match first.split(u8::is_ascii_whitespace).next()? {
            word if word.eq_ignore_ascii_case(b"solid") => Some(Self::StlText),
            b"v" | b"vn" | b"vt" | b"vp" | b"f" | b"o" | b"g" | b"s" | b"mtllib" | b"usemtl" => {
                Some(Self::Obj)
            }
            word if word.iter().all(u8::is_ascii_digit) => Some(Self::Plates),
            _ => None,
        }
    }
}
