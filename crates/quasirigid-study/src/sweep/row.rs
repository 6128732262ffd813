use super::Output;
use super::cell::Cell;
use crate::asked::Status;

/// Row with its answers.
#[derive(Clone, Debug, PartialEq)]
pub struct RowAnswer {
    /// Index of the row, from 0; users count from 1.
    pub row: u64,
    /// Answers, one for each column of the outputs.
    pub outputs: Vec<Cell>,
    /// Status of the row.
    pub status: Status,
    /// Reason for another status than answered.
    pub reason: String,
    /// Notes: reasons for missing values, and limits of those that are there.
    pub note: String,
}

impl RowAnswer {
    /// Whether the answers are those of these columns.
    pub(super) fn fits(&self, outputs: &[Output]) -> bool {
        self.outputs.len() == outputs.len()
            && self.outputs.iter().zip(outputs).all(|(cell, output)| cell.fits(output.kind))
    }
}
