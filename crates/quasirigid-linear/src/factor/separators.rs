//! Elimination of the separators above the branches, one after another, the work of each shared by all threads.
//! Each hands its update at once to the panels above, tile by tile, since a square of all its rows would not fit beside the factor.

use std::ops::Range;

use faer::{MatMut, MatRef};

use super::branch::fill;
use super::dense::{ROWS_PER_TASK, add_product, eliminate_together};
use super::permuted::Permuted;
use super::places::Places;
use super::supernodes::Supernode;
use super::tree::{Branch, Tree};
use super::triangle::Real;
use crate::threads::Team;

/// Columns of a tile of an update.
const COLUMNS: usize = 128;

/// Panels of the separators, in the order of elimination.
pub(super) struct Separators<'a, T> {
    tree: &'a Tree,
    nodes: Vec<Supernode<'a>>,
    panels: Vec<&'a mut [T]>,
}

/// Rows of an update below some row, all of them rows of one panel.
struct Incoming {
    /// Place of the separator.
    target: usize,
    /// Columns of the update that are columns of the separator.
    columns: Range<usize>,
    /// Place in the panel of each row of the update from the first of these columns on.
    places: Places,
}

/// Columns of a panel that some columns of an update are taken from.
struct Strip<'p, T> {
    part: &'p Incoming,
    /// Columns of the update.
    columns: Range<usize>,
    /// Columns of the panel, from that of the first of these on.
    entries: &'p mut [T],
    height: usize,
}

impl<'a, T: Real> Separators<'a, T> {
    /// Panels with the entries of the matrix.
    ///
    /// Zeros are written to new memory, on and below the diagonal: the system maps a page twice that is read before it is written.
    pub fn new(
        tree: &'a Tree,
        node: impl Fn(usize) -> Supernode<'a>,
        matrix: &Permuted<T>,
        mut panels: Vec<&'a mut [T]>,
        team: &Team,
    ) -> Self {
        let nodes: Vec<Supernode<'a>> = tree.separators.iter().map(|index| node(*index)).collect();
        let columns = nodes.iter().zip(&mut panels).flat_map(|(own, panel)| {
            panel.chunks_exact_mut(own.rows()).enumerate().map(|(diagonal, column)| &mut column[diagonal..])
        });
        team.map(columns.collect(), |column: &mut [T]| column.fill(T::rounded(0.0)));
        let mut local = Vec::new();
        nodes.iter().zip(&mut panels).for_each(|(own, panel)| fill(*own, matrix, panel, &mut local));
        Self { tree, nodes, panels }
    }

    /// Adds the updates of branches, in their order.
    pub fn add(
        &mut self,
        node: impl Fn(usize) -> Supernode<'a>,
        branches: &[(&Branch, &Vec<T>)],
        team: &Team,
    ) {
        let mut sources = Vec::new();
        for (branch, updates) in branches {
            let mut start = 0;
            for root in &branch.roots {
                let below = node(*root).below;
                let square = below.len() * below.len();
                sources.push((self.incoming(below), below.len(), &updates[start..][..square]));
                start += square;
            }
        }
        let heights: Vec<usize> = self.nodes.iter().map(Supernode::rows).collect();
        let pieces = self.panels.iter_mut().zip(&heights).enumerate();
        let pieces = pieces.flat_map(|(target, (panel, height))| {
            panel
                .chunks_mut(COLUMNS * height)
                .enumerate()
                .map(move |(index, piece)| (target, index * COLUMNS, piece))
        });
        team.map(pieces.collect(), |(target, first, piece): (usize, usize, &mut [T])| {
            let height = heights[target];
            let own = first..first + piece.len() / height;
            for (incoming, length, entries) in &sources {
                for part in incoming.iter().filter(|part| part.target == target) {
                    for column in part.places.before(own.start)..part.places.before(own.end) {
                        let sums = &mut piece[(part.places.at(column) - first) * height..][..height];
                        let start = column + part.columns.start;
                        let rows = column..part.places.len();
                        part.places.add(
                            rows,
                            &entries[start * length + start..(start + 1) * length],
                            sums,
                            0,
                        );
                    }
                }
            }
        });
    }

    /// Parts of an update over some rows, by the separators that own its columns.
    fn incoming(&self, below: &[usize]) -> Vec<Incoming> {
        let mut found = Vec::new();
        let mut start = 0;
        while let Some(row) = below.get(start) {
            let owner = self.tree.owners[*row] as usize;
            let target = self.tree.separators.partition_point(|separator| *separator < owner);
            let own = self.nodes[target];
            let end = start + below[start..].partition_point(|row| *row < own.columns().end);
            found.push(Incoming { target, columns: start..end, places: Places::of(&below[start..], own) });
            start = end;
        }
        found
    }

    /// Eliminates every separator; none if a pivot is not positive.
    pub fn eliminate(mut self, team: &Team, done: impl Fn(f64)) -> Option<()> {
        for index in 0..self.nodes.len() {
            let own = self.nodes[index];
            let incoming = self.incoming(own.below);
            let (panel, above) = self.panels[index..].split_first_mut()?;
            eliminate_together(own, panel, team)?;
            let low = MatRef::from_column_major_slice(panel, own.rows(), own.width);
            let low = low.subrows(own.width, own.below.len());
            let strips = strips(&incoming, &self.nodes, above, index + 1);
            team.map(strips, |strip| strip.subtract(low));
            done(own.multiplications());
        }
        Some(())
    }
}

/// Strips of the panels from place `first` on, of a width that the update alone decides.
fn strips<'p, T>(
    incoming: &'p [Incoming],
    nodes: &[Supernode<'_>],
    panels: &'p mut [&mut [T]],
    first: usize,
) -> Vec<Strip<'p, T>> {
    let mut strips = Vec::new();
    let mut panels = panels.iter_mut().zip(first..);
    for part in incoming {
        let Some((panel, target)) = panels.find(|(_, target)| *target == part.target) else { continue };
        let height = nodes[target].rows();
        let mut rest: &mut [T] = panel;
        let mut passed = 0;
        for start in part.columns.clone().step_by(COLUMNS) {
            let columns = start..part.columns.end.min(start + COLUMNS);
            let column = |column: usize| part.places.at(column - part.columns.start);
            let (from, to) = (column(columns.start), column(columns.end - 1) + 1);
            let (entries, others) = rest.split_at_mut((to - passed) * height);
            strips.push(Strip { part, columns, entries: &mut entries[(from - passed) * height..], height });
            (rest, passed) = (others, to);
        }
    }
    strips
}

impl<T: Real> Strip<'_, T> {
    /// Subtracts these columns of `L Lᵀ`, tile by tile.
    fn subtract(self, low: MatRef<'_, T>) {
        let width = self.columns.len();
        let across = low.subrows(self.columns.start, width).to_owned();
        let mut room = vec![T::rounded(0.0); ROWS_PER_TASK * width];
        let places = &self.part.places;
        let first = self.columns.start - self.part.columns.start;
        for start in (first..places.len()).step_by(ROWS_PER_TASK) {
            let rows = ROWS_PER_TASK.min(places.len() - start);
            let product = &mut room[..rows * width];
            product.fill(T::rounded(0.0));
            let tile = MatMut::from_column_major_slice_mut(product, rows, width);
            let left = low.subrows(self.part.columns.start + start, rows);
            add_product(tile, T::rounded(1.0), left, across.as_ref());
            for (column, product) in product.chunks_exact(rows).enumerate() {
                let own = first + column;
                let sums =
                    &mut self.entries[(places.at(own) - places.at(first)) * self.height..][..self.height];
                let above = own.saturating_sub(start).min(rows);
                places.subtract(start + above..start + rows, &product[above..], sums, 0);
            }
        }
    }
}
