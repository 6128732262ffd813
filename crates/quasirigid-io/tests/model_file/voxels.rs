//! Voxels as solids: sums over voxels, the same cells in another format, and the beam of a formula.

use std::f64::consts::PI;
use std::fmt::Write;
use std::fs;

use quasirigid::reduction;
use quasirigid_io::mesh::read_volume;
use quasirigid_io::model::Model;
use tempfile::TempDir;

use super::same::assert_same;
use super::{ALUMINIUM, located, written};

const SIZES: [usize; 3] = [4, 3, 2];
/// Labels, x fastest: a body of two materials, and a speck at a corner.
const LABELS: [u8; 24] = [1, 1, 0, 0, 1, 2, 0, 0, 1, 1, 1, 0, 2, 2, 0, 0, 2, 0, 0, 0, 2, 2, 0, 1];
/// Edges of a voxel, turned and of three lengths (mm), and the centre of the first.
const EDGES: [[f64; 3]; 3] = [[1.2, 1.6, 0.0], [-2.4, 1.8, 0.0], [0.0, 0.0, 5.0]];
const ORIGIN: [f64; 3] = [30.0, -7.0, 11.0];

fn nrrd() -> String {
    let vectors: Vec<String> = EDGES.iter().map(|[x, y, z]| format!("({x},{y},{z})")).collect();
    let values: Vec<String> = LABELS.iter().map(u8::to_string).collect();
    format!(
        "NRRD0004\n# made here\ntype: uchar\ndimension: 3\nspace: left-posterior-superior\nsizes: 4 3 2\n\
         space directions: {}\nspace origin: ({},{},{})\nencoding: ascii\n\n{}\n",
        vectors.join(" "),
        ORIGIN[0],
        ORIGIN[1],
        ORIGIN[2],
        values.join(" ")
    )
}

const FOAM: &str = "[material.foam]\ndensity = 50\nyoung = \"30 MPa\"\npoisson = 0.1\n";
const MODES: &str = "[reduction]\nmodes = 6\n";

fn solid(lines: &str) -> String {
    format!(
        "{ALUMINIUM}{FOAM}[[solid]]\nname = \"s\"\nunit = \"mm\"\nleast_voxels = 2\n\
        materials = {{ \"value=1\" = \"aluminium\", \"value=2\" = \"foam\" }}\n{lines}{MODES}"
    )
}

fn read(files: &[(&str, String)], text: &str) -> Model {
    written(files, text).unwrap_or_else(|error| panic!("{error}"))
}

/// Mass and inertia are the sums over voxels, each a parallelepiped; the speck is left out.
#[test]
fn the_inertia_is_the_sum_over_voxels() {
    let model = read(&[("a.nrrd", nrrd())], &solid("file = \"a.nrrd\"\n"));
    let body = model.assembly.body().unwrap_or_else(|error| panic!("{}", model.diagnose(&error)));
    let volume = 2.0 * 3.0 * 5.0 * 1e-9;
    let (mut mass, mut first, mut second) = (0.0, [0.0; 3], [[0.0; 3]; 3]);
    for (voxel, label) in LABELS.iter().enumerate().take(23) {
        let of_voxel = volume * [0.0, 2700.0, 50.0][usize::from(*label)];
        let steps = [voxel % SIZES[0], voxel / SIZES[0] % SIZES[1], voxel / 12];
        let centre: [f64; 3] = std::array::from_fn(|k| {
            1e-3 * (ORIGIN[k] + (0..3).map(|axis| steps[axis] as f64 * EDGES[axis][k]).sum::<f64>())
        });
        mass += of_voxel;
        for i in 0..3 {
            first[i] += of_voxel * centre[i];
            for j in 0..3 {
                let own: f64 = (0..3).map(|axis| EDGES[axis][i] * EDGES[axis][j] * 1e-6 / 12.0).sum();
                second[i][j] += of_voxel * (centre[i] * centre[j] + own);
            }
        }
    }
    assert!((body.invariants().mass / mass - 1.0).abs() < 1e-12, "{}", body.invariants().mass);
    let about = |i: usize, j: usize| second[i][j] - first[i] * first[j] / mass;
    let trace: f64 = (0..3).map(|i| about(i, i)).sum();
    for (i, row) in body.inertia().iter().enumerate() {
        for (j, found) in row.iter().enumerate() {
            let expected = if i == j { trace } else { 0.0 } - about(i, j);
            assert!((found - expected).abs() < 1e-11 * trace, "{i}{j}: {found} and not {expected}");
        }
    }
    let notes = model.file_notes.join("\n");
    assert!(notes.contains("2 parts that no face joins, of 12, 1 voxels"), "{notes}");
    assert!(notes.contains("1 parts of fewer than 2 voxels are left out (1 voxels)"), "{notes}");
}

/// The same cells as hexahedra of Abaqus are the same body.
#[test]
fn hexahedra_of_another_format_are_the_same() {
    let folder = TempDir::new().expect("a folder");
    fs::write(folder.path().join("a.nrrd"), nrrd()).expect("a file");
    let mesh = read_volume(&folder.path().join("a.nrrd")).expect("voxels").mesh;
    let mut text = String::from("*NODE\n");
    for (node, [x, y, z]) in (1..).zip(&mesh.nodes) {
        writeln!(text, "{node},{x:?},{y:?},{z:?}").expect("text");
    }
    for label in ["1", "2"] {
        let set = mesh.sets.iter().find(|set| set.name == format!("value={label}")).expect("a set");
        writeln!(text, "*ELEMENT, TYPE=C3D8, ELSET=\"value={label}\"").expect("text");
        for cell in set.cells.iter().filter(|cell| mesh.cells[**cell].label < 24) {
            let nodes: Vec<String> =
                mesh.cells[*cell].nodes.iter().map(|node| (node + 1).to_string()).collect();
            writeln!(text, "{},{}", mesh.cells[*cell].label, nodes.join(",")).expect("text");
        }
    }
    let ours = read(&[("a.nrrd", nrrd())], &solid("file = \"a.nrrd\"\n"));
    let theirs = solid("file = \"a.inp\"\n").replace("least_voxels = 2\n", "");
    assert_same(&ours, &read(&[("a.inp", text)], &theirs), 1e-9);
}

/// Bytes of a NumPy array with its last index fastest.
pub fn npy(descr: &str, shape: [usize; 3], bytes: &[u8]) -> Vec<u8> {
    let header = format!(
        "{{'descr': '{descr}', 'fortran_order': False, 'shape': ({}, {}, {}), }}\n",
        shape[0], shape[1], shape[2]
    );
    let mut all = b"\x93NUMPY\x01\x00".to_vec();
    all.extend((header.len() as u16).to_le_bytes());
    all.extend(header.as_bytes());
    all.extend(bytes);
    all
}

/// A model of voxels in a NumPy array.
fn of_npy(array: &[u8], lines: &str) -> Result<Model, quasirigid_io::model::ModelError> {
    let folder = TempDir::new().expect("a folder");
    fs::write(folder.path().join("a.npy"), array).expect("a file");
    let text =
        format!("{ALUMINIUM}[[solid]]\nname = \"s\"\nfile = \"a.npy\"\nmaterial = \"aluminium\"\n{lines}");
    fs::write(folder.path().join("model.toml"), text).expect("a file");
    Model::read(&folder.path().join("model.toml"))
}

/// A bar of voxels from densities above a threshold bends as Euler and Bernoulli say, within what so few cells resolve.
#[test]
fn a_bar_of_voxels_bends_as_a_beam() {
    let (length, side) = (48_usize, 4_usize);
    // a rim of air around the bar, which is along the second axis
    let mut bytes = Vec::new();
    for x in 0..side + 2 {
        for y in 0..length + 2 {
            for z in 0..side + 2 {
                let inside = (1..=side).contains(&x) && (1..=length).contains(&y) && (1..=side).contains(&z);
                bytes.extend((if inside { 0.8_f32 } else { 0.1 }).to_le_bytes());
            }
        }
    }
    let array = npy("<f4", [side + 2, length + 2, side + 2], &bytes);
    let lines = format!("voxel = \"2.5 mm\"\nthreshold = 0.5\n{MODES}");
    let model = of_npy(&array, &lines).unwrap_or_else(|error| panic!("{error}"));
    let body = model.assembly.body().unwrap_or_else(|error| panic!("{}", model.diagnose(&error)));
    let found = reduction::frequencies(&body).expect("frequencies");
    let (l, h) = (48.0 * 2.5e-3, 4.0 * 2.5e-3);
    // 4.730 = first root of cos x cosh x = 1; E 70 GPa, ρ 2700 kg/m³
    let bending = 4.730_041_f64.powi(2) * (70e9_f64 / 2700.0).sqrt() * h / 12.0_f64.sqrt() / (l * l);
    for found in &found[..2] {
        assert!((found / bending - 1.0).abs() < 0.04, "{found} and not {bending}");
    }
    // stretch: π √(E/ρ) / L
    let stretch = PI * (70e9_f64 / 2700.0).sqrt() / l;
    assert!(found.iter().any(|found| (found / stretch - 1.0).abs() < 0.01), "{found:?} without {stretch}");
    assert!((body.invariants().mass / (2700.0 * l * h * h) - 1.0).abs() < 1e-12);
}

/// What is no voxel, or too little said of it, is refused in words.
#[test]
fn voxels_without_labels_are_refused() {
    let half: Vec<u8> =
        [0.5_f32, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.25].iter().flat_map(|x| x.to_le_bytes()).collect();
    let says = |array: &[u8], lines: &str| located(&of_npy(array, lines).expect_err("a refusal"));
    insta::assert_snapshot!(says(&npy("<f4", [2, 2, 2], &half), ""), @r"
    model.toml:7:8: `file`: a.npy: the value 0.5 is no label; give `threshold`, at and above which a voxel is solid
      it is looked for beside the model; gmsh, VTK, Abaqus, CalculiX, NASTRAN, Exodus and MED meshes and voxels are read
    ");
    insta::assert_snapshot!(says(&npy("|u1", [2, 2, 2], &[0; 8]), ""), @r"
    model.toml:7:8: `file`: a.npy: no voxel is solid; are the labels all 0, or the `threshold` or `least_voxels` too high?
      it is looked for beside the model; gmsh, VTK, Abaqus, CalculiX, NASTRAN, Exodus and MED meshes and voxels are read
    ");
}
