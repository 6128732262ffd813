//! Sums of element matrices over a range of columns, so that several threads can add at once without a common entry.

use std::ops::Range;

use super::{Pattern, SymmetricError};

/// Entries of a range of columns.
pub(super) struct Strip<'s> {
    pub pattern: &'s Pattern,
    pub columns: Range<u32>,
    /// Place of the first entry.
    pub first: usize,
    pub entries: &'s mut [f64],
}

impl Strip<'_> {
    /// Adds what the matrix of an element has in these columns.
    pub fn add(&mut self, unknowns: &[Option<u32>], element: &[f64]) -> Result<(), SymmetricError> {
        let width = unknowns.len();
        if element.len() != width * width {
            return Err(SymmetricError::Shape { unknowns: width, entries: element.len() });
        }
        let mut order: Vec<(u32, usize)> =
            unknowns.iter().enumerate().filter_map(|(local, unknown)| Some(((*unknown)?, local))).collect();
        order.sort_unstable();
        let start = order.partition_point(|(column, _)| *column < self.columns.start);
        let end = order.partition_point(|(column, _)| *column < self.columns.end);
        for index in start..end {
            let (column, j) = order[index];
            let outside = |row: u32| SymmetricError::Outside { row, column };
            let range = self.pattern.range(column).ok_or_else(|| outside(column))?;
            let rows = &self.pattern.rows()[..range.end];
            let mut place = range.start;
            for (row, i) in &order[index..] {
                if rows.get(place + 1) == Some(row) {
                    place += 1;
                } else {
                    place += rows[place..].partition_point(|other| other < row);
                }
                if rows.get(place) != Some(row) {
                    return Err(outside(*row));
                }
                let entry = &mut self.entries[place - self.first];
                *entry += element[i * width + j];
                // An element that names an unknown twice has both mirror images on the diagonal.
                if *row == column && *i != j {
                    *entry += element[j * width + i];
                }
            }
        }
        Ok(())
    }
}

/// Strips of the columns of some elements, of about equally many entries.
pub(super) fn strips<'s>(
    pattern: &'s Pattern,
    entries: &'s mut [f64],
    elements: &[(&[Option<u32>], &[f64])],
    count: usize,
) -> Vec<Strip<'s>> {
    let starts = pattern.starts();
    let unknowns =
        || elements.iter().flat_map(|(unknowns, _)| *unknowns).flatten().map(|unknown| *unknown as usize);
    let last = unknowns().max().map_or(0, |last| (last + 1).min(pattern.size()));
    let first = unknowns().min().unwrap_or_default().min(last);
    let end = |share: usize| {
        let places = (starts[last] - starts[first]) * share / count;
        if share == count {
            u32::MAX
        } else {
            starts.partition_point(|start| *start < starts[first] + places) as u32
        }
    };
    let mut rest = entries;
    let (mut column, mut place) = (0, 0);
    let mut strips = Vec::with_capacity(count);
    for share in 1..=count {
        let columns = column..end(share).max(column);
        let until = starts[(columns.end as usize).min(pattern.size())];
        let (own, others) = rest.split_at_mut(until - place);
        strips.push(Strip { pattern, columns: columns.clone(), first: place, entries: own });
        (rest, column, place) = (others, columns.end, until);
    }
    strips
}
