use quasirigid_body::Support;

use super::formula::{TIME, formulas};
use super::kinds::{Kind, kind, opened};
use super::table::{Keys, Table};
use crate::units::Dimension;

pub(super) type Read = fn(&Table<'_>) -> Option<Support>;

const KEYS: &[&str] = &["kind", "point", "acceleration", "velocity", "position"];
const ANY: Keys = Keys { known: KEYS };

static KINDS: [Kind<Read>; 3] = [
    kind!("[support]", "free", &["kind"], |_| Some(Support::Free)),
    kind!("[support]", "fixed-point", &["kind", "point"], |table| {
        Some(Support::FixedPoint { point: point(table)? })
    }),
    kind!("[support]", "prescribed", KEYS, prescribed),
];

/// Opens `[support]`, if the file has it.
pub(super) fn table<'a>(file: &Table<'a>) -> Option<(Table<'a>, &'static Kind<Read>)> {
    opened(&file.single("support", "[support]")?, "[support]", "kind", &ANY, &KINDS)
}

fn prescribed(table: &Table<'_>) -> Option<Support> {
    let point = point(table);
    let acceleration =
        table.read("acceleration", "acceleration = [\"0\", \"0\", \"0.3*cos(2*t)\"]", |value| {
            formulas(&value, &TIME, Dimension::ACCELERATION)
        });
    let velocity = table.vector_or_zero("velocity", Dimension::VELOCITY);
    let position = table.vector_or_zero("position", Dimension::LENGTH);
    Some(Support::Prescribed {
        point: point?,
        acceleration: acceleration?,
        velocity: velocity?,
        position: position?,
    })
}

fn point(table: &Table<'_>) -> Option<[f64; 3]> {
    table.required("point", "point = [0.0, 0.0, 0.0]")?.vector(Dimension::LENGTH)
}
