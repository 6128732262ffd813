//! `shape = "as-observed"`: the shape or the moments of a table are those of the body in rotation, at the initial state.
//! The relaxed body is found in the study, which knows the rotation; here the file is checked for one.

use quasirigid_elements::{Assembly, ObservedShape};

use super::key::{Key, key, words};
use super::table::Table;
use super::{Displacements, Initial, Rotation, ellipsoid, surface};

/// Words of the key.
const WORDS: [&str; 2] = ["relaxed", "as-observed"];

pub(super) const SHAPE: Key = key(
    "shape",
    words(&WORDS).or("`\"relaxed\"`"),
    "`\"as-observed\"`: what is given is that of the body in rotation, at the start",
);

/// Reads whether a shape was observed in rotation.
pub(super) fn observed(table: &Table<'_>) -> Option<bool> {
    table.read_or(SHAPE.name, false, |value| value.choice(&[(WORDS[0], false), (WORDS[1], true)]))
}

/// Refuses a body observed in rotation that has none at the start, or starts relaxed.
pub(super) fn spinning(file: &Table<'_>, assembly: &Assembly, initial: &Initial) -> Option<()> {
    let Some(_): Option<ObservedShape> = assembly.as_observed else { return Some(()) };
    let readers = [&ellipsoid::READER, &surface::READER];
    let tables = readers.iter().flat_map(|reader| file.several(reader.key, reader.title));
    let Some(shape) = tables.filter_map(|table| table.entry(SHAPE.name)).next() else { return Some(()) };
    match initial.rotation {
        None => shape.refuse(
            "`shape`: the shape observed is that of the body in rotation, and the file gives no rotation",
            "no rotation",
            "add angular_velocity, periods or wobble to [initial], or leave `shape` out",
        ),
        Some(Rotation::Spin([0.0, 0.0, 0.0])) => shape.refuse(
            "`shape`: the shape observed is that of the body in rotation, and this body is at rest",
            "no rotation",
            "leave `shape` out: at rest the body has its relaxed shape",
        ),
        Some(_) if matches!(initial.displacements, Displacements::Given { .. }) => shape.refuse(
            "`shape`: the shape observed is that of the body deformed by its spin, and `displacements` let it start otherwise",
            "two shapes at the start",
            "leave `displacements` out of [initial], or `shape` here",
        ),
        Some(_) => Some(()),
    }
}
