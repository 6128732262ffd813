//! Finite-element model of a deck of Abaqus or CalculiX. Nodes, elements, sets and instances are those of the mesh reader; here are the
//! cards that make a body of them: materials, sections, bodies, springs and nodes that follow others. A part's cards hold in each of its places.
//! (Abaqus Keywords Reference Guide; CalculiX CrunchiX User's Manual)

mod connectors;
mod couplings;
mod elements;
mod equations;
mod faces;
mod fields;
mod materials;
mod names;
mod orientation;
mod profiles;
mod sections;
mod tie;

use std::collections::HashMap;
use std::path::Path;

use crate::deck::{DeckModel, Point};
use crate::matrix::MatrixProblem;
use crate::matrix::error::MatrixError;
use crate::matrix::listed::LocatedProblem;
use crate::mesh::inp::{Inp, InpCard, OF_BODIES, read_inp};
use orientation::Orientation;
use sections::Section;

/// Cards of materials, sections and the mesh, which are kept beside those of bodies.
const CARRIED: [&str; 25] = [
    "MATERIAL",
    "ELASTIC",
    "DENSITY",
    "DAMPING",
    "ORIENTATION",
    "TRANSFORM",
    "SURFACE",
    "SOLID SECTION",
    "SHELL SECTION",
    "SHELL GENERAL SECTION",
    "NODAL THICKNESS",
    "BEAM SECTION",
    "BEAM GENERAL SECTION",
    "NODE",
    "ELEMENT",
    "NSET",
    "ELSET",
    "PART",
    "INSTANCE",
    "ASSEMBLY",
    "INCLUDE",
    "CONNECTOR SECTION",
    "CONNECTOR BEHAVIOR",
    "CONNECTOR ELASTICITY",
    "CONNECTOR DAMPING",
];

/// Cards that end others, say what to compute or print, and nothing of the body.
const ANALYSIS: [&str; 45] = [
    "HEADING",
    "PREPRINT",
    "STEP",
    "END STEP",
    "END PART",
    "END INSTANCE",
    "END ASSEMBLY",
    "STATIC",
    "FREQUENCY",
    "COMPLEX FREQUENCY",
    "BUCKLE",
    "DYNAMIC",
    "MODAL DYNAMIC",
    "STEADY STATE DYNAMICS",
    "VISCO",
    "HEAT TRANSFER",
    "COUPLED TEMPERATURE-DISPLACEMENT",
    "UNCOUPLED TEMPERATURE-DISPLACEMENT",
    "GREEN",
    "SENSITIVITY",
    "SUBSTRUCTURE GENERATE",
    "SUBSTRUCTURE MATRIX OUTPUT",
    "RETAINED NODAL DOFS",
    "MATRIX ASSEMBLE",
    "NODE PRINT",
    "EL PRINT",
    "NODE FILE",
    "EL FILE",
    "NODE OUTPUT",
    "ELEMENT OUTPUT",
    "CONTACT PRINT",
    "CONTACT FILE",
    "CONTACT OUTPUT",
    "SECTION PRINT",
    "ENERGY PRINT",
    "FACE PRINT",
    "OUTPUT",
    "MONITOR",
    "RESTART",
    "CONTROLS",
    "TIME POINTS",
    "AMPLITUDE",
    "SELECT CYCLIC SYMMETRY MODES",
    "SYSTEM OF UNITS",
    "PARAMETER",
];

/// A deck while it is made into a model.
struct Reader {
    model: DeckModel,
    inp: Inp,
    cards: Vec<InpCard>,
    /// Index of each set of the mesh by its name in capitals.
    sets: HashMap<String, usize>,
    /// Index of each node and cell by its number.
    node_of: HashMap<u64, usize>,
    cell_of: HashMap<u64, usize>,
    /// Number of each material by its name in capitals.
    materials: HashMap<String, u64>,
    orientations: HashMap<String, Orientation>,
    /// Sections, and the index of that of each cell; none where it has none.
    sections: Vec<Section>,
    section_of: Vec<Option<usize>>,
    /// Number of the next property.
    next_property: u64,
}

/// Reads a deck with the files that it includes.
///
/// # Errors
/// [`MatrixError`] says what is wrong, in which file and on which line.
pub(crate) fn read(file: &Path, bytes: &[u8]) -> Result<DeckModel, MatrixError> {
    let mut inp = read_inp(file, bytes, is_carried).map_err(|error| MatrixError {
        file: error.file,
        place: error.place,
        problem: MatrixProblem::Inp(Box::new(error.problem)),
    })?;
    let cards = std::mem::take(&mut inp.cards);
    let places = std::mem::take(&mut inp.places);
    let mut reader = Reader::new(inp, cards);
    let built = reader.build();
    reader.model.places = places;
    match built {
        Ok(()) => Ok(reader.model),
        Err(fault) => Err(reader.model.located(fault)),
    }
}

/// Whether a card makes the body.
fn is_carried(name: &str) -> bool {
    CARRIED.contains(&name) || OF_BODIES.contains(&name)
}

/// Whether a file is a deck of keywords.
pub(crate) fn is_inp(bytes: &[u8]) -> bool {
    bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes).trim_ascii_start().starts_with(b"*")
}

impl Reader {
    fn new(inp: Inp, cards: Vec<InpCard>) -> Self {
        let capitals = |name: &str| name.to_ascii_uppercase();
        let sets = inp.mesh.sets.iter().enumerate().map(|(at, set)| (capitals(&set.name), at)).collect();
        let node_of = inp.mesh.node_labels.iter().enumerate().map(|(at, label)| (*label, at)).collect();
        // both halves of a pyramid have one number: the first one counts
        let cell_of = inp.mesh.cells.iter().enumerate().rev().map(|(at, cell)| (cell.label, at)).collect();
        let section_of = vec![None; inp.mesh.cells.len()];
        Self {
            model: DeckModel::new(),
            inp,
            cards,
            sets,
            node_of,
            cell_of,
            materials: HashMap::new(),
            orientations: HashMap::new(),
            sections: Vec::new(),
            section_of,
            next_property: 1,
        }
    }

    fn build(&mut self) -> Result<(), LocatedProblem> {
        for (name, count) in std::mem::take(&mut self.inp.left_out) {
            self.model.leave_out_all(&name, count);
        }
        for (name, count) in &self.inp.counts {
            if !is_carried(name) && !ANALYSIS.contains(&name.as_str()) {
                self.model.leave_out_all(&format!("*{name}"), *count);
            }
        }
        self.read_orientations()?;
        self.points()?;
        self.read_materials()?;
        self.read_sections()?;
        self.read_elements()?;
        let pyramids = self.inp.mesh.cells.windows(2).filter(|pair| pair[0].label == pair[1].label).count();
        if pyramids > 0 {
            self.model.simplified.insert("pyramids are two tetrahedra each", pyramids);
        }
        self.read_bodies()?;
        self.read_springs()?;
        self.read_connectors()?;
        self.read_couplings()?;
        self.read_ties()?;
        self.read_equations()?;
        Ok(())
    }

    /// The nodes with the axes of their displacements.
    fn points(&mut self) -> Result<(), LocatedProblem> {
        let mesh = &self.inp.mesh;
        let point = |(label, place): (&u64, &[f64; 3])| Point { label: *label, place: *place, axes: None };
        self.model.points = mesh.node_labels.iter().zip(&mesh.nodes).map(point).collect();
        self.model.points.sort_unstable_by_key(|point| point.label);
        self.read_transforms()
    }

    /// Indices of the cards of a name.
    fn cards(&self, names: &'static [&'static str]) -> Vec<usize> {
        (0..self.cards.len()).filter(|at| names.contains(&self.cards[*at].name.as_str())).collect()
    }
}
