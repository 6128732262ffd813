//! Pyramids of 5, 13 and 14 nodes in each format: two tetrahedra of one number, in the sets of the pyramid.
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

/// Edges of a pyramid: its base, then those to its top.
const EDGES: [[usize; 2]; 8] = [[0, 1], [1, 2], [2, 3], [3, 0], [0, 4], [1, 4], [2, 4], [3, 4]];

/// Nodes of two pyramids on one base whose edges have middles a little off, and the cells: corners, base, upright edges, middle of the base.
fn curved() -> (Vec<[f64; 3]>, [Vec<usize>; 2]) {
    let mut nodes = PLACES.to_vec();
    let mut cells = CELLS.map(|cell| cell.to_vec());
    let mut known: Vec<[usize; 2]> = Vec::new();
    for (cell, corners) in cells.iter_mut().zip(CELLS) {
        for edge in EDGES {
            let mut ends = edge.map(|end| corners[end]);
            ends.sort_unstable();
            let at = known.iter().position(|other| *other == ends).unwrap_or_else(|| {
                let bulge = 0.03 * (known.len() as f64 + 1.0).sin();
                nodes.push([0, 1, 2].map(|axis| {
                    0.5 * (PLACES[ends[0]][axis] + PLACES[ends[1]][axis]) + bulge * [0.3, -0.5, 1.0][axis]
                }));
                known.push(ends);
                known.len() - 1
            });
            cell.push(PLACES.len() + at);
        }
    }
    let sum = |range: std::ops::Range<usize>, axis: usize| {
        cells[0][range].iter().map(|node| nodes[*node][axis]).sum::<f64>()
    };
    let middle = [0, 1, 2].map(|axis| 0.5 * sum(5..9, axis) - 0.25 * sum(0..4, axis));
    nodes.push(middle);
    let middle = nodes.len() - 1;
    cells.iter_mut().for_each(|cell| cell.push(middle));
    (nodes, cells)
}

/// Volume of a tetrahedron of ten nodes, by four points of Gauss's rule: its sides are of second order, so that this is exact.
fn curved_volume(nodes: &[[f64; 3]]) -> f64 {
    let (a, b) = (0.138_196_601_125_010_5, 0.585_410_196_624_968_5);
    (0..4)
        .map(|at| {
            let l: [f64; 4] = std::array::from_fn(|k| if k == at { b } else { a });
            let edges = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];
            let slope = |axis: usize, k: usize| -> f64 {
                let of = |corner: usize| {
                    if corner == k {
                        4.0 * l[k] - 1.0
                    } else if corner == 0 {
                        1.0 - 4.0 * l[0]
                    } else {
                        0.0
                    }
                };
                let along = |corner: usize| {
                    if corner == k {
                        1.0
                    } else if corner == 0 {
                        -1.0
                    } else {
                        0.0
                    }
                };
                (0..4).map(|corner| nodes[corner][axis] * of(corner)).sum::<f64>()
                    + (edges.iter().zip(&nodes[4..]))
                        .map(|([i, j], node)| 4.0 * node[axis] * (l[*i] * along(*j) + l[*j] * along(*i)))
                        .sum::<f64>()
            };
            let j: [[f64; 3]; 3] = std::array::from_fn(|axis| std::array::from_fn(|k| slope(axis, k + 1)));
            let det: f64 = (0..3)
                .map(|k| {
                    j[0][k] * (j[1][(k + 1) % 3] * j[2][(k + 2) % 3] - j[1][(k + 2) % 3] * j[2][(k + 1) % 3])
                })
                .sum();
            det / 24.0
        })
        .sum()
}

/// In each format the curved pyramids are the same four tetrahedra, whose nodes are where the edges have their middles, and which share the
/// middle of the base; the volume is that of the same pyramids as NASTRAN's.
#[test]
fn curved_pyramids_are_the_same_tetrahedra_in_each_format() {
    let (nodes, cells) = curved();
    let rows = |separator: &str, counted: bool, count: usize| -> String {
        let row = |(number, place): (usize, &[f64; 3])| {
            let numbers = place.map(|x| format!("{x:?}")).join(separator);
            if counted { format!("{number}{separator}{numbers}\n") } else { format!("{numbers}\n") }
        };
        (1..).zip(&nodes[..count]).map(row).collect()
    };
    let list = |cell: &[usize], shift: usize, separator: &str| {
        cell.iter().map(|node| (node + shift).to_string()).collect::<Vec<_>>().join(separator)
    };
    let without = nodes.len() - 1;
    let grids: String = (1..)
        .zip(&nodes[..without])
        .map(|(number, [x, y, z])| format!("GRID,{number},,{x:.12},{y:.12},{z:.12}\n"))
        .collect();
    let of_nastran = |number: usize| {
        let nodes: Vec<String> = cells[number][..13].iter().map(|node| (node + 1).to_string()).collect();
        format!("CPYRAM,{},7,{}\n,{}\n", number + 1, nodes[..6].join(","), nodes[6..].join(","))
    };
    let bdf = format!("BEGIN BULK\n{grids}{}{}ENDDATA\n", of_nastran(0), of_nastran(1));
    let order = [0, 1, 2, 3, 4, 5, 8, 9, 6, 10, 7, 11, 12, 13];
    let gmsh = |code: u64, count: usize, nodes: usize| {
        let cell = |number: usize| {
            list(&order[..count].iter().map(|place| cells[number][*place]).collect::<Vec<_>>(), 1, " ")
        };
        format!(
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{nodes}\n{}$EndNodes\n$Elements\n2\n1 {code} 2 7 1 {}\n2 {code} 2 7 1 {}\n$EndElements\n",
            rows(" ", true, nodes),
            cell(0),
            cell(1)
        )
    };
    let vtk = format!(
        "# vtk DataFile Version 3.0\nmade\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {without} double\n{}CELLS 2 28\n13 {}\n13 {}\n\
         CELL_TYPES 2\n27\n27\n",
        rows(" ", false, without),
        list(&cells[0][..13], 0, " "),
        list(&cells[1][..13], 0, " ")
    );
    let files = [
        ("a.bdf", bdf),
        ("a.vtk", vtk),
        ("a.msh", gmsh(19, 13, without)),
        ("b.msh", gmsh(14, 14, nodes.len())),
    ];
    let mut volumes = Vec::new();
    for (name, text) in files {
        let mesh = volume_of(Path::new(name), text.as_bytes()).unwrap_or_else(|error| panic!("{error}")).mesh;
        assert_eq!((mesh.cells.len(), mesh.nodes.len()), (4, nodes.len()), "{name}");
        let places = |cell: usize| -> Vec<[f64; 3]> {
            mesh.cells[cell].nodes.iter().map(|node| mesh.nodes[*node]).collect()
        };
        for cell in 0..4 {
            let own = places(cell);
            let same = |a: [f64; 3], b: [f64; 3]| (0..3).all(|axis| (a[axis] - b[axis]).abs() < 1e-11);
            for node in &own {
                let inside = cells[cell / 2].iter().any(|other| same(nodes[*other], *node));
                assert!(inside, "{name}: {node:?}");
            }
            assert!(own.iter().any(|node| same(*node, nodes[without])), "{name}");
        }
        volumes.push([0, 1, 2, 3].map(|cell| curved_volume(&places(cell)).abs()));
        assert_eq!(mesh.check(), Ok(()), "{name}");
    }
    let straight = CELLS.map(|cell| volume(cell).abs());
    for (number, found) in volumes.iter().enumerate() {
        for cell in 0..4 {
            assert!((found[cell] / volumes[0][cell] - 1.0).abs() < 1e-10, "{number}: {found:?}");
        }
        let sum = found[0] + found[1];
        assert!((sum / straight[0] - 1.0).abs() < 0.1 && (sum / straight[0] - 1.0).abs() > 1e-4, "{sum}");
    }
}
