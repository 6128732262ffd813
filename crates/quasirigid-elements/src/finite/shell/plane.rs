use nalgebra::{DMatrix, Matrix3, Vector2, Vector3};

use super::error::ShellError;
use quasirigid_mesh::Shape;

/// Plane of an element: that of a triangle, or the one midway between the diagonals of a quadrilateral.
///
/// The origin is the mean of the nodes, its first axis the projection of the reference direction.
pub(super) struct Plane {
    /// Axes as rows: from components along the body's axes to those along the element's.
    axes: Matrix3<f64>,
    /// Places of the nodes in the plane (m).
    pub places: Vec<Vector2<f64>>,
    /// Heights of the nodes over the plane (m).
    pub heights: Vec<f64>,
}

/// Share of a length or area below which it is zero.
const NOTHING: f64 = 1e-9;

impl Plane {
    pub fn new(shape: Shape, nodes: &[Vector3<f64>], reference: Vector3<f64>) -> Result<Self, ShellError> {
        let normal = normal(shape, nodes)?;
        let along = reference - normal * normal.dot(&reference);
        let share = along.norm() / reference.norm();
        if !(share > NOTHING) {
            return Err(ShellError::Reference { share });
        }
        let first = along.normalize();
        let axes =
            Matrix3::from_rows(&[first.transpose(), normal.cross(&first).transpose(), normal.transpose()]);
        let mean: Vector3<f64> = nodes.iter().sum::<Vector3<f64>>() / nodes.len() as f64;
        let local: Vec<Vector3<f64>> = nodes.iter().map(|node| axes * (node - mean)).collect();
        Ok(Self {
            axes,
            places: local.iter().map(|place| place.xy()).collect(),
            heights: local.iter().map(|place| place.z).collect(),
        })
    }

    /// Rotation of the displacements of the nodes into the axes of the element.
    pub fn turn(&self) -> DMatrix<f64> {
        let mut turn = DMatrix::zeros(6 * self.places.len(), 6 * self.places.len());
        for at in (0..turn.nrows()).step_by(3) {
            turn.fixed_view_mut::<3, 3>(at, at).copy_from(&self.axes);
        }
        turn
    }
}

/// The unit normal of a cell.
fn normal(shape: Shape, nodes: &[Vector3<f64>]) -> Result<Vector3<f64>, ShellError> {
    if nodes.len() != shape.nodes() {
        return Err(ShellError::Nodes { shape, found: nodes.len() });
    }
    let twice = match (shape, nodes) {
        (Shape::Triangle3, [a, b, c]) => (b - a).cross(&(c - a)),
        (Shape::Quad4, [a, b, c, d]) => (c - a).cross(&(d - b)),
        _ => return Err(ShellError::Shape { shape }),
    };
    let sides = (0..nodes.len()).map(|i| (nodes[i] - nodes[(i + 1) % nodes.len()]).norm());
    let (side, area) = (sides.fold(0.0, f64::max), 0.5 * twice.norm());
    // A needle 10⁻⁹ wide is refused.
    if !(area > NOTHING * side * side && area.is_finite()) {
        return Err(ShellError::Area { area, side });
    }
    Ok(twice.normalize())
}
