//! Initial rotation: an angular velocity, two observed periods, or a wobble about an axis.
//! The forms exclude each other, since two of them would state the rotation twice; the state itself is computed in the study.

use std::f64::consts::FRAC_PI_2;

use quasirigid_body::Mode;

use super::key::{Key, Keys, key, quantity, words};
use super::table::Table;
use super::value::Value;
use crate::units::Dimension;

/// Axis that the angular momentum circles.
const MODE: Key = key(
    "mode",
    words(&["short-axis", "long-axis", "SAM", "LAM"]),
    "axis circled: of greatest inertia, of least",
);

pub(super) const PERIODS: Keys = Keys {
    known: &[
        key("rotation", quantity("s"), "about the long axis"),
        key("precession", quantity("s"), "of the long axis about the angular momentum"),
        MODE,
    ],
};
pub(super) const WOBBLE: Keys = Keys {
    known: &[
        key("angle", quantity("rad"), "greatest, between angular momentum and axis"),
        key("rate", quantity("rad/s"), "angular momentum over the moment of inertia"),
        MODE,
    ],
};

/// Rotation of the body at time zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rotation {
    /// With this angular velocity (rad/s), body axes.
    Spin([f64; 3]),
    /// With two observed periods.
    Periods {
        /// Period of the rotation about the long axis (s).
        rotation: f64,
        /// Mean period in which the long axis goes round the angular momentum (s).
        precession: f64,
        /// Axis that the angular momentum circles.
        mode: Mode,
    },
    /// About an axis of the body, at an angle to it.
    Wobble {
        /// Greatest angle (rad) between the angular momentum and the axis that it circles, above 0 and below a right
        /// angle.
        angle: f64,
        /// Angular momentum over the moment of inertia about that axis (rad/s).
        rate: f64,
        /// Axis that the angular momentum circles.
        mode: Mode,
    },
}

type Read = fn(&Value<'_>) -> Option<Rotation>;

/// Keys of the forms of rotation, with their readers.
const FORMS: [(&str, Read); 3] = [("angular_velocity", spin), ("periods", periods), ("wobble", wobble)];

/// The first form in the order of the list that `[initial]` has.
pub(super) fn rotation_given<'a>(table: &Table<'a>) -> Option<Value<'a>> {
    FORMS.iter().find_map(|(key, _)| table.get(key))
}

/// Reads the rotation, if `[initial]` gives one; two forms at once are refused.
pub(super) fn rotation(table: &Table<'_>) -> Option<Option<Rotation>> {
    let mut given: Vec<_> = FORMS.iter().filter_map(|(key, read)| Some((table.get(key)?, read))).collect();
    given.sort_by_key(|(value, _)| value.span().start);
    let mut rotations: Vec<_> = given.iter().map(|(value, read)| read(value)).collect();
    if let [(first, _), .., (last, _)] = given.as_slice() {
        let message = format!("`{}` and `{}` both give the rotation", first.key(), last.key());
        let help = "leave out all but one";
        return last.refuse(message, "given twice", help);
    }
    rotations.pop().map_or(Some(None), |rotation| rotation.map(Some))
}

fn spin(value: &Value<'_>) -> Option<Rotation> {
    value.vector(Dimension::ANGULAR_VELOCITY).map(Rotation::Spin)
}

fn periods(value: &Value<'_>) -> Option<Rotation> {
    let table = value.table("`periods`", &PERIODS)?;
    let period = |key, example| table.required(key, example)?.positive(Dimension::TIME);
    let rotation = period("rotation", "rotation = \"263 h\"");
    let precession = period("precession", "precession = \"27.38 h\"");
    let mode = mode(&table);
    Some(Rotation::Periods { rotation: rotation?, precession: precession?, mode: mode? })
}

fn wobble(value: &Value<'_>) -> Option<Rotation> {
    let table = value.table("`wobble`", &WOBBLE)?;
    let angle = table.read("angle", "angle = \"5 deg\"", |value| acute(&value));
    let rate = table.read("rate", "rate = \"60 rpm\"", |value| value.positive(Dimension::ANGULAR_VELOCITY));
    let mode = mode(&table);
    Some(Rotation::Wobble { angle: angle?, rate: rate?, mode: mode? })
}

fn acute(value: &Value<'_>) -> Option<f64> {
    value.between(Dimension::ANGLE, [0.0, FRAC_PI_2], "between 0 and 90 deg")
}

fn mode(table: &Table<'_>) -> Option<Mode> {
    let choices = [
        ("short-axis", Mode::ShortAxis),
        ("long-axis", Mode::LongAxis),
        ("SAM", Mode::ShortAxis),
        ("LAM", Mode::LongAxis),
    ];
    table.required("mode", "mode = \"short-axis\", or mode = \"long-axis\"")?.choice(&choices)
}
