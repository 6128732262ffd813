//! Reader of a start from an attitude file: `from` and `at` of `[initial]`. No attitude is made between two records.

use std::path::Path;

use super::rotation::rotation_given;
use super::table::Table;
use super::value::Value;
use crate::attitude::{AttitudeHistory, AttitudeRecord, Epoch, TimeSystem, read_attitude};
use crate::units::Dimension;

/// Beginnings of the names of axes that rotate, against which no start of a motion in inertial axes is told.
const ROTATING: [&str; 13] =
    ["ITRF", "GTOD", "TDR", "FIXED", "LVLH", "VVLH", "VNC", "RIC", "RSW", "RTN", "QSW", "NTW", "TNW"];
/// Beginnings of the names of inertial axes.
const INERTIAL: [&str; 9] =
    ["ICRF", "GCRF", "EME2000", "J2000", "MJ2000", "B1950", "INERTIAL", "TEME", "MEAN"];

/// Reads the record that `[initial]` starts from; none without a file.
pub(super) fn record(
    table: &Table<'_>,
    folder: &Path,
    notes: &mut Vec<String>,
) -> Option<Option<AttitudeRecord>> {
    let at = table.get("at");
    let Some(from) = table.get("from") else {
        return match at {
            Some(at) => at.refuse(
                "`at` is a time of a file, and there is none",
                "of what?",
                "add from = \"spin.aem\"",
            ),
            None => Some(None),
        };
    };
    if let Some(attitude) = table.get("attitude") {
        let message = "`from` and `attitude` both give the attitude";
        return attitude.refuse(message, "given twice", "leave out one of the two");
    }
    let file = folder.join(from.text()?);
    let history = match read_attitude(&file) {
        Ok(history) => history,
        Err(error) => {
            let help = "the file is looked for beside the model: an AEM, an attitude file of STK, or a table of a history";
            return from.refuse(format!("`from`: {error}"), "cannot be used", help);
        }
    };
    frame(&from, &history, notes)?;
    let record = match at {
        Some(at) => at_time(&at, &history)?,
        None => history.first()?,
    };
    rates(&from, table, &record)?;
    Some(Some(record))
}

/// Refuses rotating axes, and notes axes that are not known.
fn frame(from: &Value<'_>, history: &AttitudeHistory, notes: &mut Vec<String>) -> Option<()> {
    let name = history.frame.to_ascii_uppercase();
    let begins = |list: &[&str]| list.iter().any(|beginning| name.starts_with(beginning));
    if begins(&ROTATING) {
        let message = format!("`from`: the attitudes are against {}, which rotate", history.frame);
        return from.refuse(message, "not inertial", "write the file against inertial axes, such as ICRF");
    }
    if !name.is_empty() && !begins(&INERTIAL) {
        notes.push(format!("the axes {} of the attitude file are taken as inertial", history.frame));
    }
    Some(())
}

/// The record at a time: seconds of the file, or an epoch in its time system.
fn at_time(at: &Value<'_>, history: &AttitudeHistory) -> Option<AttitudeRecord> {
    let epoch = at.words().and_then(|text| text.parse::<Epoch>().ok());
    let t = match (epoch, history.epoch) {
        (Some(epoch), Some(start)) => {
            let system = history.time_system.unwrap_or(TimeSystem::Utc);
            if let Some(leap) = system.leap_between(start.min(epoch), start.max(epoch)) {
                let message = format!(
                    "`at`: a leap second ends at {leap} UTC, between the start of the file and this epoch"
                );
                return at.refuse(
                    message,
                    "across a leap second",
                    "write the seconds since the start of the file",
                );
            }
            epoch.since(start)
        }
        (Some(_), None) => {
            return at.refuse(
                "`at` is an epoch, and the file has none",
                "no epoch",
                "write the time of the row in seconds",
            );
        }
        (None, _) => at.quantity(Dimension::TIME)?,
    };
    match history.at(t) {
        Ok(record) => Some(record),
        Err(beside) => {
            let told = |time: f64| match history
                .epoch
                .filter(|_| epoch.is_some())
                .and_then(|start| start.after(time))
            {
                Some(epoch) => epoch.to_string(),
                None => format!("{time} s"),
            };
            let beside: Vec<String> = beside.into_iter().flatten().map(told).collect();
            let message = "`at`: the file has no record at this time, and none is made between two";
            at.refuse(message, "no record", format!("the records beside it are at {}", beside.join(" and ")))
        }
    }
}

/// Refuses angular velocities from two places, and from none.
fn rates(from: &Value<'_>, table: &Table<'_>, record: &AttitudeRecord) -> Option<()> {
    match (record.angular_velocity, rotation_given(table)) {
        (Some(_), Some(given)) => {
            let message = format!("`from` and `{}` both give the rotation", given.key());
            given.refuse(message, "given twice", "leave it out, or give a file without angular velocities")
        }
        (None, None) => {
            let message = "`from`: the file has no angular velocities";
            from.refuse(message, "attitudes alone", "write angular_velocity, periods or wobble, too")
        }
        _ => Some(()),
    }
}
