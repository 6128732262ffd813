//! Files beside a model, and the folder of a record.

mod matrix_files;
mod mesh;
mod record;
mod tables;
