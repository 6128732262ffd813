//! Solutions with a factor over a tree of supernodes: up through branches side by side, through the separators and back, and down again.
//! Right-hand sides stand row by row, in the order of elimination.

use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{solve_lower_triangular_in_place, solve_upper_triangular_in_place};
use faer::prelude::ReborrowMut;
use faer::{Accum, MatMut, MatRef, Par};

use super::dense::{COLUMNS, tiles};
use super::places::Places;
use super::structure::Panels;
use super::supernodes::Supernode;
use super::tree::Branch;
use super::triangle::Real;
use crate::threads::Team;

/// A factor and the number of right-hand sides.
pub(super) struct Solution<'a, T> {
    pub panels: &'a Panels,
    pub entries: &'a [T],
    pub width: usize,
}

impl<'a, T: Real> Solution<'a, T> {
    /// Solves `L Lᵀ x = b` in place.
    pub fn solve(&self, x: &mut [T]) {
        let team = if self.panels.tree.separators.is_empty() { Team::alone() } else { Team::new() };
        let passed = team.map(self.shares(x), |(branch, own)| self.up(branch, own));
        for (branch, passed) in self.panels.tree.branches.iter().zip(passed) {
            let mut rest = passed.as_slice();
            for root in &branch.roots {
                let rows = self.node(*root).below;
                let (own, others) = rest.split_at(rows.len() * self.width);
                self.add(rows, own, x);
                rest = others;
            }
        }
        self.panels.tree.separators.iter().for_each(|index| self.up_together(*index, x, &team));
        self.panels.tree.separators.iter().rev().for_each(|index| self.down_together(*index, x, &team));
        let above = |branch: &Branch| {
            branch.roots.iter().flat_map(|root| self.taken(self.node(*root).below, x)).collect()
        };
        let above: Vec<Vec<T>> = self.panels.tree.branches.iter().map(above).collect();
        let tasks = self.shares(x).into_iter().zip(above).collect();
        team.map(tasks, |((branch, own), above)| self.down(branch, own, above));
    }

    fn node(&self, index: usize) -> Supernode<'a> {
        self.panels.supernodes.node(index)
    }

    fn panel(&self, index: usize) -> MatRef<'a, T> {
        let (node, entries) = (self.node(index), self.panels.supernodes.panel(index));
        MatRef::from_column_major_slice(&self.entries[entries], node.rows(), node.width)
    }

    /// The rows of each branch, supernode by supernode.
    fn shares<'x>(&self, x: &'x mut [T]) -> Vec<(&'a Branch, Vec<&'x mut [T]>)> {
        let mut rest = x;
        let lengths = self.panels.supernodes.iter().map(|node| node.width * self.width);
        let mut rows: Vec<&mut [T]> =
            lengths.map(|length| rest.split_off_mut(..length).unwrap_or_default()).collect();
        let own = |branch: &Branch, rows: &mut Vec<&'x mut [T]>| {
            branch.nodes.iter().map(|index| std::mem::take(&mut rows[*index])).collect()
        };
        self.panels.tree.branches.iter().map(|branch| (branch, own(branch, &mut rows))).collect()
    }

    /// `L y = b` in a branch; returns what its roots subtract from the rows above, as negative numbers.
    fn up(&self, branch: &Branch, own: Vec<&mut [T]>) -> Vec<T> {
        let mut stack: Vec<T> = Vec::new();
        for (index, x) in branch.nodes.iter().zip(own) {
            let node = self.node(*index);
            let mut front = vec![T::rounded(0.0); node.rows() * self.width];
            front[..x.len()].copy_from_slice(x);
            let children = &self.panels.tree.children[*index];
            let length = |child: &usize| self.node(*child).below.len() * self.width;
            let mut start = stack.len() - children.iter().map(length).sum::<usize>();
            let base = start;
            for child in children {
                let entries = &stack[start..][..length(child)];
                let places = Places::of(self.node(*child).below, node);
                for (row, entries) in entries.chunks_exact(self.width).enumerate() {
                    let sums = &mut front[places.at(row) * self.width..][..self.width];
                    sums.iter_mut().zip(entries).for_each(|(sum, entry)| *sum += *entry);
                }
                start += entries.len();
            }
            let panel = self.panel(*index);
            let (mut top, mut low) = self.halves(&mut front, node.width);
            solve_lower_triangular_in_place(panel.subrows(0, node.width), top.rb_mut(), Par::Seq);
            let across = panel.subrows(node.width, node.below.len());
            matmul(low.rb_mut(), Accum::Add, across, top.as_ref(), T::rounded(-1.0), Par::Seq);
            let (top, low) = front.split_at(x.len());
            x.copy_from_slice(top);
            stack.truncate(base);
            stack.extend_from_slice(low);
        }
        stack
    }

    /// `Lᵀ x = y` in a branch, with the solution in the rows below its roots.
    fn down(&self, branch: &Branch, own: Vec<&mut [T]>, above: Vec<T>) {
        let mut stack = above;
        for (index, x) in branch.nodes.iter().zip(own).rev() {
            let node = self.node(*index);
            let below = stack.split_off(stack.len() - node.below.len() * self.width);
            let mut front = [&*x, &below].concat();
            let panel = self.panel(*index);
            let (mut top, low) = self.halves(&mut front, node.width);
            let across = panel.subrows(node.width, node.below.len()).transpose();
            matmul(top.rb_mut(), Accum::Add, across, low.as_ref(), T::rounded(-1.0), Par::Seq);
            solve_upper_triangular_in_place(panel.subrows(0, node.width).transpose(), top, Par::Seq);
            x.copy_from_slice(&front[..x.len()]);
            for child in &self.panels.tree.children[*index] {
                let rows = self.node(*child).below;
                let places = Places::of(rows, node);
                (0..rows.len())
                    .for_each(|row| stack.extend(&front[places.at(row) * self.width..][..self.width]));
            }
        }
    }

    /// A step of `L y = b` through a separator.
    fn up_together(&self, index: usize, x: &mut [T], team: &Team) {
        let (node, panel) = (self.node(index), self.panel(index));
        let own = node.start * self.width..(node.start + node.width) * self.width;
        let mut front = vec![T::rounded(0.0); node.rows() * self.width];
        front[..own.len()].copy_from_slice(&x[own.clone()]);
        for start in (0..node.width).step_by(COLUMNS) {
            let block = panel.subcols(start, COLUMNS.min(node.width - start));
            let (_, rest) = front.split_at_mut(start * self.width);
            let (mut top, low) = self.halves(rest, block.ncols());
            solve_lower_triangular_in_place(block.subrows(start, block.ncols()), top.rb_mut(), Par::Seq);
            let first = start + block.ncols();
            team.map(tiles(low), |(row, tile)| {
                let across = block.subrows(first + row, tile.nrows());
                matmul(tile, Accum::Add, across, top.as_ref(), T::rounded(-1.0), Par::Seq);
            });
        }
        let (top, low) = front.split_at(own.len());
        x[own].copy_from_slice(top);
        self.add(node.below, low, x);
    }

    /// A step of `Lᵀ x = y` through a separator.
    fn down_together(&self, index: usize, x: &mut [T], team: &Team) {
        let (node, panel) = (self.node(index), self.panel(index));
        let own = node.start * self.width..(node.start + node.width) * self.width;
        let mut front = [&x[own.clone()], &self.taken(node.below, x)].concat();
        for start in (0..node.width).step_by(COLUMNS).rev() {
            let block = panel.subcols(start, COLUMNS.min(node.width - start));
            let (_, rest) = front.split_at_mut(start * self.width);
            let (mut top, low) = self.halves(rest, block.ncols());
            let first = start + block.ncols();
            let parts = team.map(tiles(low), |(row, tile)| {
                let mut part = vec![T::rounded(0.0); block.ncols() * self.width];
                let across = block.subrows(first + row, tile.nrows()).transpose();
                let sum = MatMut::from_row_major_slice_mut(&mut part, block.ncols(), self.width);
                matmul(sum, Accum::Add, across, tile.as_ref(), T::rounded(1.0), Par::Seq);
                part
            });
            for part in &parts {
                top -= MatRef::from_row_major_slice(part, block.ncols(), self.width);
            }
            solve_upper_triangular_in_place(block.subrows(start, block.ncols()).transpose(), top, Par::Seq);
        }
        x[own.clone()].copy_from_slice(&front[..own.len()]);
    }

    /// The first rows of a front, and the others.
    fn halves<'f>(&self, front: &'f mut [T], rows: usize) -> (MatMut<'f, T>, MatMut<'f, T>) {
        let all = front.len() / self.width;
        MatMut::from_row_major_slice_mut(front, all, self.width).split_at_row_mut(rows)
    }

    /// Adds numbers to some rows.
    fn add(&self, rows: &[usize], numbers: &[T], x: &mut [T]) {
        for (row, numbers) in rows.iter().zip(numbers.chunks_exact(self.width)) {
            let sums = &mut x[row * self.width..][..self.width];
            sums.iter_mut().zip(numbers).for_each(|(sum, number)| *sum += *number);
        }
    }

    /// A copy of some rows.
    fn taken(&self, rows: &[usize], x: &[T]) -> Vec<T> {
        rows.iter().flat_map(|row| &x[row * self.width..][..self.width]).copied().collect()
    }
}
