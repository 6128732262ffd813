//! Solids, shells, beams and rods of a deck.

use std::collections::BTreeMap;

use quasirigid_elements::{
    Bar, BarKind, Coupling, ElasticMaterial, Layer, Material, Region, SectionShape, Skin,
};
use quasirigid_math::vec3::{add, cross, minus, norm, scale, unit};

use super::{Made, along};
use crate::deck::{BASIC, Line, Piece, Plate, Plating, Ply, RodSection, Station, Stuff, Up, across};
use crate::matrix::error::MatrixProblem;
use crate::matrix::listed::LocatedProblem;

/// Material, axes and cells of a region.
type Solids = (u64, [[f64; 3]; 3], Vec<usize>);

/// Share of the greatest moment that a section has where its card gives none.
const NO_MOMENT: f64 = 1e-6;

impl Made {
    pub(super) fn regions(&mut self) -> Result<(), LocatedProblem> {
        // Solids of one material with equal axes, to the bit, are one region.
        let mut regions: BTreeMap<_, Solids> = BTreeMap::new();
        for (cell, solid) in &self.solids {
            let property = self.deck.solids[*solid].property;
            let (material, given) = match self.plies.get(cell) {
                Some((material, axes)) => (*material, Some(*axes)),
                None => {
                    let no = (0, MatrixProblem::NoCardOf { kind: "property", label: property });
                    let of_property = self.deck.axes_of_solids.get(&property);
                    let axes = self.deck.axes_at_solids.get(solid).or(of_property);
                    (*self.deck.of_solids.get(&property).ok_or(no)?, axes.copied())
                }
            };
            let isotropic = matches!(self.deck.materials.get(&material), Some(Stuff::Isotropic { .. }));
            let axes = given.filter(|_| !isotropic).unwrap_or(BASIC);
            let bits = (material, axes.map(|axis| axis.map(f64::to_bits)));
            regions.entry(bits).or_insert_with(|| (material, axes, Vec::new())).2.push(*cell);
        }
        for (label, axes, cells) in regions.into_values() {
            let material = match self.material(label, 0.0)? {
                ElasticMaterial::Orthotropic(_) if self.is_lamina(label) => {
                    return Err((0, MatrixProblem::NoCardOf { kind: "solid material", label }));
                }
                material => material,
            };
            let axes = axes.map(|axis| self.given.placement.turned(axis));
            let name = self.name_of("MAT1", label);
            self.mixed.regions.push(Region { cells, name, material, axes, grading: None });
        }
        Ok(())
    }

    /// Whether a material has constants of a ply alone.
    fn is_lamina(&self, label: u64) -> bool {
        matches!(self.deck.materials.get(&label), Some(Stuff::Lamina { .. }))
    }

    pub(super) fn skins(&mut self) -> Result<(), LocatedProblem> {
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
            let layer = |layer: &Ply| -> Result<Layer, LocatedProblem> {
                Ok(Layer {
                    name: self.name_of("MAT", layer.material),
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

    pub(super) fn bars(&mut self) -> Result<(), LocatedProblem> {
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
            let name = self.name_of("MAT1", material_label);
            self.mixed.bars.push(Bar { ends, kind: BarKind::Rod { area }, name, material });
        }
        Ok(())
    }

    fn beam(&mut self, index: usize) -> Result<(), LocatedProblem> {
        let Line { property, ends: labels, up, offsets, released, line, .. } = self.deck.beams[index];
        let no = (line, MatrixProblem::NoCardOf { kind: "property", label: property });
        let bending = self.deck.of_beams.get(&property).ok_or(no)?;
        let (material, shear, pieces) = (bending.material, bending.shear, bending.pieces());
        let name = self.name_of("MAT1", material);
        let material = self.isotropic(material, 0.0)?;
        let mut ends = [self.of(labels[0], line)?, self.of(labels[1], line)?];
        let length = self.given.units.length;
        let first_axes = self.axes(labels[0], line)?;
        let start = self.nodes[ends[0]];
        let direction = match up {
            Some(Up::Vector(vector)) => Some(along(&first_axes, vector)),
            Some(Up::Basic(vector)) => Some(self.given.placement.turned(vector)),
            Some(Up::Point(label)) => {
                let point = self.of(label, line)?;
                Some(minus(self.nodes[point], start))
            }
            None => None,
        };
        let mut places = ends.map(|end| self.nodes[end]);
        for (end, offset) in offsets.iter().enumerate() {
            let axes = self.axes(labels[end], line)?;
            places[end] = add(places[end], scale(length, along(&axes, *offset)));
        }
        let axis = minus(places[1], places[0]);
        if !(norm(axis) > 0.0) {
            self.deck.leave_out("beams of no length");
            return Ok(());
        }
        let x = unit(axis);
        let up = direction.filter(|up| norm(cross(x, *up)) > 1e-9 * norm(*up));
        if up.is_none() && direction.is_some() {
            self.deck.simplify("beams along their own orientation have the nearest axis across");
        }
        let up = up.unwrap_or_else(|| across(x));
        let z = cross(x, up);
        let z = unit(z);
        let y = cross(z, x);
        for end in 0..2 {
            let free = released_axes(released[end], [x, y, z]);
            if released[end].to_string().bytes().any(|digit| (b'1'..=b'3').contains(&digit)) {
                self.deck.simplify("beams whose ends slide (pin flags 1 to 3) do not slide");
            }
            if offsets[end] != [0.0; 3] || !free.is_empty() {
                let node = self.new_node(places[end]);
                self.following.insert(node);
                self.mixed.couplings.push(Coupling::Rigid { node, base: ends[end], free });
                ends[end] = node;
            }
        }
        if pieces.len() > 1 {
            self.deck.simplify("tapered beams are divided into pieces of one section each");
        }
        let mut from = ends[0];
        for (left, Piece { end, section, heavy }) in (0..pieces.len()).rev().zip(pieces) {
            let inner = add(scale(1.0 - end, places[0]), scale(end, places[1]));
            let to = if left == 0 { ends[1] } else { self.new_node(inner) };
            let kind = self.section(&section, shear, [y, z]);
            let share = |part: f64| if section.area > 0.0 { part / section.area } else { 0.0 };
            let density = material.density * share(heavy[0]) + self.in_kilograms(share(heavy[1]));
            let material = Material { density, ..material.clone() };
            self.mixed.bars.push(Bar { ends: [from, to], kind, name: name.clone(), material });
            from = to;
        }
        Ok(())
    }

    /// Section in principal axes.
    fn section(&mut self, section: &Station, shear: Option<[f64; 2]>, [y, z]: [[f64; 3]; 2]) -> BarKind {
        let Station { area, moments: [first, second, product], torsion, .. } = *section;
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
        self.nodes.len() - 1
    }
}

/// Axes about which the end of a beam turns freely, from the digits of its pin flags.
fn released_axes(flags: u64, axes: [[f64; 3]; 3]) -> Vec<[f64; 3]> {
    let digits = flags.to_string();
    (0..3).filter(|axis| digits.as_bytes().contains(&(b'4' + *axis as u8))).map(|axis| axes[axis]).collect()
}
