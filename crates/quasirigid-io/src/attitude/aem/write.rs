//! Writer of attitude ephemeris messages.

use std::io::Write;

use super::super::AttitudeRecord;
use super::super::error::Unwritten;
use super::super::rows::Records;
use super::super::written::{Labels, without_leap};
use super::Version;

/// Name of the body axes.
const BODY: &str = "SC_BODY_1";

/// Writes a message with one segment.
pub fn write(
    out: &mut impl Write,
    version: Version,
    labels: &Labels,
    records: &Records<'_>,
) -> Result<(), Unwritten> {
    without_leap(labels, records)?;
    header(out, version, labels)?;
    metadata(out, version, labels, records)?;
    writeln!(out, "\nDATA_START")?;
    records.each(&mut |AttitudeRecord { t, attitude: [w, x, y, z], angular_velocity }| {
        write!(out, "{}", labels.at(t)?)?;
        let rates = angular_velocity.into_iter().flatten().map(f64::to_degrees);
        // sixteen digits are the most that the standard allows
        for number in [x, y, z, w].into_iter().chain(rates) {
            write!(out, " {number:.15e}")?;
        }
        Ok(writeln!(out)?)
    })?;
    Ok(writeln!(out, "DATA_STOP")?)
}

fn header(out: &mut impl Write, version: Version, labels: &Labels) -> Result<(), Unwritten> {
    let number = match version {
        Version::One => "1.0",
        Version::Two => "2.0",
    };
    writeln!(out, "CCSDS_AEM_VERS = {number}")?;
    for sentence in labels.sentences(labels.frame.ccsds()) {
        writeln!(out, "COMMENT {sentence}")?;
    }
    writeln!(out, "CREATION_DATE = {}", labels.created)?;
    Ok(writeln!(out, "ORIGINATOR = QUASIRIGID")?)
}

fn metadata(
    out: &mut impl Write,
    version: Version,
    labels: &Labels,
    records: &Records<'_>,
) -> Result<(), Unwritten> {
    let [first, last] = records.ends;
    let rates = records.have_rates();
    let mut pairs = vec![
        ("OBJECT_NAME", labels.plain_object()),
        ("OBJECT_ID", "UNKNOWN".to_owned()),
        ("REF_FRAME_A", labels.frame.ccsds().to_owned()),
        ("REF_FRAME_B", BODY.to_owned()),
    ];
    if version == Version::One {
        pairs.push(("ATTITUDE_DIR", "A2B".to_owned()));
    }
    pairs.extend([
        ("TIME_SYSTEM", labels.time_system.label().to_owned()),
        ("START_TIME", labels.at(first)?.to_string()),
        ("STOP_TIME", labels.at(last)?.to_string()),
    ]);
    let (with, keyword, frame) = match version {
        Version::One => ("QUATERNION/RATE", "RATE_FRAME", "REF_FRAME_B"),
        Version::Two => ("QUATERNION/ANGVEL", "ANGVEL_FRAME", BODY),
    };
    pairs.push(("ATTITUDE_TYPE", if rates { with } else { "QUATERNION" }.to_owned()));
    if version == Version::One {
        pairs.push(("QUATERNION_TYPE", "LAST".to_owned()));
    }
    if rates {
        pairs.push((keyword, frame.to_owned()));
    }
    writeln!(out, "\nMETA_START")?;
    writeln!(
        out,
        "COMMENT Q1 Q2 Q3 QC, scalar last, turn the axes of REF_FRAME_A into those of REF_FRAME_B"
    )?;
    if rates {
        writeln!(out, "COMMENT Rates: REF_FRAME_B against REF_FRAME_A, in axes of REF_FRAME_B, deg/s")?;
    }
    for (keyword, value) in pairs {
        writeln!(out, "{keyword} = {value}")?;
    }
    Ok(writeln!(out, "META_STOP")?)
}
