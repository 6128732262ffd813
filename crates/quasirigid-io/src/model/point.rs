use quasirigid_elements::{ElementKind, Point, PointMotion};

use super::key::{Keys, Shape, VECTOR, any, key, quantity, vector};
use super::names::Part;
use super::reader::{Keyed, NAME, Naming, Reader};
use super::table::Table;
use super::value::Value;
use crate::units::Dimension;

pub(super) const READER: Reader = Reader {
    key: "point",
    title: "[[point]]",
    meaning: "point mass",
    keys: Keyed::All(&POINT),
    kind: Some(ElementKind::Point),
    naming: Naming::Numbered("point"),
    names: |index| Part::Point(index),
    aliases: &[],
    nested: &[],
    is_body: false,
    read: |entry, draft| {
        draft.assembly.points.push(point(entry.table, entry.name)?);
        Some(())
    },
};

const POINT: Keys = Keys {
    known: &[
        NAME,
        key("mass", quantity("kg"), ""),
        key("position", vector("m"), "at equilibrium"),
        key(
            "motion",
            any(&[Shape::Words(&["free"]), Shape::Table(&MOTION)]).or("`\"free\"`"),
            "or a constraint",
        ),
    ],
};
const MOTION: Keys =
    Keys { known: &[key("line", VECTOR, "direction of a guide"), key("plane", VECTOR, "its normal")] };

/// Reads a `[[point]]`.
fn point(table: &Table<'_>, name: &str) -> Option<Point> {
    let mass = table.read("mass", "mass = 1.0", |value| value.positive(Dimension::MASS));
    let position =
        table.read("position", "position = [0.8, 0.3, 0.5]", |value| value.vector(Dimension::LENGTH));
    let motion = table.read_or("motion", PointMotion::Free, |value| motion(&value));
    Some(Point { name: name.to_owned(), mass: mass?, position: position?, motion: motion? })
}

fn motion(value: &Value<'_>) -> Option<PointMotion> {
    if value.is_word("free") {
        return Some(PointMotion::Free);
    }
    let help = "write \"free\", { line = [1, 0, 0] } or { plane = [0, 0, 1] }";
    if !value.is_table() {
        return value.mismatch("\"free\", a line or a plane", help);
    }
    let table = value.table("`motion`", &MOTION)?;
    let direction = |value: Value<'_>| value.vector(Dimension::NUMBER);
    match (table.get("line"), table.get("plane")) {
        (Some(line), None) => direction(line).map(PointMotion::Line),
        (None, Some(plane)) => direction(plane).map(PointMotion::Plane),
        _ => {
            let message = "`motion` needs either a line or a plane";
            value.refuse(message, "a line or a plane", help)
        }
    }
}
