//! *CONNECTOR SECTION: joints, links and springs between two nodes, along axes that follow the first one. Angles are small, so that those of
//! Cardan, of a rotation vector and of flexion and torsion are one.

use std::collections::HashMap;

use quasirigid_math::vec3::{cross, minus, scale};

use super::Reader;
use super::fields::{fields, reals};
use crate::deck::{Axial, BASIC, Bush, Equations, TO_GROUND, Term};
use crate::matrix::listed::LocatedProblem;

/// Stiffnesses and dampings of the six components.
type Laws = [[f64; 6]; 2];

/// Two nodes with the axes of the first.
struct Ends {
    nodes: [u64; 2],
    axes: [[f64; 3]; 3],
    line: usize,
}

/// Basic connections that an assembled one is made of.
fn basic(kind: &str) -> Option<&'static [&'static str]> {
    Some(match kind {
        "AXIAL" => &["AXIAL"],
        "CARTESIAN" => &["CARTESIAN"],
        "PROJECTION CARTESIAN" => &["PROJECTION CARTESIAN"],
        "JOIN" => &["JOIN"],
        "LINK" => &["LINK"],
        "ALIGN" => &["ALIGN"],
        "REVOLUTE" => &["REVOLUTE"],
        "CARDAN" | "ROTATION" | "PROJECTION FLEXION-TORSION" => &["CARDAN"],
        "BEAM" | "WELD" => &["JOIN", "ALIGN"],
        "HINGE" => &["JOIN", "REVOLUTE"],
        "BUSHING" => &["PROJECTION CARTESIAN", "CARDAN"],
        _ => return None,
    })
}

impl Reader {
    pub(super) fn read_connectors(&mut self) -> Result<(), LocatedProblem> {
        let behaviours = self.behaviours()?;
        let mut used = vec![false; self.inp.others.all.len()];
        for at in self.cards(&["CONNECTOR SECTION"]) {
            let card = &self.cards[at];
            let (line, scope) = (card.line, card.scope);
            let set = card.parameter("ELSET").unwrap_or_default().to_owned();
            let behaviour = card.parameter("BEHAVIOR").map(str::to_ascii_uppercase);
            let laws = behaviour.and_then(|name| behaviours.get(&name).copied()).unwrap_or_default();
            let of_line =
                |number: usize| card.lines.get(number).map(|(_, text)| fields(text)).unwrap_or_default();
            let kinds: Vec<String> = of_line(0)
                .iter()
                .filter(|kind| !kind.is_empty())
                .map(|kind| kind.to_ascii_uppercase())
                .collect();
            let axes =
                of_line(1).first().filter(|name| !name.is_empty()).map(|name| self.orientation(name, line));
            let axes = axes.transpose()?;
            for placed in self.placed(scope) {
                for other in self.elements(&placed, &set, line)?.others {
                    used[other] = true;
                    let [a, b, ..] = self.inp.others.all[other].nodes[..] else {
                        self.model.leave_out(TO_GROUND);
                        continue;
                    };
                    let place = self.place(a).unwrap_or_default();
                    let axes = match &axes {
                        Some(axes) => axes.axes_at(place, &placed.placing)?,
                        None => BASIC.map(|axis| placed.placing.turned(axis)),
                    };
                    self.connector(&kinds, laws, &Ends { nodes: [a, b], axes, line });
                }
            }
        }
        for (index, used) in used.into_iter().enumerate() {
            let kind = self.inp.types[usize::from(self.inp.others.all[index].kind)].as_str();
            if !used && kind.starts_with("CONN") {
                self.model.leave_out("connectors without a section");
            }
        }
        Ok(())
    }

    /// Linear laws of each behaviour, by its name in capitals.
    fn behaviours(&mut self) -> Result<HashMap<String, Laws>, LocatedProblem> {
        let mut all: HashMap<String, Laws> = HashMap::new();
        let mut name = None;
        for at in self.cards(&["CONNECTOR BEHAVIOR", "CONNECTOR ELASTICITY", "CONNECTOR DAMPING"]) {
            let card = &self.cards[at];
            if card.name == "CONNECTOR BEHAVIOR" {
                name = card.parameter("NAME").map(str::to_ascii_uppercase);
                continue;
            }
            let component = card.parameter("COMPONENT").and_then(|text| text.parse::<usize>().ok());
            let form = ["NONLINEAR", "RIGID"].iter().find(|form| card.parameter(form).is_some());
            let value =
                card.lines.first().map(reals).transpose()?.and_then(|numbers| numbers.first().copied());
            match (&name, component, form, value) {
                (Some(name), Some(component @ 1..=6), None, Some(value)) => {
                    let law = usize::from(card.name == "CONNECTOR DAMPING");
                    all.entry(name.clone()).or_default()[law][component - 1] = value;
                }
                _ => {
                    let what = format!("*{} of other forms than linear and of one component", card.name);
                    self.model.leave_out(&what);
                }
            }
        }
        Ok(all)
    }

    fn connector(&mut self, kinds: &[String], laws: Laws, ends: &Ends) {
        let Some(parts) = kinds.iter().map(|kind| basic(kind)).collect::<Option<Vec<_>>>() else {
            return self.model.leave_out(&format!("connectors of type {}", kinds.join(", ")));
        };
        let of =
            |from: usize| laws.map(|law| std::array::from_fn(|k| if k / 3 == from { law[k] } else { 0.0 }));
        for part in parts.into_iter().flatten() {
            match *part {
                "AXIAL" => {
                    let law = laws.map(|law| law[0]);
                    if law == [0.0; 2] {
                        continue;
                    }
                    self.model.axials.push(Axial { ends: ends.nodes, law, line: ends.line });
                }
                "LINK" => self.link([ends.nodes[1], ends.nodes[0]], ends.line),
                "JOIN" => self.join(ends),
                "ALIGN" => self.aligned(ends, &ends.axes),
                "REVOLUTE" => {
                    self.aligned(ends, &ends.axes[1..]);
                    let free = laws.map(|law| [0.0, 0.0, 0.0, law[3], 0.0, 0.0]);
                    self.bushing(ends, free, 1.0);
                }
                "CARTESIAN" => self.bushing(ends, of(0), 1.0),
                "PROJECTION CARTESIAN" => self.bushing(ends, of(0), 0.5),
                _ => self.bushing(ends, of(1), 0.5),
            }
        }
    }

    /// The second node stays at its place as the first one carries it.
    fn join(&mut self, ends: &Ends) {
        let [a, b] = ends.nodes;
        let (Some(from), Some(to)) = (self.place(a), self.place(b)) else {
            return self.model.leave_out("connectors of nodes that are not there");
        };
        let arm = if self.together(a, b) { [0.0; 3] } else { minus(to, from) };
        let sum = |axis: [f64; 3]| {
            let term = |node, rotates, along| Term { node, rotates, along };
            let mut sum = vec![term(b, false, axis), term(a, false, scale(-1.0, axis))];
            if arm != [0.0; 3] {
                sum.push(term(a, true, cross(axis, arm)));
            }
            sum
        };
        let sums = BASIC.map(sum).into();
        self.model.equations.push(Equations { follower: None, sums, line: ends.line });
    }

    /// The rotations of both nodes about these axes are one.
    fn aligned(&mut self, ends: &Ends, axes: &[[f64; 3]]) {
        let [a, b] = ends.nodes;
        let term = |node, along| Term { node, rotates: true, along };
        let sums = axes.iter().map(|axis| vec![term(b, *axis), term(a, scale(-1.0, *axis))]).collect();
        self.model.equations.push(Equations { follower: None, sums, line: ends.line });
    }

    /// Springs and dashpots along the axes, at a share of the way from the first node to the second.
    pub(super) fn bushing_of(
        &mut self,
        nodes: [u64; 2],
        axes: [[f64; 3]; 3],
        laws: Laws,
        share: f64,
        line: usize,
    ) {
        let property = self.property();
        self.model.of_bushes.insert(property, laws);
        self.model.bushes.push(Bush { property, ends: nodes, up: None, axes: Some(axes), share, line });
    }

    fn bushing(&mut self, ends: &Ends, laws: Laws, share: f64) {
        if laws != Laws::default() {
            self.bushing_of(ends.nodes, ends.axes, laws, share, ends.line);
        }
    }
}
