//! OUTPUT2 files of NASTRAN (`.op2`): geometry as bulk data, matrices, eigenvalues and eigenvectors.

mod bulk;
mod directions;
mod entries;
mod layouts;
mod lists;
mod results;
mod tape;
mod words;

pub(crate) use bulk::{Bulk, bulk};
pub(crate) use results::{axes, eigenvalues, frequencies, lacks_parameters, modes};
pub(crate) use tape::{Block, Layout, Tape};
