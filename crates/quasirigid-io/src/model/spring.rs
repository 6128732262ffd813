//! Spring reader: `[[spring]]`, a spring and dashpot in space, or along the line that joins its ends.
//! Keys of the axial kind are refused on a spatial spring rather than ignored, since a tension that does nothing would mislead.
//! Equations (I9) and (I10), docs/theory/02-invariants.md.

use quasirigid_elements::{Coefficient, ElementKind, End, Prestress, Spring, SpringLaw};

use super::key::{BOOLEAN, Form, Keys, Shape, any, key, quantity, vector};
use super::names::{END, Fixed, Names, Part};
use super::reader::{Keyed, NAME, Naming, Reader};
use super::rheology::{Extremes, RHEOLOGY, Scale, rheology};
use super::table::Table;
use super::value::Value;
use crate::units::Dimension;

pub(super) const READER: Reader = Reader {
    key: "spring",
    title: "[[spring]]",
    meaning: "spring and dashpot",
    keys: Keyed::All(&SPRING),
    kind: Some(ElementKind::Spring),
    naming: Naming::Optional,
    names: |_| Part::Link("spring"),
    aliases: &[],
    nested: &[],
    is_body: false,
    read: |entry, draft| {
        let (spring, range) = spring(entry.table, entry.name, &draft.names)?;
        draft.assembly.springs.push(spring);
        draft.range(ElementKind::Spring, entry, range)
    },
};

/// Stiffness or damping in space.
const COEFFICIENT: Form = any(&[Shape::Number, Shape::Vector, Shape::Matrix]);

const SPRING: Keys = Keys {
    known: &[
        NAME,
        key("from", END, "point, node or place; one end may be `\"carrier\"`"),
        key("to", END, ""),
        key(
            "stiffness",
            COEFFICIENT.in_unit("N/m"),
            "isotropic, along the file's axes, or a symmetric matrix",
        ),
        key("damping", COEFFICIENT.in_unit("N s/m").or("0"), "of a parallel dashpot"),
        RHEOLOGY,
        key("axial", BOOLEAN.or("false"), "along the line of its ends, with a scalar `stiffness`"),
        key("anchor", vector("m"), "end on the carrier, of an axial spring only"),
        key("tension", quantity("N").or("relaxed"), "of an axial spring; pressure is negative"),
        key("natural_length", quantity("m"), "instead of `tension`"),
    ],
};

/// Reads a `[[spring]]`, and the rheology at both ends of its range.
pub(super) fn spring(table: &Table<'_>, name: &str, names: &Names<'_>) -> Option<(Spring, Extremes)> {
    let from = table.read("from", "from = \"tip\"", |value| names.end(&value, Fixed::Link("spring")));
    let to = table.read("to", "to = \"carrier\"", |value| names.end(&value, Fixed::Link("spring")));
    let axial = table.read_or("axial", false, |value| value.boolean());
    let law = axial.and_then(|axial| if axial { along_the_line(table) } else { in_space(table) });
    let known = rheology(table, Scale::OF_SPRING);
    let (from, to) = (from?, to?);
    if from == to {
        let message = "both ends of the spring are the same";
        let help = "a spring joins two points, or a point and the carrier";
        return table.get("to")?.refuse(message, "the same as `from`", help);
    }
    let between_points = from != End::Carrier && to != End::Carrier;
    if let Some(anchor) = table.get("anchor").filter(|_| axial == Some(true) && between_points) {
        let message =
            "`anchor` is the end of an axial spring on the carrier, and this spring joins two points";
        return anchor.refuse(
            message.to_owned(),
            "not for this spring",
            "leave it out, or write \"carrier\" for one end",
        );
    }
    let known = known?;
    Some((Spring { name: name.to_owned(), from, to, law: law?, rheology: known.rheology }, known.extremes))
}

fn in_space(table: &Table<'_>) -> Option<SpringLaw> {
    let stiffness = stiffness(table).and_then(|value| coefficient(&value, Dimension::STIFFNESS));
    let damping = table
        .read_or("damping", Coefficient::Isotropic(0.0), |value| coefficient(&value, Dimension::DAMPING));
    let axial = [
        ("anchor", "the carrier's end"),
        ("tension", "the pull at rest"),
        ("natural_length", "the length without load"),
    ];
    for (key, what) in axial {
        if let Some(value) = table.get(key) {
            let message = format!("`{key}` is {what} of an axial spring, and this spring is not axial");
            let help = "add axial = true, or leave it out";
            return value.refuse(message, "not for this spring", help);
        }
    }
    Some(SpringLaw::Spatial { stiffness: stiffness?, damping: damping? })
}

fn along_the_line(table: &Table<'_>) -> Option<SpringLaw> {
    let stiffness = stiffness(table).and_then(|value| scalar(&value, Dimension::STIFFNESS));
    let damping = table.read_or("damping", 0.0, |value| scalar(&value, Dimension::DAMPING));
    let anchor = table.read_or("anchor", None, |value| value.vector(Dimension::LENGTH).map(Some));
    let prestress = prestress(table);
    Some(SpringLaw::Axial {
        stiffness: stiffness?,
        damping: damping?,
        anchor: anchor?,
        prestress: prestress?,
    })
}

/// Reads the prestress: a tension or a natural length.
fn prestress(table: &Table<'_>) -> Option<Prestress> {
    match (table.get("tension"), table.get("natural_length")) {
        (None, None) => Some(Prestress::Relaxed),
        (Some(tension), None) => tension.quantity(Dimension::FORCE).map(Prestress::Tension),
        (None, Some(length)) => length.positive(Dimension::LENGTH).map(Prestress::NaturalLength),
        (Some(_), Some(length)) => length.refuse(
            "the `natural_length` follows from the `tension`",
            "given twice",
            "leave out one of the two",
        ),
    }
}

fn stiffness<'a>(table: &Table<'a>) -> Option<Value<'a>> {
    table.required("stiffness", "stiffness = 600.0")
}

fn scalar(value: &Value<'_>, dimension: Dimension) -> Option<f64> {
    if value.is_array() {
        let help = "write one number: an axial spring acts only along the line that joins its ends";
        return value.mismatch("one number, since the spring is axial", help);
    }
    value.non_negative(dimension)
}

fn coefficient(value: &Value<'_>, dimension: Dimension) -> Option<Coefficient> {
    let Some(items) = value.items() else {
        return value.non_negative(dimension).map(Coefficient::Isotropic);
    };
    if items.len() != 3 {
        let help = "write k, [kx, ky, kz] or three rows of a symmetric matrix";
        return value.mismatch("a number, 3 numbers or a 3x3 matrix", help);
    }
    if items.iter().any(Value::is_array) {
        return value.matrix(dimension).map(Coefficient::Full);
    }
    value.array("numbers", |item| item.non_negative(dimension)).map(Coefficient::Diagonal)
}
