//! Names of what controllers measure and command: `rate.x`, `displacement.NODE.x`, `wheel.NAME.torque`, `moment.x`.
//! Equations (Y2), (Y4), (Y8), (Y12), docs/theory/20-control.md.

use quasirigid_body::control::{Actuator, Measurement};

use super::value::Value;

/// What a named controller measures.
pub(super) type Measured = Measurement<String, String, String>;

const AXES: [&str; 3] = ["x", "y", "z"];
const MEASURED: &str = "write rate.x, attitude.x, displacement.NODE.x, velocity.NODE.x, coordinate.NAME, speed.NAME, wheel.NAME.momentum, field.x, field_rate.x, orbit.x, orbit_rate.x, nadir.x or sun.x";
const COMMANDED: &str =
    "write torque.x, torque.y, torque.z, moment.x, moment.y, moment.z or wheel.NAME.torque";

/// Reads the name of a measurement; the attitude is that from a target.
pub(super) fn measurement(value: &Value<'_>, target: [f64; 4]) -> Option<Measured> {
    let name = value.text()?;
    measured(name, target).or_else(|| {
        value.refuse(format!("{name:?} is nothing that a controller measures"), "unknown", MEASURED)
    })
}

/// Reads the name of an actuator.
pub(super) fn actuator(value: &Value<'_>) -> Option<Actuator<String>> {
    let name = value.text()?;
    commanded(name).or_else(|| {
        value.refuse(format!("{name:?} is nothing that a controller commands"), "unknown", COMMANDED)
    })
}

/// Angular velocity, axis by axis.
pub(super) fn rates() -> [Measured; 3] {
    [0, 1, 2].map(|axis| Measurement::Rate { axis })
}

/// Attitude error from a target, axis by axis.
pub(super) fn attitude(target: [f64; 4]) -> [Measured; 3] {
    [0, 1, 2].map(|axis| Measurement::Attitude { target, axis })
}

/// Attitude error from the orbital frame, axis by axis.
pub(super) fn orbit_attitude() -> [Measured; 3] {
    [0, 1, 2].map(|axis| Measurement::OrbitAttitude { axis })
}

/// Angular velocity relative to the orbital frame, axis by axis.
pub(super) fn orbit_rates() -> [Measured; 3] {
    [0, 1, 2].map(|axis| Measurement::OrbitRate { axis })
}

/// Rate of the magnetic field, axis by axis.
pub(super) fn field_rates() -> [Measured; 3] {
    [0, 1, 2].map(|axis| Measurement::FieldRate { axis })
}

fn measured(name: &str, target: [f64; 4]) -> Option<Measured> {
    if let Some(wheel) = between(name, "wheel.", ".momentum") {
        return Some(Measurement::Wheel { wheel });
    }
    for (kind, speed) in [("coordinate.", false), ("speed.", true)] {
        let Some(own) = between(name, kind, "") else { continue };
        let coordinate = own;
        return Some(if speed {
            Measurement::Speed { coordinate }
        } else {
            Measurement::Coordinate { coordinate }
        });
    }
    let (path, axis) = name.rsplit_once('.')?;
    let axis = AXES.iter().position(|known| *known == axis)?;
    match path.split_once('.') {
        None if path == "rate" => Some(Measurement::Rate { axis }),
        None if path == "attitude" => Some(Measurement::Attitude { target, axis }),
        None if path == "field" => Some(Measurement::Field { axis }),
        None if path == "field_rate" => Some(Measurement::FieldRate { axis }),
        None if path == "orbit" => Some(Measurement::OrbitAttitude { axis }),
        None if path == "orbit_rate" => Some(Measurement::OrbitRate { axis }),
        None if path == "nadir" => Some(Measurement::Nadir { axis }),
        None if path == "sun" => Some(Measurement::Sun { axis }),
        Some(("displacement", at)) => Some(Measurement::Displacement { at: at.to_owned(), axis }),
        Some(("velocity", at)) => Some(Measurement::Velocity { at: at.to_owned(), axis }),
        _ => None,
    }
}

fn commanded(name: &str) -> Option<Actuator<String>> {
    if let Some(wheel) = between(name, "wheel.", ".torque") {
        return Some(Actuator::Wheel { wheel });
    }
    let (kind, axis) = name.split_once('.')?;
    let axis = AXES.iter().position(|known| *known == axis)?;
    match kind {
        "torque" => Some(Actuator::Torque { axis }),
        "moment" => Some(Actuator::Moment { axis }),
        _ => None,
    }
}

/// What stands between a beginning and an end; none if that is nothing.
fn between(name: &str, begin: &str, end: &str) -> Option<String> {
    let inner = name.strip_prefix(begin)?.strip_suffix(end)?;
    (!inner.is_empty()).then(|| inner.to_owned())
}
