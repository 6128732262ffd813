//! Dense kernels of one supernode: its panel eliminated by one thread, or in tiles by several.
//! Tiles are cut by sizes alone, and each is one thread's: the bits do not depend on the number of threads.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{cholesky_in_place, cholesky_in_place_scratch};
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::prelude::{ReborrowMut, default};
use faer::{Accum, MatMut, MatRef, Par};

use super::supernodes::Supernode;
use super::triangle::Real;
use crate::threads::Team;
use crate::watch;

/// Columns of a separator that are eliminated or solved at once.
pub(super) const COLUMNS: usize = 128;
/// Rows of a task.
pub(super) const ROWS_PER_TASK: usize = 576;
/// Rows of a product that the sparse library forms at once. Larger ones run at half the speed, as they leave the cache.
const TILE: usize = 144;
/// Terms of a product that the sparse library sums at once.
const DEPTH: usize = 256;

/// Eliminates the columns of a panel; none if a pivot is not positive.
pub(super) fn eliminate<T: Real>(own: Supernode<'_>, panel: &mut [T]) -> Option<()> {
    let panel = MatMut::from_column_major_slice_mut(panel, own.rows(), own.width);
    let (mut square, low) = panel.split_at_row_mut(own.width);
    factor(square.rb_mut())?;
    divide(square.as_ref(), low);
    Some(())
}

/// Eliminates the columns of a panel in tiles; none if a pivot is not positive.
pub(super) fn eliminate_together<T: Real>(own: Supernode<'_>, panel: &mut [T], team: &Team) -> Option<()> {
    let rows = own.rows();
    for start in (0..own.width).step_by(COLUMNS) {
        watch::ask();
        let width = COLUMNS.min(own.width - start);
        let (before, rest) = panel.split_at_mut(start * rows);
        let before = MatRef::from_column_major_slice(before, rows, start);
        let block = MatMut::from_column_major_slice_mut(&mut rest[..width * rows], rows, width);
        let (_, mut block) = block.split_at_row_mut(start);
        if start > 0 {
            let across = before.subrows(start, width).to_owned();
            team.map(tiles(block.rb_mut()), |(row, tile)| {
                let left = before.subrows(start + row, tile.nrows());
                add_product(tile, T::rounded(-1.0), left, across.as_ref());
            });
        }
        let (mut square, low) = block.split_at_row_mut(width);
        factor(square.rb_mut())?;
        let square = square.as_ref();
        team.map(tiles(low), |(_, tile)| divide(square, tile));
    }
    Some(())
}

/// Adds `a L Bᵀ`; `B` has few rows, close together in memory.
pub(super) fn add_product<T: Real>(mut sum: MatMut<'_, T>, a: T, L: MatRef<'_, T>, B: MatRef<'_, T>) {
    for term in (0..L.ncols()).step_by(DEPTH) {
        let terms = DEPTH.min(L.ncols() - term);
        let (L, B) = (L.subcols(term, terms), B.subcols(term, terms));
        for row in (0..L.nrows()).step_by(TILE) {
            let rows = TILE.min(L.nrows() - row);
            let sum = sum.rb_mut().subrows_mut(row, rows);
            matmul(sum, Accum::Add, L.subrows(row, rows), B.transpose(), a, Par::Seq);
        }
    }
}

/// Rows of a matrix in tiles, each with its first row.
pub(super) fn tiles<T>(matrix: MatMut<'_, T>) -> Vec<(usize, MatMut<'_, T>)> {
    let mut tiles = Vec::with_capacity(matrix.nrows().div_ceil(ROWS_PER_TASK));
    let (mut row, mut rest) = (0, matrix);
    while rest.nrows() > ROWS_PER_TASK {
        let (tile, others) = rest.split_at_row_mut(ROWS_PER_TASK);
        tiles.push((row, tile));
        row += ROWS_PER_TASK;
        rest = others;
    }
    tiles.push((row, rest));
    tiles
}

/// `L` of `A = L Lᵀ` in place of the lower triangle.
fn factor<T: Real>(matrix: MatMut<'_, T>) -> Option<()> {
    let mut buffer =
        MemBuffer::try_new(cholesky_in_place_scratch::<T>(matrix.nrows(), Par::Seq, default())).ok()?;
    cholesky_in_place(matrix, default(), Par::Seq, MemStack::new(&mut buffer), default()).ok()?;
    Some(())
}

/// `A L⁻ᵀ` in place of `A`.
fn divide<T: Real>(triangle: MatRef<'_, T>, matrix: MatMut<'_, T>) {
    if matrix.nrows() > 0 {
        solve_lower_triangular_in_place(triangle, matrix.transpose_mut(), Par::Seq);
    }
}
