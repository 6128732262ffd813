//! Numbers with units, and the short texts of settings.

use quasirigid_io::estimate::{Estimate, Limits};
use quasirigid_io::model::{KeyPath, ManifoldMasters, Target};
use quasirigid_io::plan::{Manoeuvre, Sensor};
use quasirigid_io::units::{Dimension, quantity};

/// Words of quantities.
pub const WORDS: &[&str] = &[
    "rpm",
    "rad/s",
    "g/cm^3",
    "lbf/in",
    "N m/rad",
    "deg",
    "Myr",
    "Hz",
    "^-2",
    "**3",
    "*",
    "·",
    "/",
    "(",
    ")",
    "µm",
    "% of I3",
    "km",
    "^2147483647",
    "e400",
    "1e-400",
    "slug",
    "°",
    " = ",
    " +- ",
    "..",
];

const DIMENSIONS: [Dimension; 12] = [
    Dimension::NUMBER,
    Dimension::MASS,
    Dimension::LENGTH,
    Dimension::TIME,
    Dimension::ANGULAR_VELOCITY,
    Dimension::FREQUENCY,
    Dimension::ROTATIONAL_STIFFNESS,
    Dimension::DENSITY,
    Dimension::PRESSURE,
    Dimension::ANGLE,
    Dimension::MAGNETIC_FIELD,
    Dimension::DYNAMIC_VISCOSITY,
];

/// Reads a text as every kind of quantity and setting.
pub fn text(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    for dimension in DIMENSIONS {
        match quantity(text, dimension) {
            Ok(value) => assert!(value.is_finite(), "{text:?} is {value}"),
            Err(error) => assert!(!error.to_string().is_empty() && !error.advice().is_empty()),
        }
    }
    if let Err(error) = text.parse::<KeyPath>() {
        assert!(!error.to_string().is_empty());
    }
    if let Err(error) = text.parse::<Target>() {
        assert!(!error.to_string().is_empty() && !error.advice().is_empty());
    }
    let _ = text.parse::<ManifoldMasters>();
    match text.parse::<Estimate>() {
        Ok(found) => assert!(found.value.number.is_finite() && found.sigma.number > 0.0, "{found:?}"),
        Err(error) => assert!(!error.to_string().is_empty()),
    }
    if let Err(error) = text.parse::<Sensor>() {
        assert!(!error.to_string().is_empty());
    }
    if let Err(error) = text.parse::<Manoeuvre>() {
        assert!(!error.to_string().is_empty());
    }
    if let Err(error) = text.parse::<Limits>() {
        assert!(!error.to_string().is_empty());
    }
}
