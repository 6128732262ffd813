//! Materials by name: *ELASTIC, *DENSITY and *DAMPING below *MATERIAL.

use super::Reader;
use super::fields::first;
use super::names::no;
use crate::deck::Stuff;
use crate::matrix::MatrixProblem;
use crate::matrix::listed::LocatedProblem;
use crate::mesh::inp::InpCard;

/// A material as its cards come up.
#[derive(Clone, Default)]
struct Cards {
    name: String,
    elastic: Option<Elastic>,
    density: f64,
    loss: f64,
}

/// Constants of *ELASTIC.
#[derive(Clone, Copy)]
enum Elastic {
    Isotropic([f64; 2]),
    /// Moduli, Poisson's ratios and shear moduli of 12, 13, 23.
    Orthotropic([[f64; 3]; 3]),
    /// E1, E2, ν12, G12, G13, G23.
    Lamina([f64; 6]),
}

impl Elastic {
    /// The constants of a card; none of a type that is not carried.
    fn read(card: &InpCard) -> Result<Option<Self>, LocatedProblem> {
        let kind = card.parameter("TYPE").unwrap_or("ISO").to_ascii_uppercase();
        Ok(match kind.as_str() {
            "" | "ISO" | "ISOTROPIC" => {
                let numbers = first(card, 2)?;
                Some(Self::Isotropic([numbers[0], numbers[1]]))
            }
            "ENGINEERING CONSTANTS" | "ENGINEERINGCONSTANTS" => {
                let n = first(card, 9)?;
                Some(Self::Orthotropic([[n[0], n[1], n[2]], [n[3], n[4], n[5]], [n[6], n[7], n[8]]]))
            }
            "ORTHO" | "ORTHOTROPIC" => Self::of_stiffness(&first(card, 9)?),
            "LAMINA" => {
                let n = first(card, 6)?;
                Some(Self::Lamina([n[0], n[1], n[2], n[3], n[4], n[5]]))
            }
            _ => None,
        })
    }

    /// From D1111, D1122, D2222, D1133, D2233, D3333, D1212, D1313, D2323: the inverse of the first six has the moduli.
    fn of_stiffness(n: &[f64]) -> Option<Self> {
        let d = [[n[0], n[1], n[3]], [n[1], n[2], n[4]], [n[3], n[4], n[5]]];
        let minor = |i: usize, j: usize| {
            let [a, b] = [(i + 1) % 3, (i + 2) % 3];
            let [c, e] = [(j + 1) % 3, (j + 2) % 3];
            d[a][c] * d[b][e] - d[a][e] * d[b][c]
        };
        let determinant: f64 = (0..3).map(|j| d[0][j] * minor(0, j)).sum();
        let compliance = |i: usize, j: usize| minor(j, i) / determinant;
        let young = [0, 1, 2].map(|i| compliance(i, i).recip());
        let poisson = [[0, 1], [0, 2], [1, 2]].map(|[i, j]| -compliance(i, j) * young[i]);
        young.iter().all(|young| young.is_finite()).then_some(Self::Orthotropic([
            young,
            poisson,
            [n[6], n[7], n[8]],
        ]))
    }
}

impl Reader {
    pub(super) fn read_materials(&mut self) -> Result<(), LocatedProblem> {
        let mut materials: Vec<Cards> = Vec::new();
        for card in &self.cards {
            match (card.name.as_str(), materials.last_mut()) {
                ("MATERIAL", _) => {
                    let name = card.parameter("NAME").unwrap_or_default().to_owned();
                    materials.push(Cards { name, ..Cards::default() });
                }
                ("ELASTIC", Some(material)) => {
                    material.elastic = Elastic::read(card)?;
                    let more = if matches!(material.elastic, Some(Elastic::Orthotropic(_))) { 2 } else { 1 };
                    if card.lines.len() > more {
                        self.model
                            .simplify("materials that change with temperature have their first constants");
                    }
                }
                ("DENSITY", Some(material)) => material.density = first(card, 1)?[0],
                ("DAMPING", Some(material)) => {
                    let number = |key: &str| card.parameter(key).and_then(|value| value.parse::<f64>().ok());
                    material.loss = number("STRUCTURAL").unwrap_or(0.0);
                    if number("ALPHA").or_else(|| number("BETA")).is_some_and(|value| value != 0.0) {
                        self.model.simplify("*DAMPING by ALPHA and BETA is left out; `rayleigh` gives it");
                    }
                }
                _ => {}
            }
        }
        for (number, material) in (1..).zip(&materials) {
            self.materials.insert(material.name.to_ascii_uppercase(), number);
            self.model.names.insert(number, material.name.clone());
            let Cards { elastic, density, loss, .. } = material.clone();
            let stuff = match elastic {
                None => continue,
                Some(Elastic::Isotropic([young, poisson])) => {
                    Stuff::Isotropic { young, poisson, density, loss }
                }
                Some(Elastic::Orthotropic([young, poisson, shear])) => {
                    Stuff::Orthotropic { young, poisson, shear, density, loss }
                }
                Some(Elastic::Lamina([e1, e2, poisson, g12, g13, g23])) => {
                    Stuff::Lamina { young: [e1, e2], poisson, shear: [g12, g13, g23], density, loss }
                }
            };
            self.model.materials.insert(number, stuff);
        }
        Ok(())
    }

    /// Number of the material that a card names, which has constants.
    pub(super) fn material(&self, name: &str, line: usize) -> Result<u64, LocatedProblem> {
        let known = self.materials.get(&name.to_ascii_uppercase()).copied();
        let number = known.ok_or_else(|| no("material", name, line))?;
        if self.model.materials.contains_key(&number) {
            Ok(number)
        } else {
            Err((line, MatrixProblem::NoElastic { name: name.into() }))
        }
    }
}
