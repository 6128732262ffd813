//! Errors of voxels; every message ends with a remedy or a question.

use thiserror::Error;

/// Problem of a file of voxels.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum VoxelProblem {
    /// An array of other than three dimensions.
    #[error("an array of shape {found}; voxels have three dimensions, x, y and z")]
    Dimensions {
        /// The lengths.
        found: String,
    },
    /// A value that is no label where there is no threshold.
    #[error("the value {found} is no label; give `threshold`, at and above which a voxel is solid")]
    NoLabel {
        /// The value.
        found: String,
    },
    /// No solid voxel.
    #[error("no voxel is solid; are the labels all 0, or the `threshold` or `least_voxels` too high?")]
    Nothing,
    /// Too many voxels.
    #[error("{count} and not at most {limit}; make the grid coarser, or cut the empty rim off")]
    TooMany {
        /// How many.
        count: String,
        /// How many may be.
        limit: usize,
    },
    /// A field of an NRRD header that is missing or wrong.
    #[error("the NRRD field `{name}` is {found:?}; {wanted}")]
    Field {
        /// The field.
        name: &'static str,
        /// What it says; empty where it is missing.
        found: String,
        /// What is read.
        wanted: &'static str,
    },
    /// Values that do not fill the grid.
    #[error("{found} values or bytes instead of {announced}; is the file cut off?")]
    Length {
        /// How many the header announces.
        announced: usize,
        /// How many there are.
        found: usize,
    },
    /// A file of values that does not lie beside its header.
    #[error("the values are in {file:?}; only files in the folder of the header or below it are read")]
    Elsewhere {
        /// The file.
        file: String,
    },
}
