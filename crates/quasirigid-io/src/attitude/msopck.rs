//! Input of `msopck`, the program of SPICE that makes C-kernels of text: a file of data, and a setup file that says how they are meant.
//! Epochs are UTC, which `msopck` converts by its file of leap seconds, or seconds of TDB past J2000.

use std::io::Write;

use super::error::Unwritten;
use super::rows::Records;
use super::written::{Labels, without_leap};
use super::{AttitudeRecord, Epoch, TimeSystem};

/// Writes a line for each record: time, the quaternion of the C-matrix, scalar first, and the angular velocity (rad/s), body axes.
pub fn write(out: &mut impl Write, labels: &Labels, records: &Records<'_>) -> Result<(), Unwritten> {
    let is_utc = labels.time_system == TimeSystem::Utc;
    if !is_utc && labels.time_system != TimeSystem::TDB {
        let system = labels.time_system.label();
        return Err(Unwritten::TimeSystem { system, allowed: "UTC and TDB" });
    }
    without_leap(labels, records)?;
    let start = labels.start().since(Epoch::J2000);
    records.each(&mut |AttitudeRecord { t, attitude: [w, x, y, z], angular_velocity }| {
        if is_utc {
            write!(out, "{}", labels.at(t)?)?;
        } else {
            write!(out, "{:?}", start + t)?;
        }
        // the C-matrix takes components in the reference axes to the body: the conjugate of ours
        for number in [w, -x, -y, -z].into_iter().chain(angular_velocity.into_iter().flatten()) {
            write!(out, " {number:.16e}")?;
        }
        Ok(writeln!(out)?)
    })
}

/// The setup file of data in `data`.
pub fn setup(labels: &Labels, rates: bool, data: &str) -> String {
    let [program, axes] = labels.sentences("J2000 of SPICE");
    let time = if labels.time_system == TimeSystem::Utc { "UTC" } else { "ET" };
    let rates = if rates { "YES" } else { "MAKE UP" };
    let object = labels.plain_object().replace('\'', " ");
    let segment: String = object.chars().take(SEGMENT).collect();
    format!(
        "{program}: setup file of msopck, a program of NAIF's SPICE toolkit.\n\
         {axes}.\n\
         \n\
         Data: time, q0 q1 q2 q3, wx wy wz. The quaternion is SPICE's, scalar first:\n\
         that of the C-matrix, which takes J2000 components to body components.\n\
         The angular velocity is in body axes, rad/s.\n\
         \n\
         Set the names of the kernels and INSTRUMENT_ID to those of your mission, then\n\
         run: msopck SETUP {data} OUTPUT.bc\n\
         \n\
         \\begindata\n\
         \n   LSK_FILE_NAME        = 'naif0012.tls'\
         \n   MAKE_FAKE_SCLK       = 'quasirigid.tsc'\
         \n   INSTRUMENT_ID        = -999000\
         \n   CK_TYPE              = 3\
         \n   CK_SEGMENT_ID        = '{segment}'\
         \n   REFERENCE_FRAME_NAME = 'J2000'\
         \n   INPUT_DATA_TYPE      = 'SPICE QUATERNIONS'\
         \n   INPUT_TIME_TYPE      = '{time}'\
         \n   ANGULAR_RATE_PRESENT = '{rates}'\
         \n   ANGULAR_RATE_FRAME   = 'INSTRUMENT'\
         \n   PRODUCER_ID          = 'quasirigid'\n\
         \n\\begintext\n"
    )
}

/// Most letters of the name of a segment.
const SEGMENT: usize = 40;
