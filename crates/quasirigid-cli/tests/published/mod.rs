//! Published cases from file to numbers: the model is read from TOML, and the derived JSON is compared.

mod centre_manifold;
mod full_system;
