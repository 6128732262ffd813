//! Deck reader: `[[deck]]`, a finite-element model of NASTRAN, Abaqus or CalculiX with its own materials, sections, bodies, links and rigid elements.
//! Units are those of the deck, whose cards have none; what is left out is counted and told first.
//! Equations (K1), (K2) and (I11), docs/theory.

mod elements;
mod elimination;
mod equations;
mod links;
mod nodes;

use std::collections::{HashMap, HashSet};
use std::path::Path;

use quasirigid_body::Rheology;
use quasirigid_elements::{ElasticMaterial, Material, Mixed, Orthotropic, Part, PartKind};
use quasirigid_math::vec3::{add, minus, scale};
use quasirigid_mesh::Cell;

use super::super::key::{Key, Keys, TEXT, key, quantity};
use super::super::reader::{NAME, Reader, Sources};
use super::super::rheology::{Extremes, RHEOLOGY, Scale, rheology};
use super::super::table::Table;
use super::nodal::{LENGTH_UNIT, MASS_UNIT, Units};
use super::placed::{ATTITUDE, POSITION, Placement, placement};
use super::{ATTACH, MASSES, Nodes, RAYLEIGH, Read, attached, masses, rayleigh};
use crate::deck::{BASIC, Cells, DeckModel, OfPly, Stuff};
use crate::matrix::error::MatrixProblem;
use crate::matrix::listed::LocatedProblem;
use crate::text_file::{FileError, bytes_of};
use crate::units::Dimension;
use crate::{inp, nastran};

pub(in crate::model) const READER: Reader = Reader::of_parts(
    "deck",
    "[[deck]]",
    "finite-element model of NASTRAN, Abaqus or CalculiX",
    &DECK,
    |entry, draft| draft.part(entry, deck(entry.table, entry.name, draft.sources)),
);

const FILE: Key = key(
    "file",
    TEXT,
    "bulk data or `.op2` of NASTRAN, `.inp` of Abaqus or CalculiX, with materials and sections",
);
const DENSITY: Key = key("density", quantity("kg/m³"), "of materials without one");
const DECK: Keys = Keys {
    known: &[
        NAME,
        FILE,
        LENGTH_UNIT,
        MASS_UNIT,
        DENSITY,
        POSITION,
        ATTITUDE,
        RHEOLOGY,
        MASSES,
        ATTACH,
        RAYLEIGH,
    ],
};

/// Largest deck (bytes).
const MAX_FILE: u64 = 4 * 1024 * 1024 * 1024;

/// Reads a `[[deck]]`.
pub(super) fn deck(table: &Table<'_>, name: &str, sources: Sources<'_, '_>) -> Option<Read> {
    let (units, placement, damping) = (Units::new(table), placement(table), rayleigh(table));
    let known = table.get("rheology").map(|_| rheology(table, Scale::OF_SPRING));
    let density = table.read_or("density", None, |value| value.positive(Dimension::DENSITY).map(Some));
    let value = table.required("file", "file = \"satellite.bdf\"")?;
    let path = sources.folder.join(value.text()?);
    let refuse = |error: FileError<MatrixProblem>| {
        value.refuse(format!("`file`: {error}"), "cannot be used", "it is looked for beside the model")
    };
    let model = match read(&path) {
        Ok(model) => model,
        Err(error) => return refuse(error),
    };
    let (units, placement) = (units?, placement?);
    let known = match known {
        Some(known) => Some(known?),
        None => None,
    };
    let cells = match model.divided_cells() {
        Ok(cells) => cells,
        Err(fault) => return refuse(model.located(fault)),
    };
    let rheology = known.as_ref().map(|known| known.rheology.clone());
    let mut made = Made::new(model, cells, Given { units, placement, density: density?, rheology });
    let built = made.build().and_then(|()| made.is_body());
    if let Err(fault) = built {
        return refuse(made.deck.located(fault));
    }
    let file = value.words().unwrap_or_default();
    let notes: Vec<String> = made.notes(table).into_iter().map(|note| format!("{file}: {note}")).collect();
    let mixed = made.mixed;
    let nodes = Nodes::of_mesh(&mixed.mesh);
    let (masses, attached) = (masses(table, &nodes), attached(table, &nodes));
    let extremes: Extremes = known.and_then(|known| known.extremes);
    let count = mixed.regions.len()
        + mixed.skins.iter().map(|skin| skin.layers.len()).sum::<usize>()
        + mixed.bars.len();
    let kind = PartKind::Mixed(mixed);
    let part = Part { name: name.to_owned(), kind, masses: masses?, attached: attached?, rayleigh: damping? };
    Some(Read { part, nodes, extremes: vec![extremes; count], notes })
}

fn read(path: &Path) -> Result<DeckModel, FileError<MatrixProblem>> {
    model_of(path, &bytes_of::<MatrixProblem>(path, MAX_FILE)?)
}

fn model_of(path: &Path, bytes: &[u8]) -> Result<DeckModel, FileError<MatrixProblem>> {
    if inp::is_inp(bytes) { inp::read(path, bytes) } else { nastran::model::read(path, bytes) }
}

/// What the deck in the bytes of a file has that is left out or changed, in words.
///
/// # Errors
/// Those of the readers of decks.
#[doc(hidden)]
pub fn deck_notes(path: &Path, bytes: &[u8]) -> Result<Vec<String>, FileError<MatrixProblem>> {
    let model = model_of(path, bytes)?;
    let cells = model.divided_cells().map_err(|fault| model.located(fault))?;
    Ok(model.notes().into_iter().chain(cells.notes()).collect())
}

/// Units and place of a deck, and the rheology of its materials where the model gives it.
struct Given {
    units: Units,
    placement: Placement,
    /// Density (kg/m³) of materials without one.
    density: Option<f64>,
    rheology: Option<Rheology>,
}

/// A part while it is made of a deck.
struct Made {
    deck: DeckModel,
    index: HashMap<u64, usize>,
    /// Cell and number of each solid, and of each plate.
    solids: Vec<(usize, usize)>,
    /// Material and axes of cells that are plies.
    plies: HashMap<usize, OfPly>,
    /// Nodes between two others that they follow, with the share of each.
    tied: Vec<(usize, [(usize, f64); 2])>,
    plates: Vec<(usize, usize)>,
    given: Given,
    mixed: Mixed,
    nodes: Vec<[f64; 3]>,
    labels: Vec<u64>,
    cells: Vec<Cell>,
    /// Nodes that follow others.
    following: HashSet<usize>,
    /// Number of the next node that is put.
    next_label: u64,
    notes: Vec<String>,
}

impl Made {
    fn new(deck: DeckModel, cells: Cells, given: Given) -> Self {
        let notes = cells.notes();
        let Cells { mesh, index, plates, solids, layers, .. } = cells;
        let solids = ends(&solids, plates.iter().map(|(_, cell)| *cell).min().unwrap_or(mesh.cells.len()));
        let solids =
            solids.into_iter().filter(|(cell, _)| mesh.cells[*cell].shape.dimension() == 3).collect();
        let place = |node: &[f64; 3]| given.placement.of(scale(given.units.length, *node));
        let nodes = mesh.nodes.iter().map(place).collect();
        let next_label = mesh.node_labels.iter().max().copied().unwrap_or(0).saturating_add(1);
        let plates = plates.into_iter().map(|(plate, cell)| (cell, plate)).collect();
        Self {
            deck,
            index,
            solids,
            plies: layers.of_cells,
            tied: layers.tied,
            plates,
            given,
            mixed: Mixed::default(),
            nodes,
            labels: mesh.node_labels,
            cells: mesh.cells,
            following: HashSet::new(),
            next_label,
            notes,
        }
    }

    fn build(&mut self) -> Result<(), LocatedProblem> {
        self.regions()?;
        self.skins()?;
        self.bars()?;
        self.couplings()?;
        self.equations()?;
        self.links()?;
        let bodies = self.bodies()?;
        self.finish(bodies);
        Ok(())
    }

    fn of(&self, label: u64, line: usize) -> Result<usize, LocatedProblem> {
        self.index.get(&label).copied().ok_or((line, MatrixProblem::NoGrid { node: label }))
    }

    /// Axes of the displacements of a grid point, in the file's frame.
    fn axes(&self, label: u64, line: usize) -> Result<[[f64; 3]; 3], LocatedProblem> {
        let axes = self.deck.point(label, line)?.axes.unwrap_or(BASIC);
        Ok(axes.map(|axis| self.given.placement.turned(axis)))
    }

    /// Density (kg/m³) of a material of the deck, with mass per volume beside its own.
    fn density(&self, density: f64, extra: f64) -> f64 {
        let own = self.given.density.filter(|_| density == 0.0).unwrap_or_else(|| self.in_kilograms(density));
        own + self.in_kilograms(extra)
    }

    fn in_kilograms(&self, density: f64) -> f64 {
        density * self.deck.mass_factor * self.given.units.mass / self.given.units.length.powi(3)
    }

    /// Material of a property, with mass per volume beside its own.
    fn material(&self, label: u64, extra: f64) -> Result<ElasticMaterial, LocatedProblem> {
        let stuff = self
            .deck
            .materials
            .get(&label)
            .ok_or((0, MatrixProblem::NoCardOf { kind: "material", label }))?;
        let modulus = self.given.units.mass / self.given.units.length;
        let law = |loss: f64| match &self.given.rheology {
            Some(rheology) => rheology.clone(),
            None if loss > 0.0 && loss <= 1.0 => Rheology::QualityFactor { factor: loss.recip() },
            None => Rheology::Elastic,
        };
        Ok(match *stuff {
            Stuff::Isotropic { young, poisson, density, loss } => ElasticMaterial::Isotropic(Material {
                density: self.density(density, extra),
                young: modulus * young,
                poisson,
                rheology: law(loss),
            }),
            Stuff::Orthotropic { young, poisson, shear, density, loss } => {
                ElasticMaterial::Orthotropic(Orthotropic {
                    density: self.density(density, extra),
                    young: young.map(|young| modulus * young),
                    poisson,
                    shear: shear.map(|shear| modulus * shear),
                    rheology: law(loss),
                })
            }
            Stuff::Lamina { young: [e1, e2], poisson, shear: [g12, g13, g23], density, loss } => {
                ElasticMaterial::Orthotropic(Orthotropic {
                    density: self.density(density, extra),
                    young: [e1, e2, e2].map(|young| modulus * young),
                    poisson: [poisson, poisson, 0.0],
                    shear: [g12, g13, g23].map(|shear| modulus * shear),
                    rheology: law(loss),
                })
            }
        })
    }

    /// Name of a material: its own, or its number after the kind of its card.
    fn name_of(&self, kind: &str, label: u64) -> String {
        self.deck.names.get(&label).cloned().unwrap_or_else(|| format!("{kind} {label}"))
    }

    fn isotropic(&self, label: u64, extra: f64) -> Result<Material, LocatedProblem> {
        match self.material(label, extra)? {
            ElasticMaterial::Isotropic(material) => Ok(material),
            ElasticMaterial::Orthotropic(_) => Err((0, MatrixProblem::NoCardOf { kind: "MAT1", label })),
        }
    }
}

/// The vector of components along axes.
fn along(axes: &[[f64; 3]; 3], components: [f64; 3]) -> [f64; 3] {
    (0..3).fold([0.0; 3], |sum, axis| add(sum, scale(components[axis], axes[axis])))
}

/// Cell and number of each cell of solids, which have one cell or more.
fn ends(solids: &[(usize, u64)], end: usize) -> Vec<(usize, usize)> {
    let last = solids.iter().map(|(first, _)| *first).skip(1).chain([end]);
    solids
        .iter()
        .zip(last)
        .enumerate()
        .flat_map(|(number, ((first, _), last))| (*first..last).map(move |cell| (cell, number)))
        .collect()
}

/// Sides (m) of the box around places.
fn box_around(places: &[[f64; 3]]) -> [f64; 3] {
    let bound = |pick: fn(f64, f64) -> f64, from: f64| {
        places.iter().fold([from; 3], |bound, place| [0, 1, 2].map(|axis| pick(bound[axis], place[axis])))
    };
    minus(bound(f64::max, f64::NEG_INFINITY), bound(f64::min, f64::INFINITY))
}
