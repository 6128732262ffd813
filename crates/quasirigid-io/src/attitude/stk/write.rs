//! Writer of attitude files of STK.

use std::io::Write;

use super::super::error::Unwritten;
use super::super::rows::Records;
use super::super::written::Labels;
use super::super::{AttitudeRecord, TimeSystem};

/// Writes a file, whose scenario epoch is that of time zero. Times are elapsed seconds, so that leap seconds do not matter.
pub fn write(out: &mut impl Write, labels: &Labels, records: &Records<'_>) -> Result<(), Unwritten> {
    if labels.time_system != TimeSystem::Utc {
        let system = labels.time_system.label();
        return Err(Unwritten::TimeSystem { system, allowed: "UTC" });
    }
    let axes = labels.frame.stk();
    let block = if records.have_rates() { "AttitudeTimeQuatAngVels" } else { "AttitudeTimeQuaternions" };
    writeln!(out, "stk.v.11.0")?;
    for sentence in labels.sentences(axes) {
        writeln!(out, "# {sentence}")?;
    }
    writeln!(out, "# q1 q2 q3 q4, scalar last, turn the coordinate axes into those of the body")?;
    if records.have_rates() {
        writeln!(out, "# Rates: body against the coordinate axes, in body axes, deg/s")?;
    }
    writeln!(out, "BEGIN Attitude")?;
    writeln!(out, "NumberOfAttitudePoints {}", records.count)?;
    writeln!(out, "ScenarioEpoch {}", labels.start().to_stk())?;
    writeln!(out, "BlockingFactor 20")?;
    writeln!(out, "InterpolationOrder 1")?;
    writeln!(out, "CentralBody Earth")?;
    writeln!(out, "CoordinateAxes {axes}")?;
    writeln!(out, "{block}")?;
    records.each(&mut |AttitudeRecord { t, attitude: [w, x, y, z], angular_velocity }| {
        write!(out, "{t:.16e}")?;
        let rates = angular_velocity.into_iter().flatten().map(f64::to_degrees);
        for number in [x, y, z, w].into_iter().chain(rates) {
            write!(out, " {number:.16e}")?;
        }
        Ok(writeln!(out)?)
    })?;
    Ok(writeln!(out, "END Attitude")?)
}
