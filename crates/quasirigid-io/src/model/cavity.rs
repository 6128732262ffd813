//! Cavity reader: `[[cavity]]`, a liquid in one of nine shapes, or in a mesh or surface from a file.
//! A surface is filled with a mesh here, since the library takes cells alone; either viscosity is stored as the kinematic one.
//! Theory of the flows: docs/theory/13-inside.md, from (L1) on.

use std::cell::RefCell;
use std::path::Path;

use quasirigid_elements::{Cavity, CavityShape, ElementKind, Regime};
use quasirigid_math::rotation::{ALIGNED, angle, turned};
use quasirigid_math::vec3::{cross, norm, scale};
use quasirigid_mesh::meshing::inside;

use super::initial::unit_quaternion;
use super::key::{
    KIND, Keys, QUATERNION, Shape, TEXT, VECTOR, array, integer, key, pick, quantity, vector, words,
};
use super::kinds::{Kind, kind, of_table, opened, variants};
use super::names::Part;
use super::reader::{Keyed, NAME, Naming, Reader};
use super::surface::{STRICT, UNIT, closed, told, unit};
use super::table::Table;
use crate::mesh::read_mesh;
use crate::record::ShapeFileRecord;
use crate::units::Dimension;

type Read = fn(&Table<'_>, &Source<'_>) -> Option<CavityShape>;

/// Names of the keys of a shape: those of every cavity and its own.
macro_rules! with {
    ($($own:literal),*) => {
        [
            "shape",
            "name",
            $($own,)*
            "center",
            "attitude",
            "density",
            "kinematic_viscosity",
            "dynamic_viscosity",
            "flow",
            "resolution",
            "modes",
        ]
    };
}

static SHAPES: [Kind<Read>; 9] = [
    kind!("[[cavity]]", "shape", "sphere", with!("radius"), "", sphere),
    kind!("[[cavity]]", "shape", "ellipsoid", with!("semi_axes"), "", ellipsoid),
    kind!("[[cavity]]", "shape", "cylinder", with!("axis", "radius", "height"), "", cylinder),
    kind!("[[cavity]]", "shape", "annulus", with!("axis", "radii", "height"), "", annulus),
    kind!("[[cavity]]", "shape", "ring", with!("axis", "radius", "tube_radius"), "", ring),
    kind!("[[cavity]]", "shape", "box", with!("sides"), "", cuboid),
    kind!("[[cavity]]", "shape", "shell", with!("semi_axes", "inner_semi_axes"), "", shell),
    kind!("[[cavity]]", "shape", "mesh", with!("file", "unit"), "tetrahedra", mesh),
    kind!("[[cavity]]", "shape", "surface", with!("file", "unit", "strict"), "closed", surface),
];

/// Keys of a cavity without a shape: those of every shape.
const ANY: Keys = Keys {
    known: &[
        key("shape", KIND, ""),
        NAME,
        key("radius", quantity("m"), ""),
        key("semi_axes", vector("m"), ""),
        key("axis", VECTOR.or("z"), "of revolution"),
        key("height", quantity("m"), ""),
        key("radii", array(2, &Shape::Number).in_unit("m"), "inner, outer"),
        key("tube_radius", quantity("m"), ""),
        key("sides", vector("m"), ""),
        key("inner_semi_axes", vector("m"), ""),
        key("file", TEXT, ""),
        UNIT,
        STRICT,
        key("center", vector("m").or("0"), "middle of the shape, or origin of its file"),
        key("attitude", QUATERNION.or("file's axes"), ""),
        key("density", quantity("kg/m³"), "of the liquid"),
        key("kinematic_viscosity", quantity("m²/s"), "of the liquid"),
        key("dynamic_viscosity", quantity("Pa s"), "instead"),
        key(
            "flow",
            words(&["viscous", "boundary-layer"]).or("`\"viscous\"`"),
            "the second ideal but for a layer at the wall",
        ),
        key(
            "resolution",
            integer(1, MOST_CELLS as u64).or("8; 16"),
            "degree of polynomials, 4 to 24; finite elements across the narrowest width, or the longest side of a surface",
        ),
        key(
            "modes",
            integer(0, 6).or("0"),
            "fast modes; each extends the frequencies eightfold (L11), in a boundary layer sixteenfold (L14)",
        ),
    ],
};
/// Cells across a cavity unless the file gives a number.
const RESOLUTION: usize = 8;
/// Cells across the longest side of the space that a surface encloses.
const RESOLUTION_INSIDE: usize = 16;

/// Words for the flow regime of a liquid.
const REGIMES: [(&str, Regime); 2] =
    [("viscous", Regime::Viscous), ("boundary-layer", Regime::BoundaryLayer)];
/// Most cells across.
const MOST_CELLS: usize = 1000;

/// Folder of the files, and number of cells across.
struct Source<'a> {
    folder: &'a Path,
    resolution: usize,
    /// Name of the cavity.
    name: &'a str,
    /// File of its shape, once it is read.
    file: RefCell<Option<ShapeFileRecord>>,
}

pub(super) const READER: Reader = Reader {
    key: "cavity",
    title: "[[cavity]]",
    meaning: "liquid that fills a cavity",
    keys: Keyed::ByKind {
        any: &ANY,
        kinds: || variants(&SHAPES),
        open: |value| Some(opened(value, "[[cavity]]", "shape", &ANY, &SHAPES)?.0),
        other: |_| None,
    },
    kind: Some(ElementKind::Cavity),
    naming: Naming::Numbered("cavity"),
    names: |_| Part::Inside,
    aliases: &[
        // a radius is three semi-axes, and either viscosity gives the kinematic one
        ("radius", "semi_axes"),
        ("kinematic_viscosity", "viscosity"),
        ("dynamic_viscosity", "viscosity"),
    ],
    nested: &[],
    is_body: false,
    read: |entry, draft| {
        let (cavity, file) = cavity(entry.table, entry.name, draft.sources.folder)?;
        draft.notes.extend(file.iter().flat_map(told));
        draft.shapes.extend(file);
        draft.assembly.cavities.push(cavity);
        Some(())
    },
};

/// Reads a `[[cavity]]`, and the file of its shape if it has one; files stand in the `folder`.
fn cavity(table: &Table<'_>, name: &str, folder: &Path) -> Option<(Cavity, Option<ShapeFileRecord>)> {
    let shape = of_table(table, "shape", &SHAPES)?;
    let usual = if shape.word == "surface" { RESOLUTION_INSIDE } else { RESOLUTION };
    let resolution = table.read_or("resolution", usual, |value| value.integer(1..=MOST_CELLS))?;
    let source = Source { folder, resolution, name, file: RefCell::default() };
    let shape = (shape.read)(table, &source);
    let center = table.vector_or_zero("center", Dimension::LENGTH);
    let attitude = attitude(table);
    let density = table.read("density", "density = 1000.0", |value| value.positive(Dimension::DENSITY));
    let viscosity = viscosity(table, density);
    let regime = table.read_or("flow", Regime::Viscous, |value| value.choice(&REGIMES));
    let modes = table.read_or("modes", 0, |value| value.integer(0..=usize::MAX));
    let cavity = Cavity {
        name: name.to_owned(),
        shape: shape?,
        center: center?,
        attitude: attitude?,
        density: density?,
        viscosity: viscosity?,
        resolution,
        regime: regime?,
        modes: modes?,
    };
    Some((cavity, source.file.take()))
}

/// Kinematic viscosity (m²/s), from the kinematic or the dynamic one.
fn viscosity(table: &Table<'_>, density: Option<f64>) -> Option<f64> {
    match (table.get("kinematic_viscosity"), table.get("dynamic_viscosity")) {
        (Some(_), Some(dynamic)) => {
            let message = "`dynamic_viscosity` beside `kinematic_viscosity`: each follows from the other";
            dynamic.refuse(message, "one of the two", "leave one of them out")
        }
        (None, Some(dynamic)) => Some(dynamic.positive(Dimension::DYNAMIC_VISCOSITY)? / density?),
        _ => table
            .required("kinematic_viscosity", "kinematic_viscosity = \"5 cSt\"")?
            .positive(Dimension::KINEMATIC_VISCOSITY),
    }
}

/// Attitude of the shape: given, or the one that turns z to a given axis.
fn attitude(table: &Table<'_>) -> Option<[f64; 4]> {
    match (table.get("attitude"), table.get("axis")) {
        (Some(_), Some(axis)) => {
            let message = "`axis` beside `attitude`: the attitude determines it";
            axis.refuse(message, "one of the two", "leave one of them out")
        }
        (Some(attitude), None) => unit_quaternion(&attitude, &mut Vec::new()),
        (None, Some(value)) => {
            let axis = value.vector(Dimension::NUMBER)?;
            if axis == [0.0; 3] {
                let help = "write a direction such as [0, 0, 1]; its length does not matter";
                return value.refuse("`axis` has no direction", "no direction", help);
            }
            Some(upright(axis))
        }
        (None, None) => Some(ALIGNED),
    }
}

/// The attitude that turns z to an axis.
fn upright(axis: [f64; 3]) -> [f64; 4] {
    const Z: [f64; 3] = [0.0, 0.0, 1.0];
    let across = cross(Z, axis);
    let about = if norm(across) > 0.0 { scale(norm(across).recip(), across) } else { [1.0, 0.0, 0.0] };
    turned(ALIGNED, scale(angle(Z, axis), about))
}

fn sphere(table: &Table<'_>, _: &Source<'_>) -> Option<CavityShape> {
    let radius = length(table, "radius", "radius = 0.3")?;
    Some(CavityShape::Ellipsoid { semi_axes: [radius; 3] })
}

fn ellipsoid(table: &Table<'_>, _: &Source<'_>) -> Option<CavityShape> {
    Some(CavityShape::Ellipsoid { semi_axes: lengths(table, "semi_axes", "semi_axes = [0.6, 0.45, 0.3]")? })
}

fn cylinder(table: &Table<'_>, _: &Source<'_>) -> Option<CavityShape> {
    let (radius, height) = (length(table, "radius", "radius = 0.2"), length(table, "height", "height = 0.5"));
    Some(CavityShape::Cylinder { radius: radius?, height: height? })
}

fn annulus(table: &Table<'_>, _: &Source<'_>) -> Option<CavityShape> {
    let radii = lengths(table, "radii", "radii = [0.15, 0.2]");
    let height = length(table, "height", "height = 0.05");
    Some(CavityShape::Annulus { radii: radii?, height: height? })
}

fn ring(table: &Table<'_>, _: &Source<'_>) -> Option<CavityShape> {
    let radius = length(table, "radius", "radius = 0.3");
    let tube_radius = length(table, "tube_radius", "tube_radius = \"5 mm\"");
    Some(CavityShape::Ring { radius: radius?, tube_radius: tube_radius? })
}

fn cuboid(table: &Table<'_>, _: &Source<'_>) -> Option<CavityShape> {
    Some(CavityShape::Cuboid { sides: lengths(table, "sides", "sides = [0.4, 0.3, 0.2]")? })
}

fn shell(table: &Table<'_>, _: &Source<'_>) -> Option<CavityShape> {
    let outer = lengths(table, "semi_axes", "semi_axes = [0.6, 0.45, 0.3]");
    let inner = lengths(table, "inner_semi_axes", "inner_semi_axes = [0.5, 0.35, 0.2]");
    Some(CavityShape::Shell { outer: outer?, inner: inner? })
}

fn mesh(table: &Table<'_>, source: &Source<'_>) -> Option<CavityShape> {
    let length = table.read_or("unit", 1.0, |value| unit(&value));
    let value = table.required("file", "file = \"tank.msh\"")?;
    let mut mesh = match read_mesh(&source.folder.join(value.text()?)) {
        Ok(mesh) => mesh,
        Err(error) => return value.refuse(format!("`file`: {error}"), "this file", ""),
    };
    let length = length?;
    mesh.nodes.iter_mut().flatten().for_each(|entry| *entry *= length);
    Some(CavityShape::Mesh(Box::new(mesh)))
}

fn surface(table: &Table<'_>, source: &Source<'_>) -> Option<CavityShape> {
    let (surface, file) = closed(table, source.name, source.folder, "file = \"tank.stl\"")?;
    source.file.replace(Some(file));
    let value = table.get("file")?;
    match inside(&surface, source.resolution) {
        Ok(mesh) => Some(CavityShape::Mesh(Box::new(mesh))),
        Err(error) => value.refuse(format!("`file`: {error}"), "cannot be meshed", ""),
    }
}

fn length(table: &Table<'_>, key: &'static str, example: &str) -> Option<f64> {
    table.read(key, example, |value| value.positive(Dimension::LENGTH))
}

fn lengths<const N: usize>(table: &Table<'_>, key: &'static str, example: &str) -> Option<[f64; N]> {
    table.required(key, example)?.array("numbers", |item| item.positive(Dimension::LENGTH))
}
