//! Files beside a model, and the folder of a record.

mod attitude;
mod attitude_read;
mod bounds;
mod catalogues;
mod history_files;
mod history_tables;
mod mat_files;
mod matrix_files;
mod memory;
mod mesh;
mod modes;
pub mod op2;
mod record;
mod shapes;
mod tables;
