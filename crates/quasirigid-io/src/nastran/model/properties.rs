//! Properties and materials of a deck: PSHELL, PCOMP, PROD, PELAS, PBUSH, MAT1 and MAT8.

use super::Reader;
use crate::deck::{Plating, Ply, RodSection, Stuff};
use crate::matrix::error::{MatrixProblem, Row};
use crate::matrix::listed::LocatedProblem;
use crate::nastran::bulk::{Card, integer, integer_or, real_or, real_or_zero};

impl Reader {
    /// Takes the card of a property or a material; false for another card.
    pub(super) fn property(&mut self, card: &Card, name: &str) -> Result<bool, LocatedProblem> {
        let label = || integer(card.field(2), Row::Property);
        match name {
            "PSHELL" => self.shell(card, label()?)?,
            "PCOMP" => self.composite(card, label()?, [10, 4])?,
            "PCOMPG" => self.composite(card, label()?, [11, 8])?,
            "PBAR" => self.bar(card, label()?)?,
            "PBEAM" => self.beam_section(card, label()?)?,
            "PBARL" | "PBEAML" => return self.section(card, label()?, name),
            "PROD" => self.rod_section(card, label()?, 3, 4, 5)?,
            "PTUBE" => self.tube(card, label()?)?,
            "PELAS" => self.springs_of(card)?,
            "PDAMP" => {
                for first in [2, 4, 6, 8].into_iter().filter(|first| !card.field(*first).text.is_empty()) {
                    let label = integer(card.field(first), Row::Property)?;
                    let damping = real_or_zero(card.field(first + 1))?;
                    self.model.of_springs.insert(label, [0.0, damping]);
                }
            }
            "PBUSH" => self.bushing(card, label()?)?,
            "MAT1" => self.isotropic(card, label()?)?,
            "MAT8" => {
                let label = label()?;
                let [e1, e2, nu, g12, g13, g23, density] =
                    [3, 4, 5, 6, 7, 8, 9].map(|number| real_or_zero(card.field(number)));
                let loss = real_or_zero(card.field(18))?;
                let (g12, g13, g23) = (g12?, g13?, g23?);
                if g13 == 0.0 || g23 == 0.0 {
                    self.model.simplify("MAT8 without G1Z or G2Z has G12 across the layers");
                }
                let or = |g: f64| if g > 0.0 { g } else { g12 };
                let (young, shear) = ([e1?, e2?], [g12, or(g13), or(g23)]);
                let ply = Stuff::Lamina { young, poisson: nu?, shear, density: density?, loss };
                self.model.materials.insert(label, ply);
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn isotropic(&mut self, card: &Card, label: u64) -> Result<(), LocatedProblem> {
        let given = |number: usize| -> Result<Option<f64>, LocatedProblem> {
            let field = card.field(number);
            if field.text.is_empty() { Ok(None) } else { real_or_zero(field).map(Some) }
        };
        let positive = |value: Option<f64>| value.filter(|value| *value > 0.0);
        let (young, shear, poisson) = (positive(given(3)?), positive(given(4)?), given(5)?);
        let (young, poisson) = match (young, shear, poisson) {
            (Some(young), Some(shear), Some(poisson)) => {
                if (young / (2.0 * (1.0 + poisson)) / shear - 1.0).abs() > 0.01 {
                    self.model.simplify("MAT1 with G other than E/2(1 + NU) has G from E and NU");
                }
                (young, poisson)
            }
            (Some(young), _, Some(poisson)) => (young, poisson),
            (Some(young), Some(shear), None) => {
                let poisson = 0.5 * young / shear - 1.0;
                if !(poisson > -1.0 && poisson < 0.5) {
                    self.model.simplify("MAT1 with E and G of no Poisson's ratio has NU = 0");
                    (young, 0.0)
                } else {
                    (young, poisson)
                }
            }
            (Some(young), None, None) => (young, 0.0),
            (None, Some(shear), poisson) => {
                let poisson = poisson.unwrap_or(0.0);
                (2.0 * (1.0 + poisson) * shear, poisson)
            }
            (None, None, _) => return Err((card.line, MatrixProblem::NoModulus { material: label })),
        };
        let (density, loss) = (real_or_zero(card.field(6))?, real_or_zero(card.field(9))?);
        self.model.materials.insert(label, Stuff::Isotropic { young, poisson, density, loss });
        Ok(())
    }

    fn shell(&mut self, card: &Card, label: u64) -> Result<(), LocatedProblem> {
        let membrane = integer_or(card.field(3), 0, Row::Property)?;
        let bending = card.field(5).text;
        let material = match (membrane, bending) {
            (0, "" | "-1") => return Err((card.line, MatrixProblem::NoMaterialOf { property: label })),
            (0, _) => {
                self.model.simplify("PSHELL without MID1 has the material of bending in its plane too");
                integer(card.field(5), Row::Property)?
            }
            (membrane, _) => membrane,
        };
        if membrane != 0 && bending.is_empty() {
            self.model.simplify("PSHELL without MID2 bends by its material too");
        }
        if membrane != 0
            && !matches!(bending, "" | "-1")
            && integer(card.field(5), Row::Property)? != membrane
        {
            self.model.simplify("PSHELL with another material MID2 has MID1 in bending too");
        }
        let ratio = real_or(card.field(6), 1.0)?;
        if (ratio - 1.0).abs() > 1e-6 {
            self.model.simplify("PSHELL with 12I/T**3 other than 1 has 1");
        }
        let (thickness, extra) = (real_or_zero(card.field(4))?, real_or_zero(card.field(9))?);
        let layers = vec![Ply { material, thickness, angle: 0.0 }];
        self.model.of_plates.insert(label, Plating { layers, bottom: None, extra });
        Ok(())
    }

    /// Layers from a field on, so many fields each: material, thickness, angle.
    fn composite(
        &mut self,
        card: &Card,
        label: u64,
        [first, step]: [usize; 2],
    ) -> Result<(), LocatedProblem> {
        let bottom = match card.field(3).text {
            "" => None,
            _ => Some(real_or_zero(card.field(3))?),
        };
        let extra = real_or_zero(card.field(4))?;
        let (mut layers, mut number) = (Vec::new(), first);
        let mut last = (0, 0.0);
        while !card.fields_from(number).is_empty() {
            let blank = (number..number + 3).all(|number| card.field(number).text.is_empty());
            if !blank {
                last.0 = integer_or(card.field(number), last.0, Row::Property)?;
                last.1 = real_or(card.field(number + 1), last.1)?;
                let angle = real_or_zero(card.field(number + 2))?;
                layers.push(Ply { material: last.0, thickness: last.1, angle });
            }
            number += step;
        }
        let lamina = card.field(9).text.to_ascii_uppercase();
        match lamina.as_str() {
            "" => {}
            "SYM" => {
                let mirrored: Vec<Ply> = layers.iter().rev().copied().collect();
                layers.extend(mirrored);
            }
            _ => self.model.simplify("PCOMP with LAM other than SYM is taken as its layers"),
        }
        if layers.is_empty() {
            return Err((card.line, MatrixProblem::NoMaterialOf { property: label }));
        }
        self.model.of_plates.insert(label, Plating { layers, bottom, extra });
        Ok(())
    }

    /// Notes the section of a rod: fields of the material, the area and the torsion, and the extra mass two fields on.
    pub(super) fn rod_section(
        &mut self,
        card: &Card,
        label: u64,
        material: usize,
        area: usize,
        torsion: usize,
    ) -> Result<(), LocatedProblem> {
        let material = integer(card.field(material), Row::Property)?;
        let area = real_or_zero(card.field(area))?;
        if real_or_zero(card.field(torsion))? != 0.0 {
            self.model.simplify("the twist of rods is left out");
        }
        let extra = real_or_zero(card.field(torsion + 2))?;
        self.model.of_rods.insert(label, RodSection { material, area, extra });
        Ok(())
    }

    fn tube(&mut self, card: &Card, label: u64) -> Result<(), LocatedProblem> {
        let material = integer(card.field(3), Row::Property)?;
        let (outer, wall) = (real_or_zero(card.field(4))?, real_or_zero(card.field(5))?);
        let inner = if wall > 0.0 { outer - 2.0 * wall } else { 0.0 };
        let area = 0.25 * std::f64::consts::PI * (outer.powi(2) - inner.powi(2));
        self.model.simplify("the twist of rods is left out");
        self.model.of_rods.insert(label, RodSection { material, area, extra: real_or_zero(card.field(6))? });
        Ok(())
    }

    fn springs_of(&mut self, card: &Card) -> Result<(), LocatedProblem> {
        for first in [2, 6].into_iter().filter(|first| !card.field(*first).text.is_empty()) {
            let label = integer(card.field(first), Row::Property)?;
            let stiffness = real_or_zero(card.field(first + 1))?;
            self.model.of_springs.insert(label, [stiffness, 0.0]);
        }
        Ok(())
    }

    fn bushing(&mut self, card: &Card, label: u64) -> Result<(), LocatedProblem> {
        let mut laws = [[0.0; 6]; 2];
        let mut number = 3;
        while !card.fields_from(number).is_empty() {
            let law = match card.field(number).text.to_ascii_uppercase().as_str() {
                "K" => Some(0),
                "B" => Some(1),
                "" => None,
                _ => {
                    self.model.simplify("of PBUSH only K and B are taken");
                    None
                }
            };
            for component in 0..6 {
                if let Some(law) = law {
                    laws[law][component] = real_or_zero(card.field(number + 1 + component))?;
                }
            }
            number += 8;
        }
        self.model.of_bushes.insert(label, laws);
        Ok(())
    }
}
