//! Deck reader: `[[deck]]`, a finite-element model of NASTRAN with its own materials, sections, bodies, links and rigid elements.
//! Units are those of the deck, whose cards have none; what is left out is counted and told first.
//! Equations (K1), (K2) and (I11), docs/theory.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::path::Path;
use std::sync::Arc;

use quasirigid_body::Rheology;
use quasirigid_elements::{
    Bar, BarKind, Coupling, ElasticMaterial, Layer, Material, Mixed, NodeBody, NodeLink, Orthotropic, Part,
    PartKind, Region, SectionShape, Skin, Strain, Weighted,
};
use quasirigid_math::vec3::{add, cross, dot, norm, scale};
use quasirigid_mesh::{Cell, Mesh, Shape};

use super::super::key::{Key, Keys, TEXT, key};
use super::super::reader::{NAME, Reader, Sources};
use super::super::rheology::{Extremes, RHEOLOGY, Scale, rheology};
use super::super::table::Table;
use super::nodal::{LENGTH_UNIT, MASS_UNIT, Units};
use super::placed::{ATTITUDE, POSITION, Placement, placement};
use super::{ATTACH, MASSES, Nodes, RAYLEIGH, Read, attached, masses, rayleigh};
use crate::matrix::error::MatrixProblem;
use crate::matrix::listed::LocatedProblem;
use crate::nastran::model::{
    Bending, Bush, Cells, DeckModel, Line, Mean, Plate, Plating, RodSection, Scalar, SpringEnd, Stiff, Stuff,
    Tip, Up,
};
use crate::text_file::{FileError, bytes_of};

pub(in crate::model) const READER: Reader =
    Reader::of_parts("deck", "[[deck]]", "finite-element model of NASTRAN", &DECK, |entry, draft| {
        draft.part(entry, deck(entry.table, entry.name, draft.sources))
    });

const FILE: Key = key("file", TEXT, "bulk data of NASTRAN, with its materials and sections");
const DECK: Keys = Keys {
    known: &[NAME, FILE, LENGTH_UNIT, MASS_UNIT, POSITION, ATTITUDE, RHEOLOGY, MASSES, ATTACH, RAYLEIGH],
};

/// Largest deck (bytes).
const MAX_FILE: u64 = 4 * 1024 * 1024 * 1024;
/// Share of the greatest moment that a section has where its card gives none.
const NO_MOMENT: f64 = 1e-6;

/// Reads a `[[deck]]`.
pub(super) fn deck(table: &Table<'_>, name: &str, sources: Sources<'_, '_>) -> Option<Read> {
    let (units, placement, damping) = (Units::new(table), placement(table), rayleigh(table));
    let known = table.get("rheology").map(|_| rheology(table, Scale::OF_SPRING));
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
    let cells = match model.cells() {
        Ok(cells) => cells,
        Err(fault) => return refuse(model.located(fault)),
    };
    let rheology = known.as_ref().map(|known| known.rheology.clone());
    let mut made = Made::new(model, cells, Given { units, placement, rheology });
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
    DeckModel::read(path, &bytes_of::<MatrixProblem>(path, MAX_FILE)?)
}

/// Units and place of a deck, and the rheology of its materials where the model gives it.
struct Given {
    units: Units,
    placement: Placement,
    rheology: Option<Rheology>,
}

/// A part while it is made of a deck.
struct Made {
    deck: DeckModel,
    index: HashMap<u64, usize>,
    /// Cell and property of each solid, and cell and number of each plate.
    solids: Vec<(usize, u64)>,
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
        let Cells { mesh, index, plates, solids, .. } = cells;
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
        let axes = self.deck.point(label, line)?.axes.unwrap_or(UNIT);
        Ok(axes.map(|axis| self.given.placement.turned(axis)))
    }

    /// Density (kg/m³) of one in the deck.
    fn density(&self, density: f64) -> f64 {
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
                density: self.density(density + extra),
                young: modulus * young,
                poisson,
                rheology: law(loss),
            }),
            Stuff::Lamina { young: [e1, e2], poisson, shear: [g12, g13, g23], density, loss } => {
                ElasticMaterial::Orthotropic(Orthotropic {
                    density: self.density(density + extra),
                    young: [e1, e2, e2].map(|young| modulus * young),
                    poisson: [poisson, poisson, 0.0],
                    shear: [g12, g13, g23].map(|shear| modulus * shear),
                    rheology: law(loss),
                })
            }
        })
    }

    fn isotropic(&self, label: u64, extra: f64) -> Result<Material, LocatedProblem> {
        match self.material(label, extra)? {
            ElasticMaterial::Isotropic(material) => Ok(material),
            ElasticMaterial::Orthotropic(_) => Err((0, MatrixProblem::NoCardOf { kind: "MAT1", label })),
        }
    }

    fn regions(&mut self) -> Result<(), LocatedProblem> {
        let mut cells: BTreeMap<u64, Vec<usize>> = BTreeMap::new();
        for (cell, property) in &self.solids {
            let no = (0, MatrixProblem::NoCardOf { kind: "property", label: *property });
            let material = self.deck.of_solids.get(property).ok_or(no)?;
            cells.entry(*material).or_default().push(*cell);
        }
        for (label, cells) in cells {
            let material = ElasticMaterial::Isotropic(self.isotropic(label, 0.0)?);
            self.mixed.regions.push(Region { cells, name: format!("MAT1 {label}"), material, axes: UNIT });
        }
        Ok(())
    }

    fn skins(&mut self) -> Result<(), LocatedProblem> {
        // Plates of one property whose own numbers are equal to the bit are one skin: the first of them, and their cells.
        let mut groups: BTreeMap<_, (usize, Vec<usize>)> = BTreeMap::new();
        for (cell, plate) in &self.plates {
            let Plate { property, angle, offset, reference, thickness, .. } = &self.deck.plates[*plate];
            let own = [*angle, *offset, thickness.unwrap_or(0.0)].map(f64::to_bits);
            let bits = (*property, own, reference.map(|axis| axis.map(f64::to_bits)));
            groups.entry(bits).or_insert_with(|| (*plate, Vec::new())).1.push(*cell);
        }
        for (plate, cells) in groups.into_values() {
            let Plate { property, angle, offset, reference, thickness: own, .. } = &self.deck.plates[plate];
            let no = (0, MatrixProblem::NoCardOf { kind: "property", label: *property });
            let Plating { layers, bottom, extra } = self.deck.of_plates.get(property).ok_or(no)?;
            let sum: f64 = layers.iter().map(|layer| layer.thickness).sum();
            let single = own.filter(|_| layers.len() == 1);
            let thickness = single.unwrap_or(sum);
            let length = self.given.units.length;
            let spread = if thickness > 0.0 { extra / thickness } else { 0.0 };
            let middle = bottom.map_or(*offset, |bottom| offset + bottom + 0.5 * thickness);
            let reference = reference.map(|axis| self.given.placement.turned(axis));
            let layer = |layer: &crate::nastran::model::Ply| -> Result<Layer, LocatedProblem> {
                Ok(Layer {
                    name: format!("MAT {}", layer.material),
                    material: self.material(layer.material, spread)?,
                    thickness: length * single.unwrap_or(layer.thickness),
                    angle: (layer.angle + angle).to_radians(),
                })
            };
            let layers = layers.iter().map(layer).collect::<Result<Vec<_>, _>>()?;
            self.mixed.skins.push(Skin { cells, layers, reference, offset: length * middle });
        }
        Ok(())
    }

    fn bars(&mut self) -> Result<(), LocatedProblem> {
        for index in 0..self.deck.beams.len() {
            self.beam(index)?;
        }
        for index in 0..self.deck.rods.len() {
            let Line { property, ends: [a, b], line, .. } = self.deck.rods[index];
            let no = (line, MatrixProblem::NoCardOf { kind: "property", label: property });
            let RodSection { material, area, extra } = *self.deck.of_rods.get(&property).ok_or(no)?;
            let material_label = material;
            let material = self.isotropic(material, if area > 0.0 { extra / area } else { 0.0 })?;
            let ends = [self.of(a, line)?, self.of(b, line)?];
            if self.nodes[ends[0]] == self.nodes[ends[1]] || !(area > 0.0) {
                self.deck.leave_out("rods without length or area");
                continue;
            }
            let area = area * self.given.units.length.powi(2);
            let name = format!("MAT1 {material_label}");
            self.mixed.bars.push(Bar { ends, kind: BarKind::Rod { area }, name, material });
        }
        Ok(())
    }

    fn beam(&mut self, index: usize) -> Result<(), LocatedProblem> {
        let Line { property, ends: labels, up, offsets, released, line, .. } = self.deck.beams[index];
        let no = (line, MatrixProblem::NoCardOf { kind: "property", label: property });
        let bending = *self.deck.of_beams.get(&property).ok_or(no)?;
        let Bending { material, area, extra, .. } = bending;
        let name = format!("MAT1 {material}");
        let material = self.isotropic(material, if area > 0.0 { extra / area } else { 0.0 })?;
        let mut ends = [self.of(labels[0], line)?, self.of(labels[1], line)?];
        let length = self.given.units.length;
        let first_axes = self.axes(labels[0], line)?;
        let start = self.nodes[ends[0]];
        let direction = match up {
            Some(Up::Vector(vector)) => Some(along(&first_axes, vector)),
            Some(Up::Point(label)) => {
                let point = self.of(label, line)?;
                Some(add(self.nodes[point], scale(-1.0, start)))
            }
            None => None,
        };
        let mut places = ends.map(|end| self.nodes[end]);
        for (end, offset) in offsets.iter().enumerate() {
            let axes = self.axes(labels[end], line)?;
            places[end] = add(places[end], scale(length, along(&axes, *offset)));
        }
        let axis = add(places[1], scale(-1.0, places[0]));
        if !(norm(axis) > 0.0) {
            self.deck.leave_out("beams of no length");
            return Ok(());
        }
        let x = scale(norm(axis).recip(), axis);
        let up = direction.filter(|up| norm(cross(x, *up)) > 1e-9 * norm(*up));
        if up.is_none() && direction.is_some() {
            self.deck.simplify("beams along their own orientation have the nearest axis across");
        }
        let up = up.unwrap_or_else(|| {
            let least = (0..3).min_by(|a, b| x[*a].abs().total_cmp(&x[*b].abs())).unwrap_or(0);
            UNIT[least]
        });
        let z = cross(x, up);
        let z = scale(norm(z).recip(), z);
        let y = cross(z, x);
        for end in 0..2 {
            let free = released_axes(released[end], [x, y, z]);
            if released[end].to_string().bytes().any(|digit| (b'1'..=b'3').contains(&digit)) {
                self.deck.simplify("beams whose ends slide (pin flags 1 to 3) do not slide");
            }
            if offsets[end] != [0.0; 3] || !free.is_empty() {
                let node = self.new_node(places[end]);
                self.mixed.couplings.push(Coupling::Rigid { node, base: ends[end], free });
                ends[end] = node;
            }
        }
        let kind = self.section(&bending, y, z);
        self.mixed.bars.push(Bar { ends, kind, name, material });
        Ok(())
    }

    /// Section in principal axes.
    fn section(&mut self, bending: &Bending, y: [f64; 3], z: [f64; 3]) -> BarKind {
        let Bending { area, moments: [first, second, product], torsion, shear, .. } = *bending;
        let length = self.given.units.length;
        let area_si = area * length.powi(2);
        if first.max(second).max(torsion) <= 0.0 {
            self.deck.simplify("beams without moments are rods");
            return BarKind::Rod { area: area_si };
        }
        let angle = 0.5 * (2.0 * product).atan2(first - second);
        let (mean, half) = (0.5 * (first + second), (0.5 * (first - second)).hypot(product));
        let (sin, cos) = if product == 0.0 { (0.0, 1.0) } else { angle.sin_cos() };
        let [first, second] = if product == 0.0 { [first, second] } else { [mean + half, mean - half] };
        let least = NO_MOMENT * first.max(second).max(torsion);
        if first.min(second).min(torsion) < least {
            self.deck.simplify("beams without a moment of bending or twist have a millionth of the greatest");
        }
        let [second_z, second_y, torsion] =
            [first, second, torsion].map(|moment| moment.max(least) * length.powi(4));
        let shear = shear.map(|[one, two]| [one * area_si, two * area_si]);
        let section = SectionShape::General { area: area_si, second_y, second_z, torsion, shear };
        BarKind::Beam { section, up: Some(add(scale(cos, y), scale(sin, z))) }
    }

    fn new_node(&mut self, place: [f64; 3]) -> usize {
        self.labels.push(self.next_label);
        self.next_label = self.next_label.saturating_add(1);
        self.nodes.push(place);
        self.following.insert(self.nodes.len() - 1);
        self.nodes.len() - 1
    }

    fn couplings(&mut self) -> Result<(), LocatedProblem> {
        let turned = Mixed { mesh: self.mesh(), ..self.mixed.clone() }.turned();
        for index in 0..self.deck.stiff.len() {
            let Stiff { base, components, line, .. } = self.deck.stiff[index];
            if components[..3] != [true; 3] {
                self.deck.leave_out("rigid elements in some of the displacements");
                continue;
            }
            let base = self.of(base, line)?;
            for label in self.deck.stiff[index].nodes.clone() {
                let node = self.of(label, line)?;
                let axes = self.axes(label, line)?;
                let turns = turned.get(node).copied().unwrap_or(false);
                let free =
                    (0..3).filter(|axis| turns && !components[3 + axis]).map(|axis| axes[axis]).collect();
                if node != base {
                    self.follow(Coupling::Rigid { node, base, free });
                }
            }
        }
        for index in 0..self.deck.means.len() {
            let Mean { node, components, line, .. } = self.deck.means[index];
            if components[..3] != [true; 3] {
                self.deck.leave_out("RBE3 in some of the displacements");
                continue;
            }
            let node = self.of(node, line)?;
            let mut others = Vec::new();
            for other in 0..self.deck.means[index].others.len() {
                let (weight, which, labels) = self.deck.means[index].others[other].clone();
                for label in labels {
                    let axes = self.axes(label, line)?;
                    let at = self.of(label, line)?;
                    let turns = turned.get(at).copied().unwrap_or(false);
                    let of = |first: usize| -> Vec<[f64; 3]> {
                        (0..3).filter(|axis| which[first + axis]).map(|axis| axes[axis]).collect()
                    };
                    let rotations = if turns { of(3) } else { Vec::new() };
                    let weighted = Weighted { node: at, weight, displacements: of(0), rotations };
                    if at != node && weight > 0.0 {
                        others.push(weighted);
                    }
                }
            }
            self.follow(Coupling::Mean { node, others });
        }
        Ok(())
    }

    /// Adds a coupling of a node that does not follow yet.
    fn follow(&mut self, coupling: Coupling) {
        if !self.following.insert(coupling.node()) {
            self.deck.leave_out("rigid elements of a point that follows another one already");
        } else {
            self.mixed.couplings.push(coupling);
        }
    }

    fn links(&mut self) -> Result<(), LocatedProblem> {
        for index in 0..self.deck.springs.len() {
            let Scalar { ends, ref law, line } = self.deck.springs[index];
            let law = match law {
                Ok(law) => *law,
                Err(label) => {
                    let no = (line, MatrixProblem::NoCardOf { kind: "property", label: *label });
                    *self.deck.of_springs.get(label).ok_or(no)?
                }
            };
            let [Some(from), Some(to)] = ends else {
                self.deck.leave_out("springs to the ground");
                continue;
            };
            if [from, to]
                .iter()
                .any(|end| !self.index.contains_key(&end.node) || !(1..=6).contains(&end.component))
            {
                self.deck.leave_out("springs of scalar points");
                continue;
            }
            let shares = [self.shares(from, -1.0, line)?, self.shares(to, 1.0, line)?];
            let nodes = [self.of(from.node, line)?, self.of(to.node, line)?];
            if nodes[0] == nodes[1] {
                self.deck.leave_out("springs between components of one point");
                continue;
            }
            let [stiffness, damping] = law.map(|value| value * self.given.units.mass);
            self.mixed.links.push(NodeLink { nodes, strains: vec![Strain { shares, stiffness, damping }] });
        }
        for index in 0..self.deck.bushes.len() {
            self.bush(index)?;
        }
        Ok(())
    }

    /// Shares of the six components of a node in the strain of a scalar spring; a rotation counts in units of the deck's length.
    fn shares(&self, end: SpringEnd, sign: f64, line: usize) -> Result<[f64; 6], LocatedProblem> {
        let axes = self.axes(end.node, line)?;
        let (first, axis) = ((end.component as usize - 1) / 3 * 3, (end.component as usize - 1) % 3);
        let unit = if first == 3 { self.given.units.length } else { 1.0 };
        let mut shares = [0.0; 6];
        for (along, share) in axes[axis].iter().enumerate() {
            shares[first + along] = sign * unit * share;
        }
        Ok(shares)
    }

    fn bush(&mut self, index: usize) -> Result<(), LocatedProblem> {
        let Bush { property, ends: labels, up, system, share, line } = self.deck.bushes[index];
        if labels[1] == 0 {
            self.deck.leave_out("CBUSH to the ground");
            return Ok(());
        }
        let no = (line, MatrixProblem::NoCardOf { kind: "property", label: property });
        let laws = *self.deck.of_bushes.get(&property).ok_or(no)?;
        let nodes = [self.of(labels[0], line)?, self.of(labels[1], line)?];
        let places = nodes.map(|node| self.nodes[node]);
        let between = add(places[1], scale(-1.0, places[0]));
        let axes = match system {
            Some(system) => {
                let place = self.deck.point(labels[0], line)?.place;
                self.deck.axes_of(system, place, line)?.map(|axis| self.given.placement.turned(axis))
            }
            None if norm(between) > 0.0 => {
                let first_axes = self.axes(labels[0], line)?;
                let up = match up {
                    Some(Up::Vector(vector)) => along(&first_axes, vector),
                    Some(Up::Point(label)) => add(self.nodes[self.of(label, line)?], scale(-1.0, places[0])),
                    None => UNIT[0],
                };
                let x = scale(norm(between).recip(), between);
                let z = cross(x, up);
                let z = if norm(z) > 1e-9 * norm(up) { z } else { cross(x, across(x)) };
                let z = scale(norm(z).recip(), z);
                [x, cross(z, x), z]
            }
            None => {
                self.deck.simplify("CBUSH between points at one place without CID has the basic axes");
                UNIT.map(|axis| self.given.placement.turned(axis))
            }
        };
        let centre = add(places[0], scale(share, between));
        let [mass, length] = [self.given.units.mass, self.given.units.length];
        let mut strains = Vec::new();
        for component in 0..6 {
            let axis = axes[component % 3];
            let unit = if component < 3 { mass } else { mass * length * length };
            let [stiffness, damping] = [0, 1].map(|law| unit * laws[law][component]);
            if stiffness == 0.0 && damping == 0.0 {
                continue;
            }
            let mut shares = [[0.0; 6]; 2];
            for (end, sign) in [(0, -1.0), (1, 1.0)] {
                let arm = add(centre, scale(-1.0, places[end]));
                let (along, about) = if component < 3 { (axis, cross(arm, axis)) } else { ([0.0; 3], axis) };
                for k in 0..3 {
                    shares[end][k] = sign * along[k];
                    shares[end][3 + k] = sign * about[k];
                }
            }
            strains.push(Strain { shares, stiffness, damping });
        }
        if !strains.is_empty() {
            self.mixed.links.push(NodeLink { nodes, strains });
        }
        Ok(())
    }

    /// Bodies, which need nodes that something holds.
    fn bodies(&mut self) -> Result<Vec<NodeBody>, LocatedProblem> {
        let mut bodies = Vec::new();
        let [mass_unit, length] = [self.given.units.mass * self.deck.mass_factor, self.given.units.length];
        for tip in &self.deck.tips {
            let Tip { node, mass, offset, inertia, line, .. } = *tip;
            let node = self.of(node, line)?;
            let offset = scale(length, self.given.placement.turned(offset));
            let columns = UNIT.map(|axis| self.given.placement.turned(axis));
            let turned: [[f64; 3]; 3] = std::array::from_fn(|i| {
                std::array::from_fn(|j| {
                    let sum: f64 =
                        (0..9).map(|k| columns[k / 3][i] * inertia[k / 3][k % 3] * columns[k % 3][j]).sum();
                    mass_unit * length * length * sum
                })
            });
            bodies.push(NodeBody { node, mass: mass_unit * mass, offset, inertia: turned });
        }
        Ok(bodies)
    }

    fn mesh(&self) -> Arc<Mesh> {
        Arc::new(Mesh {
            nodes: self.nodes.clone(),
            node_labels: self.labels.clone(),
            cells: self.cells.clone(),
            sets: Vec::new(),
        })
    }

    /// Refuses a deck without elements or without mass.
    fn is_body(&self) -> Result<(), LocatedProblem> {
        let Mixed { mesh, regions, skins, bars, bodies, .. } = &self.mixed;
        if mesh.cells.is_empty() && bodies.is_empty() {
            return Err((0, MatrixProblem::NoElements));
        }
        let layers = skins.iter().flat_map(|skin| &skin.layers);
        let materials =
            regions.iter().map(|region| &region.material).chain(layers.map(|layer| &layer.material));
        let heavy = materials.map(ElasticMaterial::density).any(|density| density > 0.0)
            || bars.iter().any(|bar| bar.material.density > 0.0)
            || !bodies.is_empty();
        if heavy { Ok(()) } else { Err((0, MatrixProblem::NoMass)) }
    }

    /// Takes the bodies that something holds, and leaves out the nodes that belong to nothing.
    fn finish(&mut self, bodies: Vec<NodeBody>) {
        let turned = {
            let mixed = Mixed { mesh: self.mesh(), ..self.mixed.clone() };
            mixed.turned()
        };
        let mut used = vec![false; self.nodes.len()];
        for cell in self.cells.iter().filter(|cell| cell.shape.dimension() > 1) {
            cell.nodes.iter().for_each(|node| used[*node] = true);
        }
        self.mixed.bars.iter().flat_map(|bar| bar.ends).for_each(|node| used[node] = true);
        self.mixed.links.iter().flat_map(|link| link.nodes).for_each(|node| used[node] = true);
        for coupling in &self.mixed.couplings {
            used[coupling.node()] = true;
            match coupling {
                Coupling::Rigid { base, .. } => used[*base] = true,
                Coupling::Mean { others, .. } => others.iter().for_each(|other| used[other.node] = true),
            }
        }
        let mut kept = Vec::new();
        for mut body in bodies {
            if !used[body.node] || !(body.mass > 0.0) {
                let what = if used[body.node] { "CONM2 without mass" } else { "CONM2 that nothing holds" };
                self.deck.leave_out(what);
                continue;
            }
            if !turned[body.node] && (body.offset != [0.0; 3] || body.inertia != [[0.0; 3]; 3]) {
                self.deck
                    .simplify("CONM2 on points without rotations have no offset and no moments of inertia");
                (body.offset, body.inertia) = ([0.0; 3], [[0.0; 3]; 3]);
            }
            kept.push(body);
        }
        self.mixed.bodies = kept;
        let loose = used.iter().filter(|used| !**used).count();
        if loose > 0 {
            self.notes.push(format!("grid points that belong to no element are kept aside ({loose})"));
        }
        self.renumber(&used);
    }

    /// Leaves out the nodes that are not used.
    fn renumber(&mut self, used: &[bool]) {
        let mut next = 0;
        let place: Vec<usize> = used
            .iter()
            .map(|used| {
                let here = next;
                next += usize::from(*used);
                here
            })
            .collect();
        let keep = |index: &usize| used[*index];
        let nodes = (0..used.len()).filter(keep).map(|node| self.nodes[node]).collect();
        let node_labels = (0..used.len()).filter(keep).map(|node| self.labels[node]).collect();
        let mixed = &mut self.mixed;
        for bar in &mut mixed.bars {
            bar.ends = bar.ends.map(|node| place[node]);
        }
        for body in &mut mixed.bodies {
            body.node = place[body.node];
        }
        for link in &mut mixed.links {
            link.nodes = link.nodes.map(|node| place[node]);
        }
        for coupling in &mut mixed.couplings {
            match coupling {
                Coupling::Rigid { node, base, .. } => (*node, *base) = (place[*node], place[*base]),
                Coupling::Mean { node, others } => {
                    *node = place[*node];
                    others.iter_mut().for_each(|other| other.node = place[other.node]);
                }
            }
        }
        // Lines of the deck are bars, between nodes of their own where they have offsets: they are drawn as such.
        let mut cells: Vec<Cell> = Vec::new();
        for cell in self.cells.iter().filter(|cell| cell.shape.dimension() > 1) {
            let nodes = cell.nodes.iter().map(|node| place[*node]).collect();
            cells.push(Cell { label: cell.label, shape: cell.shape, nodes });
        }
        if cells.is_empty() {
            let line = |(number, bar): (u64, &Bar)| Cell {
                label: number,
                shape: Shape::Line2,
                nodes: bar.ends.into(),
            };
            cells.extend((1..).zip(&mixed.bars).map(line));
        }
        let mut mesh = Mesh { nodes, node_labels, cells, sets: Vec::new() };
        let turned = mesh.turn_right_side_out();
        if turned > 0 {
            self.notes.push(format!(
                "cells inside out are turned, their nodes in the order of their shape ({turned})"
            ));
        }
        mixed.mesh = Arc::new(mesh);
    }

    /// What is left out or changed, and the size that the units give.
    fn notes(&mut self, table: &Table<'_>) -> Vec<String> {
        let mut notes = self.deck.notes();
        notes.append(&mut self.notes);
        if self.deck.mass_factor != 1.0 {
            notes.push(format!("masses are multiplied by PARAM,WTMASS = {}", self.deck.mass_factor));
        }
        if table.get("length_unit").is_none() || table.get("mass_unit").is_none() {
            let bound = |pick: fn(f64, f64) -> f64, from: f64| {
                let nodes = self.mixed.mesh.nodes.iter();
                nodes.fold([from; 3], |bound, node| [0, 1, 2].map(|axis| pick(bound[axis], node[axis])))
            };
            let (low, high) = (bound(f64::min, f64::INFINITY), bound(f64::max, f64::NEG_INFINITY));
            let [x, y, z] = [0, 1, 2].map(|axis| high[axis] - low[axis]);
            notes.push(format!(
                "taken in metres and kilograms where `length_unit` and `mass_unit` say nothing: {x:.3} by {y:.3} by {z:.3} m"
            ));
        }
        notes
    }
}

const UNIT: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// The vector of components along axes.
fn along(axes: &[[f64; 3]; 3], components: [f64; 3]) -> [f64; 3] {
    (0..3).fold([0.0; 3], |sum, axis| add(sum, scale(components[axis], axes[axis])))
}

/// Axis that is the least parallel to a unit vector.
fn across(unit: [f64; 3]) -> [f64; 3] {
    let least = (0..3).min_by(|a, b| dot(UNIT[*a], unit).abs().total_cmp(&dot(UNIT[*b], unit).abs()));
    UNIT[least.unwrap_or(0)]
}

/// Axes about which the end of a beam turns freely, from the digits of its pin flags.
fn released_axes(flags: u64, axes: [[f64; 3]; 3]) -> Vec<[f64; 3]> {
    let digits = flags.to_string();
    (0..3).filter(|axis| digits.as_bytes().contains(&(b'4' + *axis as u8))).map(|axis| axes[axis]).collect()
}

/// Cell and property of each cell of solids, which have one cell or two.
fn ends(solids: &[(usize, u64)], end: usize) -> Vec<(usize, u64)> {
    let last = solids.iter().map(|(first, _)| *first).skip(1).chain([end]);
    solids
        .iter()
        .zip(last)
        .flat_map(|((first, property), last)| (*first..last).map(move |cell| (cell, *property)))
        .collect()
}
