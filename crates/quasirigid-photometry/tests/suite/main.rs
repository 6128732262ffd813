//! Brightness against closed forms, laws and an independent renderer.
#![allow(clippy::unwrap_used, non_snake_case)]

mod closed_forms;
mod laws;
mod renderer;
mod shadows;
mod support;
