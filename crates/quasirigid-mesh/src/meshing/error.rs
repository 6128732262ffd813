//! Errors of meshing: lengths out of range, too many cells, or cells too wide for the shape.
//! Wherever a finer mesh may help, the error names the resolution to try.

use quasirigid_math::memory::TooMuchMemory;
use thiserror::Error;

/// Error of a shape for which there is no mesh.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum MeshingError {
    /// A length that is no positive number.
    #[error("a length is {value:e}; lengths are positive and finite")]
    Length {
        /// The length.
        value: f64,
    },
    /// Lengths so different that the cells would be flat.
    #[error(
        "the longest length is {ratio:.3e} times the shortest; cells would be flat, at most {most:e} is allowed"
    )]
    Disparate {
        /// The longest length over the shortest.
        ratio: f64,
        /// Largest ratio allowed.
        most: f64,
    },
    /// An inner length that is not less than the outer one around it.
    #[error("the inner length {inner:e} is not less than the outer {outer:e}")]
    NotWithin {
        /// The inner length.
        inner: f64,
        /// The outer one.
        outer: f64,
    },
    /// No cells across.
    #[error("a resolution of 0 leaves no cell; it is the number of cells across and at least 1")]
    Resolution,
    /// An exponent of grading that is out of range.
    #[error("the exponent of grading is {exponent:e}; it is between 1 (even cells) and {most}")]
    Exponent {
        /// The exponent.
        exponent: f64,
        /// The largest allowed.
        most: f64,
    },
    /// More cells than are allowed.
    #[error("there would be about {cells:.3e} cells, more than {most}; {}", coarser(*resolution))]
    TooMany {
        /// Number of cells that would be made.
        cells: f64,
        /// Number allowed.
        most: usize,
        /// The resolution that has about as many; 0 if none has.
        resolution: usize,
    },
    /// Cells for which there is no room.
    #[error("there would be about {cells:.3e} cells: {cause}; lower the resolution")]
    Memory {
        /// Number of cells that would be made.
        cells: f64,
        /// The memory that they take.
        cause: TooMuchMemory,
    },
    /// Curved cells that overlap themselves.
    #[error("{count} of {cells} curved cells are inside out near a wall; raise the resolution")]
    Folded {
        /// Number of such cells.
        count: usize,
        /// Number of all cells.
        cells: usize,
    },
    /// A mesh without some of the volume, or with too much: its cells are too wide for thin parts and sharp edges.
    #[error(
        "the mesh has {:.1} % of the volume that the surface encloses, more than {} % off: cells are too wide for thin parts and sharp edges; try a resolution of {resolution}",
        100.0 * found, 100.0 * allowed
    )]
    Volume {
        /// Volume of the mesh over that of the surface.
        found: f64,
        /// Allowed departure of the volume, as a share.
        allowed: f64,
        /// The resolution to try.
        resolution: usize,
    },
    /// A mesh in more parts than the surface has bodies: a neck is thinner than its cells.
    #[error(
        "the mesh falls into {parts} parts where the surface has {bodies}: a neck is thinner than a cell; try a resolution of {resolution}"
    )]
    Severed {
        /// Parts of the mesh.
        parts: usize,
        /// Bodies of the surface.
        bodies: usize,
        /// The resolution to try.
        resolution: usize,
    },
    /// A mesh with another topology than the surface: cells as wide as a ring's tube tear it, and join the sides of a gap.
    #[error(
        "the mesh has the Euler characteristic {found}, the surface {expected}: cells tear what is thinner, or join what is nearer, than they are wide; try a resolution of {resolution}"
    )]
    Torn {
        /// Euler characteristic of the wall of the mesh.
        found: i64,
        /// Euler characteristic of the surface.
        expected: i64,
        /// The resolution to try.
        resolution: usize,
    },
}

/// Advice for too many cells.
fn coarser(resolution: usize) -> String {
    match resolution {
        0 => "the shape is too thin beside its length".to_owned(),
        _ => format!("try a resolution of {resolution}"),
    }
}
