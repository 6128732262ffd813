//! Sheets of a structure that is held at its base: its mass as a rigid body, and its modes with their participation factors. NASTRAN gives
//! them by `MEFFMASS`, in OUTPUT2 and in print files, and in the matrices of an external superelement after Craig and Bampton.

mod printed;
mod superelement;
mod tables;

use std::path::Path;

use crate::matrix::error::{MatrixError, MatrixProblem};
use crate::matrix::listed::LocatedProblem;
use crate::nastran::op2;
use crate::text_file::{FileError, Place, bytes_of, kind_of};

/// Largest file that is read (bytes).
const MAX_FILE: u64 = 4 * 1024 * 1024 * 1024;
/// Share of the mass by which masses along the three axes may differ: those of points that are held are missing in some.
const UNEQUAL: f64 = 0.01;

/// Mass and modes of a structure with its base held, about a point, in the unit of the file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Sheet {
    /// Mass matrix of the structure as a rigid body: three displacements, then three rotations about the point.
    pub rigid: [[f64; 6]; 6],
    pub modes: Vec<SheetMode>,
}

/// A mode with the base held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SheetMode {
    /// Frequency (rad/s).
    pub frequency: f64,
    /// Participation factors of unit modal mass: `∫ φ dm`, then `∫ s × φ dm`.
    pub factors: [f64; 6],
}

/// Mass, centre and inertia about the point.
pub(crate) struct RigidBody {
    pub mass: f64,
    pub center: [f64; 3],
    pub inertia: [[f64; 3]; 3],
}

/// Reads the sheet in a file of NASTRAN; the places of the points of a superelement stand in a file of their own or in the same.
///
/// # Errors
/// [`MatrixError`] says what is wrong and where.
pub(crate) fn read(file: &Path, nodes: Option<&Path>) -> Result<Sheet, MatrixError> {
    let bytes = bytes_of(file, MAX_FILE)?;
    if op2::Layout::of(&bytes).is_some() && tables::has_factors(&bytes) {
        return tables::read(&bytes)
            .map_err(|(at, problem)| FileError::new(file)((Place::Byte(at), problem)));
    }
    if printed::has_factors(&bytes) {
        let named = |(line, problem): LocatedProblem| {
            FileError::new(file)((if line == 0 { Place::File } else { Place::Line(line) }, problem))
        };
        return printed::read(&bytes).map_err(named);
    }
    superelement::read(file, &bytes, nodes)
}

/// Effective masses of each mode along and about the three axes, where the bytes of a file of NASTRAN list them.
pub(crate) fn effective(bytes: &[u8]) -> Option<Vec<[f64; 6]>> {
    if op2::Layout::of(bytes).is_some() {
        return tables::effective(bytes);
    }
    let text = kind_of(bytes) == "text";
    text.then(|| printed::effective(bytes)).flatten()
}

impl Sheet {
    /// Mass, centre of mass and inertia of the rigid mass matrix.
    ///
    /// # Errors
    /// A matrix that no rigid body has.
    pub fn body(&self) -> Result<RigidBody, MatrixProblem> {
        let rigid = &self.rigid;
        let mass = (rigid[0][0] + rigid[1][1] + rigid[2][2]) / 3.0;
        if !(mass > 0.0) {
            return Err(MatrixProblem::Sheet { what: NO_MASS });
        }
        let unequal = (0..3)
            .any(|i| (0..3).any(|j| (rigid[i][j] - if i == j { mass } else { 0.0 }).abs() > UNEQUAL * mass));
        if unequal {
            return Err(MatrixProblem::Sheet { what: NO_RIGID_BODY });
        }
        // displacements of the mass in a rotation about the point are θ × c
        let center = [
            0.5 * (rigid[1][5] - rigid[2][4]) / mass,
            0.5 * (rigid[2][3] - rigid[0][5]) / mass,
            0.5 * (rigid[0][4] - rigid[1][3]) / mass,
        ];
        let reach = ((rigid[3][3] + rigid[4][4] + rigid[5][5]) / mass).max(0.0).sqrt();
        let crossed =
            [[0.0, center[2], -center[1]], [-center[2], 0.0, center[0]], [center[1], -center[0], 0.0]];
        let differs = (0..3)
            .any(|i| (0..3).any(|j| (rigid[i][3 + j] - mass * crossed[i][j]).abs() > UNEQUAL * mass * reach));
        if differs {
            return Err(MatrixProblem::Sheet { what: NO_RIGID_BODY });
        }
        let inertia = std::array::from_fn(|i| {
            std::array::from_fn(|j| 0.5 * (rigid[3 + i][3 + j] + rigid[3 + j][3 + i]))
        });
        Ok(RigidBody { mass, center, inertia })
    }
}

const NO_MASS: &str = "the rigid body mass matrix has no mass; is it that of the points that are held?";
const NO_RIGID_BODY: &str = "the rigid body mass matrix is that of no rigid body: masses along the axes differ, or mass is missing at points \
                             that are held; hold the structure by points without mass";
