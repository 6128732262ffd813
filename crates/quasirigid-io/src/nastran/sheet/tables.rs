//! `MEFFMASS` in OUTPUT2: the matrices `RBMASSS`, `MPFACS` and `MEFMASS` beside the table of eigenvalues.

use super::{Sheet, SheetMode};
use crate::matrix::MatrixFile;
use crate::matrix::error::MatrixProblem;
use crate::matrix::listed::LocatedProblem;
use crate::matrix::op2::named;
use crate::nastran::op2::{Tape, eigenvalues};

const RIGID: [&str; 2] = ["RBMASSS", "RBMASS"];
const FACTORS: [&str; 2] = ["MPFACS", "MPFAC"];
const EFFECTIVE: [&str; 2] = ["MEFMASS", "MEFMAS"];
/// Difference between an effective mass and the square of its participation factor, relative to the largest of its axis, above which they
/// do not belong together.
const APART: f64 = 1e-3;

pub(super) fn has_factors(bytes: &[u8]) -> bool {
    Tape::read(bytes).is_ok_and(|tape| tape.block(&FACTORS).is_some())
}

pub(super) fn read(bytes: &[u8]) -> Result<Sheet, LocatedProblem> {
    let tape = Tape::read(bytes)?;
    let missing = |what: &'static str| (0, MatrixProblem::Sheet { what });
    let rigid = named(&tape, &RIGID)?.ok_or_else(|| missing(NO_RIGID))?;
    let factors = named(&tape, &FACTORS)?.ok_or_else(|| missing(NO_RIGID))?;
    let modes = eigenvalues(&tape);
    if [rigid.rows, rigid.columns, factors.rows] != [6; 3] || factors.columns != modes.len() {
        return Err(missing(OTHER_SIZES));
    }
    let mut sheet = Sheet { rigid: [[0.0; 6]; 6], modes: Vec::new() };
    for (row, column, value) in rigid.entries {
        sheet.rigid[row][column] = value;
    }
    let factors = columns(&factors);
    for ([frequency, mass], factors) in modes.into_iter().zip(factors) {
        sheet.modes.push(SheetMode { frequency, factors: factors.map(|factor| mass.sqrt() * factor) });
    }
    if let Some(effective) = named(&tape, &EFFECTIVE)? {
        if (effective.rows, effective.columns) != (6, sheet.modes.len()) {
            return Err(missing(OTHER_SIZES));
        }
        agree(&sheet, &columns(&effective)).map_err(|problem| (0, problem))?;
    }
    Ok(sheet)
}

/// Effective masses, where the file has them.
pub(super) fn effective(bytes: &[u8]) -> Option<Vec<[f64; 6]>> {
    let tape = Tape::read(bytes).ok()?;
    named(&tape, &EFFECTIVE).ok()?.filter(|matrix| matrix.rows == 6).map(|matrix| columns(&matrix))
}

/// Columns of a matrix of six rows.
fn columns(matrix: &MatrixFile) -> Vec<[f64; 6]> {
    let mut columns = vec![[0.0; 6]; matrix.columns];
    for (row, column, value) in &matrix.entries {
        columns[*column][*row] = *value;
    }
    columns
}

/// Refuses effective masses that are not the squares of the participation factors.
pub(super) fn agree(sheet: &Sheet, effective: &[[f64; 6]]) -> Result<(), MatrixProblem> {
    for axis in 0..6 {
        let largest = effective.iter().fold(0.0, |largest: f64, row| largest.max(row[axis].abs()));
        let apart =
            sheet.modes.iter().zip(effective).any(|(mode, effective)| {
                (mode.factors[axis].powi(2) - effective[axis]).abs() > APART * largest
            });
        if apart {
            return Err(MatrixProblem::Sheet { what: NO_SQUARES });
        }
    }
    Ok(())
}

const NO_RIGID: &str =
    "the file has participation factors without the rigid body mass matrix; ask for MEFFMASS(PLOT,ALL)";
const OTHER_SIZES: &str = "participation factors, eigenvalues and the rigid body mass matrix are not of one run: their numbers of modes differ";
const NO_SQUARES: &str =
    "the effective masses are not the squares of the participation factors; are they of one run?";
