use std::path::Path;

use quasirigid_math::rotation::{ALIGNED, Attitude, to_inertial};
use quasirigid_mesh::Mesh;

use super::super::initial::unit_quaternion;
use super::super::key::{Key, NUMBER, QUATERNION, Shape, TEXT, any, integer, key, quantity, vector};
use super::super::surface::{unit, unit_of};
use super::super::table::Table;
use super::super::value::Value;
use crate::mesh::{DensityRule, VolumeFile, VoxelRule, read_volume_by};
use crate::units::Dimension;

/// Mesh of a part.
pub(super) const FILE: Key = key("file", TEXT, "gmsh, VTK, Abaqus, CalculiX, NASTRAN, Exodus or MED");
pub(super) const POSITION: Key = key("position", vector("m").or("0"), "origin of the mesh");
pub(super) const ATTITUDE: Key =
    key("attitude", QUATERNION.or("`[1, 0, 0, 0]`"), "from the mesh's axes to the file's");

/// Keys of voxels: sides in metres, which win over those of the file.
pub(super) const VOXEL: Key = key(
    "voxel",
    any(&[Shape::Number, Shape::Vector]).in_unit("m"),
    "sides of voxels, where the file has none",
);
pub(super) const THRESHOLD: Key = key("threshold", quantity(""), "value from which a voxel is solid");
pub(super) const DENSITIES: Key = key(
    "densities",
    any(&[Shape::Text, Shape::List(&Shape::Array(2, &Shape::Number))]).in_unit("kg/m³"),
    "of voxels: the unit of their values, or the densities of two grey values or more, straight between and beyond them: \
     `[[0, \"0 g/cm^3\"], [255, \"2.7 g/cm^3\"]]`",
);
pub(super) const EXPONENT: Key = key(
    "stiffness_exponent",
    NUMBER.or("0"),
    "moduli of a voxel are those of the material times this power of its density over the material's",
);
pub(super) const LEAST: Key = key("least_voxels", integer(1, 1 << 28), "smallest part that is kept");

/// Placement of a mesh in the file's frame.
pub(super) struct Placement {
    position: [f64; 3],
    /// Rotation from components along the axes of the mesh to those along the file's.
    attitude: Attitude,
}

/// A mesh in the file's frame, and what was left out or repaired, in words.
pub(super) struct Placed {
    pub mesh: Mesh,
    pub notes: Vec<String>,
    /// Densities (kg/m³) of the cells, where voxels have their own.
    pub densities: Option<Vec<f64>>,
    /// Numbers of the nodes that no cell of the part names.
    pub aside: Vec<u64>,
}

/// Most nodes that a note lists.
const LISTED: usize = 5;

/// Reads the mesh of a part of cells of a dimension, in the file's frame; a part without one is told to add a line such as `example`.
pub(super) fn mesh(table: &Table<'_>, folder: &Path, example: &str, dimension: usize) -> Option<Placed> {
    let length = table.read_or("unit", 1.0, |value| unit(&value));
    let placement = placement(table);
    let rule = rule(table, length);
    let mesh = table.read("file", example, |value| file(&value, folder, &rule?));
    let (length, placement, VolumeFile { mut mesh, mut notes, densities }) = (length?, placement?, mesh?);
    for node in &mut mesh.nodes {
        *node = placement.of(node.map(|entry| length * entry));
    }
    let turned = mesh.turn_right_side_out();
    if turned > 0 {
        notes
            .push(format!("cells inside out are turned, their nodes in the order of their shape ({turned})"));
    }
    let bears = mesh.cells.iter().any(|cell| cell.shape.dimension() == dimension);
    let aside = if bears { mesh.set_aside_unused(dimension) } else { Vec::new() };
    if !aside.is_empty() {
        let first: Vec<String> = aside.iter().take(LISTED).map(u64::to_string).collect();
        let more = if aside.len() > LISTED { ", …" } else { "" };
        let (count, first) = (aside.len(), first.join(", "));
        notes.push(format!(
            "nodes that belong to no cell of the part are kept aside ({count}): {first}{more}"
        ));
    }
    let file = table.get("file").and_then(|value| value.words()).unwrap_or_default();
    let notes = notes.into_iter().map(|note| format!("{file}: {note}")).collect();
    Some(Placed { mesh, notes, densities, aside })
}

/// Places a mesh that is made here in the file's frame.
pub(super) fn placed(table: &Table<'_>, mut mesh: Mesh) -> Option<Mesh> {
    let placement = placement(table)?;
    mesh.nodes.iter_mut().for_each(|node| *node = placement.of(*node));
    Some(mesh)
}

pub(super) fn placement(table: &Table<'_>) -> Option<Placement> {
    let position = table.vector_or_zero("position", Dimension::LENGTH);
    let attitude = table.read_or("attitude", ALIGNED, |value| unit_quaternion(&value, &mut Vec::new()));
    Some(Placement { position: position?, attitude: attitude? })
}

impl Placement {
    /// A direction along the file's axes of one along those of the mesh.
    pub(super) fn turned(&self, vector: [f64; 3]) -> [f64; 3] {
        to_inertial(self.attitude, vector)
    }

    /// A place in the file's frame of one in that of the mesh.
    pub(super) fn of(&self, node: [f64; 3]) -> [f64; 3] {
        let turned = to_inertial(self.attitude, node);
        [0, 1, 2].map(|axis| self.position[axis] + turned[axis])
    }
}

/// What the table says of voxels, with sides in the unit of the file.
fn rule(table: &Table<'_>, unit: Option<f64>) -> Option<VoxelRule> {
    let size = table.read_or("voxel", None, |value| match value.items() {
        Some(_) => value.array("sides", |item| item.positive(Dimension::LENGTH)).map(Some),
        None => value.positive(Dimension::LENGTH).map(|side| Some([side; 3])),
    });
    let threshold = table.read_or("threshold", None, |value| value.quantity(Dimension::NUMBER).map(Some));
    let least = table.read_or("least_voxels", 1, |value| value.integer(1..=1 << 28));
    let density = table.read_or("densities", None, |value| density(&value).map(Some));
    let unit = unit?;
    let size = size?.map(|size: [f64; 3]| size.map(|side| side / unit));
    Some(VoxelRule { size, threshold: threshold?, density: density?, least: least? })
}

/// Reads the unit of densities, or grey values in ascending order with the density of each.
fn density(value: &Value<'_>) -> Option<DensityRule> {
    if value.items().is_none() {
        return unit_of(value, Dimension::DENSITY).map(DensityRule::Unit);
    }
    let pair = |pair: Value<'_>| {
        let [grey, density] = pair.array("a grey value and its density", Some)?;
        let (grey, density) = (grey.quantity(Dimension::NUMBER), density.quantity(Dimension::DENSITY));
        Some([grey?, density?])
    };
    let points = value.list("grey values with their densities", pair)?;
    if points.len() < 2 || !points.array_windows().all(|[a, b]| a[0] < b[0]) {
        let message = "`densities` need two grey values or more, the least first";
        let help = "write for example [[0, 0.0], [255, \"2.7 g/cm^3\"]]";
        return value.refuse(message, "not a scale", help);
    }
    Some(DensityRule::Calibrated(points))
}

fn file(value: &Value<'_>, folder: &Path, rule: &VoxelRule) -> Option<VolumeFile> {
    let path = folder.join(value.text()?);
    match read_volume_by(&path, rule) {
        Ok(mesh) => Some(mesh),
        Err(error) => value.refuse(
            format!("`file`: {error}"),
            "cannot be used",
            "it is looked for beside the model; gmsh, VTK, Abaqus, CalculiX, NASTRAN, Exodus and MED meshes and voxels are read",
        ),
    }
}
