//! Real modes in an OUTPUT2 file: the table of eigenvalues, and eigenvectors by grid points and components.
//! NX Nastran DMAP Programmer's Guide, *Data blocks*, LAMA and OUG.

use std::collections::HashMap;

use quasirigid_math::vec3::dot;

use super::bulk::{PARAMETERS, bulk};
use super::tape::{Block, Record, Tape};
use super::words::Words;
use crate::matrix::Dof;
use crate::matrix::error::{MatrixProblem, Row};
use crate::matrix::listed::LocatedProblem;
use crate::nastran::bulk::cards_of;
use crate::nastran::grid::Grids;
use crate::nastran::modes::{Modes, Shape};

/// Tables of eigenvalues.
const EIGENVALUES: [&str; 2] = ["LAMA", "LAMAS"];
/// Tables of eigenvectors, first those along the axes of the grid points, then those along the basic ones, which begin with a B.
const EIGENVECTORS: [&str; 8] = ["OUGV1", "OPHIG", "OUG1", "ROUGV1", "BOUGV1", "BOPHIG", "BOUG1", "OUGV1PAT"];
/// Approach of the analysis that finds real modes.
const MODES: i64 = 2;
/// Words of a mode: number, order, eigenvalue, angular frequency, frequency, generalised mass and stiffness.
const MODE: usize = 7;
/// Words of a point: its number, its type, three displacements and three rotations.
const POINT: usize = 8;
/// Type of a grid point.
const GRID: i64 = 1;

/// The real modes of a file, of its first subcase that has some.
pub(crate) fn modes(tape: &Tape) -> Result<Modes, LocatedProblem> {
    let mut modes = Modes::default();
    if let Some(block) = tape.block(&EIGENVALUES) {
        modes.frequencies = of_subcase(tape, block).into_iter().map(|[frequency, _]| frequency).collect();
    }
    for name in EIGENVECTORS {
        let Some(block) = tape.block(&[name]) else { continue };
        modes.shapes = shapes(tape, block)?;
        modes.basic = name.starts_with('B');
        if !modes.shapes.is_empty() {
            break;
        }
    }
    Ok(modes)
}

/// Angular frequencies (rad/s) in the bytes of a file; none of another file, or of one without.
pub(crate) fn frequencies(bytes: &[u8]) -> Vec<f64> {
    let Ok(tape) = Tape::read(bytes) else { return Vec::new() };
    eigenvalues(&tape).into_iter().map(|[frequency, _]| frequency).collect()
}

/// Angular frequency (rad/s) and generalised mass of each mode.
pub(crate) fn eigenvalues(tape: &Tape) -> Vec<[f64; 2]> {
    tape.block(&EIGENVALUES).map(|block| of_subcase(tape, block)).unwrap_or_default()
}

/// Whether the bytes are a file of which nobody can tell whether the deck has PARAM,WTMASS.
pub(crate) fn lacks_parameters(bytes: &[u8]) -> bool {
    Tape::read(bytes).is_ok_and(|tape| tape.block(&PARAMETERS).is_none())
}

/// Records of a table in pairs: what it is about, and its values.
fn pairs<'t>(tape: &'t Tape, block: &'t Block) -> impl Iterator<Item = (Words<'t>, &'t Record)> {
    let tables = block.records.get(1..).unwrap_or_default().chunks_exact(2);
    tables.map(|pair| (tape.words(&pair[0]), &pair[1]))
}

/// Angular frequencies (rad/s) and generalised masses of the first subcase.
fn of_subcase(tape: &Tape, block: &Block) -> Vec<[f64; 2]> {
    let mut modal = pairs(tape, block).filter(|(about, _)| about.integer(0).unwrap_or(0) / 10 == MODES);
    let Some((_, record)) = modal.next() else { return Vec::new() };
    let words = tape.words(record);
    let of = |mode: usize| Some([words.real(mode * MODE + 3)?, words.real(mode * MODE + 5)?]);
    (0..words.len() / MODE).filter_map(of).collect()
}

/// Shapes of the first subcase with real modes.
fn shapes(tape: &Tape, block: &Block) -> Result<Vec<Shape>, LocatedProblem> {
    let (mut shapes, mut subcase) = (Vec::new(), None);
    for (about, record) in pairs(tape, block) {
        let of = |place: usize| about.integer(place).unwrap_or(0);
        // approach and device, subcase, words of a point, and a first word of real numbers by grid points
        let real = of(0) / 10 == MODES && of(9) == POINT as i64 && of(1) < 1000;
        if !real || *subcase.get_or_insert(of(3)) != of(3) {
            continue;
        }
        shapes.push(shape(&tape.words(record))?);
    }
    Ok(shapes)
}

fn shape(words: &Words) -> Result<Shape, LocatedProblem> {
    let mut shape = Shape::default();
    for point in 0..words.len() / POINT {
        let at = point * POINT;
        if words.integer(at + 1) != Some(GRID) {
            continue;
        }
        // the last digit of the number is the device
        let node = words.integer(at).and_then(|key| u64::try_from(key / 10).ok());
        let node = node.ok_or_else(|| {
            let found = words.integer(at).unwrap_or(0).to_string().into();
            (words.at, MatrixProblem::NotANumber { found, row: Row::Op2Point })
        })?;
        for component in 0..6 {
            let value = words.real(at + 2 + component).unwrap_or(0.0);
            shape.values.push((Dof { node, component: component as u8 + 1 }, value));
        }
    }
    Ok(shape)
}

/// Turns shapes along the basic axes to those of the grid points, where the file has grid points with axes of their own.
///
/// # Errors
/// Grid points that cannot be placed.
pub(crate) fn axes(bytes: &[u8], modes: &mut Modes) -> Result<(), LocatedProblem> {
    let Ok(bulk) = bulk(bytes) else { return Ok(()) };
    let mut grids = Grids::default();
    for card in cards_of((1..).zip(bulk.text.lines()), |name| !name.is_empty()) {
        grids.take(&card?)?;
    }
    let own: HashMap<u64, [[f64; 3]; 3]> =
        grids.points()?.iter().filter_map(|point| Some((point.label, point.axes?))).collect();
    for values in modes.shapes.iter_mut().flat_map(|shape| shape.values.chunks_exact_mut(3)) {
        let Some(axes) = own.get(&values[0].0.node) else { continue };
        let basic = [values[0].1, values[1].1, values[2].1];
        for (value, axis) in values.iter_mut().zip(axes) {
            value.1 = dot(*axis, basic);
        }
    }
    modes.basic = false;
    Ok(())
}
