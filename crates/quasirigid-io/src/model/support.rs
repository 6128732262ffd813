use quasirigid_body::Support;

use super::formula::{TIME, formulas};
use super::key::{KIND, Keys, Shape, array, key, pick, vector};
use super::kinds::{Kind, Variant, kind, opened, variants};
use super::table::Table;
use crate::units::Dimension;

pub(super) type Read = fn(&Table<'_>) -> Option<Support>;

pub(super) const ANY: Keys = Keys {
    known: &[
        key("kind", KIND, "`\"free\"` without the table"),
        key("point", vector("m"), "fixed or driven"),
        key(
            "acceleration",
            array(3, &Shape::Formula).in_unit("m/s²"),
            "of a driven point, in `t`; inertial axes",
        ),
        key("velocity", vector("m/s").or("0"), "at time zero"),
        key("position", vector("m").or("0"), "at time zero"),
    ],
};

static KINDS: [Kind<Read>; 3] = [
    kind!("[support]", "free", ["kind"], "", |_| Some(Support::Free)),
    kind!("[support]", "fixed-point", ["kind", "point"], "", |table| {
        Some(Support::FixedPoint { point: point(table)? })
    }),
    kind!(
        "[support]",
        "prescribed",
        ["kind", "point", "acceleration", "velocity", "position"],
        "a driven point",
        prescribed
    ),
];

/// Documentation of the kinds.
pub(super) fn documented() -> Vec<Variant> {
    variants(&KINDS)
}

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
