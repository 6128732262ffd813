//! Linear equations between displacements: those that make a node follow the mean of others are carried, as the motion of the whole
//! body satisfies them; an equation of another kind would hold the body to the ground, or bind single components.

use std::collections::BTreeMap;

use quasirigid_math::vec3::{add, norm, scale};

use super::Reader;
use super::fields::{fields, real};
use crate::deck::Mean;
use crate::matrix::listed::LocatedProblem;

/// Departure from a mean up to which shares are one.
const SAME: f64 = 1e-6;

/// A term: the name of a node, a component from 1, a factor, and the line.
type Term = (String, usize, f64, usize);

/// Shares of other nodes in a component of a node.
type Shares = BTreeMap<u64, f64>;

impl Reader {
    pub(super) fn read_equations(&mut self) -> Result<(), LocatedProblem> {
        let mut rows: BTreeMap<u64, [Option<Shares>; 3]> = BTreeMap::new();
        let mut left = 0;
        let mut line = 0;
        for at in self.cards(&["EQUATION"]) {
            if self.cards[at].parameter("REMOVE").is_some() {
                continue; // of a step
            }
            line = self.cards[at].line;
            for placed in self.placed(self.cards[at].scope) {
                for terms in self.terms(at)? {
                    let mut named = Vec::new();
                    for (name, component, factor, line) in terms {
                        named.push((self.node(&placed, &name, line)?, component, factor));
                    }
                    match row(&named) {
                        Some((node, component, shares)) => {
                            rows.entry(node).or_default()[component] = Some(shares);
                        }
                        None => left += 1,
                    }
                }
            }
        }
        for (node, components) in rows {
            let count = components.iter().flatten().count();
            let [Some(x), Some(y), Some(z)] = components else {
                left += count;
                continue;
            };
            if x != y || x != z || !self.is_mean(node, &x) {
                left += count;
                continue;
            }
            let moves = [true, true, true, false, false, false];
            let others = x.into_iter().map(|(node, weight)| (weight, moves, vec![node])).collect();
            self.model.means.push(Mean { node, components: [true; 6], others, line });
        }
        if left > 0 {
            self.model.leave_out_all("equations of single components or against motions of the whole", left);
        }
        Ok(())
    }

    /// Terms of each equation of a card: node, component from 1, factor, line.
    fn terms(&self, at: usize) -> Result<Vec<Vec<Term>>, LocatedProblem> {
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

    /// Whether shares are the weights of a mean at the node itself.
    fn is_mean(&self, node: u64, shares: &Shares) -> bool {
        let place = |label: &u64| self.node_of.get(label).map(|at| self.inp.mesh.nodes[*at]);
        let Some(here) = place(&node) else { return false };
        let mut arm = [0.0; 3];
        let mut reach: f64 = norm(here);
        for (other, share) in shares {
            let Some(there) = place(other) else { return false };
            arm = add(arm, scale(*share, add(there, scale(-1.0, here))));
            reach = reach.max(norm(there));
        }
        let sum: f64 = shares.values().sum();
        shares.values().all(|share| *share > 0.0) && (sum - 1.0).abs() < SAME && norm(arm) <= SAME * reach
    }
}

/// The first term of an equation by the others, of the same component.
fn row(terms: &[(u64, usize, f64)]) -> Option<(u64, usize, Shares)> {
    let ((node, component, factor), others) = terms.split_first()?;
    let fits =
        (1..=3).contains(component) && *factor != 0.0 && others.iter().all(|(_, of, _)| of == component);
    let mut shares = Shares::new();
    for (other, _, value) in others {
        *shares.entry(*other).or_default() -= value / factor;
    }
    (fits && !shares.contains_key(node) && !shares.is_empty()).then(|| (*node, component - 1, shares))
}
