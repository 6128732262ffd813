//! Tables of light curves, and files of DAMIT.

use std::path::Path;

use quasirigid_io::light_curve::{Clock, damit, light_curve_of};

/// Words of both formats.
pub const TEXT: &[&str] =
    &["jd", "sun_x", "observer_z [km]", "magnitude", "block", "\n2 0\n", "2450000.5 1 1 0 0 0 1 0\n", "NaN"];

/// Reads a light curve: places are not zero, brightness is positive, and what was read of DAMIT is read again as it is written.
pub fn read(bytes: &[u8]) {
    let Ok(found) = light_curve_of(Path::new("lc.txt"), bytes) else { return };
    assert!(!found.sightings.is_empty());
    for sighting in &found.sightings {
        assert!(sighting.sun != [0.0; 3] && sighting.observer != [0.0; 3]);
        assert!(sighting.brightness.is_none_or(|value| value > 0.0 && value.is_finite()));
    }
    if found.clock == Clock::JulianDate && found.sightings.iter().all(|each| each.brightness.is_some()) {
        let again = light_curve_of(Path::new("lc.txt"), damit(&found.sightings).as_bytes())
            .map(|read| read.sightings.len());
        assert_eq!(again, Ok(found.sightings.len()));
    }
}
