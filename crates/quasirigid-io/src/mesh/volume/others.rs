//! Elements that are no cells: bodies, springs and dashpots at nodes, with the sets that name them.

use std::collections::HashMap;

use super::problem::VolumeProblem;
use super::{MeshProblem, Part};

/// An element that is no cell.
#[derive(Clone, Debug)]
pub(crate) struct Other {
    pub label: u64,
    /// Index of its type among those of the file.
    pub kind: u16,
    /// Numbers of its nodes; 0 where one is left out.
    pub nodes: Vec<u64>,
}

/// Such elements as they come up, and sets of them by name in capitals.
#[derive(Default)]
pub(crate) struct Others {
    pub all: Vec<Other>,
    of_label: HashMap<u64, usize>,
    sets: HashMap<String, Vec<usize>>,
}

impl Others {
    /// Adds an element, and returns its index.
    pub fn add(&mut self, element: Other) -> Result<usize, MeshProblem> {
        let label = element.label;
        if self.of_label.insert(label, self.all.len()).is_some() {
            return Err(VolumeProblem::Twice { part: Part::Cells, label }.into());
        }
        self.all.push(element);
        Ok(self.all.len() - 1)
    }

    /// Index of the element with this number.
    pub fn of(&self, label: u64) -> Option<usize> {
        self.of_label.get(&label).copied()
    }

    /// Adds elements to a set.
    pub fn put(&mut self, set: &str, members: &[usize]) {
        self.sets.entry(set.to_ascii_uppercase()).or_default().extend(members);
    }

    /// Elements of a set.
    pub fn set(&self, name: &str) -> &[usize] {
        self.sets.get(&name.to_ascii_uppercase()).map_or(&[], Vec::as_slice)
    }

    /// Elements whose numbers are in a range, of these steps.
    pub fn between(&self, [from, to, step]: [u64; 3]) -> Vec<usize> {
        let inside = |label: u64| (from..=to).contains(&label) && (label - from).is_multiple_of(step);
        (0..self.all.len()).filter(|index| inside(self.all[*index].label)).collect()
    }

    /// Adds the elements of another file, whose nodes and numbers are shifted; sets get a prefix.
    pub fn append(
        &mut self,
        other: &Self,
        [nodes, labels]: [u64; 2],
        prefix: &str,
    ) -> Result<(), MeshProblem> {
        let first = self.all.len();
        for element in &other.all {
            let moved = |node: &u64| if *node == 0 { 0 } else { node.saturating_add(nodes) };
            self.add(Other {
                label: element.label.saturating_add(labels),
                kind: element.kind,
                nodes: element.nodes.iter().map(moved).collect(),
            })?;
        }
        for (name, members) in &other.sets {
            let members: Vec<usize> = members.iter().map(|member| first + member).collect();
            self.put(&format!("{prefix}{name}"), &members);
        }
        Ok(())
    }
}
