use std::collections::HashMap;
use std::collections::hash_map::Entry;

use quasirigid_mesh::Set;

use super::MeshProblem;
use super::draft::Pyramid;
use super::problem::VolumeProblem;

/// Most members of all sets together: a short file can put every cell into many sets.
const MOST_MEMBERS: usize = 1 << 27;

/// Sets on their way from a file.
#[derive(Default)]
pub(super) struct Sets {
    sets: Vec<Set>,
    by_key: HashMap<String, usize>,
    members: usize,
}

impl Sets {
    /// Place of the set of this key, which becomes a new one with this name if there is none.
    pub(super) fn place(&mut self, key: &str, name: &str) -> usize {
        if let Some(place) = self.by_key.get(key) {
            return *place;
        }
        self.sets.push(Set { name: name.to_owned(), ..Set::default() });
        self.by_key.insert(key.to_owned(), self.sets.len() - 1);
        self.sets.len() - 1
    }

    /// The sets so far.
    pub(super) fn all(&self) -> &[Set] {
        &self.sets
    }

    /// Takes a prefix off the names of sets where the rest is no name of another.
    pub(super) fn without_prefix(&mut self, prefix: &str) {
        for place in 0..self.sets.len() {
            let Some(rest) = self.sets[place].name.strip_prefix(prefix) else { continue };
            if let Entry::Vacant(free) = self.by_key.entry(rest.to_ascii_uppercase()) {
                free.insert(place);
                self.sets[place].name = rest.to_owned();
            }
        }
    }

    /// The set of this key, if there is one.
    pub(super) fn of_key(&self, key: &str) -> Option<&Set> {
        self.by_key.get(key).map(|place| &self.sets[*place])
    }

    /// Name of a set.
    pub(super) fn name(&self, place: usize) -> &str {
        &self.sets[place].name
    }

    /// Adds nodes to a set.
    pub(super) fn add_nodes(&mut self, place: usize, nodes: &[usize]) -> Result<(), MeshProblem> {
        self.grow(nodes.len())?;
        self.sets[place].nodes.extend(nodes);
        Ok(())
    }

    /// Adds cells to a set.
    pub(super) fn add_cells(&mut self, place: usize, cells: &[usize]) -> Result<(), MeshProblem> {
        self.grow(cells.len())?;
        self.sets[place].cells.extend(cells);
        Ok(())
    }

    fn grow(&mut self, members: usize) -> Result<(), MeshProblem> {
        self.members = self.members.saturating_add(members);
        if self.members > MOST_MEMBERS {
            return Err(VolumeProblem::Members { limit: MOST_MEMBERS }.into());
        }
        Ok(())
    }

    /// Adds the second half of each pyramid to the sets of the first.
    pub(super) fn with_halves(&mut self, pyramids: &HashMap<usize, Pyramid>) {
        if pyramids.is_empty() {
            return;
        }
        for set in &mut self.sets {
            let second = set.cells.iter().filter_map(|cell| pyramids.get(cell));
            let second: Vec<usize> = second.map(|pyramid| pyramid.second).collect();
            set.cells.extend(second);
        }
    }

    /// The sets, each member once and ascending.
    pub(super) fn sorted(self) -> Vec<Set> {
        let mut sets = self.sets;
        for members in sets.iter_mut().flat_map(|set| [&mut set.nodes, &mut set.cells]) {
            members.sort_unstable();
            members.dedup();
        }
        sets
    }
}
