//! Cells of a deck: grid points and elements as a mesh, in the order of its shapes.
//! A pyramid is two tetrahedra; a quadratic plate is linear ones between all its nodes; the middle of an edge that some cells give and a
//! cell leaves out is put there, once for all cells that need it.

use std::collections::HashMap;

use quasirigid_mesh::{Cell, Mesh, Set, Shape};

use super::layers::Layers;
use super::{BASIC, DeckModel, Plate, Solid};
use crate::matrix::error::MatrixProblem;
use crate::matrix::listed::LocatedProblem;
use crate::pyramid;

/// Cells of a deck.
#[derive(Default)]
pub(crate) struct Cells {
    /// Nodes and cells; sets of the cells of each property, by its number.
    pub mesh: Mesh,
    /// Index of each grid point.
    pub index: HashMap<u64, usize>,
    /// Number of the plate among those of the deck, for each cell of a plate.
    pub plates: Vec<(usize, usize)>,
    /// Index of the first cell and property of each solid.
    pub solids: Vec<(usize, u64)>,
    /// Plies of laminated solids.
    pub layers: Layers,
    /// Middles of edges that were put there.
    middles: HashMap<[usize; 2], usize>,
    put: usize,
    /// Number after the last grid point.
    points_end: u64,
    pyramids: usize,
    divided: usize,
}

/// Edges of a solid: corners of each, in the order of its shape; of a pyramid those of the base, then the upright ones.
const TET: &[[usize; 2]] = &[[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];
const WEDGE: &[[usize; 2]] = &[[0, 1], [1, 2], [2, 0], [3, 4], [4, 5], [5, 3], [0, 3], [1, 4], [2, 5]];
const HEX: &[[usize; 2]] =
    &[[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]];
const PYRAMID: &[[usize; 2]] = &[[0, 1], [1, 2], [2, 3], [3, 0], [0, 4], [1, 4], [2, 4], [3, 4]];

/// Edges of a solid of so many corners, in the order of its shape.
pub(crate) fn edges(corners: usize) -> &'static [[usize; 2]] {
    match corners {
        4 => TET,
        5 => PYRAMID,
        6 => WEDGE,
        _ => HEX,
    }
}

impl DeckModel {
    /// The grid points, solids, plates and lines of the deck.
    ///
    /// # Errors
    /// A grid point that no card has.
    pub fn cells(&self) -> Result<Cells, LocatedProblem> {
        self.made_cells(false)
    }

    /// The same with laminated solids divided into their plies.
    ///
    /// # Errors
    /// A grid point that no card has, a laminated solid that cannot be divided.
    pub fn divided_cells(&self) -> Result<Cells, LocatedProblem> {
        self.made_cells(true)
    }

    fn made_cells(&self, divided: bool) -> Result<Cells, LocatedProblem> {
        let mut cells = Cells::default();
        for point in &self.points {
            cells.index.insert(point.label, cells.mesh.nodes.len());
            cells.mesh.nodes.push(point.place);
            cells.mesh.node_labels.push(point.label);
        }
        cells.points_end = self.points.last().map_or(1, |point| point.label.saturating_add(1));
        let mut of_property: HashMap<u64, Vec<usize>> = HashMap::new();
        for (number, solid) in self.solids.iter().enumerate() {
            let first = cells.mesh.cells.len();
            match self.laminates.get(&solid.property).filter(|_| divided) {
                Some(laminate) => {
                    let axes = self.axes_at_solids.get(&number).copied().unwrap_or(BASIC);
                    cells.laminate(solid, laminate, axes)?;
                }
                None => cells.solid(solid)?,
            }
            cells.solids.push((first, solid.property));
            of_property.entry(solid.property).or_default().extend(first..cells.mesh.cells.len());
        }
        for (number, plate) in self.plates.iter().enumerate() {
            let first = cells.mesh.cells.len();
            cells.plate(plate)?;
            cells.plates.extend((first..cells.mesh.cells.len()).map(|cell| (number, cell)));
            of_property.entry(plate.property).or_default().extend(first..cells.mesh.cells.len());
        }
        for line in self.beams.iter().chain(&self.rods) {
            let nodes = [cells.of(line.ends[0], line.line)?, cells.of(line.ends[1], line.line)?];
            of_property.entry(line.property).or_default().push(cells.mesh.cells.len());
            cells.add(line.label, Shape::Line2, &nodes);
        }
        cells.tie();
        let mut properties: Vec<(u64, Vec<usize>)> = of_property.into_iter().collect();
        properties.sort_unstable_by_key(|(property, _)| *property);
        let set = |(property, cells): (u64, Vec<usize>)| Set {
            name: property.to_string(),
            nodes: Vec::new(),
            cells,
        };
        cells.mesh.sets = properties.into_iter().map(set).collect();
        Ok(cells)
    }
}

impl Cells {
    /// Index of a grid point that a line of the deck names.
    pub fn of(&self, label: u64, line: usize) -> Result<usize, LocatedProblem> {
        self.index.get(&label).copied().ok_or((line, MatrixProblem::NoGrid { node: label }))
    }

    pub(super) fn add(&mut self, label: u64, shape: Shape, nodes: &[usize]) {
        self.mesh.cells.push(Cell { label, shape, nodes: nodes.into() });
    }

    /// What was changed, in words.
    pub fn notes(&self) -> Vec<String> {
        let pyramids = (self.pyramids > 0).then(|| pyramid::told(self.pyramids));
        let counted = [
            (self.divided, "quadratic plates are divided into linear ones between all their nodes"),
            (self.put, "middles of edges that cells leave out are put there"),
        ];
        let counted = counted.iter().filter(|(count, _)| *count > 0);
        let counted = counted.map(|(count, what)| format!("{what} ({count})"));
        pyramids.into_iter().chain(counted).chain(self.layers.notes()).collect()
    }

    /// A new node in the middle of an edge or a face.
    fn put(&mut self, place: [f64; 3]) -> usize {
        self.put += 1;
        self.new_node(place)
    }

    /// A new node, numbered on from the last.
    pub(super) fn new_node(&mut self, place: [f64; 3]) -> usize {
        let put = self.mesh.nodes.len() - self.index.len();
        self.mesh.node_labels.push(self.points_end.saturating_add(put as u64));
        self.mesh.nodes.push(place);
        self.mesh.nodes.len() - 1
    }

    /// Corners, then middles of edges, those that are missing put there; none of a linear cell.
    fn all(
        &mut self,
        nodes: &[u64],
        corners: usize,
        edges: &[[usize; 2]],
        line: usize,
    ) -> Result<(Vec<usize>, Vec<usize>), LocatedProblem> {
        let known = |node: &u64| self.of(*node, line);
        let at: Vec<usize> = nodes[..corners].iter().map(known).collect::<Result<_, _>>()?;
        if nodes[corners..].iter().all(|node| *node == 0) {
            return Ok((at, Vec::new()));
        }
        let mut middles = Vec::with_capacity(edges.len());
        for (node, [a, b]) in nodes[corners..].iter().zip(edges) {
            let middle = match node {
                0 => self.middle([at[*a], at[*b]]),
                node => self.of(*node, line)?,
            };
            middles.push(middle);
        }
        Ok((at, middles))
    }

    fn middle(&mut self, mut edge: [usize; 2]) -> usize {
        edge.sort_unstable();
        if let Some(known) = self.middles.get(&edge) {
            return *known;
        }
        let [a, b] = edge.map(|node| self.mesh.nodes[node]);
        let node = self.put([0, 1, 2].map(|axis| 0.5 * a[axis] + 0.5 * b[axis]));
        self.middles.insert(edge, node);
        node
    }

    fn solid(&mut self, solid: &Solid) -> Result<(), LocatedProblem> {
        if solid.nodes.len() == Shape::Hex27.nodes() {
            let known = |node: &u64| self.of(*node, solid.line);
            let nodes = solid.nodes.iter().map(known).collect::<Result<Vec<_>, _>>()?;
            self.add(solid.label, Shape::Hex27, &nodes);
            return Ok(());
        }
        let (corners, middles) = self.all(&solid.nodes, solid.corners, edges(solid.corners), solid.line)?;
        if solid.corners == 5 {
            self.pyramid(solid, &corners, &middles);
            return Ok(());
        }
        let shape = match (solid.corners, middles.is_empty()) {
            (4, true) => Shape::Tet4,
            (4, false) => Shape::Tet10,
            (6, true) => Shape::Wedge6,
            (6, false) => Shape::Wedge15,
            (_, true) => Shape::Hex8,
            (_, false) => Shape::Hex20,
        };
        let nodes: Vec<usize> = corners.into_iter().chain(middles).collect();
        self.add(solid.label, shape, &nodes);
        Ok(())
    }

    fn pyramid(&mut self, solid: &Solid, corners: &[usize], middles: &[usize]) {
        self.pyramids += 1;
        let nodes = [corners, middles].concat();
        if middles.is_empty() {
            for half in pyramid::halves(&solid.nodes) {
                self.add(solid.label, Shape::Tet4, &half.map(|place| nodes[place]));
            }
            return;
        }
        let middle = self.middle_of_base(solid, &nodes);
        for half in pyramid::curved_halves(&solid.nodes) {
            let half = half.map(|place| place.map_or(middle, |place| nodes[place]));
            self.add(solid.label, Shape::Tet10, &half);
        }
    }

    fn middle_of_base(&mut self, solid: &Solid, nodes: &[usize]) -> usize {
        let [[a, _, c, _], _] = pyramid::halves(&solid.nodes);
        let mut edge = [nodes[a], nodes[c]];
        edge.sort_unstable();
        if let Some(known) = self.middles.get(&edge) {
            return *known;
        }
        let places = |first: usize| [0, 1, 2, 3].map(|corner| self.mesh.nodes[nodes[first + corner]]);
        let node = self.put(pyramid::middle_of_base(places(0), places(pyramid::NODES)));
        self.middles.insert(edge, node);
        node
    }

    fn plate(&mut self, plate: &Plate) -> Result<(), LocatedProblem> {
        let edges: &[[usize; 2]] =
            if plate.corners == 3 { &[[0, 1], [1, 2], [2, 0]] } else { &[[0, 1], [1, 2], [2, 3], [3, 0]] };
        let (corners, middles) = self.all(&plate.nodes, plate.corners, edges, plate.line)?;
        let shape = if plate.corners == 3 { Shape::Triangle3 } else { Shape::Quad4 };
        if middles.is_empty() {
            self.add(plate.label, shape, &corners);
            return Ok(());
        }
        self.divided += 1;
        let count = plate.corners;
        self.add(plate.label, shape, &middles);
        for corner in 0..count {
            let before = middles[(corner + count - 1) % count];
            self.add(plate.label, Shape::Triangle3, &[corners[corner], middles[corner], before]);
        }
        Ok(())
    }
}
