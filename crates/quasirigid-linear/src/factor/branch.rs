//! Elimination of a branch by one thread: the multifrontal method, whose updates are added up from child to parent on a stack.
//!
//! Duff & Reid, The multifrontal solution of indefinite sparse symmetric linear equations, ACM Trans. Math. Softw. 9 (1983), 302.

use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::{Accum, MatMut, Par};

use super::dense;
use super::permuted::Permuted;
use super::places::Places;
use super::supernodes::Supernode;
use super::tree::Branch;
use super::triangle::Real;

/// Eliminates the supernodes of a branch in their panels; none if a pivot is not positive.
///
/// Leaves in `stack` the updates of the roots, one after another: each a square over the rows below its root, lower triangle.
pub(super) fn eliminate<'a, T: Real>(
    branch: &Branch,
    children: &[Vec<usize>],
    node: impl Fn(usize) -> Supernode<'a>,
    matrix: &Permuted<T>,
    panels: Vec<&mut [T]>,
    stack: &mut Vec<T>,
    done: impl Fn(f64),
) -> Option<()> {
    let zero = T::rounded(0.0);
    if stack.len() < branch.room {
        stack.resize(branch.room, zero);
    }
    let mut top = 0;
    let mut local = Vec::new();
    for (index, panel) in branch.nodes.iter().zip(panels) {
        let own = node(*index);
        let length = own.below.len();
        panel.fill(zero); // new memory, written before it is read: see `Separators::new`
        fill(own, matrix, panel, &mut local);
        let (below, above) = stack.split_at_mut(top);
        let update = &mut above[..length * length];
        let mut base = top;
        for child in children[*index].iter().rev() {
            let rows = node(*child).below;
            base -= rows.len() * rows.len();
        }
        let leaf = children[*index].is_empty();
        if !leaf {
            update.fill(zero);
        }
        let mut from = base;
        for child in &children[*index] {
            let rows = node(*child).below;
            let entries = &below[from..][..rows.len() * rows.len()];
            extend(entries, &Places::of(rows, own), own, panel, update);
            from += entries.len();
        }
        dense::eliminate(own, panel)?;
        if length > 0 {
            let panel = MatMut::from_column_major_slice_mut(panel, own.rows(), own.width);
            let (_, low) = panel.split_at_row_mut(own.width);
            triangular::matmul(
                MatMut::from_column_major_slice_mut(update, length, length),
                BlockStructure::TriangularLower,
                if leaf { Accum::Replace } else { Accum::Add },
                low.as_ref(),
                BlockStructure::Rectangular,
                low.as_ref().transpose(),
                BlockStructure::Rectangular,
                T::rounded(-1.0),
                Par::Seq,
            );
        }
        if base < top {
            stack.copy_within(top..top + length * length, base);
        }
        top = base + length * length;
        done(own.multiplications());
    }
    Some(())
}

/// Puts the entries of the matrix into a panel of zeros; `local` is room for the place of each row.
pub(super) fn fill<T: Real>(own: Supernode<'_>, matrix: &Permuted<T>, panel: &mut [T], local: &mut Vec<u32>) {
    let end = own.start + own.width;
    let last = own.below.last().map_or(0, |last| last + 1 - end);
    if local.len() < last {
        local.resize(last, 0);
    }
    own.below.iter().enumerate().for_each(|(place, row)| local[row - end] = (own.width + place) as u32);
    for (column, entries) in own.columns().zip(panel.chunks_exact_mut(own.rows())) {
        for (row, entry) in matrix.column(column) {
            let place = if row < end { row - own.start } else { local[row - end] as usize };
            entries[place] = entry;
        }
    }
}

/// Adds the update of a child, whose rows have these places, to the panel of its parent and to the parent's own update.
fn extend<T: Real>(child: &[T], places: &Places, own: Supernode<'_>, panel: &mut [T], update: &mut [T]) {
    let length = own.below.len();
    let inside = places.before(own.width);
    for (j, column) in child.chunks_exact(places.len().max(1)).enumerate() {
        let place = places.at(j);
        let (above, sums) = if j < inside {
            (0, &mut panel[place * own.rows()..][..own.rows()])
        } else {
            (own.width, &mut update[(place - own.width) * length..][..length])
        };
        places.add(j..places.len(), &column[j..], sums, above);
    }
}
