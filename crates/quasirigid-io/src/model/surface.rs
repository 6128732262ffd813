//! Surface reader: `[[surface]]`, a homogeneous solid inside a closed surface of triangles from a file.
//! The file is read at once and scaled to metres, so that its errors appear at `file` in the model and not in a later run.
//! Equations (G9) and (G10), docs/theory/11-materials.md.

use std::path::Path;

use quasirigid_elements::{ElementKind, Surface};
use quasirigid_mesh::surface::ClosedSurface;

use super::key::{Key, Keys, Shape, TEXT, any, integer, key};
use super::material::Materials;
use super::names::Part;
use super::reader::{Keyed, NAME, Naming, Reader, Sources};
use super::rheology::Extremes;
use super::settings::optional;
use super::table::Table;
use super::value::Value;
use crate::mesh::read_triangles;
use crate::units::Dimension;

pub(super) const READER: Reader = Reader {
    key: "surface",
    title: "[[surface]]",
    meaning: "homogeneous elastic body inside a closed surface",
    keys: Keyed::All(&SURFACE),
    kind: Some(ElementKind::Surface),
    naming: Naming::Numbered("surface"),
    names: |_| Part::Throughout,
    aliases: &[],
    nested: &[],
    is_body: true,
    read: |entry, draft| {
        let Sources { materials, folder, .. } = draft.sources;
        let (surface, range) = surface(entry.table, entry.name, materials, folder)?;
        if entry.table.get("unit").is_none() {
            draft.notes.push(taken_in_metres(&surface));
        }
        draft.assembly.surfaces.push(surface);
        draft.range(ElementKind::Surface, entry, range)
    },
};

/// Unit of the lengths in a file.
pub(super) const UNIT: Key =
    key("unit", any(&[Shape::Text, Shape::Number]).or("`\"m\"`"), "of the file, `\"2.5 cm\"`");

const SURFACE: Keys = Keys {
    known: &[
        NAME,
        key("file", TEXT, "OBJ, STL, PLY, or a plate table of the Planetary Data System"),
        UNIT,
        key("material", TEXT, ""),
        key("degree", integer(1, Surface::MAX_DEGREE as u64).or("as needed"), "of polynomials, (G9)"),
        key(
            "cells",
            integer(1, Surface::MAX_CELLS as u64).or("6000 or 16000"),
            "finite elements, (G11), the default in bodies with necks",
        ),
    ],
};

/// Reads a `[[surface]]` with its file, which is looked for beside the model, and the rheology at both ends of its range.
pub(super) fn surface(
    table: &Table<'_>,
    name: &str,
    materials: &Materials<'_>,
    folder: &Path,
) -> Option<(Surface, Extremes)> {
    let unit = table.read_or("unit", 1.0, |value| unit(&value));
    let degree = optional(table.get("degree"), |value| value.integer(1..=Surface::MAX_DEGREE));
    let cells = optional(table.get("cells"), |value| value.integer(1..=Surface::MAX_CELLS));
    let file = table.required("file", "file = \"shape.obj\"");
    let surface = file.and_then(|value| closed(&value, folder, unit?));
    let (material, extremes) = materials.of(table)?;
    let name = name.to_owned();
    Some((Surface { name, surface: surface?, material, degree: degree?, cells: cells? }, extremes))
}

/// A note on a surface whose unit the model does not say: a shape in kilometres would be a body of metres.
fn taken_in_metres(Surface { name, surface, .. }: &Surface) -> String {
    let [low, high] = surface.bounds();
    let [x, y, z] = [0, 1, 2].map(|axis| high[axis] - low[axis]);
    format!("{name:?} has no `unit`, so that its file is taken in metres: {x:.3} by {y:.3} by {z:.3} m")
}

/// Reads the length of one unit of a file: `"km"` or `"2.5 cm"`.
pub(super) fn unit(value: &Value<'_>) -> Option<f64> {
    unit_of(value, Dimension::LENGTH)
}

/// Reads the size of one unit of a file.
pub(super) fn unit_of(value: &Value<'_>, dimension: Dimension) -> Option<f64> {
    let one = value.words().map(|text| format!("1 {text}"));
    match one.and_then(|text| crate::units::quantity(&text, dimension).ok()) {
        Some(size) if size > 0.0 => Some(size),
        _ => value.positive(dimension),
    }
}

/// Reads a closed surface; errors of its file are reported at its name.
pub(super) fn closed(value: &Value<'_>, folder: &Path, unit: f64) -> Option<ClosedSurface> {
    let path = folder.join(value.text()?);
    let refuse =
        |message: String, label: &str, help: &str| value.refuse(format!("`file`: {message}"), label, help);
    let mesh = match read_triangles(&path) {
        Ok(mesh) => mesh,
        Err(error) => {
            let help = "it is looked for beside the model; OBJ, STL, PLY and plate tables are read";
            return refuse(error.to_string(), "cannot be used", help);
        }
    };
    let vertices = mesh.vertices.into_iter().map(|vertex| vertex.map(|entry| unit * entry)).collect();
    match ClosedSurface::new(vertices, mesh.triangles) {
        Ok(surface) => Some(surface),
        Err(error) => {
            let help = "the surface must close, with every triangle counter-clockwise from outside";
            refuse(error.to_string(), "not the surface of a solid", help)
        }
    }
}
