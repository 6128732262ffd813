//! Named arrays of a container: classic netCDF, read here, and HDF5, in which netCDF-4 and MED are kept.

#[cfg(feature = "hdf5")]
mod hdf5;
mod netcdf;
#[cfg(not(feature = "hdf5"))]
mod no_hdf5;

#[cfg(feature = "hdf5")]
pub(super) use hdf5::Hdf5;
pub(super) use netcdf::NetCdf;
#[cfg(not(feature = "hdf5"))]
pub(super) use no_hdf5::Hdf5;

use super::problem::VolumeProblem;
use crate::mesh::error::{Fault, MeshProblem, Place};

/// Beginning of a classic netCDF file, before its version, and of an HDF5 file.
const NETCDF: &[u8] = b"CDF";
const HDF5: &[u8] = b"\x89HDF\r\n\x1a\n";

/// A container by the first bytes of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Container {
    NetCdf,
    Hdf5,
}

impl Container {
    pub(super) fn of(bytes: &[u8]) -> Option<Self> {
        match bytes {
            _ if bytes.starts_with(HDF5) => Some(Self::Hdf5),
            _ if bytes.starts_with(NETCDF) && matches!(bytes.get(3), Some(1 | 2 | 5)) => Some(Self::NetCdf),
            _ => None,
        }
    }
}

/// Arrays by their names; none of a name that is not there.
pub(super) trait Arrays {
    /// Lengths of an array along its dimensions.
    fn lengths(&self, name: &str) -> Option<Vec<usize>>;
    /// The entries of an array as real numbers, the last index fastest.
    fn reals(&self, name: &str) -> Result<Option<Vec<f64>>, Fault>;
    /// The entries of an array as whole numbers, the last index fastest.
    fn integers(&self, name: &str) -> Result<Option<Vec<i64>>, Fault>;
    /// The rows of an array of letters, without what fills them up.
    fn texts(&self, name: &str) -> Result<Option<Vec<String>>, Fault>;
    /// A text beside an array.
    fn attribute(&self, name: &str, key: &str) -> Option<String>;
}

/// Rows of so many letters each, without blanks and zeros behind them.
fn rows(bytes: &[u8], width: usize) -> Vec<String> {
    let row = |bytes: &[u8]| {
        let end = bytes.iter().position(|byte| *byte == 0).unwrap_or(bytes.len());
        String::from_utf8_lossy(&bytes[..end]).trim().to_owned()
    };
    if width == 0 { Vec::new() } else { bytes.chunks_exact(width).map(row).collect() }
}

/// The fault of an array that is missing.
pub(super) fn missing(name: &str) -> Fault {
    (Place::File, VolumeProblem::Missing { keyword: name.into() }.into())
}

/// Refuses an array of another length.
pub(super) fn check_length(name: &str, found: usize, expected: usize) -> Result<(), Fault> {
    if found == expected {
        return Ok(());
    }
    let (array, found, expected) = (name.to_owned(), found as u64, expected as u64);
    let problem: MeshProblem = VolumeProblem::ArrayLength { array, found, expected }.into();
    Err((Place::File, problem))
}

/// A number as nodes and cells have it.
pub(super) fn label(found: i64) -> Result<u64, Fault> {
    u64::try_from(found).map_err(|_| (Place::File, VolumeProblem::Label { found }.into()))
}

/// Number of a node by its place from 1.
pub(super) fn node(labels: &[u64], place: i64) -> Result<u64, Fault> {
    let index = usize::try_from(place).ok().and_then(|place| place.checked_sub(1));
    let label = index.and_then(|index| labels.get(index)).copied();
    label.ok_or_else(|| (Place::File, VolumeProblem::Label { found: place }.into()))
}
