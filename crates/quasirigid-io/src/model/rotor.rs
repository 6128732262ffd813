use quasirigid_elements::{ElementKind, Rotor, RotorKind};

use super::key::{Keys, Shape, VECTOR, any, key, quantity, words};
use super::names::Part;
use super::reader::{Keyed, NAME, Naming, Reader};
use super::table::Table;
use super::value::Value;
use crate::units::Dimension;

pub(super) const READER: Reader = Reader {
    key: "rotor",
    title: "[[rotor]]",
    meaning: "rotor with friction",
    keys: Keyed::All(&ROTOR),
    kind: Some(ElementKind::Rotor),
    naming: Naming::Numbered("rotor"),
    names: |_| Part::Inside,
    aliases: &[],
    nested: &[],
    is_body: false,
    read: |entry, draft| {
        draft.assembly.rotors.push(rotor(entry.table, entry.name)?);
        Some(())
    },
};

const ROTOR: Keys = Keys {
    known: &[
        NAME,
        key("shape", words(&["flywheel", "sphere"]).or("`\"flywheel\"`"), "a sphere turns about any axis"),
        key("axis", VECTOR, "of a flywheel"),
        key("inertia", quantity("kg m²"), "about the axis"),
        key("friction", quantity("N m s/rad"), "above zero"),
        key(
            "speed",
            any(&[Shape::Number, Shape::List(&Shape::Number)]).in_unit("rad/s").or("slow motion"),
            "relative to the carrier, at the start; of a sphere one per axis",
        ),
    ],
};

/// Reads a `[[rotor]]`.
pub(super) fn rotor(table: &Table<'_>, name: &str) -> Option<Rotor> {
    let kind = kind(table);
    let inertia = table.read("inertia", "inertia = 0.2", |value| value.positive(Dimension::INERTIA));
    let friction =
        table.read("friction", "friction = 0.05", |value| value.positive(Dimension::ROTATIONAL_DAMPING));
    let speed = table.read_or("speed", None, |value| speed(&value).map(Some));
    Some(Rotor { name: name.to_owned(), kind: kind?, inertia: inertia?, friction: friction?, speed: speed? })
}

fn kind(table: &Table<'_>) -> Option<RotorKind> {
    let ball = match table.get("shape") {
        Some(shape) => shape.choice(&[("flywheel", false), ("sphere", true)])?,
        None => false,
    };
    match (ball, table.get("axis")) {
        (false, _) => {
            let axis = table.required("axis", "axis = [0, 0, 1]")?;
            Some(RotorKind::Flywheel { axis: axis.vector(Dimension::NUMBER)? })
        }
        (true, None) => Some(RotorKind::Sphere),
        (true, Some(axis)) => {
            let message = "a sphere turns about any axis, so it has no `axis`";
            axis.refuse(message, "not for a sphere", "leave it out")
        }
    }
}

fn speed(value: &Value<'_>) -> Option<Vec<f64>> {
    if value.is_array() {
        return value.list("one speed per axis", |item| item.quantity(Dimension::ANGULAR_VELOCITY));
    }
    value.quantity(Dimension::ANGULAR_VELOCITY).map(|speed| vec![speed])
}
