//! Arrays of Basilisk: times (ns), modified Rodrigues parameters of the body against the inertial axes, and the angular velocity.

use std::io::{Seek, Write};
use std::path::Path;

use super::error::Unwritten;
use super::rows::Records;
use crate::record::{Array, RecordError, write_arrays};

/// Nanoseconds of a second.
const NANO: f64 = 1e9;

/// Writes `times` (int64), `sigma_BN` and, where there is one, `omega_BN_B` (rad/s), a row for each record.
pub fn write(
    out: &mut (impl Write + Seek),
    inputs: Option<&str>,
    records: &Records<'_>,
) -> Result<(), Unwritten> {
    let times = |row: &[f64], bytes: &mut Vec<u8>| {
        bytes.extend(((records.record(row).t * NANO).round() as i64).to_le_bytes());
    };
    let sigma = |row: &[f64], bytes: &mut Vec<u8>| {
        push(bytes, rodrigues(records.record(row).attitude));
    };
    let omega = |row: &[f64], bytes: &mut Vec<u8>| {
        push(bytes, records.record(row).angular_velocity.unwrap_or_default());
    };
    let mut arrays = vec![
        Array { name: "times", kind: "<i8", width: None, bytes: &times },
        Array { name: "sigma_BN", kind: "<f8", width: Some(3), bytes: &sigma },
    ];
    if records.have_rates() {
        arrays.push(Array { name: "omega_BN_B", kind: "<f8", width: Some(3), bytes: &omega });
    }
    write_arrays(Path::new("table.npz"), out, (&arrays, inputs), records.rows()).map_err(
        |error| match error {
            RecordError::File { kind, .. } => Unwritten::File(kind.into()),
            other => Unwritten::Record(other),
        },
    )
}

/// Modified Rodrigues parameters of an attitude, `e tan(φ/4)` with an angle of at most half a turn: those of the rotation that turns the
/// inertial axes into the body's.
fn rodrigues([w, x, y, z]: [f64; 4]) -> [f64; 3] {
    let sign = if w < 0.0 { -1.0 } else { 1.0 };
    [x, y, z].map(|part| sign * part / (1.0 + sign * w))
}

fn push(bytes: &mut Vec<u8>, vector: [f64; 3]) {
    vector.into_iter().for_each(|number| bytes.extend(number.to_le_bytes()));
}
