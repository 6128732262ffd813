//! Sections: which material, thickness or profile the elements of a set have.

use super::Reader;
use super::fields::{fields, first, real, reals};
use super::orientation::Orientation;
use super::profiles::{Profile, profile};
use crate::deck::{Bending, Plating, Ply, RodSection, Station, Stuff};
use crate::matrix::MatrixProblem;
use crate::matrix::listed::LocatedProblem;
use crate::mesh::inp::{InpCard, Placing};

/// Section of the elements of a set, in one place of its part.
pub(super) struct Section {
    pub kind: SectionKind,
    pub placing: Placing,
    pub line: usize,
}

/// What a section gives.
#[derive(Clone)]
pub(super) enum SectionKind {
    /// A property of solids, which is one of rods where they have an area.
    Solid { property: u64, material: u64, axes: Option<Orientation> },
    /// A property of plates, and the orientation of their material.
    Shell { property: u64, axes: Option<Orientation>, nodal: bool },
    /// Properties of beams with shear and without, and the first axis of the section.
    Beam { properties: [u64; 2], up: [f64; 3] },
}

/// First axis of the section of beams that do not say it.
const UP: [f64; 3] = [0.0, 0.0, -1.0];

impl Reader {
    pub(super) fn read_sections(&mut self) -> Result<(), LocatedProblem> {
        const NAMES: &[&str] = &[
            "SOLID SECTION",
            "SHELL SECTION",
            "SHELL GENERAL SECTION",
            "BEAM SECTION",
            "BEAM GENERAL SECTION",
        ];
        for at in self.cards(NAMES) {
            let card = &self.cards[at];
            let (line, scope) = (card.line, card.scope);
            let set = card.parameter("ELSET").unwrap_or_default().to_owned();
            let placed = self.placed(scope);
            let mut members = Vec::new();
            for placed in &placed {
                members.push((placed.placing, self.elements(placed, &set, line)?.cells));
            }
            // A set of what is left out needs no section.
            if members.iter().all(|(_, cells)| cells.is_empty()) {
                continue;
            }
            let Some(kind) = self.section(at)? else { continue };
            for (placing, cells) in members {
                let section = self.sections.len();
                self.sections.push(Section { kind: kind.clone(), placing, line });
                cells.into_iter().for_each(|cell| self.section_of[cell] = Some(section));
            }
        }
        Ok(())
    }

    fn section(&mut self, at: usize) -> Result<Option<SectionKind>, LocatedProblem> {
        let card = &self.cards[at];
        match card.name.as_str() {
            "SOLID SECTION" => self.solid_section(at).map(Some),
            "SHELL SECTION" => self.shell_section(at).map(Some),
            "SHELL GENERAL SECTION" if card.parameter("MATERIAL").is_some() => {
                self.shell_section(at).map(Some)
            }
            "SHELL GENERAL SECTION" => {
                self.model.leave_out("*SHELL GENERAL SECTION without a material");
                Ok(None)
            }
            _ => self.beam_section(at).map(Some),
        }
    }

    pub(super) fn property(&mut self) -> u64 {
        self.next_property += 1;
        self.next_property - 1
    }

    /// The orientation that a card names.
    fn orientation_of(&self, card: &InpCard) -> Result<Option<Orientation>, LocatedProblem> {
        card.parameter("ORIENTATION").map(|name| self.orientation(name, card.line)).transpose()
    }

    fn solid_section(&mut self, at: usize) -> Result<SectionKind, LocatedProblem> {
        let card = &self.cards[at];
        let material = self.material(card.parameter("MATERIAL").unwrap_or_default(), card.line)?;
        let axes = self.orientation_of(card)?;
        let area = if card.lines.is_empty() { 0.0 } else { first(card, 1)?[0] };
        let property = self.property();
        self.model.of_solids.insert(property, material);
        self.model.of_rods.insert(property, RodSection { material, area, extra: 0.0 });
        Ok(SectionKind::Solid { property, material, axes })
    }

    fn shell_section(&mut self, at: usize) -> Result<SectionKind, LocatedProblem> {
        let card = &self.cards[at];
        let mut axes = self.orientation_of(card)?;
        let mut layers = Vec::new();
        if card.parameter("COMPOSITE").is_some() {
            for (line, text) in &card.lines {
                let fields = fields(text);
                let [thickness, _, material, ..] = fields[..] else { continue };
                let turned = fields.get(3).copied().unwrap_or_default();
                let angle = match turned.parse::<f64>() {
                    Ok(angle) => angle,
                    Err(_) if turned.is_empty() => 0.0,
                    Err(_) => {
                        let own = self.orientation(turned, *line)?;
                        let base = *axes.get_or_insert(own);
                        angle_between(&base, &own)?
                    }
                };
                let (thickness, material) = (real(thickness, *line)?, self.material(material, *line)?);
                layers.push(Ply { material, thickness, angle });
            }
        } else {
            let material = self.material(card.parameter("MATERIAL").unwrap_or_default(), card.line)?;
            let thickness = if card.lines.is_empty() { 0.0 } else { first(card, 1)?[0] };
            layers.push(Ply { material, thickness, angle: 0.0 });
        }
        if layers.is_empty() {
            return Err((
                card.line,
                MatrixProblem::Values { found: 0, row: crate::matrix::error::Row::InpCard },
            ));
        }
        let offset = match card.parameter("OFFSET").map(str::to_ascii_uppercase).as_deref() {
            None | Some("") => 0.0,
            Some("SPOS") => 0.5,
            Some("SNEG") => -0.5,
            Some(number) => real(number, card.line)?,
        };
        let nodal = card.parameter("NODAL THICKNESS").is_some();
        let thickness: f64 = layers.iter().map(|layer| layer.thickness).sum();
        // The offset is the height of the nodes above the middle, in thicknesses.
        let bottom = (offset != 0.0).then_some(-(offset + 0.5) * thickness);
        let property = self.property();
        self.model.of_plates.insert(property, Plating { layers, bottom, extra: 0.0 });
        Ok(SectionKind::Shell { property, axes, nodal })
    }

    fn beam_section(&mut self, at: usize) -> Result<SectionKind, LocatedProblem> {
        let card = &self.cards[at];
        let line = card.line;
        let shape = card.parameter("SECTION").unwrap_or("GENERAL").to_ascii_uppercase();
        let refuse = || (line, MatrixProblem::BeamSection { name: shape.as_str().into() });
        let sizes = card.lines.first().map(reals).transpose()?.unwrap_or_default();
        let general = shape == "GENERAL" && card.name == "BEAM GENERAL SECTION";
        let found = if general { of_constants(&sizes) } else { profile(&shape, &sizes) };
        let Profile { area, moments, torsion, shear, off_centre } = found.ok_or_else(refuse)?;
        let up = match card.lines.get(1).map(reals).transpose()?.as_deref() {
            Some([x, y, z, ..]) if [*x, *y, *z] != [0.0; 3] => [*x, *y, *z],
            _ => UP,
        };
        let moved = ["OFFSET1", "OFFSET2"].iter().any(|key| {
            card.parameter(key).is_some_and(|offset| offset.parse::<f64>().is_ok_and(|offset| offset != 0.0))
        });
        let material = match card.parameter("MATERIAL") {
            Some(name) => self.material(name, line)?,
            None => self.own_material(at)?,
        };
        if off_centre {
            self.model.simplify("sections of beams off their centroid are centred on their nodes");
        }
        if moved {
            self.model.simplify("offsets of beams (OFFSET1, OFFSET2) are left out");
        }
        let properties = [self.property(), self.property()];
        for (property, shear) in properties.into_iter().zip([Some([shear; 2]), None]) {
            let stations = vec![Station { at: 0.0, area, moments, torsion, extra: 0.0 }];
            self.model.of_beams.insert(property, Bending { material, stations, shear });
        }
        Ok(SectionKind::Beam { properties, up })
    }

    /// Material of a general section: Young's and shear modulus on its third line, and its density.
    fn own_material(&mut self, at: usize) -> Result<u64, LocatedProblem> {
        let card = &self.cards[at];
        let missing = || (card.line, MatrixProblem::NoElastic { name: "".into() });
        let moduli = card.lines.get(2).map(reals).transpose()?.unwrap_or_default();
        let [young, shear, ..] = moduli[..] else { return Err(missing()) };
        let density = card.parameter("DENSITY").map_or(Ok(0.0), |text| real(text, card.line))?;
        let poisson = 0.5 * young / shear - 1.0;
        let poisson = if poisson > -1.0 && poisson < 0.5 {
            poisson
        } else {
            self.model.simplify("beams with E and G of no Poisson's ratio have NU = 0");
            0.0
        };
        let number = self.property().saturating_add(self.cards.len() as u64);
        self.model.materials.insert(number, Stuff::Isotropic { young, poisson, density, loss: 0.0 });
        Ok(number)
    }
}

/// A section by A, I11, I12, I22 and J: I11 bends about the first axis.
fn of_constants(sizes: &[f64]) -> Option<Profile> {
    let [area, i11, i12, i22, torsion, ..] = *sizes else { return None };
    Some(Profile { area, moments: [i22, i11, i12], torsion, shear: 1.0, off_centre: false })
}

/// Angle (degrees) from the first axis of an orientation to that of another, about the third axis.
fn angle_between(base: &Orientation, other: &Orientation) -> Result<f64, LocatedProblem> {
    let still = Placing::default();
    let place = [0.0; 3];
    let ([x, y, _], [turned, ..]) = (base.axes_at(place, &still)?, other.axes_at(place, &still)?);
    let along = |axis: [f64; 3]| quasirigid_math::vec3::dot(axis, turned);
    Ok(along(y).atan2(along(x)).to_degrees())
}
