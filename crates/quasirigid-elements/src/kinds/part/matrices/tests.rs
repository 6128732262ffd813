//! Matrices of our own cells, read back as if another program had written them.
//! Without a `Part`, with which every kind of part would be compiled once more.

use std::collections::HashMap;
use std::sync::Arc;

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::Matrices;
use crate::error::{ElementKind, Field, Problem};
use crate::kinds::part::{ElasticMaterial, NodalMass, Region, Seat, Solid};
use crate::material::Material;
use crate::model::Rheology;
use crate::structure::{Constraint, Node, Structure};
use quasirigid_mesh::{Cell, Mesh, Shape};

/// Corners of two tetrahedra with a common face, away from the origin.
const CORNERS: [[f64; 3]; 5] =
    [[4.0, -3.0, 2.0], [5.3, -2.8, 2.1], [4.2, -1.9, 1.8], [4.1, -3.1, 3.2], [4.6, -2.2, 0.7]];
const EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];

/// Two tetrahedra of ten nodes with bent edges; the corners of such cells have negative lumped masses.
fn solid() -> Solid {
    let mut mesh = Mesh { nodes: CORNERS.to_vec(), ..Mesh::default() };
    let mut middles = HashMap::new();
    for (label, corners) in (1..).zip([[0, 1, 2, 3], [0, 2, 1, 4]]) {
        let mut nodes = corners.to_vec();
        for edge in EDGES {
            let [i, j] = edge.map(|end| corners[end]);
            let middle = *middles.entry([i.min(j), i.max(j)]).or_insert_with(|| {
                let bent = |axis: usize| 0.02 * (mesh.nodes.len() as f64 + 1.7 * axis as f64).sin();
                let place = |axis| 0.5 * (CORNERS[i][axis] + CORNERS[j][axis]) + bent(axis);
                mesh.nodes.push([0, 1, 2].map(place));
                mesh.nodes.len() - 1
            });
            nodes.push(middle);
        }
        mesh.cells.push(Cell { label, shape: Shape::Tet10, nodes: nodes.into() });
    }
    mesh.node_labels = (1..=mesh.nodes.len() as u64).collect();
    let material = Material { density: 2.5, young: 3.0, poisson: 0.3, rheology: Rheology::Elastic };
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let region = Region {
        cells: vec![0, 1],
        name: String::new(),
        material: ElasticMaterial::Isotropic(material),
        axes,
        grading: None,
    };
    Solid { mesh: Arc::new(mesh), regions: vec![region] }
}

/// Seat of the only part.
fn seat() -> Seat {
    Seat { place: ElementKind::Part.at(0), first: 0, rayleigh: [0.0; 2] }
}

/// Structure of the cells.
fn of_cells(solid: &Solid) -> Structure {
    let nodes: Vec<Node> =
        solid.mesh.nodes.iter().map(|place| Node { place: (*place).into(), rotations: false }).collect();
    let constraints = vec![Constraint::Free; nodes.len()];
    let mut structure = Structure { nodes, constraints, ..Structure::default() };
    solid.assemble_into(seat(), &mut structure).expect("a solid");
    structure
}

/// Structure of matrices.
fn of_matrices(given: &Matrices) -> Structure {
    let nodes = given.mass.structure_nodes().collect();
    let mut structure = Structure { nodes, constraints: given.constraints(), ..Structure::default() };
    given.assemble_into(seat(), &mut structure).expect("matrices");
    structure
}

/// Matrices that a program would write of a structure whose nodes have no rotations.
fn exported(structure: &Structure) -> Matrices {
    let count = structure.nodes.len();
    let (mut mass, mut stiffness) = (Vec::new(), Vec::new());
    for element in &structure.elements {
        let row = |dof: usize| 3 * element.nodes()[dof / 3] + dof % 3;
        let entries = |matrix: DMatrix<f64>| {
            let size = matrix.nrows();
            let places = (0..size * size).map(move |place| (place % size, place / size));
            places.map(|(i, j)| (row(i), row(j), matrix[(i, j)])).collect::<Vec<_>>()
        };
        mass.extend(entries(element.mass()));
        stiffness.extend(entries(element.stiffness()));
    }
    Matrices {
        mass: NodalMass {
            nodes: structure.nodes.iter().map(|node| node.place.into()).collect(),
            node_labels: (1..=count as u64).collect(),
            dofs: (0..3 * count).map(|row| (row / 3, row % 3)).collect(),
            entries: mass,
        },
        stiffness,
        damping: Vec::new(),
        rheology: Rheology::Elastic,
    }
}

/// Sums over the lumped masses of a structure: mass and moments of the places, and with two fields over the degrees of freedom of its
/// nodes the sums, moments and products that inertia is made of. (K4)
fn sums(structure: &Structure, dofs: usize, u: &[f64], v: &[f64]) -> Vec<f64> {
    let reference = Vector3::new(1.0, 0.5, -2.0);
    let (mut mass, mut first, mut sum) = (0.0, Vector3::zeros(), Vector3::zeros());
    let (mut second, mut moment, mut product) = (Matrix3::zeros(), Matrix3::zeros(), Matrix3::zeros());
    for element in &structure.elements {
        let of = |field: &[f64]| {
            let own = element.nodes().iter().flat_map(|node| &field[dofs * node..dofs * (node + 1)]);
            DVector::from_iterator(dofs * element.nodes().len(), own.copied())
        };
        let (u, v) = (of(u), of(v));
        for lumped_mass in element.lumped_masses() {
            let (s, one) = (lumped_mass.place_from(reference), lumped_mass.one());
            let (u, v) = (&lumped_mass.shapes * &u, &lumped_mass.shapes * &v);
            mass += lumped_mass.mass * one;
            first += lumped_mass.mass * one * s;
            second += lumped_mass.mass * s * s.transpose();
            sum += lumped_mass.mass * one * v;
            moment += lumped_mass.mass * s * v.transpose();
            product += lumped_mass.mass * u * v.transpose();
        }
    }
    let vectors = [first, sum].into_iter().flat_map(|vector| vector.data.0.concat());
    let matrices = [second, moment, product].into_iter().flat_map(|matrix| matrix.data.0.concat());
    std::iter::once(mass).chain(vectors).chain(matrices).collect()
}

fn field(size: usize, phase: f64) -> Vec<f64> {
    (0..size).map(|row| (1.3 * row as f64 + phase).sin()).collect()
}

/// The mass matrix alone gives every moment of a quadrature over the cells. (K9)
#[test]
fn masses_between_nodes_have_the_moments_of_the_cells() {
    let cells = of_cells(&solid());
    let given = of_matrices(&exported(&cells));
    let (u, v) = (field(3 * cells.nodes.len(), 0.4), field(3 * cells.nodes.len(), 2.0));
    let (found, expected) = (sums(&given, 3, &u, &v), sums(&cells, 3, &u, &v));
    let scale = expected.iter().fold(0.0, |scale: f64, x| scale.max(x.abs()));
    for (number, (found, expected)) in found.iter().zip(&expected).enumerate() {
        assert!((found - expected).abs() < 1e-14 * scale, "sum {number}: {found} {expected}");
    }
    assert!(exported(&cells).mass.entries.iter().any(|(row, column, mass)| row == column && *mass > 0.0));
}

/// A node on a rail: CalculiX leaves out the rows of displacements that it constrains.
#[test]
fn a_node_has_its_mass_whatever_rows_it_has() {
    let given = Matrices {
        mass: NodalMass {
            nodes: vec![[1.0, 2.0, 3.0], [2.0, 0.0, 1.0]],
            node_labels: vec![4, 7],
            dofs: vec![(0, 0), (1, 0), (1, 2)],
            entries: vec![(0, 0, 2.0), (0, 1, 0.5), (1, 0, 0.5), (1, 1, 3.0), (2, 2, 3.0)],
        },
        stiffness: vec![(0, 0, 1.0), (1, 1, 1.0), (2, 2, 1.0)],
        damping: Vec::new(),
        rheology: Rheology::Elastic,
    };
    let structure = of_matrices(&given);
    let found = sums(&structure, 3, &[0.0; 6], &[0.0; 6]);
    let places = [[0.0, 1.5, 5.0], [1.0, -0.5, 3.0]]; // from the reference point
    assert_eq!(found[0], 6.0);
    let first = [0, 1, 2].map(|axis| 2.5 * places[0][axis] + 3.5 * places[1][axis]);
    assert_eq!(found[1..4], first);
}

/// Mass and rotary inertia of one node make a rigid piece.
#[test]
fn a_turning_node_has_its_rotary_inertia() {
    let J = Matrix3::new(3.0, 0.2, -0.1, 0.2, 4.0, 0.3, -0.1, 0.3, 5.0);
    let mut mass: Vec<(usize, usize, f64)> = (0..3).map(|axis| (axis, axis, 2.0)).collect();
    mass.extend((0..9).map(|place| (3 + place % 3, 3 + place / 3, J[(place % 3, place / 3)])));
    let given = Matrices {
        mass: NodalMass {
            nodes: vec![[1.0, 0.5, -2.0]],
            node_labels: vec![1],
            dofs: (0..6).map(|component| (0, component)).collect(),
            entries: mass,
        },
        stiffness: Vec::new(),
        damping: Vec::new(),
        rheology: Rheology::Elastic,
    };
    let structure = of_matrices(&given);
    for (a, b) in (0..9).map(|pair| (pair / 3, pair % 3)) {
        let turn = |axis: usize| DVector::from_fn(6, |row, _| f64::from(u8::from(row == 3 + axis)));
        let found = sums(&structure, 6, turn(a).as_slice(), turn(b).as_slice());
        let product = Matrix3::from_column_slice(&found[25..34]);
        assert!((product.trace() - J[(a, b)]).abs() < 1e-14 * J.amax(), "{a} {b}: {}", product.trace());
    }
}

/// Free cells have no stiffness against rigid motions of the whole; springs to the ground at three nodes give enough, at two they leave a
/// rotation about the line between them. Nodes in a line cannot rotate about it.
#[test]
fn matrices_stand_by_their_own_stiffness() {
    let mut given = exported(&of_cells(&solid()));
    assert!(!given.stands());
    let mut stands = Vec::new();
    for node in [0, 1, 3] {
        given.stiffness.extend((3 * node..3 * node + 3).map(|row| (row, row, 1e-3)));
        stands.push(given.stands());
    }
    assert_eq!(stands, [false, false, true]);
    let line = Matrices {
        mass: NodalMass {
            nodes: vec![[1.0, 2.0, 3.0], [1.0, 2.0, 4.0]],
            node_labels: vec![1, 2],
            dofs: (0..6).map(|row| (row / 3, row % 3)).collect(),
            entries: Vec::new(),
        },
        stiffness: (0..6).map(|row| (row, row, 5.0)).collect(),
        damping: Vec::new(),
        rheology: Rheology::Elastic,
    };
    assert!(line.stands());
}

fn refusal(change: impl Fn(&mut Matrices)) -> (Field, Problem) {
    let mut given = exported(&of_cells(&solid()));
    change(&mut given);
    let error = given.assemble_into(seat(), &mut Structure::default()).expect_err("a refusal");
    (error.field, error.problem)
}

#[test]
fn matrices_of_no_body_are_refused() {
    let (field, problem) = refusal(|given| given.stiffness.push((1, 5, 1e-3)));
    assert_eq!(field, Field::STIFFNESS);
    assert!(matches!(problem, Problem::Lopsided { dofs: [ref row, _], .. } if row == "1.2"), "{problem}");
    let (field, problem) = refusal(|given| given.mass.entries.push((4, 4, -10.0)));
    assert_eq!(field, Field::MASS);
    assert!(matches!(problem, Problem::NegativeDiagonal { ref dof, .. } if dof == "2.2"), "{problem}");
    let (field, problem) = refusal(|given| given.mass.entries.clear());
    assert_eq!((field, problem), (Field::MASS, Problem::NotAMass { value: 0.0 }));
    let (field, problem) = refusal(|given| given.damping.push((0, 0, f64::NAN)));
    assert!(field == Field::DAMPING && matches!(problem, Problem::NotFinite { .. }), "{problem}");
    let (_, problem) = refusal(|given| given.damping.push((0, 99, 1.0)));
    assert_eq!(problem, Problem::NoSuchRow { index: 99, count: 42 });
}
