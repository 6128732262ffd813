//! Meshes from maps of a rectangle.

use nalgebra::Vector3;

use quasirigid_mesh::Shape;

/// Nodes in rows, with quadrilaterals between them or two triangles for each.
pub struct Grid {
    pub nodes: Vec<Vector3<f64>>,
    pub cells: Vec<Vec<usize>>,
    columns: usize,
}

impl Grid {
    /// `map(x, y)` of the unit square, with `counts` elements along each side.
    pub fn new(shape: Shape, counts: [usize; 2], map: &dyn Fn(f64, f64) -> [f64; 3]) -> Self {
        let columns = counts[0] + 1;
        let place = |i: usize| {
            let (column, row) = (i % columns, i / columns);
            Vector3::from(map(column as f64 / counts[0] as f64, row as f64 / counts[1] as f64))
        };
        let nodes = (0..columns * (counts[1] + 1)).map(place).collect();
        let corners = |i: usize| {
            let first = i / counts[0] * columns + i % counts[0];
            [first, first + 1, first + 1 + columns, first + columns]
        };
        let cells = (0..counts[0] * counts[1]).map(corners).flat_map(|[a, b, c, d]| match shape {
            Shape::Quad4 => vec![vec![a, b, c, d]],
            _ => vec![vec![a, b, c], vec![c, d, a]],
        });
        Self { nodes, cells: cells.collect(), columns }
    }

    pub fn shape(&self) -> Shape {
        if self.cells[0].len() == 4 { Shape::Quad4 } else { Shape::Triangle3 }
    }

    pub fn places(&self, cell: &[usize]) -> Vec<Vector3<f64>> {
        cell.iter().map(|index| self.nodes[*index]).collect()
    }

    /// Index of a node.
    pub fn node(&self, column: usize, row: usize) -> usize {
        row * self.columns + column
    }
}

pub const SHAPES: [Shape; 2] = [Shape::Quad4, Shape::Triangle3];

pub fn name(shape: Shape) -> &'static str {
    if shape == Shape::Quad4 { "quads" } else { "triangles" }
}
