use super::interval::Interval;
use crate::eigen::Dense;
use crate::lu::Lu;

/// Chain of intervals around a period, each a matrix from its node to the next: nodes are eliminated one after the other, with pivots from
/// both equations that they stand in, so that growing and decaying parts keep their digits.
pub(super) struct Chain {
    size: usize,
    /// Columns of the relations: a node, the first node, the next node, the shared unknowns and the right-hand side.
    width: usize,
    /// Rows that give each eliminated node, triangular in it.
    eliminated: Vec<Vec<f64>>,
    /// Relation between the first node and the last one that is left.
    left: Vec<f64>,
}

impl Chain {
    pub fn of(size: usize, intervals: &[Interval]) -> Self {
        let rest = intervals.first().map_or(0, |interval| interval.next.len() / size - size);
        let width = 3 * size + rest;
        let mut chain = Self { size, width, eliminated: Vec::new(), left: Vec::new() };
        for interval in intervals {
            chain.append(interval);
        }
        chain
    }

    /// Appends an interval, and eliminates the node before it.
    fn append(&mut self, interval: &Interval) {
        let (size, width) = (self.size, self.width);
        let mut rows = std::mem::take(&mut self.left);
        let first = rows.is_empty();
        for (k, next) in interval.next.chunks(width - 2 * size).enumerate() {
            let mut row = vec![0.0; width];
            let from = if first { size } else { 0 };
            row[from..from + size].copy_from_slice(&next[..size]);
            row[2 * size + k] = -1.0;
            row[3 * size..].copy_from_slice(&next[size..]);
            rows.extend(row);
        }
        if !first {
            eliminate(&mut rows, width, size);
            self.eliminated.push(rows[..size * width].to_vec());
            rows.drain(..size * width);
        }
        // the next node is the one to be eliminated from now on
        for row in rows.chunks_mut(width) {
            row.copy_within(2 * size..3 * size, 0);
            row[2 * size..3 * size].fill(0.0);
        }
        self.left = rows;
    }

    /// Matrix that takes a change of the first node to that of the node after the last interval; none where it is singular.
    pub fn monodromy(&self) -> Option<Dense> {
        let (size, width) = (self.size, self.width);
        let mut last = Dense::zero(size);
        let mut first = Vec::with_capacity(size * size);
        for (k, row) in self.left.chunks(width).enumerate() {
            (0..size).for_each(|column| last.add(k, column, -row[column]));
            first.extend(&row[size..2 * size]);
        }
        let solved = Lu::new(&last)?.solve(&first, size)?;
        let mut monodromy = Dense::zero(size);
        for (place, entry) in solved.into_iter().enumerate() {
            monodromy.add(place / size, place % size, entry);
        }
        Some(monodromy)
    }

    /// Changes of the nodes and of the shared unknowns, with the first `shared` components of the first node unchanged; none where the
    /// equations are singular.
    pub fn solved(mut self, shared: usize) -> Option<(Vec<Vec<f64>>, Vec<f64>)> {
        let (size, width) = (self.size, self.width);
        let mut matrix = Dense::zero(size + shared);
        let mut right = vec![0.0; size + shared];
        for (k, row) in self.left.chunks(width).enumerate() {
            for column in 0..size {
                matrix.add(k, column, row[column] + row[size + column]);
            }
            for column in 0..shared {
                matrix.add(k, size + column, row[3 * size + column]);
            }
            right[k] = -row[width - 1];
        }
        (0..shared).for_each(|k| matrix.add(size + k, k, 1.0));
        let solved = Lu::new(&matrix)?.solve(&right, 1)?;
        let (first, shared) = solved.split_at(size);
        let mut nodes = vec![first.to_vec()];
        while let Some(rows) = self.eliminated.pop() {
            let next = nodes.last().map_or(first, Vec::as_slice).to_vec();
            nodes.push(substituted(&rows, width, [first, &next], shared));
        }
        nodes[1..].reverse();
        Some((nodes, shared.to_vec()))
    }
}

/// Eliminates the first `size` columns of twice as many rows, with partial pivots.
fn eliminate(rows: &mut [f64], width: usize, size: usize) {
    let count = rows.len() / width;
    for column in 0..size {
        let size_of = |row: usize| rows[row * width + column].abs();
        let pivot = (column..count).max_by(|a, b| size_of(*a).total_cmp(&size_of(*b))).unwrap_or(column);
        if pivot != column {
            let (upper, lower) = rows.split_at_mut(pivot * width);
            upper[column * width..(column + 1) * width].swap_with_slice(&mut lower[..width]);
        }
        let (done, below) = rows.split_at_mut((column + 1) * width);
        let top = &done[column * width..];
        for row in below.chunks_mut(width) {
            let factor = row[column] / top[column];
            if factor != 0.0 {
                row[column..].iter_mut().zip(&top[column..]).for_each(|(entry, top)| *entry -= factor * top);
            }
        }
    }
}

/// The eliminated node of triangular rows, from the first node, the next one and the shared unknowns.
fn substituted(rows: &[f64], width: usize, [first, next]: [&[f64]; 2], shared: &[f64]) -> Vec<f64> {
    let size = first.len();
    let mut node = vec![0.0; size];
    for k in (0..size).rev() {
        let row = &rows[k * width..(k + 1) * width];
        let product = |columns: &[f64], values: &[f64]| -> f64 {
            columns.iter().zip(values).map(|(entry, value)| entry * value).sum()
        };
        let known = product(&row[k + 1..size], &node[k + 1..])
            + product(&row[size..2 * size], first)
            + product(&row[2 * size..3 * size], next)
            + product(&row[3 * size..], shared)
            + row[width - 1];
        node[k] = -known / row[k];
    }
    node
}
