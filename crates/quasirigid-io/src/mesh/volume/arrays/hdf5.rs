//! HDF5 by the library: groups, and arrays as numbers and letters. What is unpacked is bounded by the length of the file.

use std::cell::Cell;

use hdf5_pure::{AttrValue, DType, Dataset, File, Group};

use super::{Arrays, rows};
use crate::mesh::error::{Fault, MeshProblem, Place};
use crate::mesh::volume::problem::VolumeProblem;
use crate::text_file::unpacked_limit;

/// An HDF5 file.
pub(in crate::mesh::volume) struct Hdf5 {
    file: File,
    /// Bytes that may still be unpacked, and in all.
    left: Cell<u64>,
    limit: u64,
}

impl Hdf5 {
    pub(in crate::mesh::volume) fn read(bytes: &[u8]) -> Result<Self, Fault> {
        let limit = unpacked_limit(bytes.len() as u64);
        let file = File::from_bytes(bytes.to_vec()).map_err(|error| damaged(&error))?;
        Ok(Self { file, left: Cell::new(limit), limit })
    }

    /// Names of the groups in a group, sorted; none where there is no such group.
    pub(in crate::mesh::volume) fn groups(&self, path: &str) -> Vec<String> {
        let mut names = self.group(path).and_then(|group| group.groups().ok()).unwrap_or_default();
        names.sort_unstable();
        names
    }

    /// A whole number beside a group.
    pub(in crate::mesh::volume) fn number(&self, path: &str, key: &str) -> Option<i64> {
        whole(self.group(path)?.attrs().ok()?.get(key)?)
    }

    fn group(&self, path: &str) -> Option<Group> {
        if path.is_empty() { Some(self.file.root()) } else { self.file.group(path).ok() }
    }

    /// An array whose entries of so many bytes may be unpacked.
    fn array(&self, name: &str, width: u64) -> Result<Option<Dataset>, Fault> {
        let Ok(array) = self.file.dataset(name) else { return Ok(None) };
        let lengths = array.shape().map_err(|error| damaged(&error))?;
        let size = lengths.iter().fold(width, |size, length| size.saturating_mul(*length));
        let limit = self.limit;
        let left = self.left.get().checked_sub(size).ok_or_else(|| {
            (Place::File, MeshProblem::from(VolumeProblem::Inflated { array: name.to_owned(), limit }))
        })?;
        self.left.set(left);
        Ok(Some(array))
    }
}

impl Arrays for Hdf5 {
    fn lengths(&self, name: &str) -> Option<Vec<usize>> {
        let lengths = self.file.dataset(name).ok()?.shape().ok()?;
        lengths.into_iter().map(|length| usize::try_from(length).ok()).collect()
    }

    fn reals(&self, name: &str) -> Result<Option<Vec<f64>>, Fault> {
        let Some(array) = self.array(name, 8)? else { return Ok(None) };
        array.read_f64().map(Some).map_err(|error| damaged(&error))
    }

    fn integers(&self, name: &str) -> Result<Option<Vec<i64>>, Fault> {
        let Some(array) = self.array(name, 8)? else { return Ok(None) };
        array.read_i64().map(Some).map_err(|error| damaged(&error))
    }

    fn texts(&self, name: &str) -> Result<Option<Vec<String>>, Fault> {
        let Some(array) = self.array(name, 1)? else { return Ok(None) };
        let width = match (array.dtype(), self.lengths(name).as_deref()) {
            (Ok(DType::Array(_, lengths)), _) => lengths.iter().map(|length| *length as usize).product(),
            (Ok(DType::String), Some([_, .., width])) => *width,
            (Ok(DType::String), _) => array.element_size().map_or(0, |width| width as usize),
            _ => return Ok(None),
        };
        array.read_raw().map(|bytes| Some(rows(&bytes, width))).map_err(|error| damaged(&error))
    }

    fn attribute(&self, name: &str, key: &str) -> Option<String> {
        let attributes = self.file.dataset(name).ok()?.attrs().ok()?;
        text(attributes.get(key)?)
    }
}

fn text(value: &AttrValue) -> Option<String> {
    let text = match value {
        AttrValue::String(text) | AttrValue::AsciiString(text) => text,
        AttrValue::AsciiStringSized { value, .. } | AttrValue::StringSized { value, .. } => value,
        AttrValue::StringArray(texts) | AttrValue::AsciiStringArray(texts) => texts.first()?,
        _ => return None,
    };
    Some(text.trim_end_matches(['\0', ' ']).to_owned())
}

fn whole(value: &AttrValue) -> Option<i64> {
    match value {
        AttrValue::I64(number) => Some(*number),
        AttrValue::I32(number) => Some((*number).into()),
        AttrValue::I64Array(numbers) => numbers.first().copied(),
        AttrValue::I32Array(numbers) => numbers.first().map(|number| (*number).into()),
        _ => None,
    }
}

fn damaged(error: &hdf5_pure::Error) -> Fault {
    (Place::File, VolumeProblem::Hdf5 { detail: error.to_string().as_str().into() }.into())
}
