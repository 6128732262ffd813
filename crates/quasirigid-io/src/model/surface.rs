//! Surface reader: `[[surface]]`, a homogeneous solid inside a closed surface of triangles from a file.
//! The file is read at once and scaled to metres, so that its errors appear at `file` in the model and not in a later run.
//! Equations (G9) and (G10), docs/theory/11-materials.md.

use std::path::Path;

use quasirigid_elements::{ElementKind, ObservedShape, Surface};
use quasirigid_mesh::surface::{ClosedSurface, SurfaceError, closing, repaired};

use super::as_observed::{SHAPE, observed};
use super::key::{BOOLEAN, Key, Keys, Shape, TEXT, any, integer, key, words};
use super::material::Materials;
use super::names::Part;
use super::reader::{Keyed, NAME, Naming, Reader, Sources};
use super::rheology::Extremes;
use super::settings::optional;
use super::table::Table;
use super::value::Value;
use crate::mesh::{TriangleMesh, read_triangles};
use crate::record::{RepairRecord, ShapeFileRecord};
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
        let surface = surface(entry.table, entry.name, materials, folder);
        let observed = observed(entry.table);
        let (surface, file, range) = surface?;
        draft.assembly.as_observed =
            draft.assembly.as_observed.or(observed?.then_some(ObservedShape::Surface));
        draft.notes.extend(told(&file));
        draft.shapes.push(file);
        draft.assembly.surfaces.push(surface);
        draft.range(ElementKind::Surface, entry, range)
    },
};

/// Unit of the lengths in a file.
pub(super) const UNIT: Key = key(
    "unit",
    any(&[Shape::Text, Shape::Number]).or("its label's, else `\"m\"`"),
    "of the file, `\"2.5 cm\"`",
);
/// Unit of the lengths in a mesh of cells, which has no label.
pub(super) const UNIT_OF_CELLS: Key =
    key("unit", any(&[Shape::Text, Shape::Number]).or("`\"m\"`"), "of the file, `\"2.5 cm\"`");
/// Whether a file must need no repair.
pub(super) const STRICT: Key = key("strict", BOOLEAN.or("`false`"), "refuses what would be repaired");

/// Whether small holes are closed.
const CLOSE_HOLES: Key =
    key("close_holes", BOOLEAN.or("`false`"), "closes holes by caps of at most 1 % of the surface together");

const SURFACE: Keys = Keys {
    known: &[
        NAME,
        key(
            "file",
            TEXT,
            "OBJ, STL, PLY, OFF, VRML, glTF, VTK, gmsh, or a table of the Planetary Data System",
        ),
        UNIT,
        STRICT,
        CLOSE_HOLES,
        key("parts", words(&["largest"]).or("one"), "of a file with separate bodies"),
        SHAPE,
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
) -> Option<(Surface, ShapeFileRecord, Extremes)> {
    let degree = optional(table.get("degree"), |value| value.integer(1..=Surface::MAX_DEGREE));
    let cells = optional(table.get("cells"), |value| value.integer(1..=Surface::MAX_CELLS));
    let largest = table.get("parts").is_some_and(|value| value.choice(&[("largest", ())]).is_some());
    let shape = closed(table, name, folder, "file = \"shape.obj\"");
    let shape = shape.and_then(|(surface, file)| one_part(table, surface, file, largest));
    let (material, extremes) = materials.of(table)?;
    let (surface, file) = shape?;
    let name = name.to_owned();
    Some((Surface { name, surface, material, degree: degree?, cells: cells? }, file, extremes))
}

/// Separate bodies that a question lists.
const LISTED: usize = 4;

/// The one body of a surface, or its largest; several are a question that names them.
fn one_part(
    table: &Table<'_>,
    surface: ClosedSurface,
    mut file: ShapeFileRecord,
    largest: bool,
) -> Option<(ClosedSurface, ShapeFileRecord)> {
    if surface.bodies() < 2 {
        return Some((surface, file));
    }
    let parts = surface.separated();
    let told = |part: &ClosedSurface| {
        let ([x, y, z], [low, high]) = (size(part), part.bounds());
        let [a, b, c] = [0, 1, 2].map(|axis| 0.5 * (low[axis] + high[axis]));
        format!("{x:.4} by {y:.4} by {z:.4} m near ({a:.4}, {b:.4}, {c:.4}) m")
    };
    if !largest {
        let listed: Vec<String> = parts.iter().take(LISTED).map(told).collect();
        let more = if parts.len() > LISTED { "; …" } else { "" };
        let count = parts.len();
        return table.get("file")?.refuse(
            format!("`file`: it holds {count} bodies that nothing joins: {}{more}", listed.join("; ")),
            "which one?",
            "write `parts = \"largest\"` for the first alone, or give each its own file and join them by a [carrier] and springs; parts \
             that touch in whole facets are one body",
        );
    }
    let left: f64 = parts[1..].iter().map(ClosedSurface::volume).sum();
    file.remarks.push(format!(
        "`parts` takes the largest of {} bodies; the others have {:.2} % of its volume",
        parts.len(),
        100.0 * left / parts[0].volume()
    ));
    let part = parts.into_iter().next()?;
    (file.size, file.volume) = (size(&part), part.volume());
    Some((part, file))
}

/// Sides of the box around a surface.
fn size(surface: &ClosedSurface) -> [f64; 3] {
    let [low, high] = surface.bounds();
    std::array::from_fn(|axis| high[axis] - low[axis])
}

/// Notes on a file that was repaired, on choices its reader made, and on a unit that the model does not say: a shape in kilometres would
/// be a body of metres.
pub(super) fn told(file: &ShapeFileRecord) -> Vec<String> {
    let ShapeFileRecord { name, unit_from, size: [x, y, z], remarks, .. } = file;
    let mut told = Vec::new();
    if unit_from.is_empty() {
        told.push(format!(
            "{name:?} has no `unit`, so that its file is taken in metres: {x:.3} by {y:.3} by {z:.3} m"
        ));
    } else if unit_from != MODEL {
        told.push(format!("{name:?} has its unit from its file ({unit_from}): {x:.6} by {y:.6} by {z:.6} m"));
    }
    if !file.repaired.is_empty() {
        told.push(format!("{name:?}: {:?} was repaired: {}", file.file, file.repaired));
    }
    told.extend(remarks.iter().map(|remark| format!("{name:?}: {:?}: {remark}", file.file)));
    told
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

/// Words for a unit that the model gives.
const MODEL: &str = "the model";

/// Reads a closed surface and what is to tell of its file; errors are reported at its name.
pub(super) fn closed(
    table: &Table<'_>,
    name: &str,
    folder: &Path,
    example: &str,
) -> Option<(ClosedSurface, ShapeFileRecord)> {
    let given = optional(table.get("unit"), |value| unit(&value));
    let strict = table.read_or("strict", false, |value| value.boolean());
    let close = table.read_or("close_holes", false, |value| value.boolean());
    let value = table.required("file", example)?;
    let (given, strict, close) = (given?, strict?, close?);
    let text = value.text()?;
    let refuse =
        |message: String, label: &str, help: &str| value.refuse(format!("`file`: {message}"), label, help);
    let TriangleMesh { mut vertices, triangles, mut remarks, unit: stated } = match read_triangles(
        &folder.join(text),
    ) {
        Ok(mesh) => mesh,
        Err(error) => {
            let help = "it is looked for beside the model; OBJ, STL, PLY, OFF, VRML, glTF, VTK and plate tables are read";
            return refuse(error.to_string(), "cannot be used", help);
        }
    };
    if let (Some(given), Some((stated, words))) = (given, &stated)
        && !(0.999..1.001).contains(&(given / stated))
    {
        remarks.push(format!("`unit` of the model is taken, {given} m, although {words}"));
    }
    let (unit, unit_from) = match (given, stated) {
        (Some(unit), _) => (unit, MODEL.to_owned()),
        (None, Some((unit, words))) => (unit, words),
        (None, None) => (1.0, String::new()),
    };
    vertices.iter_mut().flatten().for_each(|entry| *entry *= unit);
    let counts = [vertices.len(), triangles.len()];
    let repair = if close { closing } else { repaired };
    let (surface, repairs) = match repair(vertices, triangles) {
        Ok(repaired) => repaired,
        Err(error) => {
            let mut help = "the surface must close around one body; corners closer than 1e-5 of its size are merged, facets turned and \
                            copies left out already"
                .to_owned();
            if matches!(error.fault, SurfaceError::Open { .. }) && !close {
                help.push_str("; `close_holes = true` of a [[surface]] closes small holes");
            }
            return refuse(error.to_string(), "not the surface of a solid", &help);
        }
    };
    if strict && !repairs.none() {
        return refuse(
            format!("it needs repair: {repairs}"),
            "`strict` allows none",
            "leave `strict` out to have this done, or mend the file",
        );
    }
    let counted = |(repair, count): (&str, usize)| RepairRecord { repair: repair.into(), count };
    let file = ShapeFileRecord {
        name: name.to_owned(),
        file: text.to_owned(),
        unit,
        unit_from,
        vertices: counts[0],
        triangles: counts[1],
        size: size(&surface),
        volume: surface.volume(),
        repaired: repairs.to_string(),
        repairs: repairs.counts().into_iter().map(counted).collect(),
        merged_within: repairs.within,
        remarks,
        mass: None,
        density: None,
        warnings: Vec::new(),
    };
    Some((surface, file))
}
