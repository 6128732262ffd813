//! Linear equations between displacements and rotations of nodes.

use quasirigid_math::vec3::scale;

use super::Reader;
use super::fields::{fields, real};
use crate::deck::{BASIC, Equations, Term};
use crate::matrix::listed::LocatedProblem;
use crate::mesh::inp::Placed;

/// A term as it is written: the name of a node or of a set, a component from 1, a factor, and the line.
type Written = (String, usize, f64, usize);

impl Reader {
    pub(super) fn read_equations(&mut self) -> Result<(), LocatedProblem> {
        for at in self.cards(&["EQUATION"]) {
            if self.cards[at].parameter("REMOVE").is_some() {
                continue; // of a step
            }
            let line = self.cards[at].line;
            for placed in self.placed(self.cards[at].scope) {
                for terms in self.terms(at)? {
                    match self.sums(&placed, &terms)? {
                        Some(sums) => self.model.equations.push(Equations { follower: None, sums, line }),
                        None => self.model.leave_out("equations of other quantities or of unequal sets"),
                    }
                }
            }
        }
        Ok(())
    }

    /// Terms of each equation of a card.
    fn terms(&self, at: usize) -> Result<Vec<Vec<Written>>, LocatedProblem> {
        let mut equations = Vec::new();
        let mut lines = self.cards[at].lines.iter();
        while let Some((line, text)) = lines.next() {
            let count = real(fields(text).first().copied().unwrap_or_default(), *line)? as usize;
            let mut terms = Vec::new();
            while terms.len() < count {
                let Some((line, text)) = lines.next() else { break };
                for term in fields(text).chunks(3) {
                    let [node, component, factor] = *term else { continue };
                    terms.push((
                        node.to_owned(),
                        real(component, *line)? as usize,
                        real(factor, *line)?,
                        *line,
                    ));
                }
            }
            equations.push(terms);
        }
        Ok(equations)
    }

    /// Sums of an equation: one, or as many as the first of its sets has nodes; none if the others have not as many, nor one.
    fn sums(&self, placed: &Placed, terms: &[Written]) -> Result<Option<Vec<Vec<Term>>>, LocatedProblem> {
        let mut columns = Vec::new();
        for (name, component, factor, line) in terms {
            if !(1..=6).contains(component) {
                return Ok(None);
            }
            let mut column = Vec::new();
            for node in self.nodes(placed, name, *line)? {
                let axis = self.axes_of(node, *line)?[(component - 1) % 3];
                column.push(Term { node, rotates: *component > 3, along: scale(*factor, axis) });
            }
            columns.push(column);
        }
        let count = columns.first().map_or(0, Vec::len);
        if columns.iter().any(|column| column.len() != count && column.len() != 1) {
            return Ok(None);
        }
        let at = |number: usize| columns.iter().map(|column| column[number % column.len()]).collect();
        Ok(Some((0..count).map(at).collect()))
    }

    /// Axes of the displacements of a node.
    pub(super) fn axes_of(&self, node: u64, line: usize) -> Result<[[f64; 3]; 3], LocatedProblem> {
        Ok(self.model.point(node, line)?.axes.unwrap_or(BASIC))
    }
}
