//! Blocks of cells and their matrices, dense.

use std::collections::HashMap;

use nalgebra::{DMatrix, DVector, Rotation3, Vector3};

use quasirigid_mesh::Shape;

pub const SHAPES: [Shape; 7] =
    [Shape::Tet4, Shape::Tet10, Shape::Wedge6, Shape::Wedge15, Shape::Hex8, Shape::Hex20, Shape::Hex27];

/// Unit cube divided into cells, with displaced nodes.
pub struct Block {
    pub shape: Shape,
    /// Places of the nodes.
    pub nodes: Vec<Vector3<f64>>,
    /// Places of the nodes in the even cube.
    pub even: Vec<Vector3<f64>>,
    pub cells: Vec<Vec<usize>>,
}

impl Block {
    /// Cube of so many bricks along each axis, each one hexahedron, two wedges or six tetrahedra. Corners inside the cube are shifted by up
    /// to a share of a brick; edges stay straight.
    pub fn new(shape: Shape, counts: [usize; 3], shift: f64) -> Self {
        let size = counts.map(|count| count + 1);
        let index = |at: [usize; 3]| at[0] + size[0] * (at[1] + size[1] * at[2]);
        let mut block = Self { shape, nodes: Vec::new(), even: Vec::new(), cells: Vec::new() };
        for k in 0..size.iter().product() {
            let at = [k % size[0], k / size[0] % size[1], k / (size[0] * size[1])];
            let inside = (0..3).all(|axis| at[axis] > 0 && at[axis] < counts[axis]);
            let place = Vector3::from_fn(|axis, _| at[axis] as f64 / counts[axis] as f64);
            let away = |axis: usize| (7.3 * k as f64 + 2.1 * axis as f64).sin() * shift / counts[axis] as f64;
            let shifted = Vector3::from_fn(|axis, _| place[axis] + if inside { away(axis) } else { 0.0 });
            block.even.push(place);
            block.nodes.push(shifted);
        }
        for k in 0..counts.iter().product() {
            let low = [k % counts[0], k / counts[0] % counts[1], k / (counts[0] * counts[1])];
            let brick = Shape::Hex8.reference().into_iter().map(|place| {
                index(std::array::from_fn(|axis| low[axis] + if place[axis] > 0.0 { 1 } else { 0 }))
            });
            let brick: Vec<usize> = brick.collect();
            block.cells.extend(
                pieces(shape).iter().map(|piece| piece.iter().map(|corner| brick[*corner]).collect()),
            );
        }
        block.middles();
        block
    }

    /// Nodes between the corners.
    fn middles(&mut self) {
        let straight = match self.shape.corners() {
            4 => Shape::Tet4,
            6 => Shape::Wedge6,
            _ => Shape::Hex8,
        };
        let mut between: HashMap<Vec<usize>, usize> = HashMap::new();
        for cell in 0..self.cells.len() {
            for place in self.shape.reference().into_iter().skip(self.shape.corners()) {
                let shares = straight.functions(place);
                let corners = &self.cells[cell][..self.shape.corners()];
                let mut ends: Vec<usize> = corners
                    .iter()
                    .zip(shares)
                    .filter(|(_, share)| *share > 1e-9)
                    .map(|(corner, _)| *corner)
                    .collect();
                ends.sort_unstable();
                let mean = |places: &[Vector3<f64>]| {
                    ends.iter().map(|end| places[*end]).sum::<Vector3<f64>>() / ends.len() as f64
                };
                let (node, even) = (mean(&self.nodes), mean(&self.even));
                let next = self.nodes.len();
                let index = *between.entry(ends).or_insert(next);
                if index == next {
                    self.nodes.push(node);
                    self.even.push(even);
                }
                self.cells[cell].push(index);
            }
        }
    }

    /// All nodes moved, so that edges may become curved.
    pub fn mapped(mut self, map: impl Fn(Vector3<f64>) -> Vector3<f64>) -> Self {
        self.nodes.iter_mut().for_each(|node| *node = map(*node));
        self
    }

    pub fn places(&self, cell: usize) -> Vec<Vector3<f64>> {
        self.cells[cell].iter().map(|node| self.nodes[*node]).collect()
    }

    /// A matrix of the block with `per` unknowns at each node.
    pub fn assembled(&self, per: usize, matrix: impl Fn(&[Vector3<f64>]) -> DMatrix<f64>) -> DMatrix<f64> {
        let size = per * self.nodes.len();
        let mut whole = DMatrix::zeros(size, size);
        for (cell, nodes) in self.cells.iter().enumerate() {
            let part = matrix(&self.places(cell));
            let place = |row: usize| per * nodes[row / per] + row % per;
            for row in 0..part.nrows() {
                for column in 0..part.ncols() {
                    whole[(place(row), place(column))] += part[(row, column)];
                }
            }
        }
        whole
    }

    /// Whether a node is on the surface of the cube.
    pub fn outside(&self, node: usize) -> bool {
        self.even[node].iter().any(|x| *x < 1e-9 || *x > 1.0 - 1e-9)
    }

    /// Values of a field at the nodes.
    pub fn field(&self, field: impl Fn(Vector3<f64>) -> Vector3<f64>) -> DVector<f64> {
        DVector::from_iterator(
            3 * self.nodes.len(),
            self.nodes.iter().flat_map(|node| <[f64; 3]>::from(field(*node))),
        )
    }
}

/// Corners of the cells that a brick is cut into.
fn pieces(shape: Shape) -> &'static [&'static [usize]] {
    match shape.corners() {
        4 => &[&[0, 1, 2, 6], &[0, 2, 3, 6], &[0, 3, 7, 6], &[0, 7, 4, 6], &[0, 4, 5, 6], &[0, 5, 1, 6]],
        6 => &[&[0, 1, 2, 4, 5, 6], &[0, 2, 3, 4, 6, 7]],
        _ => &[&[0, 1, 2, 3, 4, 5, 6, 7]],
    }
}

/// Solution of a balance in which the unknowns that `held` gives a value keep it.
pub fn solved(
    stiffness: &DMatrix<f64>,
    load: &DVector<f64>,
    held: impl Fn(usize) -> Option<f64>,
) -> DVector<f64> {
    let mut solution = DVector::from_fn(load.len(), |row, _| held(row).unwrap_or(0.0));
    let free: Vec<usize> = (0..load.len()).filter(|row| held(*row).is_none()).collect();
    let rest = (load - stiffness * &solution).select_rows(&free);
    let inner = stiffness.select_rows(&free).select_columns(&free);
    let answer = inner.cholesky().expect("a held body is stiff").solve(&rest);
    free.iter().zip(&answer).for_each(|(row, x)| solution[*row] = *x);
    solution
}

/// Cell far from its reference form: rotated, sheared, off the origin, edges curved if there are nodes on them.
pub fn distorted(shape: Shape) -> Vec<Vector3<f64>> {
    let turn = Rotation3::from_scaled_axis(Vector3::new(0.3, -0.9, 0.5));
    let place = |(node, at): (usize, [f64; 3])| {
        let away = Vector3::from_fn(|axis, _| (3.7 * node as f64 + 1.9 * axis as f64).sin());
        let [x, y, z] = at;
        let sheared = Vector3::new(1.3 * x + 0.2 * y, 0.8 * y + 0.1 * z, 0.6 * z - 0.1 * x);
        turn * (sheared + 0.06 * away) + Vector3::new(4.0, -3.0, 2.0)
    };
    shape.reference().into_iter().enumerate().map(place).collect()
}

/// Six motions of a rigid body, node by node.
pub fn rigid(nodes: &[Vector3<f64>]) -> DMatrix<f64> {
    DMatrix::from_fn(3 * nodes.len(), 6, |row, motion| {
        let axis = Vector3::ith(motion % 3, 1.0);
        let moved = if motion < 3 { axis } else { axis.cross(&nodes[row / 3]) };
        moved[row % 3]
    })
}
