//! Sparse complex matrices that fall apart into blocks, most of them small: their factors.

use std::sync::Arc;

use nalgebra::Complex;

use crate::connected_components::connected_components;
use crate::lu::SparseLu;

type C = Complex<f64>;

/// Partition of unknowns into blocks that no entry couples.
#[derive(Clone, Debug)]
pub struct Blocks {
    layout: Arc<Layout>,
}

#[derive(Debug)]
struct Layout {
    lists: Vec<Vec<usize>>,
    /// Block of each unknown, and its place there.
    places: Vec<[usize; 2]>,
    /// Where the dense matrix of each block starts, and the end of the last; nothing for large blocks.
    starts: Vec<usize>,
}

/// Factors of a matrix of blocks: of small ones one after the other, row by row, as thousands of matrices by themselves cost ten times as much.
#[derive(Clone, Debug)]
pub struct BlockFactor {
    layout: Arc<Layout>,
    dense: Vec<C>,
    /// Row that takes the place of each row of a small block.
    pivots: Vec<usize>,
    sparse: Vec<Option<SparseLu>>,
}

/// Entry by row and column, real and imaginary part.
type Entry = (usize, usize, [f64; 2]);

/// Size up to which a block is factored as a dense matrix.
const DENSE: usize = 48;

impl Blocks {
    /// Blocks of so many unknowns, coupled in pairs.
    #[must_use]
    pub fn of(size: usize, pairs: impl IntoIterator<Item = [usize; 2]>) -> Self {
        let lists = connected_components(size, pairs);
        let (mut places, mut starts) = (vec![[0; 2]; size], vec![0]);
        for (block, list) in lists.iter().enumerate() {
            list.iter().enumerate().for_each(|(place, unknown)| places[*unknown] = [block, place]);
            let entries = if list.len() <= DENSE { list.len() * list.len() } else { 0 };
            starts.push(starts[block] + entries);
        }
        Self { layout: Arc::new(Layout { lists, places, starts }) }
    }

    /// Unknowns of each block, ascending.
    #[must_use]
    pub fn lists(&self) -> &[Vec<usize>] {
        &self.layout.lists
    }

    /// Block of an unknown, and its place there.
    #[must_use]
    pub fn place(&self, unknown: usize) -> [usize; 2] {
        self.layout.places[unknown]
    }

    /// Factors the matrix that is the sum of these entries within blocks; none where a block is singular.
    #[must_use]
    pub fn factor(&self, entries: impl IntoIterator<Item = Entry>) -> Option<BlockFactor> {
        let Layout { lists, places, starts } = &*self.layout;
        let mut dense = vec![C::from(0.0); starts[lists.len()]];
        let mut large: Vec<Vec<Entry>> = vec![Vec::new(); lists.len()];
        for (row, column, [re, im]) in entries {
            let ([block, i], [_, j]) = (places[row], places[column]);
            let size = lists[block].len();
            if size <= DENSE {
                dense[starts[block] + i * size + j] += C::new(re, im);
            } else {
                large[block].push((i, j, [re, im]));
            }
        }
        let mut pivots = Vec::with_capacity(places.len());
        let mut sparse = Vec::with_capacity(lists.len());
        for (block, list) in lists.iter().enumerate() {
            sparse.push(if list.len() <= DENSE {
                eliminate(&mut dense[starts[block]..starts[block + 1]], list.len(), &mut pivots)?;
                None
            } else {
                pivots.extend(0..list.len());
                Some(SparseLu::new(list.len(), &large[block])?)
            });
        }
        Some(BlockFactor { layout: Arc::clone(&self.layout), dense, pivots, sparse })
    }
}

impl BlockFactor {
    /// Solutions for right-hand sides stored row by row, `width` to a row; none where a large block is singular.
    #[must_use]
    pub fn solve(&self, right: &[[f64; 2]], width: usize) -> Option<Vec<[f64; 2]>> {
        let Layout { lists, starts, .. } = &*self.layout;
        let mut solved = vec![[0.0; 2]; right.len()];
        let (mut rows, mut first) = (Vec::new(), 0);
        for (block, list) in lists.iter().enumerate() {
            let given = list.iter().flat_map(|row| &right[row * width..(row + 1) * width]);
            if let Some(factor) = &self.sparse[block] {
                let given: Vec<[f64; 2]> = given.copied().collect();
                let found = factor.solve(&given, width)?;
                for (row, found) in list.iter().zip(found.chunks_exact(width)) {
                    solved[row * width..(row + 1) * width].copy_from_slice(found);
                }
            } else {
                rows.clear();
                rows.extend(given.map(|[re, im]| C::new(*re, *im)));
                let pivots = &self.pivots[first..first + list.len()];
                substitute(&self.dense[starts[block]..starts[block + 1]], pivots, &mut rows, width);
                for (row, found) in list.iter().zip(rows.chunks_exact(width)) {
                    let entries = solved[row * width..(row + 1) * width].iter_mut().zip(found);
                    entries.for_each(|(entry, found)| *entry = [found.re, found.im]);
                }
            }
            first += list.len();
        }
        Some(solved)
    }
}

/// Replaces a matrix by its LU factors and adds the rows that take the place of each; none where it is singular.
fn eliminate(matrix: &mut [C], size: usize, pivots: &mut Vec<usize>) -> Option<()> {
    for k in 0..size {
        let weight = |row: &usize| matrix[row * size + k].norm_sqr();
        let pivot = (k..size).max_by(|a, b| weight(a).total_cmp(&weight(b)))?;
        if !(weight(&pivot) > 0.0) {
            return None;
        }
        pivots.push(pivot);
        if pivot != k {
            (0..size).for_each(|column| matrix.swap(k * size + column, pivot * size + column));
        }
        let inverse = matrix[k * size + k].inv();
        for row in k + 1..size {
            let factor = matrix[row * size + k] * inverse;
            matrix[row * size + k] = factor;
            for column in k + 1..size {
                let above = matrix[k * size + column];
                matrix[row * size + column] -= factor * above;
            }
        }
    }
    Some(())
}

/// Solves in place with LU factors for right-hand sides stored row by row, `width` to a row.
fn substitute(factors: &[C], pivots: &[usize], x: &mut [C], width: usize) {
    let size = pivots.len();
    for (k, pivot) in pivots.iter().enumerate().filter(|(k, pivot)| *k != **pivot) {
        (0..width).for_each(|column| x.swap(k * width + column, pivot * width + column));
    }
    for k in 0..size {
        for row in k + 1..size {
            let factor = factors[row * size + k];
            for column in 0..width {
                let above = x[k * width + column];
                x[row * width + column] -= factor * above;
            }
        }
    }
    for k in (0..size).rev() {
        let inverse = factors[k * size + k].inv();
        (0..width).for_each(|column| x[k * width + column] *= inverse);
        for row in 0..k {
            let factor = factors[row * size + k];
            for column in 0..width {
                let below = x[k * width + column];
                x[row * width + column] -= factor * below;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A large chain and small blocks between its unknowns, in which rows change places; two right-hand sides.
    #[test]
    fn solutions_of_small_and_large_blocks_satisfy_their_equations() {
        let size = 4 * DENSE;
        let chain = (0..size - 2).filter(|i| i % 2 == 0).map(|i| [i, i + 2]);
        let pairs: Vec<_> = chain.chain((1..size - 4).step_by(8).map(|i| [i, i + 4])).collect();
        let wave = |i: usize| (1.3 * i as f64 + 0.4).sin();
        let mut entries: Vec<Entry> = (0..size).map(|i| (i, i, [0.3, wave(i)])).collect();
        entries.extend(pairs.iter().flat_map(|[i, j]| [(*i, *j, [1.0, 0.2]), (*j, *i, [-0.5, wave(*j)])]));
        let blocks = Blocks::of(size, pairs);
        assert!(blocks.lists().iter().any(|list| list.len() > DENSE) && blocks.lists().len() > DENSE);
        let right: Vec<[f64; 2]> = (0..2 * size).map(|i| [wave(i + 1), wave(i + 7)]).collect();
        let solved =
            blocks.factor(entries.clone()).and_then(|factor| factor.solve(&right, 2)).expect("regular");
        let complex = |[re, im]: [f64; 2]| Complex::new(re, im);
        let mut left: Vec<(Complex<f64>, f64)> =
            right.iter().map(|entry| (-complex(*entry), complex(*entry).norm())).collect();
        for (row, column, entry) in entries {
            for k in 0..2 {
                let term = complex(entry) * complex(solved[2 * column + k]);
                let (sum, size) = left[2 * row + k];
                left[2 * row + k] = (sum + term, size + term.norm());
            }
        }
        let errors = left.iter().map(|(sum, size)| sum.norm() / size);
        assert!(errors.fold(0.0, f64::max) < 1e-14);
    }

    #[test]
    fn a_singular_block_has_no_factors() {
        assert!(Blocks::of(2, []).factor([(0, 0, [1.0, 0.0])]).is_none());
    }
}
