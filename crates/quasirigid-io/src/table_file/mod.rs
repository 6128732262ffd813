//! Tables of many rows: bodies read from CSV and Parquet, results written to both.
//! What is read is text by column, whatever the file, so that one reading of numbers and units serves both formats; what is written has
//! typed columns with units in the metadata. Parquet is written by the low-level column writer, which needs no Arrow.

mod bodies;
mod cells;
mod error;
mod formula;
mod line;
mod parquet;

pub use bodies::{BodyTable, read_bodies};
pub use cells::{CellColumn, CellKind, Cells, csv_header, csv_rows};
pub use error::TableError;
pub(crate) use formula::{guarded, unguarded};
pub use parquet::{read_parquet, write_parquet};
