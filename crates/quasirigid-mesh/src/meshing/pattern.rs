//! Pattern: tetrahedra in flat coordinates, and their image as curved cells in space.

use super::MeshingError;
use super::jacobian::{least_jacobian, six_volumes};
use super::quadratic::Quadratic;
use super::simplices::Simplices;
use crate::Mesh;

impl<const N: usize> Simplices<4, N> {
    /// Layers of prisms over triangles, each cut into three. The rule of the lower number makes neighbours fit: on every side the diagonal
    /// rises from the end with the lower number. In a closed stack the last layer meets the first.
    pub fn prisms<const M: usize>(
        base: &Simplices<3, M>,
        layers: usize,
        closed: bool,
        point: impl Fn([f64; M], usize) -> [f64; N],
    ) -> Self {
        let levels = if closed { layers } else { layers + 1 };
        let cut = |layer: usize, triangle: &[usize; 3]| {
            let mut corners = *triangle;
            corners.sort_unstable();
            let [low, high] = [layer, layer + 1].map(|level| level % levels * base.points.len());
            let [a, b, c] = corners;
            [
                [low + a, low + b, low + c, high + c],
                [low + a, low + b, high + b, high + c],
                [low + a, high + a, high + b, high + c],
            ]
        };
        let level = |level: usize| base.points.iter().map(move |at| (*at, level));
        Self {
            points: (0..levels).flat_map(level).map(|(at, level)| point(at, level)).collect(),
            cells: (0..layers)
                .flat_map(|layer| base.cells.iter().flat_map(move |triangle| cut(layer, triangle)))
                .collect(),
        }
    }

    /// The cells after a smooth map, in a `unit` of length: nodes at the images of the points and of the middles between
    /// them, corners in an order that makes the volume positive.
    ///
    /// # Errors
    /// [`MeshingError::Folded`] where the map bends edges too much for cells of this size.
    pub fn mapped(mut self, unit: f64, map: impl Fn([f64; N]) -> [f64; 3]) -> Result<Mesh, MeshingError> {
        let mut nodes: Vec<[f64; 3]> = self.points.iter().map(|point| map(*point)).collect();
        for cell in &mut self.cells {
            if six_volumes(cell.map(|corner| nodes[corner])) < 0.0 {
                cell.swap(2, 3);
            }
        }
        let quadratic = Quadratic::new(&self.cells, nodes.len());
        nodes.extend(quadratic.edges.iter().map(|ends| {
            let [a, b] = ends.map(|end| self.points[end]);
            map(std::array::from_fn(|axis| 0.5 * (a[axis] + b[axis])))
        }));
        let folded = |cell: &&[usize; 10]| !(least_jacobian(&cell.map(|node| nodes[node])) > 0.0);
        let count = quadratic.cells.iter().filter(folded).count();
        if count > 0 {
            return Err(MeshingError::Folded { count, cells: quadratic.cells.len() });
        }
        nodes.iter_mut().flatten().for_each(|x| *x *= unit);
        Ok(quadratic.mesh(nodes))
    }
}
