//! Patch tests: distorted elements carry constant strain and constant curvature exactly.

use nalgebra::{DMatrix, DVector, Matrix3, Rotation3, Vector2, Vector3};

use super::super::stiffness;
use super::element::laminate;
use super::grid::SHAPES;
use quasirigid_mesh::Shape;

/// The patch of `[@macneal1985]`: four corners, four nodes inside, five quadrilaterals.
const NODES: [[f64; 2]; 8] = [
    [0.0, 0.0],
    [0.24, 0.0],
    [0.24, 0.12],
    [0.0, 0.12],
    [0.04, 0.02],
    [0.18, 0.03],
    [0.16, 0.08],
    [0.08, 0.08],
];
const CELLS: [[usize; 4]; 5] = [[0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7], [4, 5, 6, 7]];

fn cells(shape: Shape) -> Vec<Vec<usize>> {
    let split = |[a, b, c, d]: [usize; 4]| match shape {
        Shape::Quad4 => vec![vec![a, b, c, d]],
        _ => vec![vec![a, b, c], vec![c, d, a]],
    };
    CELLS.into_iter().flat_map(split).collect()
}

/// Patch in a skew plane of space, and the displacements of its nodes by a field in the plane.
fn patch(field: impl Fn(Vector2<f64>) -> [f64; 6]) -> (Vec<Vector3<f64>>, DVector<f64>) {
    let rotation = Rotation3::new(Vector3::new(0.9, -0.4, 1.7));
    let nodes =
        NODES.map(|[x, y]| rotation * Vector3::new(x, y, 0.0) + Vector3::new(0.3, -0.1, 0.2)).to_vec();
    let values = NODES.iter().flat_map(|[x, y]| {
        let [a, b, c, d, e, f] = field(Vector2::new(*x, *y));
        let halves = [Vector3::new(a, b, c), Vector3::new(d, e, f)].map(|half| rotation * half);
        [halves[0].x, halves[0].y, halves[0].z, halves[1].x, halves[1].y, halves[1].z]
    });
    (nodes, DVector::from_iterator(48, values))
}

/// Errors of the inner nodes when the outer ones are displaced, and the energy of the whole per area.
fn solved(shape: Shape, thickness: f64, field: impl Fn(Vector2<f64>) -> [f64; 6]) -> (f64, f64) {
    let (nodes, exact) = patch(field);
    let mut K = DMatrix::zeros(48, 48);
    let reference = Rotation3::new(Vector3::new(0.9, -0.4, 1.7)) * Vector3::x();
    for cell in cells(shape) {
        let places: Vec<_> = cell.iter().map(|index| nodes[*index]).collect();
        let part = stiffness(shape, &places, reference, &laminate(thickness)).unwrap();
        for (i, a) in cell.iter().enumerate() {
            for (j, b) in cell.iter().enumerate() {
                let mut block = K.fixed_view_mut::<6, 6>(6 * a, 6 * b);
                block += part.fixed_view::<6, 6>(6 * i, 6 * j);
            }
        }
    }
    let inner = K.view((24, 24), (24, 24)).into_owned();
    let right = -K.view((24, 0), (24, 24)) * exact.rows(0, 24);
    let found = inner.cholesky().unwrap().solve(&right);
    let error = (found - exact.rows(24, 24)).amax() / exact.amax();
    (error, exact.dot(&(&K * &exact)) / (0.24 * 0.12))
}

/// Any constant gradient, rotation included, with layers that couple it to bending.
#[test]
fn constant_strain_is_carried_exactly() {
    let section = laminate(0.01);
    for shape in SHAPES {
        let field = |p: Vector2<f64>| {
            let (u, v) = (1e-3 * (p.x + 0.5 * p.y), 1e-3 * (0.9 * p.x - 0.7 * p.y));
            [u, v, 0.0, 0.0, 0.0, 0.5e-3 * (0.9 - 0.5)]
        };
        let (error, energy) = solved(shape, 0.01, field);
        let strain: Vector3<f64> = 1e-3 * Vector3::new(1.0, -0.7, 1.4);
        let expected = strain.dot(&(section.A * strain));
        assert!(error < 1e-10, "{shape}: {error:e}");
        assert!((energy / expected - 1.0).abs() < 1e-10, "{shape}: {energy} {expected}");
    }
}

#[test]
fn constant_curvature_is_carried_exactly() {
    for (shape, thickness) in SHAPES.into_iter().flat_map(|shape| [(shape, 0.01), (shape, 0.05)]) {
        let field = |p: Vector2<f64>| {
            let w = 0.5e-3 * (p.x * p.x + 1.3 * p.x * p.y - 0.6 * p.y * p.y);
            let (slope_x, slope_y) = (1e-3 * (p.x + 0.65 * p.y), 1e-3 * (0.65 * p.x - 0.6 * p.y));
            [0.0, 0.0, w, slope_y, -slope_x, 0.0]
        };
        let (error, energy) = solved(shape, thickness, field);
        let curvature: Vector3<f64> = 1e-3 * Vector3::new(-1.0, 0.6, -1.3);
        let D: Matrix3<f64> = laminate(thickness).D;
        let expected = curvature.dot(&(D * curvature));
        assert!(error < 1e-10, "{shape}: {error:e}");
        assert!((energy / expected - 1.0).abs() < 1e-10, "{shape}: {energy} {expected}");
    }
}
