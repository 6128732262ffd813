//! Repair of a mesh whose cells are whole but listed in another way: cells turned right side out, nodes of no cell set aside.
//! Programs do not agree on the order of the nodes of a wedge, and CAD kernels leave the centres of arcs among the nodes.

use super::{Mesh, Shape};

impl Mesh {
    /// Reverses the order of the nodes of each solid cell whose volume is negative, and returns the number of these cells.
    ///
    /// Cells that name nodes that do not exist are left alone; [`Mesh::check`] finds them.
    pub fn turn_right_side_out(&mut self) -> usize {
        let mut turned = 0;
        let nodes = &self.nodes;
        for cell in self.cells.iter_mut().filter(|cell| cell.shape.dimension() == 3) {
            let places: Option<Vec<[f64; 3]>> =
                cell.nodes.iter().map(|node| nodes.get(*node).copied()).collect();
            let whole = places.filter(|places| places.len() == cell.shape.nodes());
            if whole.is_some_and(|places| cell.shape.volume(&places) < 0.0) {
                let old = cell.nodes.clone();
                for (node, from) in cell.nodes.iter_mut().zip(mirror(cell.shape)) {
                    *node = old[from];
                }
                turned += 1;
            }
        }
        turned
    }

    /// Removes the nodes that no cell of a dimension names, with the cells and members of sets that name them, and returns
    /// the numbers of these nodes.
    pub fn set_aside_unused(&mut self, dimension: usize) -> Vec<u64> {
        let mut used = vec![false; self.nodes.len()];
        let bearing = self.cells.iter().filter(|cell| cell.shape.dimension() == dimension);
        for node in bearing.flat_map(|cell| &cell.nodes) {
            if let Some(used) = used.get_mut(*node) {
                *used = true;
            }
        }
        if used.iter().all(|used| *used) {
            return Vec::new();
        }
        let aside = self.node_labels.iter().zip(&used).filter(|(_, used)| !**used);
        let aside = aside.map(|(label, _)| *label).collect();
        let nodes = places(&used);
        retain(&mut self.nodes, &used);
        retain(&mut self.node_labels, &used);
        let whole = |cell: &super::Cell| {
            cell.shape.dimension() == dimension
                || cell.nodes.iter().all(|node| used.get(*node).copied().unwrap_or(true))
        };
        let kept: Vec<bool> = self.cells.iter().map(whole).collect();
        let cells = places(&kept);
        retain(&mut self.cells, &kept);
        for node in self.cells.iter_mut().flat_map(|cell| cell.nodes.iter_mut()) {
            *node = nodes.get(*node).copied().flatten().unwrap_or(usize::MAX);
        }
        for set in &mut self.sets {
            set.nodes = set.nodes.iter().filter_map(|node| nodes.get(*node).copied().flatten()).collect();
            set.cells = set.cells.iter().filter_map(|cell| cells.get(*cell).copied().flatten()).collect();
        }
        aside
    }
}

/// Order of the nodes of a shape in its mirror image.
fn mirror(shape: Shape) -> Vec<usize> {
    let places = shape.reference();
    let image = |[x, y, z]: &[f64; 3]| places.iter().position(|place| *place == [*y, *x, *z]);
    places.iter().enumerate().map(|(node, place)| image(place).unwrap_or(node)).collect()
}

/// New index of each entry that is kept.
fn places(kept: &[bool]) -> Vec<Option<usize>> {
    let mut next = 0;
    let place = |kept: &bool| {
        next += usize::from(*kept);
        kept.then(|| next - 1)
    };
    kept.iter().map(place).collect()
}

fn retain<T>(entries: &mut Vec<T>, kept: &[bool]) {
    let mut kept = kept.iter();
    entries.retain(|_| kept.next().copied().unwrap_or(true));
}

#[cfg(test)]
mod tests {
    use super::super::{Cell, Set};
    use super::*;
    use crate::functions::tests::SHAPES;

    #[test]
    fn a_mirrored_cell_of_every_shape_is_turned_to_the_same_volume() {
        for shape in SHAPES.into_iter().filter(|shape| shape.dimension() == 3) {
            let nodes = shape.reference().iter().map(|[x, y, z]| [3.0 - x, 7.0 + 2.0 * y, *z]).collect();
            let cell = Cell { label: 5, shape, nodes: (0..shape.nodes()).collect() };
            let labels = (1..=shape.nodes() as u64).collect();
            let mut mesh = Mesh { nodes, node_labels: labels, cells: vec![cell], sets: Vec::new() };
            let volume = mesh.volume(&[0]);
            assert!(volume < 0.0 && mesh.check().is_err());
            assert_eq!([mesh.turn_right_side_out(), mesh.turn_right_side_out()], [1, 0]);
            assert!((mesh.volume(&[0]) + volume).abs() < 1e-14 * volume.abs(), "{shape}");
            assert_eq!(mesh.check(), Ok(()), "{shape}");
        }
    }

    #[test]
    fn nodes_of_no_solid_leave_with_the_faces_and_set_members_that_name_them() {
        let corners = [[9.0; 3], [0.0; 3], [1.0, 0.0, 0.0], [8.0; 3], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let cell = |label, shape, nodes: &[usize]| Cell { label, shape, nodes: nodes.into() };
        let mut mesh = Mesh {
            nodes: corners.to_vec(),
            node_labels: vec![10, 11, 12, 13, 14, 15],
            cells: vec![
                cell(1, Shape::Line2, &[0, 1]),
                cell(2, Shape::Tet4, &[1, 2, 4, 5]),
                cell(3, Shape::Triangle3, &[1, 4, 2]),
            ],
            sets: vec![Set { name: "foot".into(), nodes: vec![0, 2, 5], cells: vec![0, 1, 2] }],
        };
        assert_eq!(mesh.set_aside_unused(3), [10, 13]);
        assert_eq!(mesh.node_labels, [11, 12, 14, 15]);
        assert_eq!(mesh.nodes[2], [0.0, 1.0, 0.0]);
        let cells: Vec<(u64, &[usize])> = mesh.cells.iter().map(|cell| (cell.label, &*cell.nodes)).collect();
        assert_eq!(cells, [(2, &[0, 1, 2, 3][..]), (3, &[0, 2, 1])]);
        assert_eq!((&mesh.sets[0].nodes[..], &mesh.sets[0].cells[..]), (&[1, 3][..], &[0, 1][..]));
        assert!(mesh.set_aside_unused(3).is_empty());
    }
}
