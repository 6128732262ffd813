//! Supernodes: columns of a factor with the same rows below, whose entries are stored as one dense panel.

use std::ops::Range;

use faer::sparse::linalg::cholesky::supernodal::SymbolicSupernodalCholesky;

/// Columns of a supernode and the rows of its panel below them, ascending.
#[derive(Clone, Copy, Debug)]
pub(super) struct Supernode<'a> {
    pub start: usize,
    pub width: usize,
    pub below: &'a [usize],
}

impl Supernode<'_> {
    /// Rows of the panel.
    pub fn rows(&self) -> usize {
        self.width + self.below.len()
    }

    pub fn columns(&self) -> Range<usize> {
        self.start..self.start + self.width
    }

    /// Multiplications of its elimination: the sum of squares of the lengths of its columns.
    pub fn multiplications(&self) -> f64 {
        (1..=self.width).map(|column| ((self.below.len() + column) as f64).powi(2)).sum()
    }
}

/// All supernodes of a factor, in the order of elimination.
#[derive(Clone, Debug)]
pub(super) struct Supernodes {
    /// First column of each, and the number of columns.
    starts: Vec<usize>,
    /// Rows below the columns of each, one list after another.
    below: Vec<usize>,
    /// Where each list begins, and the end of the last.
    lists: Vec<usize>,
    /// Where the entries of each panel begin, and their number.
    panels: Vec<usize>,
}

impl Supernodes {
    /// Supernodes of a symbolic factor, each column of which stands for several; `columns` has the first of them, and the number of all.
    pub fn of(symbolic: &SymbolicSupernodalCholesky<usize>, columns: &[usize]) -> Self {
        let count = symbolic.n_supernodes();
        let mut starts = Vec::with_capacity(count + 1);
        let (mut below, mut lists, mut panels) = (Vec::new(), vec![0], vec![0]);
        for index in 0..count {
            let (start, end) =
                (columns[symbolic.supernode_begin()[index]], columns[symbolic.supernode_end()[index]]);
            starts.push(start);
            below.extend(
                symbolic.supernode(index).pattern().iter().flat_map(|row| columns[*row]..columns[row + 1]),
            );
            let length = below.len() - lists[index];
            lists.push(below.len());
            panels.push(panels[index] + (end - start) * (end - start + length));
        }
        starts.extend(columns.last());
        Self { starts, below, lists, panels }
    }

    /// Number of supernodes.
    pub fn count(&self) -> usize {
        self.panels.len() - 1
    }

    /// Number of columns.
    pub fn size(&self) -> usize {
        self.starts[self.count()]
    }

    /// Number of entries of the factor.
    pub fn entries(&self) -> usize {
        self.panels[self.count()]
    }

    pub fn node(&self, index: usize) -> Supernode<'_> {
        let start = self.starts[index];
        let below = &self.below[self.lists[index]..self.lists[index + 1]];
        Supernode { start, width: self.starts[index + 1] - start, below }
    }

    pub fn iter(&self) -> impl Iterator<Item = Supernode<'_>> {
        (0..self.count()).map(|index| self.node(index))
    }

    /// Entries of a panel among those of the factor.
    pub fn panel(&self, index: usize) -> Range<usize> {
        self.panels[index]..self.panels[index + 1]
    }

    /// Multiplications of the factorisation.
    pub fn multiplications(&self) -> f64 {
        self.iter().map(|node| node.multiplications()).sum()
    }
}
