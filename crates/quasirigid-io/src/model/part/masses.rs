use quasirigid_elements::TipMass;

use super::super::body::inertia;
use super::super::key::{Key, Keys, Shape, any, key, list, quantity};
use super::super::names::NODE;
use super::super::table::Table;
use super::super::value::Value;
use super::Nodes;
use crate::units::Dimension;

/// Rigid bodies at nodes of a part.
pub(super) const MASSES: Key = key("masses", list(&Shape::Table(&MASS)).or("none"), "rigid bodies");

const MASS: Keys = Keys {
    known: &[
        key("node", any(NODE), ""),
        key("mass", quantity("kg"), ""),
        key(
            "inertia",
            any(&[Shape::Vector, Shape::Matrix]).in_unit("kg m²").or("0"),
            "about its centre of mass",
        ),
    ],
};

/// Reads the rigid bodies at nodes of a part, none if the table has none.
pub(super) fn masses(table: &Table<'_>, nodes: &Nodes) -> Option<Vec<TipMass>> {
    let Some(value) = table.get("masses") else { return Some(Vec::new()) };
    value.list("an array of tables", |item| mass(&item, nodes))
}

fn mass(value: &Value<'_>, nodes: &Nodes) -> Option<TipMass> {
    if !value.is_table() {
        return value.mismatch("a table", "write { node = \"tip\", mass = 1.2 }");
    }
    let table = value.table("the mass", &MASS)?;
    let node = table.read("node", "node = \"tip\"", |value| nodes.single(&value));
    let mass = table.read("mass", "mass = 1.2", |value| value.positive(Dimension::MASS));
    let inertia = table.read_or("inertia", [[0.0; 3]; 3], |value| inertia(&value));
    Some(TipMass { node: node?, mass: mass?, inertia: inertia? })
}
