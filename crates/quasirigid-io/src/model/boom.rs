//! Boom reader: `[[boom]]`, a boom whose length is prescribed, or a mass on a rail. (T11)

use quasirigid_elements::{Boom, ElementKind};

use super::formula::{PRESCRIBED, prescribed};
use super::key::{Keys, VECTOR, key, quantity, vector};
use super::names::Part;
use super::reader::{Keyed, NAME, Naming, Reader};
use super::table::Table;
use crate::units::Dimension;

pub(super) const READER: Reader = Reader {
    key: "boom",
    title: "[[boom]]",
    meaning: "boom that is run out, or mass on a rail",
    keys: Keyed::All(&BOOM),
    kind: Some(ElementKind::Boom),
    naming: Naming::Numbered("boom"),
    names: |_| Part::Boom,
    aliases: &[],
    nested: &[],
    is_body: false,
    read: |entry, draft| {
        draft.assembly.booms.push(boom(entry.table, entry.name)?);
        Some(())
    },
};

const BOOM: Keys = Keys {
    known: &[
        NAME,
        key("position", vector("m"), "of the root"),
        key("direction", VECTOR, "from the root to the tip"),
        key("mass", quantity("kg").or("0"), "spread evenly along the length"),
        key("tip_mass", quantity("kg").or("0"), ""),
        key("length", PRESCRIBED.in_unit("m"), "constant, or over time"),
    ],
};

/// Reads a `[[boom]]`.
fn boom(table: &Table<'_>, name: &str) -> Option<Boom> {
    let position = table.read("position", "position = [0.5, 0, 0]", |value| value.vector(Dimension::LENGTH));
    let direction = table.read("direction", "direction = [1, 0, 0]", |value| value.vector(Dimension::NUMBER));
    let mass = table.read_or("mass", 0.0, |value| value.non_negative(Dimension::MASS));
    let tip_mass = table.read_or("tip_mass", 0.0, |value| value.non_negative(Dimension::MASS));
    let length = table.read("length", "length = { formula = \"0.5 + 0.02 * t\" }", |value| {
        prescribed(&value, "`length`", Dimension::LENGTH)
    });
    Some(Boom {
        name: name.to_owned(),
        position: position?,
        direction: direction?,
        mass: mass?,
        tip_mass: tip_mass?,
        length: length?,
    })
}
