//! Mesh under construction: nodes and cells by the labels of their file, sets by name.
//! Labels are arbitrary 64-bit numbers, so indices come from a hash map and not from a table as long as the greatest label.

use std::collections::hash_map::Entry;
use std::collections::{HashMap, HashSet};

use quasirigid_math::memory;
use quasirigid_mesh::{Cell, Mesh, Shape};

use super::others::Others;
use super::problem::VolumeProblem;
use super::sets::Sets;
use super::{MeshProblem, Part};
use crate::pyramid;

/// A mesh on its way from a file that numbers nodes and cells as it likes.
#[derive(Default)]
pub(super) struct Draft {
    nodes: Vec<[f64; 3]>,
    node_labels: Vec<u64>,
    node_of: HashMap<u64, usize>,
    cells: Vec<Cell>,
    cell_of: HashMap<u64, usize>,
    /// Greatest number of a node.
    last_node: u64,
    /// Nodes that were put in the middles of diagonals.
    middles: HashMap<[u64; 2], u64>,
    pub(super) sets: Sets,
    /// Type of each cell among those of the file, where the format has them.
    pub(super) types: Vec<u16>,
    /// Node towards which a beam has its first axis, by the index of its cell.
    pub(super) towards: Vec<(usize, u64)>,
    pub(super) others: Others,
    /// Pyramids by their first halves.
    pub(super) pyramids: HashMap<usize, Pyramid>,
}

/// A pyramid of two halves.
#[derive(Clone, Copy)]
pub(crate) struct Pyramid {
    /// Index of the cell that is its second half.
    pub second: usize,
    /// Corner of its base with which the first half begins.
    pub least: usize,
}

impl Draft {
    /// Adds a node, and returns its index.
    pub(super) fn add_node(&mut self, label: u64, place: [f64; 3]) -> Result<usize, MeshProblem> {
        finite(label, place)?;
        insert(&mut self.node_of, Part::Nodes, label, self.nodes.len())?;
        self.nodes.push(place);
        self.node_labels.push(label);
        self.last_node = self.last_node.max(label);
        Ok(self.nodes.len() - 1)
    }

    /// Adds a cell whose nodes stand in the order of [`Shape`], and returns its index.
    pub(super) fn add_cell(&mut self, label: u64, shape: Shape, nodes: &[u64]) -> Result<usize, MeshProblem> {
        let nodes = nodes.iter().map(|node| self.index(label, *node)).collect::<Result<_, _>>()?;
        insert(&mut self.cell_of, Part::Cells, label, self.cells.len())?;
        self.cells.push(Cell { label, shape, nodes });
        Ok(self.cells.len() - 1)
    }

    /// Adds a pyramid of 5, 13 or 14 nodes as two tetrahedra of its number, and returns the index of the first; the second follows it into sets.
    pub(super) fn add_pyramid(&mut self, label: u64, nodes: &[u64]) -> Result<usize, MeshProblem> {
        let least = pyramid::least(nodes);
        let (shape, [first, second]) = if nodes.len() == pyramid::NODES {
            (Shape::Tet4, pyramid::halves(nodes).map(|half| half.map(|place| nodes[place]).to_vec()))
        } else {
            let middle = match nodes.get(pyramid::CURVED) {
                Some(given) => *given,
                None => self.middle_of_base(label, nodes)?,
            };
            let of = |place: Option<usize>| place.map_or(middle, |place| nodes[place]);
            (Shape::Tet10, pyramid::curved_halves(nodes).map(|half| half.map(of).to_vec()))
        };
        let added = self.add_cell(label, shape, &first)?;
        let nodes = second.into_iter().map(|node| self.index(label, node)).collect::<Result<_, _>>()?;
        self.pyramids.insert(added, Pyramid { second: self.cells.len(), least });
        self.cells.push(Cell { label, shape, nodes });
        Ok(added)
    }

    /// The node in the middle of the base of a pyramid of 13 nodes, which the cell on the other side shares.
    fn middle_of_base(&mut self, cell: u64, nodes: &[u64]) -> Result<u64, MeshProblem> {
        let [[a, _, c, _], _] = pyramid::halves(nodes);
        let diagonal = [nodes[a].min(nodes[c]), nodes[a].max(nodes[c])];
        if let Some(known) = self.middles.get(&diagonal) {
            return Ok(*known);
        }
        let mut places = [[[0.0; 3]; 4]; 2];
        for (places, first) in places.iter_mut().zip([0, pyramid::NODES]) {
            for (place, node) in places.iter_mut().zip(&nodes[first..]) {
                *place = self.nodes[self.index(cell, *node)?];
            }
        }
        let [corners, sides] = places;
        let label = self.last_node.saturating_add(1);
        self.add_node(label, pyramid::middle_of_base(corners, sides))?;
        self.middles.insert(diagonal, label);
        Ok(label)
    }

    /// Index of a node that a cell names.
    fn index(&self, cell: u64, node: u64) -> Result<usize, VolumeProblem> {
        self.node(node).ok_or(VolumeProblem::NoSuchNode { cell, node })
    }

    /// Index of the node with this number.
    pub(super) fn node(&self, label: u64) -> Option<usize> {
        self.node_of.get(&label).copied()
    }

    /// Index of the cell with this number.
    pub(super) fn cell(&self, label: u64) -> Option<usize> {
        self.cell_of.get(&label).copied()
    }

    /// Whether there is no node, no set and no element.
    pub(super) fn is_empty(&self) -> bool {
        self.nodes.is_empty() && self.sets.all().is_empty() && self.others.all.is_empty()
    }

    fn has_element(&self, label: u64) -> bool {
        self.cell_of.contains_key(&label) || self.others.of(label).is_some()
    }

    /// Numbers of the nodes, in their order.
    pub(super) fn node_labels(&self) -> &[u64] {
        &self.node_labels
    }

    /// The cells so far.
    pub(super) fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// Adds the nodes, moved, the cells and the sets of another draft, whose numbers are shifted beyond those that are there; sets get a
    /// prefix. Returns the shifts of nodes and cells.
    pub(super) fn append(
        &mut self,
        other: &Self,
        place: impl Fn([f64; 3]) -> [f64; 3],
        prefix: &str,
    ) -> Result<[u64; 2], MeshProblem> {
        let clash = other.node_labels.iter().any(|label| self.node_of.contains_key(label))
            || other.cells.iter().any(|cell| self.has_element(cell.label))
            || other.others.all.iter().any(|element| self.has_element(element.label));
        let last = |labels: &mut dyn Iterator<Item = u64>| labels.max().unwrap_or(0);
        let shifts = if clash {
            let others = self.others.all.iter().map(|element| element.label);
            [
                last(&mut self.node_labels.iter().copied()),
                last(&mut self.cells.iter().map(|cell| cell.label).chain(others)),
            ]
        } else {
            [0; 2]
        };
        let (first_node, first_cell) = (self.nodes.len(), self.cells.len());
        memory::ask((other.nodes.len() * 100 + other.cells.len() * 200) as f64)
            .map_err(MeshProblem::Memory)?;
        for (node, label) in other.nodes.iter().zip(&other.node_labels) {
            self.add_node(label.saturating_add(shifts[0]), place(*node))?;
        }
        let second: HashSet<usize> = other.pyramids.values().map(|pyramid| pyramid.second).collect();
        for (place, cell) in other.cells.iter().enumerate() {
            let label = cell.label.saturating_add(shifts[1]);
            if second.contains(&place) {
                let nodes = cell.nodes.iter().map(|node| first_node + node).collect();
                self.cells.push(Cell { label, shape: cell.shape, nodes });
                continue;
            }
            insert(&mut self.cell_of, Part::Cells, label, self.cells.len())?;
            let nodes = cell.nodes.iter().map(|node| first_node + node).collect();
            self.cells.push(Cell { label, shape: cell.shape, nodes });
        }
        let pyramids = other.pyramids.iter().map(|(first, Pyramid { second, least })| {
            (first_cell + first, Pyramid { second: first_cell + second, least: *least })
        });
        self.pyramids.extend(pyramids);
        self.types.extend(&other.types);
        self.towards.extend(
            other.towards.iter().map(|(cell, node)| (first_cell + cell, node.saturating_add(shifts[0]))),
        );
        self.others.append(&other.others, shifts, prefix)?;
        for set in other.sets.all() {
            let name = format!("{prefix}{}", set.name);
            let at = self.sets.place(&name.to_ascii_uppercase(), &name);
            let shifted = |members: &[usize], first: usize| -> Vec<usize> {
                members.iter().map(|member| first + member).collect()
            };
            self.sets.add_nodes(at, &shifted(&set.nodes, first_node))?;
            self.sets.add_cells(at, &shifted(&set.cells, first_cell))?;
        }
        Ok(shifts)
    }

    /// The mesh.
    pub(super) fn mesh(self) -> Mesh {
        let Self { nodes, node_labels, cells, mut sets, pyramids, .. } = self;
        sets.with_halves(&pyramids);
        Mesh { nodes, node_labels, cells, sets: sets.sorted() }
    }
}

/// Refuses a node whose coordinates are not finite.
pub(super) fn finite(label: u64, place: [f64; 3]) -> Result<(), MeshProblem> {
    match place.iter().find(|x| !x.is_finite()) {
        Some(x) => Err(VolumeProblem::NotFinite { node: label, found: x.to_string().into() }.into()),
        None => Ok(()),
    }
}

fn insert(of: &mut HashMap<u64, usize>, part: Part, label: u64, index: usize) -> Result<(), VolumeProblem> {
    match of.entry(label) {
        Entry::Occupied(_) => Err(VolumeProblem::Twice { part, label }),
        Entry::Vacant(vacant) => {
            vacant.insert(index);
            Ok(())
        }
    }
}
