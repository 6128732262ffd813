//! One cell of each shape, by gmsh and VTK from their own reference cells (see `tests/data/volume/write.py`).

use quasirigid_mesh::{Cell, Mesh, Shape};

use super::{mesh, parsed, path, set};

const LINES: [Shape; 2] = [Shape::Line2, Shape::Line3];
const FACES: [Shape; 5] = [Shape::Triangle3, Shape::Triangle6, Shape::Quad4, Shape::Quad8, Shape::Quad9];
const LEFT: [Shape; 3] = [Shape::Tet4, Shape::Wedge6, Shape::Hex8];
const RIGHT: [Shape; 4] = [Shape::Tet10, Shape::Wedge15, Shape::Hex20, Shape::Hex27];

/// Shapes in the order in which the cells stand in space.
fn in_space() -> Vec<Shape> {
    [&LINES[..], &FACES, &LEFT, &RIGHT].concat()
}

const MAP: [[f64; 3]; 3] = [[0.9, -0.2, 0.1], [0.3, 0.8, -0.15], [-0.05, 0.25, 1.1]];
const ORIGIN: [f64; 3] = [-3.0, 0.7, 11.0];
const STEP: [f64; 3] = [2.5, 0.5, -0.25];

/// The determinant of the map: a₁·(a₂×a₃) of its rows, worked out by hand.
const VOLUME: f64 =
    0.9 * (0.8 * 1.1 + 0.15 * 0.25) + 0.2 * (0.3 * 1.1 - 0.15 * 0.05) + 0.1 * (0.3 * 0.25 + 0.8 * 0.05);

pub const GMSH: [&str; 5] =
    ["zoo-2.2-text.msh", "zoo-2.2-binary.msh", "zoo-4.0-text.msh", "zoo-4.1-text.msh", "zoo-4.1-binary.msh"];
pub const VTK: [&str; 11] = [
    "zoo-4.2-text.vtk",
    "zoo-4.2-binary.vtk",
    "zoo-5.1-text.vtk",
    "zoo-5.1-binary.vtk",
    "zoo-text.vtu",
    "zoo-inline.vtu",
    "zoo-inline-zlib.vtu",
    "zoo-raw.vtu",
    "zoo-raw-zlib.vtu",
    "zoo-base64.vtu",
    "zoo-base64-zlib.vtu",
];

pub const CONTAINERS: [&str; 4] = ["zoo-2.exo", "zoo-4.exo", "zoo-5.exo", "zoo.med"];

type Corners = &'static [[f64; 3]];
type Edges = &'static [[usize; 2]];

/// Reference corners and edges, as the docs of [`Shape`] say them.
fn reference(shape: Shape) -> (Corners, Edges) {
    const HEX: Corners = &[
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 1.0],
        [1.0, 1.0, 1.0],
        [0.0, 1.0, 1.0],
    ];
    const WEDGE: Corners = &[
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 1.0],
        [0.0, 1.0, 1.0],
    ];
    match shape {
        Shape::Line2 | Shape::Line3 => (HEX.split_at(2).0, &[[0, 1]]),
        Shape::Triangle3 | Shape::Triangle6 => (WEDGE.split_at(3).0, &[[0, 1], [1, 2], [2, 0]]),
        Shape::Quad4 | Shape::Quad8 | Shape::Quad9 => (HEX.split_at(4).0, &[[0, 1], [1, 2], [2, 3], [3, 0]]),
        Shape::Tet4 | Shape::Tet10 => {
            (WEDGE.split_at(4).0, &[[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]])
        }
        Shape::Wedge6 | Shape::Wedge15 => {
            (WEDGE, &[[0, 1], [1, 2], [2, 0], [3, 4], [4, 5], [5, 3], [0, 3], [1, 4], [2, 5]])
        }
        Shape::Hex8 | Shape::Hex20 | Shape::Hex27 => (
            HEX,
            &[[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]],
        ),
    }
}

/// Corners of the faces −ξ +ξ −η +η −ζ +ζ of a hexahedron.
const HEX_FACES: [[usize; 4]; 6] =
    [[0, 3, 7, 4], [1, 2, 6, 5], [0, 1, 5, 4], [3, 2, 6, 7], [0, 1, 2, 3], [4, 5, 6, 7]];

fn mean(points: impl IntoIterator<Item = [f64; 3]>) -> [f64; 3] {
    let points: Vec<_> = points.into_iter().collect();
    [0, 1, 2].map(|axis| points.iter().map(|point| point[axis]).sum::<f64>() / points.len() as f64)
}

/// Whether two places agree, relative to the size of the zoo: VTK writes 11 digits in a text, gmsh 16.
fn same(a: [f64; 3], b: [f64; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 40.0 * 1e-15)
}

fn assert_cell_is_in_place(mesh: &Mesh, cell: &Cell) {
    let (corners, edges) = reference(cell.shape);
    let number = in_space().iter().position(|shape| *shape == cell.shape).unwrap() as f64;
    let nodes: Vec<[f64; 3]> = cell.nodes.iter().map(|node| mesh.nodes[*node]).collect();
    let mut expected: Vec<[f64; 3]> = corners
        .iter()
        .map(|xi| {
            let mapped = |axis: usize| (0..3).map(|k| MAP[axis][k] * xi[k]).sum::<f64>();
            [0, 1, 2].map(|axis| ORIGIN[axis] + number * STEP[axis] + mapped(axis))
        })
        .collect();
    let corners = expected.clone();
    let middle = |of: &[usize]| mean(of.iter().map(|corner| corners[*corner]));
    if nodes.len() > corners.len() {
        expected.extend(edges.iter().map(|edge| middle(edge)));
    }
    if cell.shape == Shape::Hex27 {
        expected.extend(HEX_FACES.iter().map(|face| middle(face)));
    }
    if matches!(cell.shape, Shape::Hex27 | Shape::Quad9) {
        expected.push(mean(corners.iter().copied()));
    }
    assert_eq!(nodes.len(), expected.len(), "{}", cell.shape);
    for (place, (node, expected)) in nodes.iter().zip(expected).enumerate() {
        assert!(same(*node, expected), "node {place} of a {} is {node:?} and not {expected:?}", cell.shape);
    }
}

/// Shapes of the cells of a set, in the order of [`in_space`].
fn shapes(mesh: &Mesh, name: &str) -> Vec<Shape> {
    let place = |shape: &Shape| in_space().iter().position(|other| other == shape);
    let mut shapes: Vec<Shape> = set(mesh, name).cells.iter().map(|cell| mesh.cells[*cell].shape).collect();
    shapes.sort_by_key(place);
    shapes
}

fn assert_is_zoo(name: &str, mesh: &Mesh) {
    assert_eq!(mesh.nodes.len(), in_space().iter().map(|shape| shape.nodes()).sum::<usize>(), "{name}");
    let mut found: Vec<Shape> = mesh.cells.iter().map(|cell| cell.shape).collect();
    found.sort();
    let mut expected = in_space();
    expected.sort();
    assert_eq!(found, expected, "{name}");
    mesh.cells.iter().for_each(|cell| assert_cell_is_in_place(mesh, cell));
}

#[test]
fn every_shape_comes_in_our_order_from_gmsh() {
    for name in GMSH {
        let mesh = mesh(name);
        assert_is_zoo(name, &mesh);
        assert_eq!(shapes(&mesh, "40"), LINES, "{name}");
        assert_eq!(shapes(&mesh, "face"), FACES, "{name}");
        assert_eq!(shapes(&mesh, "left"), LEFT, "{name}");
        assert_eq!(shapes(&mesh, "right"), RIGHT, "{name}");
        assert_eq!(shapes(&mesh, "all of it"), [LEFT.as_slice(), &RIGHT].concat(), "{name}");
        let tip = set(&mesh, "tip");
        assert!(tip.cells.is_empty() && tip.nodes.len() == 1, "{name}");
        assert!(same(mesh.nodes[tip.nodes[0]], ORIGIN), "{name}");
        assert_eq!(mesh.sets.len(), 6, "{name}");
    }
}

#[test]
fn numbers_of_gmsh_are_kept() {
    let mesh = mesh("zoo-4.1-binary.msh");
    let mut labels = mesh.node_labels.clone();
    labels.sort();
    assert_eq!(labels, (0..125).map(|node| 100 + 3 * node).collect::<Vec<u64>>());
    let hex = mesh.cells.iter().find(|cell| cell.shape == Shape::Hex8).unwrap();
    assert_eq!((hex.label, mesh.node_labels[hex.nodes[0]]), (48, 235)); // as zoo.inp has them
}

#[test]
fn every_shape_comes_in_our_order_from_vtk() {
    for name in VTK {
        let mesh = mesh(name);
        let nodes = mesh.nodes.len() as u64;
        assert_eq!(mesh.node_labels, (0..nodes).collect::<Vec<_>>());
        assert_is_zoo(name, &mesh);
        assert_eq!(shapes(&mesh, "region=-1"), LINES, "{name}");
        assert_eq!(shapes(&mesh, "region=0"), FACES, "{name}");
        assert_eq!(shapes(&mesh, "region=1"), LEFT, "{name}");
        assert_eq!(shapes(&mesh, "region=2"), RIGHT, "{name}");
        assert_eq!(mesh.sets.len(), 4, "{name}"); // none of pairs, reals, values of points, or the vertex
    }
}

#[test]
fn every_shape_comes_in_our_order_from_abaqus() {
    let mesh = mesh("zoo.inp");
    assert_is_zoo("zoo.inp", &mesh);
    assert_eq!(shapes(&mesh, "PhysicalLine40"), LINES);
    assert_eq!(shapes(&mesh, "face"), FACES);
    assert_eq!(shapes(&mesh, "right"), RIGHT);
    assert_eq!(shapes(&mesh, "left"), LEFT);
    assert_eq!(shapes(&mesh, "all_of_it"), [LEFT.as_slice(), &RIGHT].concat());
    assert_eq!(shapes(&mesh, "Volume22"), [Shape::Hex20]);
}

#[test]
fn every_shape_comes_in_our_order_from_exodus() {
    for name in &CONTAINERS[..3] {
        let mesh = mesh(name);
        assert_is_zoo(name, &mesh);
        assert_eq!(mesh.node_labels, (0..125).map(|node| 100 + 3 * node).collect::<Vec<u64>>(), "{name}");
        assert_eq!(shapes(&mesh, "left"), LEFT, "{name}");
        assert_eq!(shapes(&mesh, "23"), [Shape::Hex27], "{name}: by number");
        let label = |set: &str| -> Vec<u64> {
            super::set(&mesh, set).nodes.iter().map(|node| mesh.node_labels[*node]).collect()
        };
        assert_eq!([label("tip"), label("ns8")], [vec![100, 106], vec![103_u64]], "{name}");
        assert_eq!(mesh.sets.len(), 14, "{name}"); // twelve of blocks, since three share one name
    }
}

#[test]
fn every_shape_comes_in_our_order_from_med() {
    let mesh = mesh("zoo.med");
    assert_is_zoo("zoo.med", &mesh);
    assert_eq!(mesh.node_labels, (0..125).map(|node| 100 + 3 * node).collect::<Vec<u64>>());
    for (name, expected) in [("edge", &LINES[..]), ("face", &FACES), ("left", &LEFT), ("right", &RIGHT)] {
        assert_eq!(shapes(&mesh, name), expected);
    }
    assert_eq!(shapes(&mesh, "all of it"), in_space());
    assert_eq!((&set(&mesh, "tip").nodes[..], mesh.sets.len()), (&[0, 1][..], 6));
}

#[test]
fn pieces_count_on() {
    let text = std::fs::read_to_string(path("zoo-text.vtu")).unwrap();
    let (start, end) = (text.find("<Piece").unwrap(), text.find("</Piece>").unwrap() + "</Piece>".len());
    let mesh = parsed("two.vtu", format!("{}{}", &text[..end], &text[start..]));
    assert_eq!((mesh.nodes.len(), mesh.cells.len()), (2 * 125, 2 * 14));
    mesh.cells.iter().for_each(|cell| assert_cell_is_in_place(&mesh, cell));
    assert!(mesh.cells.iter().all(|cell| cell.nodes.iter().all(|node| (*node >= 125) == (cell.label >= 15))));
    assert_eq!(set(&mesh, "region=1").cells, [7, 8, 9, 21, 22, 23]);
    let labels: Vec<u64> = mesh.cells.iter().map(|cell| cell.label).collect();
    assert_eq!(labels, (0..14).chain(15..29).collect::<Vec<_>>()); // the vertices are counted
}

/// Six times the volume of a tetrahedron.
fn six_volumes(mesh: &Mesh, corners: [usize; 4]) -> f64 {
    let [a, b, c, d] = corners.map(|corner| mesh.nodes[corner]);
    let [u, v, w] = [b, c, d].map(|to| [0, 1, 2].map(|axis| to[axis] - a[axis]));
    let cross = [v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]];
    (0..3).map(|axis| u[axis] * cross[axis]).sum()
}

/// Volume of a solid with plane faces, from tetrahedra about its first corner.
fn volume(mesh: &Mesh, cell: &Cell) -> f64 {
    let tetrahedra: &[[usize; 4]] = match cell.shape.corners() {
        4 => &[[0, 1, 2, 3]],
        6 => &[[0, 1, 2, 5], [0, 1, 5, 4], [0, 4, 5, 3]],
        _ => &[[0, 1, 2, 6], [0, 2, 3, 6], [0, 3, 7, 6], [0, 7, 4, 6], [0, 4, 5, 6], [0, 5, 1, 6]],
    };
    tetrahedra.iter().map(|corners| six_volumes(mesh, corners.map(|corner| cell.nodes[corner])) / 6.0).sum()
}

#[test]
fn solids_have_the_volume_of_their_reference_cells() {
    for name in GMSH.iter().chain(&VTK).chain(&CONTAINERS).chain(&["zoo.inp"]) {
        let mesh = mesh(name);
        for cell in mesh.cells.iter().filter(|cell| cell.shape.dimension() == 3) {
            let part =
                [(4, 1.0 / 6.0), (6, 0.5), (8, 1.0)].into_iter().find(|part| part.0 == cell.shape.corners());
            let expected = part.unwrap().1 * VOLUME;
            assert!((volume(&mesh, cell) - expected).abs() <= 1e-13 * VOLUME, "{name}: {}", cell.shape);
        }
    }
}

/// Two boxes of unit volume that gmsh filled with tetrahedra, as gmsh and meshio write them.
#[test]
fn tetrahedra_of_gmsh_fill_their_boxes() {
    let files = [
        ("block.msh", ["left", "right", "tip face"]),
        ("block-text.msh", ["left", "right", "tip face"]),
        ("block.vtk", ["CellEntityIds=1", "CellEntityIds=2", "CellEntityIds=3"]),
        ("block.inp", ["left", "right", "tip_face"]),
        ("block-meshio.msh", ["left", "right", "tip face"]),
        ("block-meshio.vtk", ["gmsh:physical=1", "gmsh:physical=2", "gmsh:physical=3"]),
        ("block-meshio.vtu", ["gmsh:physical=1", "gmsh:physical=2", "gmsh:physical=3"]),
    ];
    for (name, [left, right, face]) in files {
        let mesh = mesh(name);
        for (region, x) in [(left, 4.5), (right, 5.5)] {
            let solids: Vec<&Cell> = set(&mesh, region).cells.iter().map(|cell| &mesh.cells[*cell]).collect();
            assert!(solids.iter().all(|cell| cell.shape == Shape::Tet10), "{name}");
            let total: f64 = solids.iter().map(|cell| volume(&mesh, cell)).sum();
            assert!((total - 1.0).abs() <= 1e-14, "{name}: {total}"); // 24 sums of exact coordinates
            let corners = solids.iter().flat_map(|cell| &cell.nodes[..4]).map(|node| mesh.nodes[*node]);
            assert!(corners.clone().all(|corner| (corner[0] - x).abs() <= 0.5), "{name}");
        }
        let face = set(&mesh, face).cells.iter().map(|cell| &mesh.cells[*cell]);
        assert!(face.clone().all(|cell| cell.nodes.iter().all(|node| mesh.nodes[*node][0] == 6.0)), "{name}");
        assert!(face.count() >= 2, "{name}");
        for cell in &mesh.cells {
            let edges = reference(cell.shape).1;
            for (edge, middle) in edges.iter().zip(&cell.nodes[cell.shape.corners()..]) {
                let expected = mean(edge.map(|corner| mesh.nodes[cell.nodes[corner]]));
                assert!(same(mesh.nodes[*middle], expected), "{name}: {edge:?} of a {}", cell.shape);
            }
        }
    }
}
