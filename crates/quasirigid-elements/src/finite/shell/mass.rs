use nalgebra::{DMatrix, Matrix3, Vector3};

use super::error::ShellError;
use super::plane::Plane;
use super::quad::{R, S, gauss};
use super::section::ShellSection;
use quasirigid_mesh::Shape;

/// Mass (kg, kg·m, kg·m²), consistent with `u + θ × z n` where `u` and `θ` are linear or bilinear between the nodes:
///
/// ```text
/// T = ½ ∫ m u̇² + 2 s u̇·(θ̇ × n) + I |θ̇ × n|² dA
/// ```
///
/// on the surface through the nodes, warped as it is. A rotation about the normal has no mass.
///
/// # Errors
/// A shape that is no shell, or nodes between which no element is possible.
pub(crate) fn mass(
    shape: Shape,
    nodes: &[Vector3<f64>],
    section: &ShellSection,
) -> Result<DMatrix<f64>, ShellError> {
    // Any direction along the surface would do.
    Plane::new(shape, nodes, nodes.first().zip(nodes.get(1)).map_or(Vector3::x(), |(a, b)| b - a))?;
    let mut mass = DMatrix::zeros(6 * nodes.len(), 6 * nodes.len());
    for point in points(shape, nodes) {
        let across = point.normal.cross_matrix();
        // θ × n = −n × θ
        let blocks = [
            (0, 0, section.mass * Matrix3::identity()),
            (0, 3, -section.first * across),
            (3, 0, section.first * across),
            (3, 3, -section.second * across * across),
        ];
        for (i, j) in (0..nodes.len()).flat_map(|i| (0..nodes.len()).map(move |j| (i, j))) {
            let share = point.area * point.shares[i] * point.shares[j];
            for (row, column, block) in &blocks {
                let mut part = mass.fixed_view_mut::<3, 3>(6 * i + row, 6 * j + column);
                part += share * block;
            }
        }
    }
    Ok(mass)
}

/// A point of a surface that stands for an area (m²), with the values of the shape functions there.
pub(super) struct Point {
    pub area: f64,
    pub normal: Vector3<f64>,
    pub shares: Vec<f64>,
}

/// Quadrature points: middles of the sides of a triangle, four Gauss points of a quadrilateral; exact for products of two shape functions.
pub(super) fn points(shape: Shape, nodes: &[Vector3<f64>]) -> Vec<Point> {
    let point = |tangents: [Vector3<f64>; 2], part: f64, shares: Vec<f64>| {
        let area = tangents[0].cross(&tangents[1]);
        Point { area: part * area.norm(), normal: area.normalize(), shares }
    };
    if shape == Shape::Triangle3 {
        let sides = [nodes[1] - nodes[0], nodes[2] - nodes[0]];
        let middle = |i: usize| (0..3).map(|node| if node == i { 0.0 } else { 0.5 }).collect();
        return (0..3).map(|i| point(sides, 1.0 / 6.0, middle(i))).collect();
    }
    let gauss_point = |[r, s]: [f64; 2]| {
        let sum = |factor: &dyn Fn(usize) -> f64| -> Vector3<f64> {
            (0..4).map(|i| 0.25 * factor(i) * nodes[i]).sum()
        };
        let tangents = [sum(&|i| R[i] * (1.0 + S[i] * s)), sum(&|i| S[i] * (1.0 + R[i] * r))];
        let shares = (0..4).map(|i| 0.25 * (1.0 + R[i] * r) * (1.0 + S[i] * s)).collect();
        point(tangents, 1.0, shares)
    };
    gauss().map(gauss_point).into()
}
