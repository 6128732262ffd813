//! Light curves in files: times with the places of Sun and observer as seen from the body, and brightness that was measured.
//!
//! A table in text has the columns `t` (s) or `jd` (days), `sun_x`, `sun_y`, `sun_z`, `observer_x`, `observer_y`, `observer_z` (au, or another
//! length in brackets), and perhaps `brightness` or `magnitude`, and `block`, whose brightness has a scale of its own. The other format
//! is that of the files `lc.txt` of DAMIT. Both are read; DAMIT and ALCDEF are written.

mod alcdef;
mod damit;
mod error;
mod table;

use std::path::Path;

pub use alcdef::alcdef;
pub use damit::damit;
pub use error::{LightCurveFileError, LightCurveProblem};

use crate::text_file::{FileError, Place, bytes_of, kind_of};

/// Largest file that is read (bytes).
const MAX_FILE: u64 = 256 * 1024 * 1024;

/// Clock of the times of a light curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clock {
    /// Seconds from the start of the model.
    Seconds,
    /// Julian dates (days).
    JulianDate,
}

/// A time of a light curve, with what was seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sighting {
    /// Time, in seconds or Julian days.
    pub time: f64,
    /// Sun as seen from the body (au).
    pub sun: [f64; 3],
    /// Observer as seen from the body (au).
    pub observer: [f64; 3],
    /// Brightness that was measured, positive, in a unit that is free in each block.
    pub brightness: Option<f64>,
    /// Block, from 0.
    pub block: usize,
}

/// Light curve of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct LightCurveFile {
    /// Its clock.
    pub clock: Clock,
    /// Its times, in the order of the file.
    pub sightings: Vec<Sighting>,
}

/// Reads a light curve or the geometry of one: a table in text with a heading, or a file of DAMIT.
///
/// # Errors
/// [`LightCurveFileError`] says what is wrong and where.
pub fn read_light_curve(file: &Path) -> Result<LightCurveFile, LightCurveFileError> {
    let bytes = bytes_of(file, MAX_FILE)?;
    light_curve_of(file, &bytes)
}

/// The light curve in the bytes of a file.
///
/// # Errors
/// Those of [`read_light_curve`], except that the file cannot be read.
pub fn light_curve_of(file: &Path, bytes: &[u8]) -> Result<LightCurveFile, LightCurveFileError> {
    let named = FileError::new(file);
    let kind = kind_of(bytes);
    if kind != "text" {
        return Err(named((Place::File, LightCurveProblem::Kind { kind })));
    }
    let found = if damit::is_damit(bytes) { damit::read(bytes) } else { table::read(file, bytes) };
    let found = found.map_err(named)?;
    if found.sightings.is_empty() {
        return Err(named((Place::File, LightCurveProblem::Empty)));
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<LightCurveFile, String> {
        light_curve_of(Path::new("x"), text.as_bytes()).map_err(|error| error.to_string())
    }

    const HEADING: &str = "jd,sun_x,sun_y,sun_z,observer_x,observer_y,observer_z";

    #[test]
    fn tables_are_read_with_units_and_blocks() {
        let found = read(&format!(
            "{HEADING} [km],magnitude,block\n2460000.5,1,0,0,0,1,1.495978707e8,2.5,7\n2460001.5,1,0,0,0,1,0,0,9\n"
        ));
        let found = found.unwrap();
        assert_eq!(found.clock, Clock::JulianDate);
        let [first, second] = found.sightings[..] else { panic!() };
        assert!((first.observer[2] - 1.0).abs() < 1e-12 && first.sun == [1.0, 0.0, 0.0]);
        assert!((first.brightness.unwrap() - 0.1).abs() < 1e-15 && second.brightness == Some(1.0));
        assert_eq!((first.block, second.block), (0, 1));
        let hours = read(&format!("{}\n2,1,0,0,0,1,0\n", HEADING.replace("jd", "t [h]"))).unwrap();
        assert_eq!((hours.clock, hours.sightings[0].time), (Clock::Seconds, 7200.0));
    }

    /// What is written is read again to the digits that are written.
    #[test]
    fn files_of_damit_are_read_and_written() {
        let text = "2\n2 0\n2444085.0 1.05 0.1 -2.3 0.01 0.2 -1.4 0.02\n2444085.1 0.95 0.1 -2.3 0.01 0.2 -1.4 0.02\n1 1\n\
            2444090.25 3.0 0.2 -2.2 0.01 0.3 -1.3 0.02\n";
        let found = read(text).unwrap();
        assert_eq!((found.clock, found.sightings.len()), (Clock::JulianDate, 3));
        assert_eq!(found.sightings[2].block, 1);
        assert_eq!(found.sightings[1].observer, [0.2, -1.4, 0.02]);
        let again = read(&damit(&found.sightings)).unwrap();
        assert_eq!(again, found);
    }

    #[test]
    fn files_that_are_no_light_curve_are_refused_where_they_fail() {
        let row = "2460000.5,1,0,0,0,1,0";
        for (text, told) in [
            (String::new(), "no times"),
            (format!("{HEADING}\n"), "no times"),
            (format!("{HEADING},brightness\n{row},-1\n"), "row 1: the brightness -1 is not positive"),
            (format!("{HEADING}\n2460000.5,0,0,0,0,1,0\n"), "row 1: the Sun is at the body"),
            (format!("{HEADING}\n2460000.5,1,0,0,0,0,0\n"), "row 1: the observer is at the body"),
            (format!("{HEADING},brightness,magnitude\n{row},1,1\n"), "both brightness and magnitude"),
            ("jd,sun_x\n1,2\n".to_owned(), "no column is \"sun_y\""),
            (
                "t,jd,sun_x,sun_y,sun_z,observer_x,observer_y,observer_z\n1,2,1,0,0,0,1,0\n".to_owned(),
                "two clocks",
            ),
            (HEADING.replace("jd", "day") + "\n1,1,0,0,0,1,0\n", "no column is the time"),
            (format!("{HEADING}\n2460000.5,1,0\n"), "x:2: 3 values where the heading has 7"),
            (format!("{HEADING}\n2460000.5,1,0,0,0,1,x\n"), "x:2: observer_z: \"x\" is not a finite number"),
            ("1\n2 0\n2444085.0 1.0 1 0 0 0 1 0\n".to_owned(), "the file ends"),
            ("1\n1 0\n2444085.0 0.0 1 0 0 0 1 0\n".to_owned(), "x:3: the brightness 0 is not positive"),
            ("1\n1 0\n2444085.0 1.0 1 0 0 0 1\n".to_owned(), "x:3: 7 numbers"),
            ("1\n1 0\n2444085.0 1.0 1 0 0 0 1 0\n5 5\n".to_owned(), "x:4: after the last"),
        ] {
            let found = read(&text).unwrap_err();
            assert!(found.contains(told), "{text:?}: {found}");
        }
    }
}
