//! Every test of files in one program, which is linked once: models, meshes of cells, and the rest.
#![allow(non_snake_case, clippy::unwrap_used, clippy::print_stdout)]

mod files;
mod heap;
mod model_file;
mod volume_mesh;
