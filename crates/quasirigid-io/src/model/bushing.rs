//! Bushing reader: `[[bushing]]`, three translational and three rotational stiffnesses and dampings between two places.
//! One number stands for all three axes; what is left out is zero, so a bushing may resist displacement or rotation alone.
//! Equation (I11), docs/theory/02-invariants.md.

use quasirigid_elements::{Bushing, ElementKind, End};

use super::key::{Form, Keys, Shape, any, array, key, vector};
use super::names::{END, Fixed, Part};
use super::reader::{Draft, Entry, Keyed, NAME, Naming, Reader};
use super::rheology::{Extremes, RHEOLOGY, Scale, rheology};
use super::table::Table;
use crate::units::Dimension;

pub(super) const READER: Reader = Reader {
    key: "bushing",
    title: "[[bushing]]",
    meaning: "elastic mount",
    keys: Keyed::All(&BUSHING),
    kind: Some(ElementKind::Bushing),
    naming: Naming::Optional,
    names: |_| Part::Link("bushing"),
    aliases: &[],
    nested: &[],
    is_body: false,
    read: |entry, draft| {
        let (bushing, range) = bushing(entry, draft)?;
        draft.assembly.bushings.push(bushing);
        draft.range(ElementKind::Bushing, entry, range)
    },
};

/// Coefficient for the three axes, or one each.
const PER_AXIS: Form = any(&[Shape::Number, Shape::Vector]);

const BUSHING: Keys = Keys {
    known: &[
        NAME,
        key("from", END, "as of a spring"),
        key("to", END, "as of a spring"),
        key(
            "center",
            vector("m").or("an end without rotations, else the first that is not the carrier"),
            "elastic centre",
        ),
        key(
            "axes",
            array(2, &Shape::Vector).or("file's"),
            "first axis, and one in the plane of the first two",
        ),
        key("stiffness", PER_AXIS.in_unit("N/m").or("0"), "along each axis"),
        key("rotational_stiffness", PER_AXIS.in_unit("N m/rad").or("0"), "about each axis"),
        key("damping", PER_AXIS.in_unit("N s/m").or("0"), "along each axis"),
        key("rotational_damping", PER_AXIS.in_unit("N m s/rad").or("0"), "about each axis"),
        RHEOLOGY,
    ],
};

/// Axes unless the file chooses others: those of the file.
const ALIGNED: [[f64; 3]; 2] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

/// Reads a `[[bushing]]`, and the rheology at both ends of its range.
fn bushing(entry: &Entry<'_, '_>, draft: &Draft<'_, '_>) -> Option<(Bushing, Extremes)> {
    let table = entry.table;
    let end = |key: &'static str, example: &str| -> Option<End> {
        table.read(key, example, |value| draft.names.end(&value, Fixed::Link("bushing")))
    };
    let (from, to) =
        (end("from", "from = \"carrier\""), end("to", "to = { part = \"boom\", node = \"root\" }"));
    let center = table.read_or("center", None, |value| value.vector(Dimension::LENGTH).map(Some));
    let axes = table.read_or("axes", ALIGNED, |value| {
        value.array("two directions", |axis| axis.vector(Dimension::NUMBER))
    });
    let stiffness = per_axis(table, "stiffness", Dimension::STIFFNESS);
    let rotational_stiffness = per_axis(table, "rotational_stiffness", Dimension::ROTATIONAL_STIFFNESS);
    let damping = per_axis(table, "damping", Dimension::DAMPING);
    let rotational_damping = per_axis(table, "rotational_damping", Dimension::ROTATIONAL_DAMPING);
    let known = rheology(table, Scale::OF_SPRING)?;
    let bushing = Bushing {
        name: entry.name.to_owned(),
        from: from?,
        to: to?,
        center: center?,
        axes: axes?,
        stiffness: stiffness?,
        rotational_stiffness: rotational_stiffness?,
        damping: damping?,
        rotational_damping: rotational_damping?,
        rheology: known.rheology,
    };
    Some((bushing, known.extremes))
}

/// Reads a coefficient: one number for the three axes or one each; none is zero.
fn per_axis(table: &Table<'_>, key: &'static str, dimension: Dimension) -> Option<[f64; 3]> {
    match table.get(key) {
        None => Some([0.0; 3]),
        Some(value) if value.is_array() => value.array("numbers", |item| item.non_negative(dimension)),
        Some(value) => value.non_negative(dimension).map(|number| [number; 3]),
    }
}
