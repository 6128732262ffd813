//! Numerical factorisation over a tree of supernodes: branches side by side, then the separators above them on all threads.

use std::sync::atomic::{AtomicU64, Ordering};

use super::branch;
use super::permuted::{self, Permuted};
use super::separators::Separators;
use super::structure::Panels;
use super::supernodes::Supernodes;
use super::triangle::Real;
use crate::symmetric::Symmetric;
use crate::threads::{self, Team};
use crate::watch;

/// Branches for each thread whose updates wait at once to be added in their order.
const AHEAD: usize = 2;

/// Entries of the factor of a matrix, scaled and shifted, panel by panel; none if a pivot is not positive.
pub(super) fn factored<T: Real>(
    panels: &Panels,
    (matrix, scale, shift): (&Symmetric, &[f64], f64),
) -> Option<Vec<T>> {
    let Panels { supernodes, tree, .. } = panels;
    let team = if tree.separators.is_empty() { Team::alone() } else { Team::new() };
    let node = |index: usize| supernodes.node(index);
    let matrix = Permuted::new(matrix, &panels.places(), scale, shift);
    let mut entries = vec![T::rounded(0.0); supernodes.entries()];
    let mut panels = split(supernodes, &mut entries);
    let mut taken = |index: &usize| std::mem::take(&mut panels[*index]);
    let upper = tree.separators.iter().map(&mut taken).collect();
    let mut separators = Separators::new(tree, node, &matrix, upper, &team);
    let progress = Progress::of(supernodes.multiplications());
    let mut stacks = vec![Vec::new(); AHEAD * team.size()];
    for round in tree.branches.chunks(stacks.len()) {
        let panels: Vec<Vec<&mut [T]>> =
            round.iter().map(|branch| branch.nodes.iter().map(&mut taken).collect()).collect();
        let tasks: Vec<_> = round.iter().zip(panels).zip(&mut stacks).collect();
        let done = team.map(tasks, |((branch, panels), stack)| {
            let done = |more| progress.add(more);
            branch::eliminate(branch, &tree.children, node, &matrix, panels, stack, done)
        });
        done.into_iter().collect::<Option<()>>()?;
        separators.add(node, &round.iter().zip(&stacks).collect::<Vec<_>>(), &team);
    }
    drop((matrix, stacks));
    separators.eliminate(&team, |more| progress.add(more))?;
    Some(entries)
}

/// Bytes beside the factor: the matrix, and the updates that exist at once.
pub(super) fn bytes<T: Real>(panels: &Panels, matrix_entries: usize) -> usize {
    let mut rooms: Vec<usize> = panels.tree.branches.iter().map(|branch| branch.room).collect();
    rooms.sort_unstable_by(|a, b| b.cmp(a));
    let updates: usize = rooms.iter().take(AHEAD * threads::count()).sum();
    updates * size_of::<T>() + permuted::bytes::<T>(panels.supernodes.size(), matrix_entries)
}

/// The panel of each supernode.
fn split<'a, T>(supernodes: &Supernodes, entries: &'a mut [T]) -> Vec<&'a mut [T]> {
    let mut rest = entries;
    let lengths = (0..supernodes.count()).map(|index| supernodes.panel(index).len());
    lengths.map(|length| rest.split_off_mut(..length).unwrap_or_default()).collect()
}

/// Multiplications done by all threads, as the watch is told.
struct Progress {
    all: f64,
    done: AtomicU64,
}

impl Progress {
    fn of(all: f64) -> Self {
        Self { all, done: AtomicU64::new(0) }
    }

    fn add(&self, more: f64) {
        let more = more as u64;
        let done = self.done.fetch_add(more, Ordering::Relaxed) + more;
        watch::progress(done as f64 / self.all);
    }
}
