//! Tables of many rows: bodies read from text, VOTable, workbooks and Parquet, results written to CSV and Parquet.
//! What is read is text by column, whatever the file, so that one reading of numbers and units serves both formats; what is written has
//! typed columns with units in the metadata. Parquet is written by the low-level column writer, which needs no Arrow.

mod bodies;
mod cells;
mod error;
mod fixed;
mod formula;
mod heading;
mod layout;
mod line;
mod names;
mod numbers;
mod parquet;
mod text_table;
mod votable;
mod workbook;

pub use bodies::{BodyTable, read_bodies};
pub use cells::{CellColumn, CellKind, Cells, csv_header, csv_rows};
pub use error::TableError;
pub(crate) use formula::{guarded, unguarded};
pub use names::{bracketed_name, ending as unit_ending};
pub(crate) use numbers::{BadLine, Unnumbered, read_numbers};
pub(crate) use parquet::undamaged;
pub use parquet::{read_parquet, write_parquet};
