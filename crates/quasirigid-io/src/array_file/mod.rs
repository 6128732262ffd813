//! Files of named arrays for other programs: NPZ for NumPy, MAT of version 5 for MATLAB and Octave.

mod mat;
mod npz;

use std::io;
use std::path::Path;

/// Array with its name in a file.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedArray {
    /// Name: letters, digits and underscores, a letter first.
    pub name: String,
    /// Array.
    pub value: ArrayValue,
}

/// Array of a file.
#[derive(Clone, Debug, PartialEq)]
pub enum ArrayValue {
    /// Matrix of numbers.
    Matrix {
        /// Number of rows and of columns.
        size: [usize; 2],
        /// Entries, row by row.
        entries: Vec<f64>,
    },
    /// List of texts.
    Texts(Vec<String>),
    /// Text.
    Text(String),
}

/// Format of a file of arrays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ArrayFormat {
    /// Archive of NumPy arrays, as `numpy.load` reads.
    Npz,
    /// MAT file of version 5, as `load` of MATLAB and Octave and `scipy.io.loadmat` read.
    Mat,
}

impl ArrayFormat {
    /// The format of a file's ending, `.npz` or `.mat`.
    #[must_use]
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "npz" => Some(Self::Npz),
            "mat" => Some(Self::Mat),
            _ => None,
        }
    }

    /// The bytes of a file with these arrays.
    ///
    /// # Errors
    /// Those of the archive, such as two arrays of one name.
    pub fn bytes(self, arrays: &[NamedArray]) -> io::Result<Vec<u8>> {
        match self {
            Self::Npz => npz::archive(arrays),
            Self::Mat => Ok(mat::file(arrays)),
        }
    }
}
