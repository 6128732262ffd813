//! Hinge reader: `[[hinged]]`, a rigid appendage on one to three axes, with named places for springs and forces.
//! The names of its places are registered here, because springs and forces are read later and refer to them.
//! Equations (I8) and (I9), docs/theory/02-invariants.md.

use quasirigid_elements::{ElementKind, HingeCoefficient, Hinged, PrescribedMotion};

use super::body::{INERTIA, inertia};
use super::formula::{PRESCRIBED, prescribed};
use super::key::{Form, Keys, Shape, any, key, list, named, quantity, vector};
use super::names::Part;
use super::reader::{Keyed, NAME, Naming, Reader};
use super::rheology::{Extremes, RHEOLOGY, Scale, rheology};
use super::table::Table;
use super::value::Value;
use crate::units::Dimension;

pub(super) const READER: Reader = Reader {
    key: "hinged",
    title: "[[hinged]]",
    meaning: "rigid appendage on a hinge",
    keys: Keyed::All(&HINGED),
    kind: Some(ElementKind::Hinged),
    naming: Naming::Numbered("appendage"),
    names: |index| Part::Hinged(index),
    aliases: &[],
    nested: &[],
    is_body: false,
    read: |entry, draft| {
        let (hinged, range) = hinged(entry.table, entry.name)?;
        let places = hinged.places.iter().map(|(name, _)| name.clone()).collect();
        draft.names.places.insert(entry.index, places);
        draft.assembly.hinged.push(hinged);
        draft.range(ElementKind::Hinged, entry, range)
    },
};

/// Stiffness or damping about the axes.
const COEFFICIENT: Form =
    any(&[Shape::Number, Shape::List(&Shape::Number), Shape::List(&Shape::List(&Shape::Number))]);

const HINGED: Keys = Keys {
    known: &[
        NAME,
        key("mass", quantity("kg"), "of a rigid appendage"),
        key("center_of_mass", vector("m"), ""),
        INERTIA,
        key("hinge", vector("m"), ""),
        key("axes", list(&Shape::Vector), "1 to 3; the first is fixed in the carrier and carries the second"),
        key("stiffness", COEFFICIENT.in_unit("N m/rad"), "one, one per axis, or a matrix"),
        key("damping", COEFFICIENT.in_unit("N m s/rad").or("0"), "same"),
        RHEOLOGY,
        key(
            "angle",
            PRESCRIBED.in_unit("rad"),
            "about one axis, instead of them: locked, or driven over time",
        ),
        key("places", named(&Shape::Vector).in_unit("m").or("none"), "for springs and forces"),
    ],
};

/// Reads a `[[hinged]]` appendage, and the rheology at both ends of its range.
pub(super) fn hinged(table: &Table<'_>, name: &str) -> Option<(Hinged, Extremes)> {
    let mass = table.read("mass", "mass = 1.0", |value| value.positive(Dimension::MASS));
    let center_of_mass = table
        .read("center_of_mass", "center_of_mass = [1.5, 0.0, 0.0]", |value| value.vector(Dimension::LENGTH));
    let inertia = table.read("inertia", "inertia = [0.0, 0.3, 0.3]", |value| inertia(&value));
    let hinge = table.read("hinge", "hinge = [1.0, 0.0, 0.0]", |value| value.vector(Dimension::LENGTH));
    let axes = table.read("axes", "axes = [[0, 0, 1]]", |value| axes(&value));
    let count = axes.as_ref().map_or(1, Vec::len);
    let angle = angle(table)?;
    let stiffness = match angle {
        Some(_) => Some(HingeCoefficient::PerAxis(vec![0.0; count])),
        None => table.read("stiffness", "stiffness = \"0.565 N m/rad\"", |value| {
            coefficient(&value, Dimension::ROTATIONAL_STIFFNESS, count)
        }),
    };
    let damping = table.read_or("damping", HingeCoefficient::PerAxis(vec![0.0; count]), |value| {
        coefficient(&value, Dimension::ROTATIONAL_DAMPING, count)
    });
    let places = table.read_or("places", Vec::new(), |value| {
        value.places("a table of places", "write { tip = [2, 0, 0] }")
    });
    let known = rheology(table, Scale::OF_SPRING)?;
    let hinged = Hinged {
        name: name.to_owned(),
        mass: mass?,
        center_of_mass: center_of_mass?,
        inertia: inertia?,
        hinge: hinge?,
        axes: axes?,
        stiffness: stiffness?,
        damping: damping?,
        rheology: known.rheology,
        angle,
        places: places?,
    };
    Some((hinged, known.extremes))
}

/// Reads the angle of a driven hinge, which has neither spring nor damper; none where there is no drive.
fn angle(table: &Table<'_>) -> Option<Option<PrescribedMotion>> {
    let Some(angle) = table.get("angle") else { return Some(None) };
    for key in ["stiffness", "damping", "rheology"] {
        if let Some(other) = table.get(key) {
            let message = format!("`{key}` beside `angle`: a drive holds the hinge at its angle");
            let help = "give either `angle`, or the spring and the damper of the hinge";
            return other.refuse(message, "one of the two", help);
        }
    }
    prescribed(&angle, "`angle`", Dimension::ANGLE).map(Some)
}

fn axes(value: &Value<'_>) -> Option<Vec<[f64; 3]>> {
    let list = "one to three axes, each an array of 3 numbers";
    match value.items() {
        Some(items) if (1..=3).contains(&items.len()) && items.iter().all(Value::is_array) => {
            value.list(list, |axis| axis.vector(Dimension::NUMBER))
        }
        _ => value.mismatch(list, "write for example [[0, 0, 1]] for one axis along z"),
    }
}

/// Reads a stiffness or damping: one value for all `count` axes, one per axis, or a matrix.
fn coefficient(value: &Value<'_>, dimension: Dimension, count: usize) -> Option<HingeCoefficient> {
    let Some(items) = value.items() else {
        return value.non_negative(dimension).map(|number| HingeCoefficient::PerAxis(vec![number; count]));
    };
    if items.iter().any(Value::is_array) {
        let row = |row: Value<'_>| row.list("a row of numbers", |entry| entry.quantity(dimension));
        return value.list("rows of numbers", row).map(HingeCoefficient::Full);
    }
    value.list("one number per axis", |entry| entry.non_negative(dimension)).map(HingeCoefficient::PerAxis)
}
