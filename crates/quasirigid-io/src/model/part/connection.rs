//! Connection reader: `[[connection]]`, a weld, a hinge about one or two axes, or a ball between parts or to the carrier.
//! No axes means a weld: the joint is told by its axes alone, and stiffness and damping have one entry for each.
//! Equations (K1) and (K2), docs/theory/12-structures.md.

use quasirigid_elements::{Anchor, Connection, ElementKind};

use super::super::key::{BOOLEAN, Form, Keys, Shape, any, key};
use super::super::names::{END, Names, Part};
use super::super::reader::{Keyed, Naming, Reader};
use super::super::rheology::{Extremes, RHEOLOGY, Scale, rheology};
use super::super::table::Table;
use super::super::value::Value;
use crate::units::Dimension;

pub(in crate::model) const READER: Reader = Reader {
    key: "connection",
    title: "[[connection]]",
    meaning: "joint of parts",
    keys: Keyed::All(&CONNECTION),
    kind: Some(ElementKind::Connection),
    naming: Naming::Nameless,
    names: |_| Part::Throughout,
    aliases: &[],
    nested: &[],
    is_body: false,
    read: |entry, draft| {
        let (connection, range) = connection(entry.table, &draft.names)?;
        draft.assembly.connections.push(connection);
        draft.range(ElementKind::Connection, entry, range)
    },
};

/// Coefficient for all axes, or one each.
const PER_AXIS: Form = any(&[Shape::Number, Shape::List(&Shape::Number)]);

const CONNECTION: Keys = Keys {
    known: &[
        key("from", END, "`\"carrier\"` or nodes"),
        key("to", END, "same"),
        key(
            "hinge",
            any(&[Shape::Vector, Shape::List(&Shape::Vector)]).or("none"),
            "one axis, or a list of up to three",
        ),
        key("ball", BOOLEAN.or("false"), "about all three axes"),
        key("stiffness", PER_AXIS.in_unit("N m/rad").or("0"), "or one per axis"),
        key("damping", PER_AXIS.in_unit("N m s/rad").or("0"), "or one per axis"),
        RHEOLOGY,
    ],
};

/// Axes of a ball joint.
const BALL: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Reads a `[[connection]]`: a weld, a hinge about one or two axes, or a ball.
pub(in crate::model) fn connection(table: &Table<'_>, names: &Names<'_>) -> Option<(Connection, Extremes)> {
    let side = |key: &'static str, example: &str| table.read(key, example, |value| names.anchor(&value));
    let from = side("from", "from = \"carrier\"");
    let to = side("to", "to = { part = \"boom\", node = \"root\" }");
    let axes = axes(table)?;
    let springs = |key: &'static str, dimension: Dimension| match table.get(key) {
        Some(value) if value.is_array() => {
            value.list("an array of one number per axis", |item| item.non_negative(dimension))
        }
        Some(value) => value.non_negative(dimension).map(|number| vec![number; axes.len()]),
        None => Some(vec![0.0; axes.len()]),
    };
    let stiffness = springs("stiffness", Dimension::ROTATIONAL_STIFFNESS);
    let damping = springs("damping", Dimension::ROTATIONAL_DAMPING);
    let known = rheology(table, Scale::OF_SPRING);
    let (from, to, stiffness, damping) = (from?, to?, stiffness?, damping?);
    let known = known?;
    Some((Connection { from, to, axes, stiffness, damping, rheology: known.rheology }, known.extremes))
}

fn axes(table: &Table<'_>) -> Option<Vec<[f64; 3]>> {
    let ball = table.read_or("ball", false, |value| value.boolean())?;
    match table.get("hinge") {
        Some(value) if ball => value.refuse(
            "a ball joint turns about every axis",
            "beside `ball`",
            "leave out one of `hinge` and `ball`",
        ),
        Some(value) => match value.items() {
            Some(items) if items.iter().any(Value::is_array) => {
                value.list("an array of axes", |axis| axis.vector(Dimension::NUMBER))
            }
            _ => value.vector(Dimension::NUMBER).map(|axis| vec![axis]),
        },
        None if ball => Some(BALL.to_vec()),
        None => Some(Vec::new()),
    }
}

impl Names<'_> {
    /// One side of a connection: the carrier, or nodes of a part.
    fn anchor(&self, value: &Value<'_>) -> Option<Anchor> {
        if value.is_table() {
            let (part, nodes) = self.nodes(value)?;
            return Some(Anchor::Nodes { part, nodes });
        }
        if value.is_word("carrier") {
            return Some(Anchor::Carrier);
        }
        let help =
            "write \"carrier\", { part = \"boom\", node = \"root\" } or { part = \"array\", set = \"left\" }";
        value.mismatch("the carrier, or nodes of a part", help)
    }
}
