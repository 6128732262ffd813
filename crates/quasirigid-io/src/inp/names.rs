//! Names of sets, nodes and surfaces, as cards in parts, instances and the assembly say them.

use crate::matrix::MatrixProblem;
use crate::matrix::listed::LocatedProblem;
use crate::mesh::inp::{Placed, Scope};

use super::Reader;

/// Cells and other elements of a set.
#[derive(Default)]
pub(super) struct Members {
    pub cells: Vec<usize>,
    pub others: Vec<usize>,
}

impl Reader {
    /// Where a card holds: in each place of its part, in its instance, or once.
    pub(super) fn placed(&self, scope: Scope) -> Vec<Placed> {
        let here = |placed: &&Placed| match scope {
            Scope::Whole => placed.part.is_none() && placed.instance.is_none(),
            Scope::Part(part) => placed.part == Some(part),
            Scope::Instance(instance) => placed.instance == Some(instance),
        };
        self.inp.placed.iter().filter(here).cloned().collect()
    }

    /// Names under which a name may stand: with the prefix of its place, alone, and without that of the only instance.
    fn spellings(&self, placed: &Placed, name: &str) -> Vec<String> {
        let name = name.trim_matches('"').to_ascii_uppercase();
        let mut spellings = vec![format!("{}{name}", placed.prefix.to_ascii_uppercase())];
        let prefixes = self.inp.placed.iter().filter(|placed| placed.instance.is_some());
        let bare = prefixes.filter_map(|placed| name.strip_prefix(&placed.prefix.to_ascii_uppercase()));
        spellings.extend(bare.map(str::to_owned));
        spellings.push(name);
        spellings
    }

    /// Members of an element set, or the element of a number.
    pub(super) fn elements(
        &self,
        placed: &Placed,
        name: &str,
        line: usize,
    ) -> Result<Members, LocatedProblem> {
        if let Ok(label) = name.parse::<u64>() {
            let label = label.saturating_add(placed.shifts[1]);
            let (cell, other) = (self.cell_of.get(&label).copied(), self.inp.others.of(label));
            let second = cell.and_then(|cell| self.inp.pyramids.get(&cell)).map(|pyramid| pyramid.second);
            let cells = cell.into_iter().chain(second).collect();
            return Ok(Members { cells, others: other.into_iter().collect() });
        }
        let mut known = false;
        for name in self.spellings(placed, name) {
            let set = self.sets.get(&name);
            let cells = set.map(|set| self.inp.mesh.sets[*set].cells.clone()).unwrap_or_default();
            let others = self.inp.others.set(&name).to_vec();
            known |= set.is_some();
            if !cells.is_empty() || !others.is_empty() {
                return Ok(Members { cells, others });
            }
        }
        if known { Ok(Members::default()) } else { Err(no("element set", name, line)) }
    }

    /// Numbers of the nodes of a set, or of one node, `7` or `Wing-1.7`.
    pub(super) fn nodes(&self, placed: &Placed, name: &str, line: usize) -> Result<Vec<u64>, LocatedProblem> {
        if let Ok(label) = name.parse::<u64>() {
            return Ok(vec![label.saturating_add(placed.shifts[0])]);
        }
        let upper = name.trim_matches('"').to_ascii_uppercase();
        for other in self.inp.placed.iter().filter(|other| other.instance.is_some()) {
            let rest = upper.strip_prefix(&other.prefix.to_ascii_uppercase());
            if let Some(Ok(label)) = rest.map(str::parse::<u64>) {
                return Ok(vec![label.saturating_add(other.shifts[0])]);
            }
        }
        let set = self.spellings(placed, name).into_iter().find_map(|name| {
            self.sets.get(&name).map(|set| &self.inp.mesh.sets[*set].nodes).filter(|nodes| !nodes.is_empty())
        });
        let nodes = set.ok_or_else(|| no("node set", name, line))?;
        Ok(nodes.iter().map(|node| self.inp.mesh.node_labels[*node]).collect())
    }

    /// The one node that a reference names.
    pub(super) fn node(&self, placed: &Placed, name: &str, line: usize) -> Result<u64, LocatedProblem> {
        let nodes = self.nodes(placed, name, line)?;
        nodes.first().copied().ok_or_else(|| no("node", name, line))
    }
}

/// A name that nothing has.
pub(super) fn no(kind: &'static str, name: &str, line: usize) -> LocatedProblem {
    (line, MatrixProblem::NoNamed { kind, name: name.into() })
}
