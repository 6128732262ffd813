//! Validity of a mesh: positive Jacobians, distinct nodes and cells.
//! Judged at corners and quadrature points, since elements divide by the Jacobian there; each kind of fault is reported once, with a count.
//! Fatal faults are here, suspect but possible ones in `note.rs`.

use std::collections::HashMap;

use super::geometry::{normal, tangents, thickness};
use super::{Cell, MAX_NODES, Mesh, MeshFault, Rule, Shape};
use quasirigid_math::vec3::{add, scale};

/// Thickness of a cell over its length below which the cell is flat; coordinates in files often have no more digits.
const FLAT: f64 = 1e-9;

/// Shape functions at a place, and their derivatives.
type Probe = ([f64; MAX_NODES], [[f64; 3]; MAX_NODES]);

/// Least thickness of a cell over its length, its place, and the greatest.
struct Worst {
    thickness: f64,
    at: [f64; 3],
    best: f64,
}

impl Mesh {
    /// Accepts the mesh if its cells describe a body; changes nothing. Suspect but possible features are in [`Mesh::notes`].
    ///
    /// The Jacobian of each cell must be positive at its corners and at every point at which it is integrated. Of
    /// faces and lines, which have no inside, it must not change its direction within the cell.
    ///
    /// # Errors
    /// Every kind of [`MeshFault`] that occurs, with the first place and the count. Cells that name nodes that do not exist end the check.
    pub fn check(&self) -> Result<(), Vec<MeshFault>> {
        if let Some(fault) = self.labels() {
            return Err(vec![fault]);
        }
        let unusable: Vec<MeshFault> =
            [self.not_finite(), self.node_count(), self.no_such_node()].into_iter().flatten().collect();
        if !unusable.is_empty() {
            return Err(unusable);
        }
        let twice = self.cells.iter().map(|cell| self.node_twice(cell)).collect::<Vec<_>>();
        let repeated = counted(twice.iter().flatten().cloned());
        // A cell with a node twice is flat as well; that fault would add nothing.
        let distinct = self.cells.iter().zip(&twice).filter(|(_, fault)| fault.is_none());
        let mut probed: HashMap<Shape, Vec<Probe>> = HashMap::new();
        let mut misshapen = |cell: &Cell| {
            self.misshapen(cell, probed.entry(cell.shape).or_insert_with(|| probes(cell.shape)))
        };
        let shapes: Vec<MeshFault> = distinct.filter_map(|(cell, _)| misshapen(cell)).collect();
        let (flat, inside_out): (Vec<_>, Vec<_>) =
            shapes.into_iter().partition(|fault| matches!(fault, MeshFault::Flat { .. }));
        let kinds = [repeated, self.cell_twice(), counted(flat.into_iter()), counted(inside_out.into_iter())];
        let faults: Vec<MeshFault> = kinds.into_iter().flatten().collect();
        if faults.is_empty() { Ok(()) } else { Err(faults) }
    }

    fn labels(&self) -> Option<MeshFault> {
        let [nodes, labels] = [self.nodes.len(), self.node_labels.len()];
        (nodes != labels).then_some(MeshFault::Labels { nodes, labels })
    }

    fn not_finite(&self) -> Option<MeshFault> {
        let astray =
            self.nodes.iter().zip(&self.node_labels).filter(|(at, _)| at.iter().any(|x| !x.is_finite()));
        counted(astray.map(|(_, label)| MeshFault::NotFinite { node: *label, count: 1 }))
    }

    fn node_count(&self) -> Option<MeshFault> {
        let odd = self.cells.iter().filter(|cell| cell.nodes.len() != cell.shape.nodes());
        counted(odd.map(|cell| MeshFault::NodeCount {
            cell: cell.label,
            shape: cell.shape,
            found: cell.nodes.len(),
            count: 1,
        }))
    }

    fn no_such_node(&self) -> Option<MeshFault> {
        let nodes = self.nodes.len();
        let missing = |cell: &Cell| {
            let index = cell.nodes.iter().copied().find(|node| *node >= nodes)?;
            Some(MeshFault::NoSuchNode { cell: cell.label, index, nodes, count: 1 })
        };
        counted(self.cells.iter().filter_map(missing))
    }

    fn node_twice(&self, cell: &Cell) -> Option<MeshFault> {
        let again = |(place, node): (usize, &usize)| cell.nodes[..place].contains(node).then_some(*node);
        let node = cell.nodes.iter().enumerate().find_map(again)?;
        let node = self.node_labels[node];
        Some(MeshFault::NodeTwice { cell: cell.label, shape: cell.shape, node, count: 1 })
    }

    fn cell_twice(&self) -> Option<MeshFault> {
        let mut seen: HashMap<Box<[usize]>, usize> = HashMap::with_capacity(self.cells.len());
        let twin = |(index, cell): (usize, &Cell)| {
            let mut nodes = cell.nodes.clone();
            nodes.sort_unstable();
            let first = *seen.entry(nodes).or_insert(index);
            let cells = [self.cells[first].label, cell.label];
            (first != index).then_some(MeshFault::CellTwice { cells, count: 1 })
        };
        counted(self.cells.iter().enumerate().filter_map(twin))
    }

    fn misshapen(&self, cell: &Cell, probes: &[Probe]) -> Option<MeshFault> {
        let nodes: Vec<[f64; 3]> = cell.nodes.iter().map(|node| self.nodes[*node]).collect();
        let Cell { label, shape, .. } = *cell;
        let Worst { thickness, at, best } = worst(shape.dimension(), &nodes, probes);
        if thickness > FLAT {
            return None;
        }
        if thickness >= -FLAT {
            return Some(MeshFault::Flat { cell: label, shape, thickness, at, count: 1 });
        }
        Some(MeshFault::InsideOut { cell: label, shape, thickness, at, wholly: best < 0.0, count: 1 })
    }
}

/// Derivatives of the shape functions at the corners of a shape and at its quadrature points, with the functions.
fn probes(shape: Shape) -> Vec<Probe> {
    let corners = shape.reference().into_iter().take(shape.corners());
    let inner = [Rule::Slopes, Rule::Products].into_iter().flat_map(|rule| shape.samples(rule));
    corners
        .chain(inner.map(|sample| sample.at))
        .map(|at| (shape.functions(at), shape.gradients(at)))
        .collect()
}

/// Place at which the Jacobian of a cell is least.
fn worst(dimension: usize, nodes: &[[f64; 3]], probes: &[Probe]) -> Worst {
    let mean = if dimension == 3 { [0.0; 3] } else { mean_normal(dimension, nodes, probes) };
    let mut worst = Worst { thickness: f64::INFINITY, at: [0.0; 3], best: f64::NEG_INFINITY };
    for (functions, gradients) in probes {
        let thickness = thickness(dimension, tangents(nodes, gradients), mean);
        worst.best = worst.best.max(thickness);
        if thickness < worst.thickness {
            worst.thickness = thickness;
            worst.at =
                nodes.iter().zip(functions).map(|(node, share)| scale(*share, *node)).fold([0.0; 3], add);
        }
    }
    worst
}

/// Mean normal of a face or mean direction of a line.
fn mean_normal(dimension: usize, nodes: &[[f64; 3]], probes: &[Probe]) -> [f64; 3] {
    probes.iter().map(|(_, gradients)| normal(dimension, tangents(nodes, gradients))).fold([0.0; 3], add)
}

/// The first of several faults of a kind, with their number.
fn counted(mut faults: impl Iterator<Item = MeshFault>) -> Option<MeshFault> {
    let mut first = faults.next()?;
    let further = faults.count();
    use MeshFault::*;
    match &mut first {
        NotFinite { count, .. }
        | NodeCount { count, .. }
        | NoSuchNode { count, .. }
        | NodeTwice { count, .. }
        | CellTwice { count, .. }
        | Flat { count, .. }
        | InsideOut { count, .. } => *count += further,
        Labels { .. } => {}
    }
    Some(first)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::functions::tests::SHAPES;

    /// Two hexahedra side by side, rotated and off the origin, numbered unlike their indices.
    fn pair(unit: f64) -> Mesh {
        let (sin, cos) = 0.4_f64.sin_cos();
        let place = |k: usize| {
            let [x, y, z] = [k % 3, k / 3 % 2, k / 6].map(|i| i as f64);
            [cos * x - sin * y + 20.0, sin * x + cos * y - 7.0, 0.5 * z + 3.0].map(|x| unit * x)
        };
        let hexahedron = |label, x: usize| {
            let nodes = [0, 1, 4, 3, 6, 7, 10, 9].map(|node| node + x);
            Cell { label, shape: Shape::Hex8, nodes: nodes.into() }
        };
        Mesh {
            nodes: (0..12).map(place).collect(),
            node_labels: (0..12).map(|k| 100 + 10 * k).collect(),
            cells: vec![hexahedron(71, 0), hexahedron(72, 1)],
            sets: Vec::new(),
        }
    }

    /// One cell on its reference place, the nodes moved.
    fn single(shape: Shape, moved: impl Fn(usize, [f64; 3]) -> [f64; 3]) -> Mesh {
        let places = shape.reference();
        Mesh {
            nodes: places.iter().enumerate().map(|(node, place)| moved(node, *place)).collect(),
            node_labels: (1..=places.len() as u64).collect(),
            cells: vec![Cell { label: 5, shape, nodes: (0..places.len()).collect() }],
            sets: Vec::new(),
        }
    }

    fn only(mesh: &Mesh) -> MeshFault {
        let mut faults = mesh.check().unwrap_err();
        assert_eq!(faults.len(), 1, "{faults:?}");
        faults.remove(0)
    }

    #[test]
    fn a_good_mesh_of_any_unit_passes() {
        for unit in [1e-9, 1.0, 1e9] {
            let mesh = pair(unit);
            assert_eq!(mesh.check(), Ok(()));
            assert!((mesh.volume(&[0, 1]) / unit.powi(3) - 1.0).abs() < 1e-12);
        }
        for shape in SHAPES {
            assert_eq!(single(shape, |_, place| place).check(), Ok(()), "{shape}");
        }
    }

    #[test]
    fn a_mirrored_solid_is_inside_out_wholly() {
        for shape in SHAPES.into_iter().filter(|shape| shape.dimension() == 3) {
            let fault = only(&single(shape, |_, [x, y, z]| [x + 3.0, 7.0 - y, z]));
            assert!(matches!(fault, MeshFault::InsideOut { cell: 5, wholly: true, .. }), "{fault}");
        }
    }

    #[test]
    fn a_middle_node_too_near_to_a_corner_turns_that_corner() {
        // The Jacobian at the end of an edge vanishes when the middle node is at a quarter of it.
        let moved = |share: f64| {
            single(Shape::Tet10, move |node, [x, y, z]| if node == 4 { [share, y, z] } else { [x, y, z] })
        };
        assert_eq!(moved(0.251).check(), Ok(()));
        let MeshFault::InsideOut { at, wholly, thickness, .. } = only(&moved(0.249)) else { panic!() };
        assert!(!wholly && at == [0.0; 3] && (thickness + 0.004).abs() < 1e-5, "{at:?} {thickness}");
    }

    #[test]
    fn faces_and_lines_that_fold_back_are_inside_out() {
        for shape in [Shape::Quad4, Shape::Quad8, Shape::Quad9] {
            let folded = single(shape, |node, [x, y, z]| if node == 2 { [-0.9, -0.9, z] } else { [x, y, z] });
            assert!(matches!(only(&folded), MeshFault::InsideOut { wholly: false, .. }), "{shape}");
        }
        let line = single(Shape::Line3, |node, [x, y, z]| if node == 2 { [0.6, y, z] } else { [x, y, z] });
        assert!(matches!(only(&line), MeshFault::InsideOut { wholly: false, .. }));
    }

    #[test]
    fn flatness_is_judged_beside_the_length_on_both_sides_of_the_line() {
        for shape in [Shape::Tet4, Shape::Hex8, Shape::Wedge15] {
            for unit in [1e-6, 1.0, 1e6] {
                let thin =
                    |share: f64| single(shape, move |_, [x, y, z]| [x, y, share * z].map(|x| unit * x));
                assert_eq!(thin(1.1e-9).check(), Ok(()), "{shape}");
                assert!(matches!(only(&thin(0.9e-9)), MeshFault::Flat { count: 1, .. }), "{shape}");
                assert!(matches!(only(&thin(0.0)), MeshFault::Flat { count: 1, .. }), "{shape}");
                assert!(matches!(only(&thin(-1.1e-9)), MeshFault::InsideOut { .. }), "{shape}");
            }
        }
        assert!(matches!(only(&single(Shape::Quad8, |_, _| [2.0; 3])), MeshFault::Flat { .. }));
        assert!(matches!(only(&single(Shape::Line2, |_, _| [2.0; 3])), MeshFault::Flat { .. }));
    }

    #[test]
    fn nodes_and_cells_that_come_twice_are_found_by_their_labels() {
        let mut mesh = pair(1.0);
        mesh.cells[1].nodes[3] = mesh.cells[1].nodes[0];
        let expected = MeshFault::NodeTwice { cell: 72, shape: Shape::Hex8, node: 110, count: 1 };
        assert_eq!(only(&mesh), expected);
        let mut mesh = pair(1.0);
        let mut copy = mesh.cells[0].clone();
        copy.label = 90;
        copy.nodes.rotate_left(4);
        copy.nodes[..4].reverse();
        copy.nodes[4..].reverse();
        mesh.cells.push(copy);
        assert_eq!(only(&mesh), MeshFault::CellTwice { cells: [71, 90], count: 1 });
    }

    #[test]
    fn what_cannot_be_read_is_refused_before_its_shape_is_judged() {
        let mut mesh = pair(1.0);
        mesh.nodes[4][1] = f64::NAN;
        mesh.cells[0].nodes = Box::new([0, 1, 2]);
        mesh.cells[1].nodes[7] = 12;
        let faults = mesh.check().unwrap_err();
        let expected = [
            MeshFault::NotFinite { node: 140, count: 1 },
            MeshFault::NodeCount { cell: 71, shape: Shape::Hex8, found: 3, count: 1 },
            MeshFault::NoSuchNode { cell: 72, index: 12, nodes: 12, count: 1 },
        ];
        assert_eq!(faults, expected);
        mesh.node_labels.pop();
        assert_eq!(mesh.check().unwrap_err(), [MeshFault::Labels { nodes: 12, labels: 11 }]);
    }

    #[test]
    fn messages_name_the_cell_and_what_to_do() {
        let folded = single(Shape::Hex8, |node, place| if node == 6 { [-0.5; 3] } else { place });
        let expected = "cell 5 (hexahedron of 8 nodes) is inside out near (-5.0000e-1, -5.0000e-1, -5.0000e-1): -0.98 times \
                        as thick as it is long; move the node that went too far back";
        assert_eq!(only(&folded).to_string(), expected);
    }
}
