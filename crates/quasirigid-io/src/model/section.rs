//! Section reader: `[section.NAME]`, cross-sections of beams by shape or by their constants.
//! Sections have names of their own because many beams share one; a reference to an unknown one suggests the nearest name.

use std::collections::BTreeMap;

use quasirigid_elements::SectionShape;

use super::key::{KIND, Keys, Shape, array, key, pick, quantity};
use super::kinds::{Kind, Variant, kind, opened, variants};
use super::names::suggestion;
use super::table::Table;
use super::value::Value;
use crate::units::Dimension;

/// Keys of a section without a shape: those of every shape.
pub(super) const ANY: Keys = Keys {
    known: &[
        key("shape", KIND, ""),
        key("height", quantity("m"), "along z"),
        key("width", quantity("m"), "along y"),
        key("radius", quantity("m"), "outer"),
        key("thickness", quantity("m"), ""),
        key("web", quantity("m"), "its thickness"),
        key("flange", quantity("m"), "its thickness"),
        key("area", quantity("m²"), ""),
        key("second_y", quantity("m⁴"), "∫z²dA"),
        key("second_z", quantity("m⁴"), "∫y²dA"),
        key("torsion", quantity("m⁴"), ""),
        key("shear_areas", array(2, &Shape::Number).in_unit("m²").or("rigid in shear"), "along y and z"),
    ],
};

/// Documentation of the shapes.
pub(super) fn documented() -> Vec<Variant> {
    variants(&SHAPES)
}

type Read = fn(&Table<'_>) -> Option<SectionShape>;

static SHAPES: [Kind<Read>; 6] = [
    kind!("a section", "shape", "rectangle", ["shape", "height", "width"], "", rectangle),
    kind!("a section", "shape", "circle", ["shape", "radius"], "", circle),
    kind!("a section", "shape", "tube", ["shape", "radius", "thickness"], "", tube),
    kind!("a section", "shape", "box", ["shape", "height", "width", "thickness"], "outer lengths", hollow),
    kind!("a section", "shape", "I", ["shape", "height", "width", "web", "flange"], "", i_beam),
    kind!(
        "a section",
        "shape",
        "general",
        ["shape", "area", "second_y", "second_z", "torsion", "shear_areas"],
        "",
        general
    ),
];

/// The `[section.NAME]` tables of a file.
pub(super) struct Sections<'a> {
    entries: BTreeMap<&'a str, Option<SectionShape>>,
}

impl<'a> Sections<'a> {
    /// Reads every section, also those that no beam has.
    pub(super) fn new(file: &Table<'a>) -> Self {
        let help = "write [section.tube], and its name in place of tube, with its keys below";
        let named = file.named("section", help).into_iter();
        Self { entries: named.map(|value| (value.key(), section(&value))).collect() }
    }

    /// The section with the name that a value gives.
    pub(super) fn named(&self, value: &Value<'_>) -> Option<SectionShape> {
        let name = value.text()?;
        if let Some(section) = self.entries.get(name) {
            return *section;
        }
        let help = match self.entries.len() {
            0 => format!(
                "the file has no sections; add [section.{name}] with shape = \"tube\", radius and thickness"
            ),
            count => suggestion(name, || self.entries.keys().copied(), count),
        };
        value.refuse(format!("there is no section {name:?}"), "unknown section", help)
    }
}

fn section(value: &Value<'_>) -> Option<SectionShape> {
    let (table, shape) = opened(value, "the section", "shape", &ANY, &SHAPES)?;
    (shape.read)(&table)
}

fn length(table: &Table<'_>, key: &'static str) -> Option<f64> {
    table.required(key, &format!("{key} = \"20 mm\"")).and_then(|value| value.positive(Dimension::LENGTH))
}

fn rectangle(table: &Table<'_>) -> Option<SectionShape> {
    let (height, width) = (length(table, "height"), length(table, "width"));
    Some(SectionShape::Rectangle { height: height?, width: width? })
}

fn circle(table: &Table<'_>) -> Option<SectionShape> {
    Some(SectionShape::Circle { radius: length(table, "radius")? })
}

fn tube(table: &Table<'_>) -> Option<SectionShape> {
    let (radius, thickness) = (length(table, "radius"), length(table, "thickness"));
    Some(SectionShape::Tube { radius: radius?, thickness: thickness? })
}

fn hollow(table: &Table<'_>) -> Option<SectionShape> {
    let (height, width, thickness) =
        (length(table, "height"), length(table, "width"), length(table, "thickness"));
    Some(SectionShape::Box { height: height?, width: width?, thickness: thickness? })
}

fn i_beam(table: &Table<'_>) -> Option<SectionShape> {
    let (height, width) = (length(table, "height"), length(table, "width"));
    let (web, flange) = (length(table, "web"), length(table, "flange"));
    Some(SectionShape::IBeam { height: height?, width: width?, web: web?, flange: flange? })
}

fn general(table: &Table<'_>) -> Option<SectionShape> {
    let constant = |key: &'static str, dimension: Dimension, example: &str| {
        table.read(key, example, |value| value.positive(dimension))
    };
    let area = constant("area", Dimension::AREA, "area = \"4 cm^2\"");
    let second_y = constant("second_y", Dimension::SECOND_MOMENT, "second_y = \"12 cm^4\"");
    let second_z = constant("second_z", Dimension::SECOND_MOMENT, "second_z = \"12 cm^4\"");
    let torsion = constant("torsion", Dimension::SECOND_MOMENT, "torsion = \"3 cm^4\"");
    let shear = table.read_or("shear_areas", None, |value| {
        value.array("areas", |area| area.positive(Dimension::AREA)).map(Some)
    });
    Some(SectionShape::General {
        area: area?,
        second_y: second_y?,
        second_z: second_z?,
        torsion: torsion?,
        shear: shear?,
    })
}
