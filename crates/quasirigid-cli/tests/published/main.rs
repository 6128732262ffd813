//! Published cases from file to numbers: the model is read from TOML, and the derived JSON is compared.
#![allow(non_snake_case, clippy::unwrap_used, clippy::print_stdout)]

mod centre_manifold;
mod full_system;
