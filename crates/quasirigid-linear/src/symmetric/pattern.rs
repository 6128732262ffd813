//! Sparsity pattern of symmetric matrices.

use std::ops::Range;

use super::SymmetricError;

/// Places of the lower triangle, by columns, rows ascending; each column begins with its diagonal.
#[derive(Clone, Debug, PartialEq)]
pub struct Pattern {
    starts: Vec<usize>,
    rows: Vec<u32>,
}

impl Pattern {
    /// The places that elements fill, each of which joins all unknowns of its nodes with each other.
    ///
    /// Unknowns are numbered node by node: those of node `i` are `first[i]..first[i + 1]`, so `first` holds one
    /// number more than there are nodes, and a fixed node has an empty range. An element is the list of its
    /// nodes. Beside the result this needs one list of the elements of each node.
    ///
    /// # Errors
    /// [`SymmetricError`] if `first` falls or an element names a node that does not exist.
    pub fn new<'a>(
        first: &[u32],
        elements: impl Iterator<Item = &'a [u32]> + Clone,
    ) -> Result<Self, SymmetricError> {
        check(first, elements.clone())?;
        let nodes = first.len().saturating_sub(1);
        let incidence = Incidence::of(nodes, elements);
        let size = first.last().map_or(0, |last| *last as usize);
        let mut pattern = Self { starts: Vec::with_capacity(size + 1), rows: Vec::new() };
        pattern.starts.push(0);
        // Unknowns before the first node are joined with nothing.
        (0..first.first().map_or(0, |first| *first))
            .for_each(|unknown| pattern.column([unknown].into_iter()));
        let mut neighbours = Neighbours { of: vec![u32::MAX; nodes], list: Vec::new() };
        for node in 0..nodes {
            neighbours.find(node as u32, &incidence);
            for unknown in first[node]..first[node + 1] {
                let own = unknown..first[node + 1];
                let others = neighbours.list.iter().map(|other| *other as usize);
                pattern.column(own.chain(others.flat_map(|other| first[other]..first[other + 1])));
            }
        }
        pattern.rows.shrink_to_fit();
        Ok(pattern)
    }

    /// A pattern from the rows of each column, which ascend and begin with the diagonal.
    pub(crate) fn of_columns(size: usize, column: impl Fn(usize, &mut Vec<u32>)) -> Self {
        let mut pattern = Self { starts: vec![0], rows: Vec::new() };
        for index in 0..size {
            column(index, &mut pattern.rows);
            pattern.starts.push(pattern.rows.len());
        }
        pattern
    }

    fn column(&mut self, rows: impl Iterator<Item = u32>) {
        self.rows.extend(rows);
        self.starts.push(self.rows.len());
    }

    /// Number of unknowns.
    #[must_use]
    pub fn size(&self) -> usize {
        self.starts.len() - 1
    }

    /// Number of places, those of the diagonal included.
    #[must_use]
    pub fn places(&self) -> usize {
        self.rows.len()
    }

    /// The places of a column; none if there is no such column.
    pub(crate) fn range(&self, column: u32) -> Option<Range<usize>> {
        let end = self.starts.get(column as usize + 1)?;
        Some(self.starts[column as usize]..*end)
    }

    /// First place of each column, and the end of the last column.
    pub(crate) fn starts(&self) -> &[usize] {
        &self.starts
    }

    /// The row of each place.
    pub(crate) fn rows(&self) -> &[u32] {
        &self.rows
    }
}

fn check<'a>(first: &[u32], elements: impl Iterator<Item = &'a [u32]>) -> Result<(), SymmetricError> {
    if let Some(node) = (1..first.len()).find(|node| first[*node] < first[node - 1]) {
        return Err(SymmetricError::Unordered { node, first: first[node], before: first[node - 1] });
    }
    let count = first.len().saturating_sub(1);
    for (element, nodes) in elements.enumerate() {
        if let Some(node) = nodes.iter().copied().find(|node| *node as usize >= count) {
            return Err(SymmetricError::Node { element, node, count });
        }
    }
    Ok(())
}

/// The elements that meet at each node.
struct Incidence<'a> {
    starts: Vec<usize>,
    elements: Vec<&'a [u32]>,
}

impl<'a> Incidence<'a> {
    fn of(nodes: usize, elements: impl Iterator<Item = &'a [u32]> + Clone) -> Self {
        let mut starts = vec![0_usize; nodes + 1];
        elements.clone().flatten().for_each(|node| starts[*node as usize + 1] += 1);
        (0..nodes).for_each(|node| starts[node + 1] += starts[node]);
        let mut next = starts.clone();
        let mut incidence = Self { elements: vec![&[]; starts[nodes]], starts };
        for element in elements {
            for node in element {
                incidence.elements[next[*node as usize]] = element;
                next[*node as usize] += 1;
            }
        }
        incidence
    }
}

/// The nodes that share an element with a node and come after it, ascending.
struct Neighbours {
    /// The node for which each node was last listed.
    of: Vec<u32>,
    list: Vec<u32>,
}

impl Neighbours {
    fn find(&mut self, node: u32, incidence: &Incidence) {
        self.list.clear();
        let range = incidence.starts[node as usize]..incidence.starts[node as usize + 1];
        for other in incidence.elements[range].iter().copied().flatten().copied() {
            if other > node && self.of[other as usize] != node {
                self.of[other as usize] = node;
                self.list.push(other);
            }
        }
        self.list.sort_unstable();
    }
}
