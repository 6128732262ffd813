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
    /// A solid voxel without a density.
    #[error(
        "the voxel {voxel:?}, whose value is {value}, has a density of {density} kg/m³; raise `threshold`, or correct `densities`"
    )]
    NoDensity {
        /// Indices of the voxel along x, y and z, from 0.
        voxel: [usize; 3],
        /// The value.
        value: String,
        /// Its density.
        density: String,
    },
    /// Densities for cells that are no voxels.
    #[error("`densities` are for voxels, and this is a mesh of cells; give its cells a `material`")]
    NoVoxels,
    /// A TIFF file that cannot be read.
    #[error("the TIFF file cannot be read: {detail}; save it uncompressed, or with LZW or Deflate")]
    Tiff {
        /// What is wrong.
        detail: String,
    },
    /// A page of a TIFF file that is no layer of grey values of the size of the first.
    #[error("page {page} is {found}; {wanted}")]
    Page {
        /// Number of the page, from 1.
        page: usize,
        /// What it is.
        found: String,
        /// What is read.
        wanted: String,
    },
    /// A stack of which the file has other pages than its description says.
    #[error(
        "the description tells of {told} {what}, and the file has {pages} pages; save one stack of grey values, a page for each layer"
    )]
    Stack {
        /// What is counted.
        what: &'static str,
        /// How many the description tells of.
        told: usize,
        /// Pages of the file.
        pages: usize,
    },
    /// A TIFF file for a program that reads none.
    #[error(
        "the file is TIFF, and this program was built without it; build it with `--features tiff`, or save the voxels as .npy or .nrrd"
    )]
    WithoutTiff,
    /// A file of values that does not lie beside its header.
    #[error("the values are in {file:?}; only files in the folder of the header or below it are read")]
    Elsewhere {
        /// The file.
        file: String,
    },
}
