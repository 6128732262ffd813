//! Panel reader: `[[panel]]`, a layered shell on a mesh from a file, or on a rectangle that is meshed here.
//! Angles of layers count from `reference`; by default that is the first side of the first cell, so it depends on the mesh.

use std::sync::Arc;

use quasirigid_elements::{Layer, Panel, Part, PartKind};
use quasirigid_math::vec3::{cross, norm};
use quasirigid_mesh::{Cell, Mesh, Set, Shape};

use super::super::key::{self, Keys, TEXT, VECTOR, array, key, list, quantity, table};
use super::super::reader::{NAME, Reader, Sources};
use super::super::rheology::Extremes;
use super::super::surface::UNIT_OF_CELLS;
use super::super::table::Table;
use super::super::value::Value;
use super::placed::{ATTITUDE, FILE, POSITION, Placed, mesh, placed};
use super::{ATTACH, MASSES, Nodes, PARALLEL, RAYLEIGH, Read, attached, masses, rayleigh};
use crate::units::Dimension;

pub(in crate::model) const READER: Reader =
    Reader::of_parts("panel", "[[panel]]", "layered plate or shell", &PANEL, |entry, draft| {
        draft.part(entry, panel(entry.table, entry.name, draft.sources))
    });

const PANEL: Keys = Keys {
    known: &[
        NAME,
        FILE,
        UNIT_OF_CELLS,
        key("rectangle", table(&RECTANGLE), "instead of `file`"),
        POSITION,
        ATTITUDE,
        key("layers", list(&key::Shape::Table(&LAYER)), "lowest first"),
        key("reference", VECTOR.or("first side"), "direction of angle zero"),
        key("offset", quantity("m").or("0"), "height of the layers' middle above the nodes"),
        MASSES,
        ATTACH,
        RAYLEIGH,
    ],
};
const RECTANGLE: Keys = Keys {
    known: &[
        key("sides", array(2, &key::Shape::Vector).in_unit("m"), ""),
        key("cells", array(2, &key::Shape::Integer(1, MOST_CELLS as u64)), "along each side"),
    ],
};
const LAYER: Keys = Keys {
    known: &[
        key("material", TEXT, ""),
        key("thickness", quantity("m"), ""),
        key("angle", quantity("rad").or("0"), ""),
    ],
};

const MOST_CELLS: usize = 1000;

/// Reads a `[[panel]]`: from a file, or a rectangle of a given number of cells.
pub(super) fn panel(table: &Table<'_>, name: &str, sources: Sources<'_, '_>) -> Option<Read> {
    let mesh = match table.get("rectangle") {
        Some(value) => rectangle(&value).and_then(|mesh| placed(table, mesh)).map(|mesh| Placed {
            mesh,
            notes: Vec::new(),
            densities: None,
            aside: Vec::new(),
        }),
        None => {
            let example =
                "rectangle = { sides = [[2, 0, 0], [0, 1, 0]], cells = [8, 4] }, or file = \"wing.msh\"";
            mesh(table, sources.folder, example, 2)
        }
    };
    let layers =
        table.read("layers", "layers = [{ material = \"aluminium\", thickness = \"2 mm\" }]", |value| {
            value.list("an array of layers", |item| layer(&item, sources))
        });
    let reference = table.get("reference").map(|value| value.vector(Dimension::NUMBER));
    let offset = table.read_or("offset", 0.0, |value| value.quantity(Dimension::LENGTH));
    let damping = rayleigh(table);
    let Placed { mesh, notes, aside, .. } = mesh?;
    let nodes = Nodes::of_mesh(&mesh).with_aside(aside);
    let (masses, attached) = (masses(table, &nodes), attached(table, &nodes));
    let reference = reference.unwrap_or_else(|| Some(first_side(&mesh)))?;
    let (layers, extremes): (Vec<Layer>, Vec<Extremes>) = layers?.into_iter().unzip();
    let kind = PartKind::Panel(Panel { mesh: Arc::new(mesh), layers, reference, offset: offset? });
    let part = Part { name: name.to_owned(), kind, masses: masses?, attached: attached?, rayleigh: damping? };
    Some(Read { part, nodes, extremes, notes })
}

fn layer(value: &Value<'_>, sources: Sources<'_, '_>) -> Option<(Layer, Extremes)> {
    if !value.is_table() {
        return value.mismatch("a table", "write { material = \"aluminium\", thickness = \"2 mm\" }");
    }
    let table = value.table("the layer", &LAYER)?;
    let named = table.required("material", "material = \"aluminium\"");
    let material = named.as_ref().and_then(|value| sources.materials.named(value));
    let thickness =
        table.read("thickness", "thickness = \"2 mm\"", |value| value.positive(Dimension::LENGTH));
    let angle = table.read_or("angle", 0.0, |value| value.quantity(Dimension::ANGLE));
    let (material, extremes) = material?;
    let name = named.and_then(|value| value.words().map(str::to_owned)).unwrap_or_default();
    Some((Layer { name, material, thickness: thickness?, angle: angle? }, extremes))
}

/// Direction of the first side of the first cell.
fn first_side(mesh: &Mesh) -> [f64; 3] {
    let cell = mesh.cells.iter().find(|cell| cell.shape.dimension() == 2);
    cell.map_or([1.0, 0.0, 0.0], |cell| {
        let [a, b] = [cell.nodes[0], cell.nodes[1]].map(|node| mesh.nodes[node]);
        [0, 1, 2].map(|axis| b[axis] - a[axis])
    })
}

/// Accepts the sides of a rectangle if they differ in direction.
fn span_a_plane(rectangle: &Table<'_>, sides: [[f64; 3]; 2]) -> Option<[[f64; 3]; 2]> {
    let [first, second] = sides;
    if norm(cross(first, second)) > PARALLEL * norm(first) * norm(second) {
        return Some(sides);
    }
    let help = "write two sides at an angle, such as sides = [[2, 0, 0], [0, 1, 0]]";
    let message = "the sides are parallel, or one has no length";
    rectangle.get("sides")?.refuse(message, "no area", help)
}

/// Bytes that a cell takes at least: an element for each of two materials, and six rows of some ten matrices.
const CELL: f64 = 12_000.0;

/// Meshes a parallelogram with a corner at the origin: its edges are the sets `left`, `right` (at the end of the first side),
/// `bottom` and `top` (at the end of the second), its corners `left bottom` and so on.
fn rectangle(value: &Value<'_>) -> Option<Mesh> {
    if !value.is_table() {
        return value.mismatch("a table", "write { sides = [[2, 0, 0], [0, 1, 0]], cells = [8, 4] }");
    }
    let table = value.table("`rectangle`", &RECTANGLE)?;
    let sides: Option<[[f64; 3]; 2]> = table.read("sides", "sides = [[2, 0, 0], [0, 1, 0]]", |value| {
        value.array("sides", |side| side.vector(Dimension::LENGTH))
    });
    let cells: Option<[usize; 2]> = table.read("cells", "cells = [8, 4]", |value| {
        let cells: [usize; 2] = value.array("numbers", |count| count.integer(1..=MOST_CELLS))?;
        value.room(cells[0] as f64 * cells[1] as f64, CELL).map(|()| cells)
    });
    let ([first, second], [m, n]) = (span_a_plane(&table, sides?)?, cells?);
    let node = |i: usize, j: usize| j * (m + 1) + i;
    let place = |i: usize, j: usize| {
        let (s, t) = (i as f64 / m as f64, j as f64 / n as f64);
        [0, 1, 2].map(|axis| s * first[axis] + t * second[axis])
    };
    let nodes: Vec<[f64; 3]> = (0..=n).flat_map(|j| (0..=m).map(move |i| place(i, j))).collect();
    let corners = (0..n)
        .flat_map(|j| (0..m).map(move |i| [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)]));
    let cells =
        corners.zip(1..).map(|(nodes, label)| Cell { label, shape: Shape::Quad4, nodes: Box::new(nodes) });
    let across = |i: usize| (0..=n).map(|j| node(i, j)).collect::<Vec<_>>();
    let along = |j: usize| (0..=m).map(|i| node(i, j)).collect::<Vec<_>>();
    let sets = [
        ("left", across(0)),
        ("right", across(m)),
        ("bottom", along(0)),
        ("top", along(n)),
        ("left bottom", vec![node(0, 0)]),
        ("right bottom", vec![node(m, 0)]),
        ("left top", vec![node(0, n)]),
        ("right top", vec![node(m, n)]),
    ];
    let sets = sets.into_iter().map(|(name, nodes)| Set { name: name.to_owned(), nodes, cells: Vec::new() });
    let node_labels = (1..=nodes.len() as u64).collect();
    Some(Mesh { nodes, node_labels, cells: cells.collect(), sets: sets.collect() })
}
