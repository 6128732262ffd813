//! Cells written in every format read as one mesh, and a damaged file is refused by line or byte.

mod abaqus;
mod containers;
mod corpus;
mod gmsh;
mod nastran;
mod pyramids;
mod robustness;
mod tiff;
mod vtk;
mod zoo;

use std::fs;
use std::path::{Path, PathBuf};

use quasirigid_io::mesh::{mesh_of, read_mesh};
use quasirigid_mesh::{Mesh, Set};

/// A file of `tests/data/volume`.
fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/volume").join(name)
}

fn bytes(name: &str) -> Vec<u8> {
    fs::read(path(name)).unwrap()
}

fn mesh(name: &str) -> Mesh {
    read_mesh(&path(name)).unwrap()
}

fn parsed(name: &str, bytes: impl AsRef<[u8]>) -> Mesh {
    mesh_of(Path::new(name), bytes.as_ref()).unwrap()
}

/// Message about a bad file.
fn says(name: &str, bytes: impl AsRef<[u8]>) -> String {
    mesh_of(Path::new(name), bytes.as_ref()).unwrap_err().to_string()
}

/// Message about a text in which something is replaced once.
fn with(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "{from:?} is not in the text");
    says("a", text.replacen(from, to, 1))
}

fn set<'a>(mesh: &'a Mesh, name: &str) -> &'a Set {
    let mut sets = mesh.sets.iter().filter(|set| set.name == name);
    let set = sets.next().unwrap_or_else(|| panic!("no set {name:?}"));
    assert!(sets.next().is_none(), "two sets {name:?}");
    set
}

#[test]
fn what_is_no_mesh_is_refused() {
    insta::assert_snapshot!(says("a.msh", ""), @"a.msh: the file is empty; was its download cut off?");
    insta::assert_snapshot!(says("a.msh", "solid block\n"), @"a.msh: the file is text, which is not a known mesh format; give a .msh file of gmsh, .vtk or .vtu of VTK, .inp of Abaqus or CalculiX, .bdf or .op2 of NASTRAN, .exo of Exodus, .med, or voxels as .npy, .nrrd or .tif");
    insta::assert_snapshot!(says("a.inp", "*HEADING\n*NODE\n1, 0, 0, 0\n"), @"a.inp: the file has no cells; were they left out when it was written, perhaps for lack of physical groups?");
    let folder = tempfile::tempdir().unwrap();
    let problem = |file: &Path| read_mesh(file).unwrap_err().problem.to_string();
    insta::assert_snapshot!(problem(folder.path()), @"this is a folder; give the file of the mesh inside it");
    insta::assert_snapshot!(problem(&folder.path().join("none.msh")), @"entity not found; is the name right, and is the file readable?");
}
