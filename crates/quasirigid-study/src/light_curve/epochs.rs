//! Times of a light curve, with the directions to Sun and observer.

use quasirigid_io::light_curve::{Clock, LightCurveFile, Sighting};
use quasirigid_io::record::Column;
use quasirigid_math::rotation::{ALIGNED, Attitude, angle};
use quasirigid_math::vec3::{norm, scale, unit};

use super::{SECONDS_PER_DAY, View, refused};
use crate::error::StudyError;

/// Columns of the attitude in a history.
const ATTITUDE: [&str; 4] = ["qw", "qx", "qy", "qz"];

/// A time at which the body is seen.
#[derive(Clone, Copy, Debug)]
pub struct Epoch {
    /// Time (s).
    pub t: f64,
    /// Directions to Sun and observer, unit vectors in inertial axes.
    pub sun: [f64; 3],
    pub observer: [f64; 3],
    /// Distances of Sun and observer (au), where the places have them.
    pub distances: Option<[f64; 2]>,
    /// Brightness that was measured.
    pub measured: Option<f64>,
    /// Block of the measured brightness.
    pub block: usize,
    /// Attitude of the body.
    pub attitude: Attitude,
}

impl Epoch {
    /// Angle (rad) between the directions to Sun and observer.
    pub fn phase_angle(&self) -> f64 {
        angle(self.sun, self.observer)
    }
}

/// Times that are asked for.
pub enum Epochs {
    /// The times of the history itself, with two directions.
    Fixed { sun: [f64; 3], observer: [f64; 3] },
    /// Those of a file, in its order.
    Listed(Vec<Epoch>),
}

impl Epochs {
    pub fn new(view: &View, epoch: Option<f64>) -> Result<Self, StudyError> {
        match view {
            View::Fixed { sun, observer } => {
                Ok(Self::Fixed { sun: direction("Sun", *sun)?, observer: direction("observer", *observer)? })
            }
            View::File(file) => Ok(Self::Listed(listed(file, epoch)?)),
        }
    }

    /// Times (s) for a history, ascending, each once; none where it has its own.
    pub fn times(&self) -> Option<Vec<f64>> {
        let Self::Listed(epochs) = self else { return None };
        let mut times: Vec<f64> = epochs.iter().map(|epoch| epoch.t).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        Some(times)
    }

    /// The times that a history reached, with its attitudes, and the number of those that it did not.
    pub fn seen(self, columns: &[Column]) -> (Vec<Epoch>, usize) {
        let column = |name: &str| {
            columns.iter().find(|column| column.name == name).map_or(&[][..], |column| &column.values)
        };
        let (t, attitude) = (column("t"), ATTITUDE.map(column));
        let turned =
            |row: usize, epoch: Epoch| Epoch { t: t[row], attitude: attitude.map(|part| part[row]), ..epoch };
        match self {
            Self::Fixed { sun, observer } => {
                let still = Epoch {
                    t: 0.0,
                    sun,
                    observer,
                    distances: None,
                    measured: None,
                    block: 0,
                    attitude: ALIGNED,
                };
                ((0..t.len()).map(|row| turned(row, still)).collect(), 0)
            }
            Self::Listed(epochs) => {
                let asked = epochs.len();
                let of = |epoch: Epoch| {
                    let row = t.binary_search_by(|time| time.total_cmp(&epoch.t)).ok()?;
                    Some(turned(row, epoch))
                };
                let seen: Vec<Epoch> = epochs.into_iter().filter_map(of).collect();
                let missed = asked - seen.len();
                (seen, missed)
            }
        }
    }
}

fn direction(what: &str, place: [f64; 3]) -> Result<[f64; 3], StudyError> {
    let largest = place.iter().fold(0.0, |size: f64, entry| size.max(entry.abs()));
    if largest > 0.0 && largest.is_finite() {
        return Ok(unit(scale(largest.recip(), place)));
    }
    Err(refused(format!(
        "the direction to the {what} is {place:?}: give three finite numbers that are not all zero"
    )))
}

/// Times of a file from the start of the model.
fn listed(file: &LightCurveFile, epoch: Option<f64>) -> Result<Vec<Epoch>, StudyError> {
    let seconds = |time: f64| {
        match (file.clock, epoch) {
        (Clock::Seconds, _) => Ok(time),
        (Clock::JulianDate, Some(epoch)) => Ok((time - epoch) * SECONDS_PER_DAY),
        (Clock::JulianDate, None) => Err(refused(
            "the file has Julian dates, and the model does not say which one its start has; give that date, the epoch".to_owned(),
        )),
    }
    };
    let epoch = |(row, sighting): (usize, &Sighting)| {
        let t = seconds(sighting.time)?;
        if !(t >= 0.0) {
            return Err(refused(format!(
                "row {} of the view is {:.6e} s before the start of the model; give an earlier start, or leave the row out",
                row + 1,
                -t
            )));
        }
        Ok(Epoch {
            t,
            sun: direction("Sun", sighting.sun)?,
            observer: direction("observer", sighting.observer)?,
            distances: Some([norm(sighting.sun), norm(sighting.observer)]),
            measured: sighting.brightness,
            block: sighting.block,
            attitude: ALIGNED,
        })
    };
    file.sightings.iter().enumerate().map(epoch).collect()
}
