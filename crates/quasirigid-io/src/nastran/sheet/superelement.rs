//! External superelements: stiffness and mass between the points of a boundary and the coordinates of modes with the boundary held, as
//! `EXTSEOUT` and `PARAM,EXTOUT` write them to OUTPUT4, as `DMIG` cards or to OUTPUT2. The boundary is held rigidly: its six motions and the
//! modes are left.
//! MSC Nastran Quick Reference Guide, EXTSEOUT and EXTRN.

use std::collections::{BTreeSet, HashMap};
use std::path::Path;

use quasirigid_math::vec3::cross;

use super::{MAX_FILE, Sheet, SheetMode};
use crate::matrix::error::{MatrixError, MatrixProblem, Row};
use crate::matrix::listed::LocatedProblem;
use crate::matrix::{Dof, MatrixFile, Node, matrix_of, nodes_of};
use crate::nastran::bulk::{bulk_lines, cards_of, integer, integer_or};
use crate::nastran::op2;
use crate::text_file::{FileError, Place, bytes_of};

/// Names of a stiffness, the usual ones first; that of the mass has an M in place of the K.
const STIFFNESS: [&str; 4] = ["KXX", "KAAX", "KAA", "KGG"];
/// Force of a rigid motion, relative to the terms that cancel in it, above which the boundary is not free.
const FREE: f64 = 1e-5;
/// Entry between two modes, or a mode and the boundary, relative to the diagonal, above which they are coupled.
const COUPLED: f64 = 1e-5;

pub(super) fn read(file: &Path, bytes: &[u8], nodes: Option<&Path>) -> Result<Sheet, MatrixError> {
    let refuse = |what: &'static str| FileError::new(file)((Place::File, MatrixProblem::Sheet { what }));
    let names = match matrix_of(file, bytes, None) {
        Err(FileError { problem: MatrixProblem::WhichMatrix { names }, .. }) => names,
        Err(error) => return Err(error),
        Ok(_) => return Err(refuse(NO_PAIR)),
    };
    let names: Vec<String> = names.iter().map(|name| name.to_uppercase()).collect();
    let mass_of =
        |name: &str| Some(format!("M{}", name.strip_prefix('K')?)).filter(|mass| names.contains(mass));
    let usual = STIFFNESS.iter().map(|name| (*name).to_owned()).filter(|name| names.contains(name));
    let pair = usual.chain(names.iter().cloned()).find_map(|name| Some((mass_of(&name)?, name)));
    let (mass, stiffness) = pair.ok_or_else(|| refuse(NO_PAIR))?;
    let [stiffness, mass] =
        aligned([matrix_of(file, bytes, Some(&stiffness))?, matrix_of(file, bytes, Some(&mass))?]);
    let own;
    let (places, places_bytes) = match nodes {
        Some(nodes) => {
            own = bytes_of(nodes, MAX_FILE)?;
            (nodes, own.as_slice())
        }
        None if bytes.is_ascii() || op2::Layout::of(bytes).is_some() => (file, bytes),
        None => return Err(refuse(NO_POINTS)),
    };
    let table = nodes_of(places, places_bytes)?;
    let listed = boundary(places_bytes)
        .map_err(|(line, problem)| FileError::new(places)((Place::Line(line), problem)))?;
    let superelement = Superelement::new(&stiffness, &mass, table.nodes(), listed);
    superelement.and_then(|all| all.sheet(&stiffness, &mass)).map_err(refuse)
}

/// Two matrices over the rows of both: cards give a degree of freedom without an entry no row.
fn aligned(matrices: [MatrixFile; 2]) -> [MatrixFile; 2] {
    let [Some(first), Some(second)] = [&matrices[0].labels, &matrices[1].labels] else { return matrices };
    let all: BTreeSet<Dof> = first.iter().chain(second).copied().collect();
    let labels: Vec<Dof> = all.into_iter().collect();
    matrices.map(|matrix| {
        let own = matrix.labels.unwrap_or_default();
        let at = |row: usize| labels.partition_point(|dof| *dof < own[row]);
        let entries = matrix.entries.iter().map(|(i, j, value)| (at(*i), at(*j), *value)).collect();
        MatrixFile { rows: labels.len(), columns: labels.len(), entries, labels: Some(labels.clone()) }
    })
}

/// Degrees of freedom of the rows, by the cards `EXTRN`; none in a file without them.
fn boundary(bytes: &[u8]) -> Result<Vec<Dof>, LocatedProblem> {
    let mut dofs = Vec::new();
    if op2::Layout::of(bytes).is_some() {
        return Ok(dofs);
    }
    let text = String::from_utf8_lossy(bytes);
    let lines = bulk_lines((1..).zip(text.lines()).filter(|(_, line)| line.is_ascii()));
    for card in cards_of(lines, |name| name.eq_ignore_ascii_case("EXTRN")) {
        let card = card?;
        for pair in card.fields_from(2).chunks(2) {
            let &[node, components] = pair else { continue };
            if node.text.is_empty() {
                continue;
            }
            let node = integer(node, Row::Element)?;
            let digits = integer_or(components, 0, Row::Element)?.to_string();
            dofs.extend(digits.bytes().map(|digit| Dof { node, component: digit.saturating_sub(b'0') }));
        }
    }
    Ok(dofs)
}

/// Rows of the boundary, with their displacements in the six rigid motions about the origin, and rows of modes.
struct Superelement {
    /// None for a mode.
    rigid: Vec<Option<[f64; 6]>>,
}

impl Superelement {
    fn new(
        stiffness: &MatrixFile,
        mass: &MatrixFile,
        nodes: &[Node],
        listed: Vec<Dof>,
    ) -> Result<Self, &'static str> {
        let count = stiffness.rows;
        let known: HashMap<u64, &Node> = nodes.iter().map(|node| (node.label, node)).collect();
        let dofs = match (&stiffness.labels, listed) {
            (Some(labels), _) => labels.clone(),
            (None, listed) if !listed.is_empty() => listed,
            (None, _) => {
                let of = |node: &Node| {
                    (1..=6).map(|component| Dof { node: node.label, component }).collect::<Vec<_>>()
                };
                let mut dofs: Vec<Dof> = nodes.iter().flat_map(of).collect();
                dofs.resize(count.max(dofs.len()), Dof { node: 0, component: 0 });
                dofs
            }
        };
        let same = stiffness.labels.is_none() || mass.labels.is_none() || stiffness.labels == mass.labels;
        if [stiffness.columns, mass.rows, mass.columns, dofs.len()] != [count; 4] || !same {
            return Err(OTHER_ROWS);
        }
        let rigid: Vec<Option<[f64; 6]>> = dofs.iter().map(|dof| rigid(&known, *dof)).collect();
        if rigid.iter().all(Option::is_none) {
            return Err(OTHER_ROWS);
        }
        Ok(Self { rigid })
    }

    fn sheet(&self, stiffness: &MatrixFile, mass: &MatrixFile) -> Result<Sheet, &'static str> {
        let diagonal = |matrix: &MatrixFile| {
            let mut diagonal = vec![0.0; self.rigid.len()];
            matrix.entries.iter().filter(|(i, j, _)| i == j).for_each(|(i, _, value)| diagonal[*i] = *value);
            diagonal
        };
        let (k, m) = (diagonal(stiffness), diagonal(mass));
        self.check(stiffness, &k, &m)?;
        self.apart(mass, &m)?;
        let mut rigid = [[0.0; 6]; 6];
        let mut coupling = vec![[0.0; 6]; self.rigid.len()];
        for (i, j, value) in &mass.entries {
            match (&self.rigid[*i], &self.rigid[*j]) {
                (Some(left), Some(right)) => {
                    (0..36).for_each(|at| rigid[at / 6][at % 6] += left[at / 6] * value * right[at % 6]);
                }
                (Some(left), None) => (0..6).for_each(|axis| coupling[*j][axis] += left[axis] * value),
                _ => {}
            }
        }
        // coordinates that no mode took have neither mass nor stiffness
        let taken = (0..self.rigid.len()).filter(|row| self.rigid[*row].is_none() && m[*row] > 0.0);
        let mode = |row: usize| SheetMode {
            frequency: (k[row] / m[row]).sqrt(),
            factors: coupling[row].map(|sum| sum / m[row].sqrt()),
        };
        let mut modes: Vec<SheetMode> = taken.map(mode).collect();
        if modes.is_empty() {
            return Err(NO_MODES);
        }
        if modes.iter().any(|mode| !(mode.frequency > 0.0)) {
            return Err(COUPLED_MODES);
        }
        modes.sort_by(|a, b| a.frequency.total_cmp(&b.frequency));
        Ok(Sheet { rigid, modes })
    }

    /// Refuses a stiffness that resists a rigid motion of the boundary, or couples modes.
    fn check(&self, stiffness: &MatrixFile, k: &[f64], m: &[f64]) -> Result<(), &'static str> {
        self.apart(stiffness, k)?;
        let (mut energy, mut scale) = ([0.0; 6], [0.0; 6]);
        let largest =
            |rows: &mut dyn Iterator<Item = usize>| rows.fold(0.0, |most: f64, row| most.max(k[row].abs()));
        let of_boundary = largest(&mut (0..k.len()).filter(|row| self.rigid[*row].is_some()));
        for (i, j, value) in &stiffness.entries {
            match (&self.rigid[*i], &self.rigid[*j]) {
                (Some(left), Some(right)) => {
                    for axis in 0..6 {
                        energy[axis] += left[axis] * value * right[axis];
                        scale[axis] += (left[axis] * value * right[axis]).abs();
                    }
                }
                (Some(_), None) if value.abs() > COUPLED * (of_boundary * k[*j].abs()).sqrt() => {
                    return Err(COUPLED_MODES);
                }
                _ => {}
            }
        }
        if (0..6).any(|axis| energy[axis].abs() > FREE * scale[axis]) {
            return Err(GROUNDED);
        }
        let massless = (0..k.len()).any(|row| self.rigid[row].is_none() && m[row] < 0.0);
        if massless { Err(COUPLED_MODES) } else { Ok(()) }
    }

    /// Refuses modes that a matrix couples with each other.
    fn apart(&self, matrix: &MatrixFile, diagonal: &[f64]) -> Result<(), &'static str> {
        let coupled = matrix.entries.iter().any(|(i, j, value)| {
            i != j
                && self.rigid[*i].is_none()
                && self.rigid[*j].is_none()
                && value.abs() > COUPLED * (diagonal[*i] * diagonal[*j]).abs().sqrt()
        });
        if coupled { Err(COUPLED_MODES) } else { Ok(()) }
    }
}

/// Displacement or rotation of a degree of freedom in the six rigid motions about the origin; none of one that no point has.
fn rigid(nodes: &HashMap<u64, &Node>, dof: Dof) -> Option<[f64; 6]> {
    let node = nodes.get(&dof.node)?;
    let component = usize::from(dof.component).checked_sub(1).filter(|component| *component < 6)?;
    let mut axis = [0.0; 3];
    axis[component % 3] = 1.0;
    let axis = node.axes.map_or(axis, |axes| axes[component % 3]);
    // the part along the axis of θ × r is θ · (r × axis)
    let (moves, turns) = if component < 3 { (axis, cross(node.place, axis)) } else { ([0.0; 3], axis) };
    Some([moves[0], moves[1], moves[2], turns[0], turns[1], turns[2]])
}

const NO_PAIR: &str = "the file has no stiffness and mass of an external superelement, such as KXX and MXX or KAAX and MAAX, and no \
                       participation factors of MEFFMASS";
const NO_POINTS: &str =
    "the matrices stand without their points; give `nodes`, the .pch or .asm that EXTSEOUT wrote beside them";
const OTHER_ROWS: &str = "the rows of the matrices are not those of the points in `nodes`; give the .pch or .asm that EXTSEOUT wrote beside them";
const NO_MODES: &str = "the superelement has no modes beside its boundary; ask for some by EIGRL, QSET and SPOINT, or read it as [[matrices]]";
const COUPLED_MODES: &str = "the matrices are not those of modes with the boundary held: modes are coupled with each other or by stiffness with \
                             the boundary; reduce by Craig and Bampton (BSET)";
const GROUNDED: &str = "the stiffness resists rigid motions of the boundary: the structure is also held elsewhere, or `nodes` has other places";
