//! Magnitudes of a brightness.

use std::f64::consts::PI;

/// Astronomical unit (m), IAU 2012.
pub const ASTRONOMICAL_UNIT: f64 = 149_597_870_700.0;
/// Apparent magnitude of the Sun in V at one astronomical unit `[@willmer2018]`.
pub const SUN_MAGNITUDE: f64 = -26.76;

/// Magnitude in V of a brightness (m²) times the geometric albedo, at one astronomical unit from the Sun and the observer. (O14)
#[must_use]
pub fn magnitude(brightness: f64) -> f64 {
    SUN_MAGNITUDE - 2.5 * (brightness / (PI * ASTRONOMICAL_UNIT * ASTRONOMICAL_UNIT)).log10()
}

/// Geometric albedo of a body of a mean cross-section (m²) with an absolute magnitude. (O14)
#[must_use]
pub fn albedo(absolute_magnitude: f64, cross_section: f64) -> f64 {
    let unit = PI * ASTRONOMICAL_UNIT * ASTRONOMICAL_UNIT;
    10f64.powf(0.4 * (SUN_MAGNITUDE - absolute_magnitude)) * unit / cross_section
}
