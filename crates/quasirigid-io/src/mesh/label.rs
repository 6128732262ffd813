//! Unit of length from the label of the Planetary Data System beside a file, `.lbl` of PDS3 or `.xml` of PDS4.

use std::path::Path;

use super::error::{MeshError, MeshProblem, Place};
use crate::text_file::{FileError, bytes_of};

/// Largest label that is read.
const MAX_LABEL: u64 = 16 * 1024 * 1024;
/// Words for units of length, in capitals.
const UNITS: [(&str, f64, &[&str]); 4] = [
    ("km", 1e3, &["KM", "KILOMETER", "KILOMETERS", "KILOMETRE", "KILOMETRES"]),
    ("m", 1.0, &["M", "METER", "METERS", "METRE", "METRES"]),
    ("cm", 1e-2, &["CM", "CENTIMETER", "CENTIMETERS"]),
    ("mm", 1e-3, &["MM", "MILLIMETER", "MILLIMETERS"]),
];

/// The unit (m) that a label beside the file gives its lengths, with words that name the label; none without a label, or if the label
/// gives none.
pub(super) fn unit(file: &Path) -> Result<Option<(f64, String)>, MeshError> {
    for ending in ["lbl", "LBL", "xml", "XML"] {
        let label = file.with_extension(ending);
        if label == file || !label.is_file() {
            continue;
        }
        let bytes = bytes_of::<MeshProblem>(&label, MAX_LABEL)?;
        let text = String::from_utf8_lossy(&bytes);
        let mut found: Vec<(&str, f64)> = stated(&text).collect();
        found.sort_by(|a, b| a.1.total_cmp(&b.1));
        found.dedup();
        let name = label.file_name().unwrap_or_default().to_string_lossy().into_owned();
        match found.as_slice() {
            [] => {}
            [(unit, size)] => return Ok(Some((*size, format!("{name} says {unit}")))),
            [(one, _), (other, _), ..] => {
                let problem = MeshProblem::Units { label: name, units: [(*one).into(), (*other).into()] };
                return Err(FileError::new(file)((Place::File, problem)));
            }
        }
    }
    Ok(None)
}

/// Units of length in lines such as `UNIT = KM` and elements such as `<unit>km</unit>`.
fn stated(text: &str) -> impl Iterator<Item = (&'static str, f64)> {
    let of_line = |line: &str| -> Option<(&'static str, f64)> {
        let line = line.trim();
        let value = match line.split_once('=') {
            Some((key, value)) if key.trim().eq_ignore_ascii_case("UNIT") => value,
            _ => line.strip_prefix("<unit>")?.strip_suffix("</unit>")?,
        };
        let word = value.trim().trim_matches(['"', '<', '>', '\'']).trim().to_ascii_uppercase();
        UNITS.iter().find(|(.., words)| words.contains(&word.as_str())).map(|(unit, size, _)| (*unit, *size))
    };
    text.lines().filter_map(of_line)
}
