//! Format of a surface file, by its beginning first and by its name second.

use std::path::Path;

use super::error::{Fault, MeshProblem, Place};
use super::{gltf, off, stl};
use crate::text_file::kind_of;

/// Format of a surface file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Obj,
    StlText,
    StlBinary,
    Ply,
    Plates,
    Off,
    Vrml,
    Gltf,
    /// A surface of VTK.
    VtkLegacy,
    VtkXml,
    /// A mesh of cells: gmsh, Abaqus, an unstructured grid of VTK.
    Cells,
}

/// Bytes at the beginning in which the kind of a VTK file stands.
const HEAD: usize = 4096;

impl Format {
    /// The format of a file: where its beginning leaves a doubt, its name decides.
    pub(super) fn of(file: &Path, bytes: &[u8]) -> Result<Self, Fault> {
        if bytes.iter().all(u8::is_ascii_whitespace) {
            return Err((Place::File, MeshProblem::Empty));
        }
        if let Some(format) = Self::by_mark(bytes) {
            return Ok(format);
        }
        if stl::has_exact_size(bytes) {
            return Ok(Self::StlBinary);
        }
        let ending = file.extension().and_then(|ending| ending.to_str()).map(str::to_ascii_lowercase);
        let is_text = stl::is_text(bytes) && !bytes.starts_with(b"version https://git-lfs");
        match (ending.as_deref(), Self::by_first_word(bytes)) {
            (Some("stl"), _) if !is_text => Ok(Self::StlBinary),
            (Some("stl"), Some(Self::StlText)) => Ok(Self::StlText),
            (_, Some(format)) if is_text => Ok(format),
            (Some("obj"), _) if is_text => Ok(Self::Obj),
            (Some("tab" | "plt"), _) if is_text => Ok(Self::Plates),
            _ => Err((Place::File, MeshProblem::NotAMesh { kind: kind_of(bytes) })),
        }
    }

    /// Formats whose first bytes are theirs alone.
    fn by_mark(bytes: &[u8]) -> Option<Self> {
        let start = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes).trim_ascii_start();
        let head = &start[..start.len().min(HEAD)];
        let has = |word: &[u8]| head.windows(word.len()).any(|part| part.eq_ignore_ascii_case(word));
        if bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r") {
            Some(Self::Ply)
        } else if gltf::is_gltf(bytes) {
            Some(Self::Gltf)
        } else if start.starts_with(b"#VRML") || start.starts_with(b"#Inventor") {
            Some(Self::Vrml)
        } else if start.starts_with(b"# vtk DataFile") {
            Some(if has(b"POLYDATA") { Self::VtkLegacy } else { Self::Cells })
        } else if start.starts_with(b"<") && has(b"VTKFile") {
            Some(if has(b"\"PolyData\"") { Self::VtkXml } else { Self::Cells })
        } else if start.starts_with(b"$MeshFormat") || start.starts_with(b"$Comments") {
            Some(Self::Cells)
        } else if start.starts_with(b"*") {
            let mesh = ["*NODE", "*HEADING", "*PART"].iter().any(|word| has(word.as_bytes()));
            mesh.then_some(Self::Cells)
        } else {
            None
        }
    }

    fn by_first_word(bytes: &[u8]) -> Option<Self> {
        let start = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
        let comment = |line: &&[u8]| line.first().is_some_and(|byte| b"#!;%*/".contains(byte));
        let mut lines = start
            .split(|byte| *byte == b'\n')
            .map(<[u8]>::trim_ascii)
            .filter(|line| !line.is_empty() && !comment(line));
        let first = lines.next()?;
        let second = lines.find(|line| !is_numbers(line));
        match first.split(u8::is_ascii_whitespace).next()? {
            word if word.eq_ignore_ascii_case(b"solid") => Some(Self::StlText),
            b"v" | b"V" | b"vn" | b"vt" | b"vp" | b"f" | b"o" | b"g" | b"s" | b"mtllib" | b"usemtl" => {
                Some(Self::Obj)
            }
            word if off::is_header(word) => Some(Self::Off),
            // Counts before the rows of an OBJ.
            _ if is_numbers(first)
                && second.is_some_and(|line| line.starts_with(b"v ") || line.starts_with(b"v\t")) =>
            {
                Some(Self::Obj)
            }
            _ if is_numbers(first) => Some(Self::Plates),
            _ => None,
        }
    }
}

/// Whether a line has nothing but numbers.
fn is_numbers(line: &[u8]) -> bool {
    let number =
        |byte: &u8| byte.is_ascii_digit() || byte.is_ascii_whitespace() || b"+-.,eEdD".contains(byte);
    line.first().is_some_and(|byte| byte.is_ascii_digit() || b"+-.".contains(byte)) && line.iter().all(number)
}
