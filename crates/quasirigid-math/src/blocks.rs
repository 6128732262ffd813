//! Sparse complex matrices that fall apart into blocks, most of them small: their factors.

use std::sync::Arc;

use nalgebra::{Complex, DMatrix, Dyn, LU};

use crate::connected_components::connected_components;
use crate::lu::SparseLu;

/// Partition of unknowns into blocks that no entry couples.
#[derive(Clone, Debug)]
pub struct Blocks {
    lists: Arc<Vec<Vec<usize>>>,
    /// Block of each unknown, and its place there.
    places: Vec<[usize; 2]>,
}

/// Factors of a matrix of blocks.
#[derive(Clone, Debug)]
pub struct BlockFactor {
    lists: Arc<Vec<Vec<usize>>>,
    factors: Vec<Factor>,
}

#[derive(Clone, Debug)]
enum Factor {
    Dense(LU<Complex<f64>, Dyn, Dyn>),
    Sparse(SparseLu),
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
        let mut places = vec![[0; 2]; size];
        for (block, list) in lists.iter().enumerate() {
            list.iter().enumerate().for_each(|(place, unknown)| places[*unknown] = [block, place]);
        }
        Self { lists: Arc::new(lists), places }
    }

    /// Unknowns of each block, ascending.
    #[must_use]
    pub fn lists(&self) -> &[Vec<usize>] {
        &self.lists
    }

    /// Block of an unknown, and its place there.
    #[must_use]
    pub fn place(&self, unknown: usize) -> [usize; 2] {
        self.places[unknown]
    }

    /// Factors the matrix that is the sum of these entries within blocks; none where a large block is singular.
    #[must_use]
    pub fn factor(&self, entries: impl IntoIterator<Item = Entry>) -> Option<BlockFactor> {
        let small = |list: &Vec<usize>| list.len() <= DENSE;
        let zero = |list: &Vec<usize>| {
            let size = if small(list) { list.len() } else { 0 };
            DMatrix::zeros(size, size)
        };
        let mut dense: Vec<DMatrix<Complex<f64>>> = self.lists.iter().map(zero).collect();
        let mut sparse: Vec<Vec<Entry>> = vec![Vec::new(); self.lists.len()];
        for (row, column, [re, im]) in entries {
            let ([block, i], [_, j]) = (self.places[row], self.places[column]);
            if small(&self.lists[block]) {
                dense[block][(i, j)] += Complex::new(re, im);
            } else {
                sparse[block].push((i, j, [re, im]));
            }
        }
        let factors = self.lists.iter().zip(dense.into_iter().zip(sparse));
        let factors = factors.map(|(list, (dense, sparse))| {
            Some(if small(list) {
                Factor::Dense(dense.lu())
            } else {
                Factor::Sparse(SparseLu::new(list.len(), &sparse)?)
            })
        });
        Some(BlockFactor { lists: Arc::clone(&self.lists), factors: factors.collect::<Option<_>>()? })
    }
}

impl BlockFactor {
    /// Solutions for right-hand sides stored row by row, `width` to a row; none where a block is singular.
    #[must_use]
    pub fn solve(&self, right: &[[f64; 2]], width: usize) -> Option<Vec<[f64; 2]>> {
        let mut solved = vec![[0.0; 2]; right.len()];
        for (list, factor) in self.lists.iter().zip(&self.factors) {
            let given = |i: usize, k: usize| right[list[i] * width + k];
            let found = match factor {
                Factor::Dense(factor) => {
                    let mut x = DMatrix::from_fn(list.len(), width, |i, k| {
                        let [re, im] = given(i, k);
                        Complex::new(re, im)
                    });
                    if !factor.solve_mut(&mut x) {
                        return None;
                    }
                    x.transpose().iter().map(|entry| [entry.re, entry.im]).collect()
                }
                Factor::Sparse(factor) => {
                    let rows: Vec<_> =
                        (0..list.len()).flat_map(|i| (0..width).map(move |k| given(i, k))).collect();
                    factor.solve(&rows, width)?
                }
            };
            for (row, found) in list.iter().zip(found.chunks_exact(width)) {
                solved[row * width..(row + 1) * width].copy_from_slice(found);
            }
        }
        Some(solved)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A large chain and small blocks between its unknowns, two right-hand sides.
    #[test]
    fn solutions_of_small_and_large_blocks_satisfy_their_equations() {
        let size = 4 * DENSE;
        let chain = (0..size - 2).filter(|i| i % 2 == 0).map(|i| [i, i + 2]);
        let pairs: Vec<_> = chain.chain((1..size - 4).step_by(8).map(|i| [i, i + 4])).collect();
        let wave = |i: usize| (1.3 * i as f64 + 0.4).sin();
        let mut entries: Vec<Entry> = (0..size).map(|i| (i, i, [3.0, wave(i)])).collect();
        entries.extend(pairs.iter().flat_map(|[i, j]| [(*i, *j, [1.0, 0.2]), (*j, *i, [-0.5, wave(*j)])]));
        let blocks = Blocks::of(size, pairs);
        assert!(blocks.lists().iter().any(|list| list.len() > DENSE) && blocks.lists().len() > DENSE);
        let right: Vec<[f64; 2]> = (0..2 * size).map(|i| [wave(i + 1), wave(i + 7)]).collect();
        let solved = blocks.factor(entries.clone()).and_then(|factor| factor.solve(&right, 2)).expect("regular");
        let complex = |[re, im]: [f64; 2]| Complex::new(re, im);
        let mut left: Vec<Complex<f64>> = right.iter().map(|entry| -complex(*entry)).collect();
        for (row, column, entry) in entries {
            for k in 0..2 {
                left[2 * row + k] += complex(entry) * complex(solved[2 * column + k]);
            }
        }
        assert!(left.iter().all(|entry| entry.norm() < 1e-13), "{left:?}");
    }

    #[test]
    fn a_singular_block_has_no_solution() {
        let factor = Blocks::of(2, []).factor([(0, 0, [1.0, 0.0])]).expect("small blocks");
        assert!(factor.solve(&[[1.0, 0.0], [1.0, 0.0]], 1).is_none());
    }
}
