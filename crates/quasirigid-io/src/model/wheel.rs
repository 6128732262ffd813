use quasirigid_elements::{ElementKind, Wheel, WheelSpeed};

use super::formula::{LAW, PRESCRIBED, TIME, formula};
use super::key::{Keys, VECTOR, key, quantity};
use super::names::Part;
use super::reader::{Keyed, NAME, Naming, Reader};
use super::table::Table;
use super::value::Value;
use crate::units::Dimension;

pub(super) const READER: Reader = Reader {
    key: "wheel",
    title: "[[wheel]]",
    meaning: "momentum wheel",
    keys: Keyed::All(&WHEEL),
    kind: Some(ElementKind::Wheel),
    naming: Naming::Numbered("wheel"),
    names: |_| Part::Inside,
    aliases: &[],
    nested: &[],
    is_body: false,
    read: |entry, draft| {
        draft.assembly.wheels.push(wheel(entry.table, entry.name)?);
        Some(())
    },
};

const WHEEL: Keys = Keys {
    known: &[
        NAME,
        key("axis", VECTOR, ""),
        key("inertia", quantity("kg m²"), ""),
        key("speed", PRESCRIBED.in_unit("rad/s"), "relative to the carrier, kept by a motor"),
        key("momentum", quantity("N m s"), "instead of `inertia` and `speed`"),
    ],
};

/// Reads a `[[wheel]]`.
pub(super) fn wheel(table: &Table<'_>, name: &str) -> Option<Wheel> {
    let axis = table.read("axis", "axis = [0, 0, 1]", |value| value.vector(Dimension::NUMBER));
    let speed = match table.get("momentum") {
        Some(momentum) => given_momentum(table, &momentum),
        None => given_speed(table),
    };
    Some(Wheel { name: name.to_owned(), axis: axis?, speed: speed? })
}

fn given_momentum(table: &Table<'_>, momentum: &Value<'_>) -> Option<WheelSpeed> {
    for key in ["inertia", "speed"] {
        if let Some(other) = table.get(key) {
            let message = format!("`{key}` beside `momentum`: the momentum determines it");
            let help = "give either `momentum`, or `inertia` and `speed`";
            return other.refuse(message, "one of the two", help);
        }
    }
    let momentum = momentum.quantity(Dimension::ANGULAR_MOMENTUM)?;
    Some(WheelSpeed::Constant { angular_momentum: momentum })
}

fn given_speed(table: &Table<'_>) -> Option<WheelSpeed> {
    let inertia = table.read("inertia", "inertia = 0.02", |value| value.positive(Dimension::INERTIA));
    let speed = table.required("speed", "speed = \"3000 rpm\"")?;
    if !speed.is_table() {
        let speed = speed.quantity(Dimension::ANGULAR_VELOCITY)?;
        return Some(WheelSpeed::Constant { angular_momentum: inertia? * speed });
    }
    let prescribed = speed.table("`speed`", &LAW)?;
    let value = prescribed.required("formula", "speed = { formula = \"300 + 20 * sin(0.1 * t)\" }")?;
    let speed = formula(&value, &TIME, Dimension::ANGULAR_VELOCITY)?;
    Some(WheelSpeed::Prescribed { inertia: inertia?, speed })
}
