//! Laminated solids and the materials of solids that are not the same in every direction: PCOMPS, MAT9, MAT11, MATORT; axes by CORDM.
//! NX Nastran Quick Reference Guide, PCOMPS and MAT11; MSC Nastran Quick Reference Guide, PSOLID, MAT9 and MATORT.

use std::collections::HashMap;

use quasirigid_math::vec3::{add, cross, minus, scale, unit};

use super::Reader;
use crate::deck::{Laminate, Ply, Solid, Stuff};
use crate::matrix::error::{MatrixProblem, Row};
use crate::matrix::listed::LocatedProblem;
use crate::nastran::bulk::{Card, integer, integer_or, real_or_zero};

/// Coupling of a material beyond that of three planes of symmetry, relative to its largest modulus, that is none.
const NO_COUPLING: f64 = 1e-6;
/// Fields of a ply, and the first of them.
const PLY: [usize; 2] = [10, 8];

/// Systems by whose axes the materials of solids count, by property; none for the axes of each element.
pub(super) type SystemsOfSolids = HashMap<u64, Option<u64>>;

impl Reader {
    /// Takes the card of a property or a material of solids; false for another card.
    pub(super) fn of_solids(&mut self, card: &Card, name: &str) -> Result<bool, LocatedProblem> {
        let label = || integer(card.field(2), Row::Property);
        match name {
            "PSOLID" => {
                let (label, material) = (label()?, integer(card.field(3), Row::Property)?);
                self.model.of_solids.insert(label, material);
                let system = system_of(card, 4)?;
                self.systems_of_solids.insert(label, system);
            }
            "PCOMPS" => self.laminate(card, label()?)?,
            "MAT9" => self.anisotropic(card, label()?)?,
            "MAT11" | "MATORT" => {
                let stuff = orthotropic(card, name)?;
                self.model.materials.insert(label()?, stuff);
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn laminate(&mut self, card: &Card, label: u64) -> Result<(), LocatedProblem> {
        let system = system_of(card, 3)?;
        let digits = integer_or(card.field(4), 13, Row::Property)?;
        let directions = [digits / 10, digits % 10];
        let [ply, stack] = directions;
        if !(1..=3).contains(&ply) || !(1..=3).contains(&stack) || ply == stack {
            let found = card.field(4).text.into();
            return Err((card.line, MatrixProblem::Unexpected { found, row: Row::Property }));
        }
        let (mut plies, [mut number, step]) = (Vec::new(), PLY);
        while !card.fields_from(number).is_empty() {
            if (number..number + step).any(|number| !card.field(number).text.is_empty()) {
                let material = integer(card.field(number + 1), Row::Property)?;
                let thickness = real_or_zero(card.field(number + 2))?;
                let angle = real_or_zero(card.field(number + 3))?;
                if !(thickness > 0.0) {
                    return Err((card.line, MatrixProblem::NoThickness { property: label }));
                }
                plies.push(Ply { material, thickness, angle });
            }
            number += step;
        }
        if plies.is_empty() {
            return Err((card.line, MatrixProblem::NoMaterialOf { property: label }));
        }
        let directions = directions.map(|direction| direction as usize - 1);
        self.model.laminates.insert(label, Laminate { plies, directions });
        self.systems_of_solids.insert(label, system);
        Ok(())
    }

    /// A material by its moduli between six strains, which must have three planes of symmetry.
    fn anisotropic(&mut self, card: &Card, label: u64) -> Result<(), LocatedProblem> {
        let mut g = [[0.0; 6]; 6];
        let mut number = 3;
        for i in 0..6 {
            for j in i..6 {
                g[i][j] = real_or_zero(card.field(number))?;
                g[j][i] = g[i][j];
                number += 1;
            }
        }
        let most = g.iter().flatten().fold(0.0, |most: f64, value| most.max(value.abs()));
        let coupled = (0..6).any(|i| (0..6).any(|j| i != j && j > 2 && g[i][j].abs() > NO_COUPLING * most));
        if coupled {
            return Err((card.line, MatrixProblem::NoSymmetry { material: label }));
        }
        let density = real_or_zero(card.field(24))?;
        let loss = real_or_zero(card.field(32))?;
        // compliances by the cofactors of the moduli of the three stretches
        let minor = |i: usize, j: usize| {
            let [a, b, c, d] = [(i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3];
            g[a][c] * g[b][d] - g[a][d] * g[b][c]
        };
        let whole: f64 = (0..3).map(|j| g[0][j] * minor(0, j)).sum();
        let young = [0, 1, 2].map(|i| whole / minor(i, i));
        let poisson = [[0, 1], [0, 2], [1, 2]].map(|[i, j]| -minor(i, j) / minor(i, i));
        let shear = [g[3][3], g[5][5], g[4][4]];
        if !young.iter().chain(&shear).all(|modulus| *modulus > 0.0 && modulus.is_finite()) {
            return Err((card.line, MatrixProblem::NoModulus { material: label }));
        }
        self.model.materials.insert(label, Stuff::Orthotropic { young, poisson, shear, density, loss });
        Ok(())
    }

    /// Axes of the materials of solids that are not the same in every direction, and of laminates.
    pub(super) fn resolve_solids(&mut self) -> Result<(), LocatedProblem> {
        for index in 0..self.model.solids.len() {
            let property = self.model.solids[index].property;
            let material =
                self.model.of_solids.get(&property).and_then(|label| self.model.materials.get(label));
            let turned = matches!(material, Some(Stuff::Orthotropic { .. }));
            if !turned && !self.model.laminates.contains_key(&property) {
                continue;
            }
            let Solid { line, corners, .. } = self.model.solids[index];
            let mut places = Vec::with_capacity(corners);
            for corner in 0..corners {
                places.push(self.model.point(self.model.solids[index].nodes[corner], line)?.place);
            }
            let axes = match self.systems_of_solids.get(&property).copied().unwrap_or(Some(0)) {
                Some(0) => continue,
                Some(system) => {
                    let sum = places.iter().fold([0.0; 3], |sum, place| add(sum, *place));
                    self.grids.system(system, line)?.axes_at(scale((corners as f64).recip(), sum))
                }
                None => {
                    self.model.simplify(
                        "axes of the materials of solids that are those of their elements have the first side and the first face",
                    );
                    own_axes(&places)
                }
            };
            self.model.axes_at_solids.insert(index, axes);
        }
        Ok(())
    }
}

/// A coordinate system in a field; none for the axes of each element.
fn system_of(card: &Card, number: usize) -> Result<Option<u64>, LocatedProblem> {
    match card.field(number).text {
        "-1" | "-2" => Ok(None),
        _ => integer_or(card.field(number), 0, Row::Property).map(Some),
    }
}

/// Axes by the first side of a cell and its first face.
fn own_axes(places: &[[f64; 3]]) -> [[f64; 3]; 3] {
    let side = |from: usize, to: usize| minus(places[to], places[from]);
    let last = if places.len() == 8 { 3 } else { 2 };
    let x = unit(side(0, 1));
    let z = unit(cross(x, side(0, last)));
    [x, cross(z, x), z]
}

/// Moduli along three axes; of MATORT the ratios and shear moduli are of 12, 23 and 31.
fn orthotropic(card: &Card, name: &str) -> Result<Stuff, LocatedProblem> {
    let at = |number: usize| real_or_zero(card.field(number));
    let young = [at(3)?, at(4)?, at(5)?];
    let (density, loss) = (at(if name == "MAT11" { 12 } else { 9 })?, at(17)?);
    let (poisson, shear) = if name == "MAT11" {
        ([at(6)?, at(7)?, at(8)?], [at(9)?, at(10)?, at(11)?])
    } else {
        ([at(6)?, at(8)? * young[0] / young[2], at(7)?], [at(10)?, at(12)?, at(11)?])
    };
    if !young.iter().chain(&shear).all(|modulus| *modulus > 0.0) {
        let material = integer(card.field(2), Row::Property)?;
        return Err((card.line, MatrixProblem::NoModulus { material }));
    }
    Ok(Stuff::Orthotropic { young, poisson, shear, density, loss })
}
