//! Reports: what is made of a record alone, the page and the body in motion.

pub use quasirigid_report::{GltfOptions, gltf, page};
