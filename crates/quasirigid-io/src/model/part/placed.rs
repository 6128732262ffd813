use std::path::Path;

use quasirigid_math::rotation::{ALIGNED, Attitude, to_inertial};
use quasirigid_mesh::Mesh;

use super::super::initial::unit_quaternion;
use super::super::key::{Key, QUATERNION, TEXT, key, vector};
use super::super::surface::unit;
use super::super::table::Table;
use super::super::value::Value;
use crate::mesh::read_mesh;
use crate::units::Dimension;

/// Mesh of a part.
pub(super) const FILE: Key = key("file", TEXT, "gmsh, VTK, Abaqus or CalculiX");
pub(super) const POSITION: Key = key("position", vector("m").or("0"), "origin of the mesh");
pub(super) const ATTITUDE: Key =
    key("attitude", QUATERNION.or("`[1, 0, 0, 0]`"), "from the mesh's axes to the file's");

/// Placement of a mesh in the file's frame.
struct Placement {
    position: [f64; 3],
    /// Rotation from components along the axes of the mesh to those along the file's.
    attitude: Attitude,
}

/// Reads the mesh of a part, in the file's frame; a part without one is told to add a line such as `example`.
pub(super) fn mesh(table: &Table<'_>, folder: &Path, example: &str) -> Option<Mesh> {
    let length = table.read_or("unit", 1.0, |value| unit(&value));
    let placement = placement(table);
    let mesh = table.read("file", example, |value| file(&value, folder));
    let (length, placement, mut mesh) = (length?, placement?, mesh?);
    for node in &mut mesh.nodes {
        *node = placement.of(node.map(|entry| length * entry));
    }
    Some(mesh)
}

/// Places a mesh that is made here in the file's frame.
pub(super) fn placed(table: &Table<'_>, mut mesh: Mesh) -> Option<Mesh> {
    let placement = placement(table)?;
    mesh.nodes.iter_mut().for_each(|node| *node = placement.of(*node));
    Some(mesh)
}

fn placement(table: &Table<'_>) -> Option<Placement> {
    let position = table.vector_or_zero("position", Dimension::LENGTH);
    let attitude = table.read_or("attitude", ALIGNED, |value| unit_quaternion(&value, &mut Vec::new()));
    Some(Placement { position: position?, attitude: attitude? })
}

impl Placement {
    fn of(&self, node: [f64; 3]) -> [f64; 3] {
        let turned = to_inertial(self.attitude, node);
        [0, 1, 2].map(|axis| self.position[axis] + turned[axis])
    }
}

fn file(value: &Value<'_>, folder: &Path) -> Option<Mesh> {
    let path = folder.join(value.text()?);
    match read_mesh(&path) {
        Ok(mesh) => Some(mesh),
        Err(error) => value.refuse(
            format!("`file`: {error}"),
            "cannot be used",
            "it is looked for beside the model; gmsh, VTK and Abaqus or CalculiX meshes are read",
        ),
    }
}
