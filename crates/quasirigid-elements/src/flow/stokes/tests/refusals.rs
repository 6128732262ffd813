//! Meshes in which no flow can be found.

use super::super::assembly::Assembly;
use super::super::grid::Grid;
use super::super::{StokesError, StokesFlow};
use super::lattice::{Lattice, block};
use quasirigid_mesh::{Cell, Mesh, MeshFault, Shape};

fn refusal(mesh: &Mesh) -> StokesError {
    StokesFlow::new(mesh).err().unwrap()
}

fn octahedron() -> Mesh {
    Lattice::octahedron(1).straight(&|x| x)
}

/// A cell of so many of the first nodes.
fn cell(shape: Shape) -> Cell {
    Cell { label: 9, shape, nodes: (0..shape.nodes()).collect() }
}

/// Adds a cell of three nodes of the mesh and one of its own.
fn attach(mesh: &mut Mesh, face: [usize; 3], apex: [f64; 3]) {
    mesh.nodes.push(apex);
    mesh.node_labels.push(7000 + mesh.nodes.len() as u64);
    let mut nodes: Box<[usize]> = face.into_iter().chain([mesh.nodes.len() - 1]).collect();
    let places: Vec<[f64; 3]> = nodes.iter().map(|node| mesh.nodes[*node]).collect();
    if Shape::Tet4.volume(&places) < 0.0 {
        nodes.swap(0, 1);
    }
    mesh.cells.push(Cell { label: mesh.nodes.len() as u64, shape: Shape::Tet4, nodes });
}

#[test]
fn faces_lines_and_loose_nodes_do_not_count() {
    let mut mesh = octahedron();
    let flow = StokesFlow::new(&mesh).unwrap();
    mesh.cells.insert(2, cell(Shape::Triangle3));
    mesh.cells.push(cell(Shape::Line2));
    mesh.nodes.push([f64::NAN; 3]);
    mesh.node_labels.push(3);
    let other = StokesFlow::new(&mesh).unwrap();
    assert_eq!((other.moments().volume, other.unknowns()), (flow.moments().volume, flow.unknowns()));
    // The middle, and the middles of the edges from it.
    assert_eq!(flow.unknowns(), 21);
}

#[test]
fn other_cells_are_refused() {
    let mut mesh = octahedron();
    mesh.cells.retain(|cell| cell.shape.dimension() < 3);
    mesh.cells.push(cell(Shape::Triangle3));
    assert_eq!(refusal(&mesh), StokesError::NoTetrahedra);
    mesh.cells.extend([cell(Shape::Wedge6), cell(Shape::Wedge6)]);
    let expected = "cell 9 of the cavity is a wedge of 6 nodes, the first of 2 such cells; liquid needs \
                    tetrahedra of 4 or 10 nodes";
    assert_eq!(refusal(&mesh).to_string(), expected);
}

#[test]
fn cells_that_describe_no_body_are_refused() {
    let mut mesh = octahedron();
    mesh.cells[3].nodes.swap(0, 1);
    let StokesError::Mesh(faults) = refusal(&mesh) else { panic!() };
    assert!(matches!(faults[..], [MeshFault::InsideOut { cell: 1003, wholly: true, .. }]));
    mesh = octahedron();
    let apex = mesh.cells[0].nodes[3];
    mesh.nodes[apex] = mesh.nodes[0];
    assert!(
        matches!(refusal(&mesh), StokesError::Mesh(faults) if matches!(faults[..], [MeshFault::Flat { .. }]))
    );
    mesh.nodes[apex][1] = f64::INFINITY;
    assert!(
        matches!(refusal(&mesh), StokesError::Mesh(faults) if matches!(faults[..], [MeshFault::NotFinite { .. }]))
    );
    mesh.cells[0].nodes[0] = 99;
    assert!(matches!(refusal(&mesh), StokesError::Mesh(faults) if faults.len() == 2));
}

#[test]
fn a_cavity_must_have_room_for_a_flow() {
    let mut mesh = octahedron();
    mesh.cells.truncate(1);
    assert_eq!(refusal(&mesh), StokesError::NoInterior);
}

#[test]
fn cavities_must_hang_together_by_faces() {
    // Opposite octants touch in the middle; of eight, these are the even ones.
    let mut mesh = octahedron();
    let even = |cell: &Cell| {
        let sum = cell.nodes.iter().map(|node| mesh.nodes[*node]).fold([0.0; 3], crate::math::vec3::add);
        sum.iter().product::<f64>() > 0.0
    };
    let cells = mesh.cells.iter().filter(|cell| even(cell)).cloned().collect();
    mesh.cells = cells;
    assert_eq!(refusal(&mesh), StokesError::Pieces { count: 4 });
}

#[test]
fn a_face_has_two_sides() {
    let mut mesh = octahedron();
    let nodes = mesh.cells[0].nodes.clone();
    let outer: Vec<usize> = nodes.iter().copied().filter(|node| mesh.nodes[*node] != [0.0; 3]).collect();
    let [a, b, c] = outer[..] else { panic!() };
    attach(&mut mesh, [a, b, c], [2.0, 1.0, 3.0]);
    assert!(StokesFlow::new(&mesh).is_ok());
    attach(&mut mesh, [a, b, c], [3.0, 2.0, 1.0]);
    let mut corners = [a, b, c].map(|node| mesh.node_labels[node]);
    corners.sort_unstable();
    assert_eq!(refusal(&mesh), StokesError::CrowdedFace { corners, count: 3 });
}

#[test]
fn edges_have_one_middle_and_nodes_one_role() {
    let whole = Lattice::octahedron(1).quadratic(&|_| false, &|x| x);
    assert!(StokesFlow::new(&whole).is_ok());
    let mut torn = whole.clone();
    let middle = torn.cells[0].nodes[5];
    torn.nodes.push(torn.nodes[middle]);
    torn.node_labels.push(5000);
    torn.cells[0].nodes[5] = torn.nodes.len() - 1;
    let refused = refusal(&torn);
    assert!(matches!(refused, StokesError::TornEdge { middles: [5000, _], .. }), "{refused}");
    // The middle of an edge of one cell as the corner of another.
    let mut hanging = whole;
    let [a, b, middle] = [2, 3, 4].map(|k| hanging.cells[0].nodes[k]);
    attach(&mut hanging, [a, b, middle], [5.0, 6.0, 7.0]);
    assert_eq!(refusal(&hanging), StokesError::Hanging { node: hanging.node_labels[middle] });
}

#[test]
fn sizes_beyond_numbers_and_cells_without_thickness_are_refused() {
    for unit in [1e-70, 1e70] {
        let mesh = Lattice::octahedron(1).straight(&|x| x.map(|x| unit * x));
        assert!(matches!(refusal(&mesh), StokesError::OutOfRange { .. }));
    }
}

#[test]
fn cells_without_thickness_have_no_factor() {
    let mut grid = Grid::new(&block(2)).unwrap();
    grid.places.iter_mut().for_each(|x| x[2] *= if x[2].abs() > 0.5 { 1.0 } else { 1e-15 });
    let Err(StokesError::Singular { at }) = Assembly::new(&grid) else { panic!() };
    assert!(at[2].abs() < 0.5, "{at:?}");
}

#[test]
fn loads_beyond_numbers_are_refused() {
    let flow = StokesFlow::new(&block(1)).unwrap();
    let mut load = flow.load(&|x| x);
    load[1] = f64::INFINITY;
    assert!(matches!(flow.solve(&[load], 0.0), Err(StokesError::NoConvergence { iterations: 0, .. })));
}
