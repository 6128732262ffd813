//! Every test of the report in one program, which is linked once.
#![allow(non_snake_case, clippy::unwrap_used)]

mod gltf;
mod pages;
mod study;
mod support;
