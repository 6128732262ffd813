//! Pyramids of five nodes in each format: two tetrahedra of one number, in the sets of the pyramid.
#![allow(clippy::unwrap_used)]

use std::path::Path;

use quasirigid_io::mesh::{VolumeFile, volume_of};

/// Base with its corners at heights that leave it flat, then the top; the second pyramid stands under the same base.
const PLACES: [[f64; 3]; 6] =
    [[0.0, 0.0, 0.0], [2.0, 0.0, 0.2], [2.0, 1.5, 0.5], [0.0, 1.5, 0.3], [0.7, 0.4, 3.0], [1.0, 1.0, -2.0]];
const CELLS: [[usize; 5]; 2] = [[1, 2, 3, 0, 4], [2, 1, 0, 3, 5]];

/// Six times the volume of a tetrahedron, by the determinant.
fn six_volumes(corners: [[f64; 3]; 4]) -> f64 {
    let [a, b, c] = [1, 2, 3].map(|k| [0, 1, 2].map(|axis| corners[k][axis] - corners[0][axis]));
    (0..3).map(|k| a[k] * (b[(k + 1) % 3] * c[(k + 2) % 3] - b[(k + 2) % 3] * c[(k + 1) % 3])).sum()
}

/// A third of the area of the base times the height: by Gauss's theorem over its base of two triangles and its sides.
fn volume(cell: [usize; 5]) -> f64 {
    let [a, b, c, d, top] = cell.map(|node| PLACES[node]);
    let apex = |x, y, z| six_volumes([[10.0, -3.0, 7.0], x, y, z]) / 6.0;
    -(apex(a, c, b) + apex(a, d, c) + apex(a, b, top) + apex(b, c, top) + apex(c, d, top) + apex(d, a, top))
}

fn assert_divided(read: &VolumeFile, set: &str) {
    assert_eq!(read.notes, ["pyramids are two tetrahedra each (2)"]);
    let mesh = &read.mesh;
    let of = |cell: usize| six_volumes([0, 1, 2, 3].map(|k| mesh.nodes[mesh.cells[cell].nodes[k]])) / 6.0;
    assert_eq!(mesh.cells.len(), 4);
    for (number, pair) in [[0, 1], [2, 3]].into_iter().enumerate() {
        let sum = of(pair[0]) + of(pair[1]);
        let expected = volume(CELLS[number]);
        assert!((sum.abs() / expected.abs() - 1.0).abs() < 1e-13, "{sum} and not {expected}");
        assert!(of(pair[0]) * of(pair[1]) > 0.0);
    }
    // the common base is cut on one diagonal
    let diagonal = |cells: [usize; 2]| {
        let [a, b] = cells.map(|cell| &mesh.cells[cell].nodes);
        let mut both: Vec<usize> = a.iter().filter(|node| b.contains(node)).copied().collect();
        both.sort_unstable();
        both.retain(|node| ![4, 5].contains(node));
        both
    };
    assert_eq!(diagonal([0, 1]), diagonal([2, 3]));
    let set = mesh.sets.iter().find(|found| found.name == set).unwrap();
    assert_eq!(set.cells, [0, 1, 2, 3]);
    assert_eq!(mesh.check(), Ok(()));
}

fn nodes(separator: &str, counted: bool) -> String {
    let row = |(number, place): (usize, &[f64; 3])| {
        let numbers = place.map(|x| format!("{x:?}")).join(separator);
        if counted { format!("{number}{separator}{numbers}\n") } else { format!("{numbers}\n") }
    };
    (1..).zip(&PLACES).map(row).collect()
}

fn cell(number: usize, shift: usize, separator: &str) -> String {
    CELLS[number].map(|node| (node + shift).to_string()).join(separator)
}

#[test]
fn pyramids_are_two_tetrahedra_in_each_format() {
    let gmsh = format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 5 \"top\"\n$EndPhysicalNames\n$Nodes\n6\n{}$EndNodes\n\
         $Elements\n2\n1 7 2 5 1 {}\n2 7 2 5 1 {}\n$EndElements\n",
        nodes(" ", true),
        cell(0, 1, " "),
        cell(1, 1, " ")
    );
    assert_divided(&volume_of(Path::new("a.msh"), gmsh.as_bytes()).unwrap(), "top");
    let vtk = format!(
        "# vtk DataFile Version 3.0\nmade\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 double\n{}CELLS 2 12\n5 {}\n5 {}\n\
         CELL_TYPES 2\n14\n14\nCELL_DATA 2\nSCALARS m int 1\nLOOKUP_TABLE default\n7\n7\n",
        nodes(" ", false),
        cell(0, 0, " "),
        cell(1, 0, " ")
    );
    assert_divided(&volume_of(Path::new("a.vtk"), vtk.as_bytes()).unwrap(), "m=7");
    let inp = format!(
        "*PART, NAME=P\n*NODE\n{}*ELEMENT, TYPE=C3D5, ELSET=TOP\n1,{}\n2,{}\n*END PART\n*ASSEMBLY, NAME=A\n\
         *INSTANCE, NAME=I, PART=P\n*END INSTANCE\n*END ASSEMBLY\n",
        nodes(",", true),
        cell(0, 1, ","),
        cell(1, 1, ",")
    );
    assert_divided(&volume_of(Path::new("a.inp"), inp.as_bytes()).unwrap(), "TOP");
}
