//! Attitude files of other programs: histories of attitude and angular velocity written and read.
//!
//! Everywhere here an attitude is our own: a unit quaternion, scalar first, that turns body components into those of the reference axes
//! (Hamilton's product). AEM and STK store the same four numbers, scalar last: their quaternion turns the reference axes into the body
//! axes as vectors are turned, and its matrix, which they apply, takes reference components to body ones. SPICE's C-matrix does so too, but
//! its quaternion is that of the matrix, which is the conjugate of ours.

mod aem;
mod basilisk;
mod epoch;
mod error;
mod msopck;
mod rows;
mod stk;
mod table;
mod written;

use std::path::Path;

pub use epoch::{Epoch, NoEpoch, TimeSystem};
pub use error::{AttitudeError, AttitudeProblem, Line, Unwritten};
pub use written::{AttitudeFormat, InertialFrame, Labels, creation_time};

use crate::text_file::{FileError, Place, bytes_of, text};
use error::Fault;

/// Largest file that is read (bytes): some ten million records.
const MAX_FILE: u64 = 1024 * 1024 * 1024;

/// Attitudes against time, as a file has them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AttitudeHistory {
    /// Name of the object, where the file gives one.
    pub object: String,
    /// Name of the reference axes, where the file gives one.
    pub frame: String,
    /// Epoch of time zero: of the first record of an AEM, of the scenario of an STK file.
    pub epoch: Option<Epoch>,
    /// Time scale of the epoch.
    pub time_system: Option<TimeSystem>,
    /// Times (s), ascending.
    pub t: Vec<f64>,
    /// Unit quaternions, scalar first, that turn body components into those of the reference axes.
    pub attitude: Vec<[f64; 4]>,
    /// Angular velocities against the reference axes (rad/s), body axes; empty where the file has none.
    pub angular_velocity: Vec<[f64; 3]>,
}

/// A record of a history.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AttitudeRecord {
    /// Time (s).
    pub t: f64,
    /// Unit quaternion, scalar first, that turns body components into those of the reference axes.
    pub attitude: [f64; 4],
    /// Angular velocity (rad/s), body axes.
    pub angular_velocity: Option<[f64; 3]>,
}

/// Largest distance (s) at which a record is the one that is asked for.
const SAME: f64 = 1e-6;

impl AttitudeHistory {
    /// The record at a time (s); none is made between two.
    ///
    /// # Errors
    /// The times of the records on both sides.
    pub fn at(&self, t: f64) -> Result<AttitudeRecord, [Option<f64>; 2]> {
        let next = self.t.partition_point(|time| *time < t - SAME);
        match self.t.get(next) {
            Some(time) if *time <= t + SAME => Ok(self.record(next)),
            after => Err([next.checked_sub(1).map(|before| self.t[before]), after.copied()]),
        }
    }

    /// The first record of a history that has some.
    #[must_use]
    pub fn first(&self) -> Option<AttitudeRecord> {
        (!self.t.is_empty()).then(|| self.record(0))
    }

    fn record(&self, place: usize) -> AttitudeRecord {
        AttitudeRecord {
            t: self.t[place],
            attitude: self.attitude[place],
            angular_velocity: self.angular_velocity.get(place).copied(),
        }
    }

    /// Appends a record, which must follow those before.
    fn push(&mut self, record: AttitudeRecord) -> Result<(), AttitudeProblem> {
        let AttitudeRecord { t, attitude, angular_velocity } = record;
        let norm = attitude.iter().map(|part| part * part).sum::<f64>().sqrt();
        if !((norm - 1.0).abs() <= UNIT) {
            return Err(AttitudeProblem::NotUnit { norm });
        }
        if let Some(before) = self.t.last().filter(|before| !(t > **before)) {
            return Err(AttitudeProblem::Order { t, before: *before });
        }
        self.t.push(t);
        self.attitude.push(attitude.map(|part| part / norm));
        self.angular_velocity.extend(angular_velocity);
        Ok(())
    }
}

/// Largest deviation of the norm of a quaternion in a file from one, as of one in a model: three digits.
const UNIT: f64 = 1e-3;

/// Reads a history of attitudes, whose format the beginning of the file tells:
///
/// - CCSDS attitude ephemeris messages (AEM), versions 1.0 and 2.0, as keywords and values: `QUATERNION`, `QUATERNION/DERIVATIVE`,
///   `QUATERNION/RATE` and `QUATERNION/ANGVEL`; segments of one object and one pair of frames follow each other;
/// - STK attitude files (`.a`): `AttitudeTimeQuaternions`, `AttitudeTimeQuatScalarFirst` and `AttitudeTimeQuatAngVels`;
/// - tables with the columns `t`, `qw`, `qx`, `qy`, `qz` and perhaps `wx`, `wy`, `wz` of a history, in CSV or Parquet.
///
/// # Errors
/// [`AttitudeError`] says what is wrong and on which line.
pub fn read_attitude(file: &Path) -> Result<AttitudeHistory, AttitudeError> {
    let bytes = bytes_of(file, MAX_FILE)?;
    let fault = FileError::new(file);
    if table::begins(file, &bytes) {
        return table::read(file).map_err(fault);
    }
    attitude_of(&bytes).map_err(fault)
}

fn attitude_of(bytes: &[u8]) -> Result<AttitudeHistory, Fault> {
    let text = text(bytes)?;
    let beginning = text.trim_start();
    let history = if beginning.starts_with("CCSDS_AEM_VERS") {
        aem::read(text)?
    } else if beginning.get(..6).is_some_and(|start| start.eq_ignore_ascii_case("stk.v.")) {
        stk::read(text)?
    } else {
        return Err((Place::File, AttitudeProblem::NotAttitude { is_xml: beginning.starts_with('<') }));
    };
    if history.t.is_empty() {
        return Err((Place::File, AttitudeProblem::Empty));
    }
    Ok(history)
}
