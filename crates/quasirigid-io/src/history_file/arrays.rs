//! Histories in archives of NumPy arrays: columns, or arrays of three or four columns each, as Basilisk has them.

use std::io::{Cursor, Read};

use zip::ZipArchive;

use super::columns::{Chosen, Column};
use super::error::{Fault, HistoryFileProblem};
use super::{HistoryFile, Resolution};
use crate::matrix::numpy::Array;
use crate::text_file::{Place, unpacked_limit};

/// Nanoseconds of a second: `times` of Basilisk are whole numbers of them.
const NANO: f64 = 1e9;

/// Reads an archive; arrays that are no columns are passed over.
pub(super) fn read(bytes: &[u8]) -> Result<HistoryFile, Fault> {
    let refused = |detail: String| (Place::File, HistoryFileProblem::Arrays { detail });
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(|error| refused(error.to_string()))?;
    let mut left = unpacked_limit(bytes.len() as u64);
    let (mut titles, mut columns) = (Vec::new(), Vec::new());
    for index in 0..archive.len() {
        let file = archive.by_index(index).map_err(|error| refused(error.to_string()))?;
        let name = file.name().map_or_else(|_| String::new(), |name| name.to_string());
        let Some(name) = name.strip_suffix(".npy") else { continue };
        let mut data = Vec::new();
        file.take(left + 1).read_to_end(&mut data).map_err(|error| refused(error.to_string()))?;
        let within = left.checked_sub(data.len() as u64);
        left = within.ok_or_else(|| refused("the archive unpacks to a hundred times its size".to_owned()))?;
        for (title, column) in Array::new(&data).map_or_else(|_| Vec::new(), |array| named(name, &array)) {
            titles.push(title);
            columns.push(Some(column));
        }
    }
    let chosen = Chosen::of(&titles, &[]).map_err(|problem| (Place::File, problem))?;
    let mut wanted = Vec::new();
    for index in &chosen.indices {
        let column = columns.get_mut(*index).and_then(Option::take).flatten();
        let name = titles[*index].as_str().into();
        let found = "nan, inf or no number".into();
        wanted.push(column.ok_or((Place::File, HistoryFileProblem::Cell { name, found }))?);
    }
    let rows = wanted.first().map_or(0, |column| column.values.len());
    if wanted.iter().any(|column| column.values.len() != rows) {
        return Err(refused("the arrays have different lengths".to_owned()));
    }
    chosen.history(wanted, Vec::new())
}

/// Columns of an array with their names, none of them where a number is not finite; an array of more dimensions has no columns.
fn named(name: &str, array: &Array<'_>) -> Vec<(String, Option<Column>)> {
    let resolution = if array.is_single() { Resolution::Single } else { Resolution::Double };
    let unit = if array.is_whole() && name == "times" { NANO } else { 1.0 };
    let column = |indices: &mut dyn Iterator<Item = usize>| {
        let values = indices.map(|index| array.real(index).map(|value| value / unit).ok());
        values.collect::<Option<Vec<f64>>>().map(|values| Column { values, resolution })
    };
    match array.shape[..] {
        [rows] | [rows, 1] => vec![(name.to_owned(), column(&mut (0..rows)))],
        [rows, width @ 2..=4] => (0..width)
            .map(|part| {
                let end = if width == 3 { ["x", "y", "z"][part] } else { ["0", "1", "2", "3"][part] };
                let index = |row: usize| if array.by_rows() { row * width + part } else { part * rows + row };
                (format!("{name}_{end}"), column(&mut (0..rows).map(index)))
            })
            .collect(),
        _ => Vec::new(),
    }
}
