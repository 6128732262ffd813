//! Study record: the rows of a study as columns, with their percentiles and rank correlations, for its page.
//! The parts on disk hold the same rows; this is what a summary needs of them, numbers only.

/// Origin of the values of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StudyRole {
    /// Points of a grid.
    Grid,
    /// Draws from a distribution.
    Drawn,
    /// Rows of a table of bodies.
    Table,
    /// Answers to a quantity that was asked for.
    Quantity,
}

/// Column of a study: one number a row.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyColumn {
    /// Path of the key or of the quantity.
    pub name: String,
    /// Unit; empty if there is none.
    pub unit: String,
    /// Origin of the values.
    pub role: StudyRole,
    /// Values, one per row of the record; not a number where there is none.
    pub values: Vec<f64>,
    /// Percentiles, each in percent with its value, ascending.
    pub percentiles: Vec<(f64, f64)>,
}

/// Rank correlation of an input with a quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyInfluence {
    /// Path of the key.
    pub input: String,
    /// Path of the quantity.
    pub quantity: String,
    /// Spearman's coefficient, −1 to 1.
    pub rank_correlation: f64,
    /// Rows in which both are known.
    pub rows: usize,
}

/// Rows without an answer, by reason.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StudyRefusal {
    /// Status of the rows: `refused`, `invalid` or `failed`.
    pub status: String,
    /// Reason, in words.
    pub reason: String,
    /// Rows that have it.
    pub rows: usize,
    /// First of them.
    pub first: usize,
}

/// Record of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyRecord {
    /// Name of the study.
    pub name: String,
    /// Version of the program.
    pub version: String,
    /// Rows of the study.
    pub rows: usize,
    /// Rows with an answer.
    pub answered: usize,
    /// Text of the study file.
    pub text: String,
    /// Inputs and quantities; all have the same number of values, which may be fewer than the rows, evenly chosen.
    pub columns: Vec<StudyColumn>,
    /// Rank correlations.
    pub influences: Vec<StudyInfluence>,
    /// Rows without an answer, the most frequent reason first.
    pub refusals: Vec<StudyRefusal>,
}
