//! Names of the nodes of a part: by name, by number, or in sets.
//! One lookup serves beams (names), matrices (labels) and meshes (labels and sets), so that references are written alike for all.

use std::collections::{HashMap, HashSet};

use quasirigid_mesh::Mesh;

use super::super::names::suggestion;
use super::super::value::Value;

/// Node lookup of a part: by name, by number, or in sets.
#[derive(Clone, Debug, Default)]
pub(in crate::model) struct Nodes {
    names: HashMap<String, usize>,
    labels: HashMap<u64, usize>,
    sets: HashMap<String, Vec<usize>>,
    /// Nodes of the file that belong to no cell.
    aside: HashSet<u64>,
}

impl Nodes {
    /// Nodes with names of their own.
    pub(super) fn of_names(names: impl Iterator<Item = String>) -> Self {
        Self { names: names.enumerate().map(|(index, name)| (name, index)).collect(), ..Self::default() }
    }

    /// Nodes with numbers alone.
    pub(super) fn of_labels(labels: &[u64]) -> Self {
        Self {
            labels: labels.iter().enumerate().map(|(index, label)| (*label, index)).collect(),
            ..Self::default()
        }
    }

    /// Nodes of a mesh: by their numbers, and by its sets, which stand for the nodes of their cells too.
    pub(super) fn of_mesh(mesh: &Mesh) -> Self {
        let labels = mesh.node_labels.iter().enumerate().map(|(index, label)| (*label, index)).collect();
        let members = |set: &quasirigid_mesh::Set| {
            let of_cells = set.cells.iter().flat_map(|cell| mesh.cells[*cell].nodes.iter().copied());
            let mut nodes: Vec<usize> = set.nodes.iter().copied().chain(of_cells).collect();
            nodes.sort_unstable();
            nodes.dedup();
            nodes
        };
        let sets = mesh.sets.iter().map(|set| (set.name.clone(), members(set))).collect();
        Self { labels, sets, ..Self::default() }
    }

    /// The same with the numbers of nodes that belong to no cell.
    pub(super) fn with_aside(self, aside: Vec<u64>) -> Self {
        Self { aside: aside.into_iter().collect(), ..self }
    }

    /// The nodes that a value names: a name, a number, a set, or a list of them.
    pub(in crate::model) fn named(&self, value: &Value<'_>) -> Option<Vec<usize>> {
        let Some(items) = value.items() else { return self.one(value) };
        let all: Option<Vec<Vec<usize>>> = items.iter().map(|item| self.one(item)).collect();
        let mut nodes = all?.concat();
        nodes.sort_unstable();
        nodes.dedup();
        Some(nodes)
    }

    /// The one node that a value names.
    pub(in crate::model) fn single(&self, value: &Value<'_>) -> Option<usize> {
        match self.named(value)?.as_slice() {
            [node] => Some(*node),
            several => value.refuse(
                format!("`{}` names {} nodes, but one is needed", value.key(), several.len()),
                "several nodes",
                "name one node, by its name or its number",
            ),
        }
    }

    fn one(&self, value: &Value<'_>) -> Option<Vec<usize>> {
        if value.is_number() {
            let label = value.integer(0..=usize::MAX)? as u64;
            return match self.labels.get(&label) {
                Some(node) => Some(vec![*node]),
                None if self.aside.contains(&label) => value.refuse(
                    format!("node {label} belongs to no cell of this part, so that nothing holds it"),
                    "a loose node",
                    "name a node of a cell; a [[connection]] of the nodes around it makes them one rigid piece",
                ),
                None => value.refuse(
                    format!("there is no node {label} in this part"),
                    "unknown node",
                    self.known(),
                ),
            };
        }
        let name = value.text()?;
        if let Some(node) = self.names.get(name) {
            return Some(vec![*node]);
        }
        if let Some(nodes) = self.sets.get(name) {
            if nodes.is_empty() && !self.aside.is_empty() {
                let help = "name nodes of cells";
                return value.refuse(
                    format!("the set {name:?} has no node of a cell of this part"),
                    "nothing",
                    help,
                );
            }
            return Some(nodes.clone());
        }
        let help = if self.sorted().is_empty() {
            self.known()
        } else {
            suggestion(name, || self.sorted().into_iter(), self.sorted().len())
        };
        value.refuse(format!("this part has no node or set {name:?}"), "unknown", help)
    }

    fn sorted(&self) -> Vec<&str> {
        let mut all: Vec<&str> = self.names.keys().chain(self.sets.keys()).map(String::as_str).collect();
        all.sort_unstable();
        all
    }

    fn known(&self) -> String {
        match self.labels.len() {
            0 => format!("its nodes are {}", self.sorted().join(", ")),
            count => format!("its {count} nodes are named by their numbers in the file"),
        }
    }
}
