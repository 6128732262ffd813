//! Unstructured grid of VTK made into nodes, cells and sets, piece after piece.
//! Arrays of whole numbers become sets of cells; an array with more than a thousand values numbers the cells and becomes none.

use std::collections::{BTreeMap, HashMap};
use std::ops::Range;

use quasirigid_mesh::{Cell, Mesh, Shape};

use super::array::{Array, Values};
use super::{Fault, MeshProblem, Place, Sets, VolumeProblem, finite};
use crate::pyramid;

/// Most values of an array whose values become sets: one with more numbers the cells.
const MOST_VALUES: usize = 1000;
/// Type of a vertex, which is no cell.
const VERTEX: i64 = 1;
/// Types of pyramids, of five nodes and of 13, which become two tetrahedra.
const PYRAMID: i64 = 14;
const CURVED_PYRAMID: i64 = 27;

/// A piece of an unstructured grid.
pub(super) struct Grid<'a> {
    /// Three coordinates for each point.
    pub(super) points: Array<'a>,
    /// Points of the cells, one cell after the other.
    pub(super) corners: Array<'a>,
    /// Ends of the corners of each cell.
    pub(super) ends: Array<'a>,
    /// Whether the corners of each cell stand after their number.
    pub(super) counted: bool,
    pub(super) types: Array<'a>,
    /// One whole number for each cell.
    pub(super) groups: Vec<Array<'a>>,
}

/// Nodes that were put in the middles of the bases of pyramids, by the ends of the diagonals on which bases are cut.
#[derive(Default)]
struct Middles {
    of: HashMap<[usize; 2], usize>,
    places: Vec<[f64; 3]>,
    /// Index of the first in the mesh.
    first: usize,
}

impl Grid<'_> {
    /// Adds the grid to a mesh, in which points and cells count on; returns how many cells it has, with its vertices.
    pub(super) fn add_to(self, mesh: &mut Mesh, sets: &mut Sets, first_cell: u64) -> Result<u64, Fault> {
        let points = mesh.nodes.len();
        self.check_length()?;
        let mut put = Middles { first: points + self.points.values.len() / 3, ..Middles::default() };
        let mut indices = Vec::new(); // in the mesh: none for vertices, two for pyramids
        let mut start = 0;
        for (number, (end, code)) in self.ends.whole()?.iter().zip(self.types.whole()?).enumerate() {
            let label = first_cell + number as u64;
            let corners = self.corners_of(number, start, *end)?;
            start += corners.len();
            let first = mesh.cells.len();
            let here = |problem| (self.place(number, start - corners.len()), problem);
            if matches!(*code, PYRAMID | CURVED_PYRAMID) {
                let count = if *code == PYRAMID { pyramid::NODES } else { pyramid::CURVED };
                let nodes = self.nodes(label, (count, format!("pyramid of {count} nodes")), corners, points);
                self.divide(label, &nodes.map_err(here)?, points, mesh, &mut put);
            } else if *code != VERTEX {
                let shape = shape(*code).map_err(|problem| (self.types.origin.place(number), problem))?;
                let nodes = self.nodes(label, (shape.nodes(), shape.to_string()), corners, points);
                mesh.cells.push(Cell { label, shape, nodes: nodes.map_err(here)? });
            }
            indices.push(first..mesh.cells.len());
        }
        for array in &self.groups {
            add_groups(array, &indices, sets)?;
        }
        self.add_points(mesh)?;
        for place in put.places {
            mesh.node_labels.push(mesh.nodes.len() as u64);
            mesh.nodes.push(place);
        }
        Ok(indices.len() as u64)
    }

    /// Adds a pyramid as two tetrahedra of its number.
    fn divide(&self, label: u64, nodes: &[usize], first: usize, mesh: &mut Mesh, put: &mut Middles) {
        let labels: Vec<u64> = nodes.iter().map(|node| *node as u64).collect();
        if nodes.len() == pyramid::NODES {
            for half in pyramid::halves(&labels) {
                let nodes = half.map(|place| nodes[place]).into();
                mesh.cells.push(Cell { label, shape: Shape::Tet4, nodes });
            }
            return;
        }
        let [[a, _, c, _], _] = pyramid::halves(&labels);
        let diagonal = [nodes[a].min(nodes[c]), nodes[a].max(nodes[c])];
        let middle = *put.of.entry(diagonal).or_insert_with(|| {
            let places = |from: usize| [0, 1, 2, 3].map(|corner| self.point(nodes[from + corner] - first));
            put.places.push(pyramid::middle_of_base(places(0), places(pyramid::NODES)));
            put.first + put.places.len() - 1
        });
        for half in pyramid::curved_halves(&labels) {
            let nodes = half.map(|place| place.map_or(middle, |place| nodes[place])).into();
            mesh.cells.push(Cell { label, shape: Shape::Tet10, nodes });
        }
    }

    /// Coordinates of a point of this piece, which exists.
    fn point(&self, index: usize) -> [f64; 3] {
        [0, 1, 2].map(|axis| match &self.points.values {
            Values::Whole(values) => values[3 * index + axis] as f64,
            Values::Real(values) => values[3 * index + axis],
        })
    }

    /// Refuses a grid with more or fewer types than ends.
    fn check_length(&self) -> Result<(), Fault> {
        let (found, expected) = (self.types.values.len() as u64, self.ends.values.len() as u64);
        let array = self.types.name.clone();
        let wrong =
            || (self.types.origin.place(0), VolumeProblem::ArrayLength { array, found, expected }.into());
        if found == expected { Ok(()) } else { Err(wrong()) }
    }

    fn corners_of(&self, cell: usize, start: usize, end: i64) -> Result<&[i64], Fault> {
        let corners = self.corners.whole()?;
        usize::try_from(end).ok().and_then(|end| corners.get(start..end)).ok_or_else(|| {
            let (start, total) = (start as u64, corners.len() as u64);
            let problem = VolumeProblem::Offset { cell: cell as u64, start, end: end.max(0) as u64, total };
            (self.ends.origin.place(cell), problem.into())
        })
    }

    /// Place of a cell whose corners start at this index.
    fn place(&self, cell: usize, start: usize) -> Place {
        self.corners.origin.place(if self.counted { start + cell } else { start })
    }

    fn nodes(
        &self,
        cell: u64,
        (count, shape): (usize, String),
        corners: &[i64],
        first: usize,
    ) -> Result<Box<[usize]>, MeshProblem> {
        if corners.len() != count {
            let found = corners.len() as u64;
            return Err(VolumeProblem::NodeCount { found, shape }.into());
        }
        let points = self.points.values.len() / 3;
        let index = |corner: &i64| match usize::try_from(*corner) {
            Ok(corner) if corner < points => Ok(first + corner),
            Ok(corner) => Err(VolumeProblem::NoSuchNode { cell, node: corner as u64 }.into()),
            Err(_) => Err(VolumeProblem::Label { found: *corner }.into()),
        };
        corners.iter().map(index).collect()
    }

    fn add_points(self, mesh: &mut Mesh) -> Result<(), Fault> {
        let origin = self.points.origin;
        let points = self.points.values.into_reals();
        for (number, point) in points.as_chunks::<3>().0.iter().enumerate() {
            let label = mesh.nodes.len() as u64;
            finite(label, *point).map_err(|problem| {
                let axis = point.iter().position(|x| !x.is_finite()).unwrap_or(0);
                (origin.place(3 * number + axis), problem)
            })?;
            mesh.node_labels.push(label);
            mesh.nodes.push(*point);
        }
        Ok(())
    }
}

/// Makes sets of the cells with equal values.
fn add_groups(array: &Array, indices: &[Range<usize>], sets: &mut Sets) -> Result<(), Fault> {
    let mut cells_of: BTreeMap<i64, Vec<usize>> = BTreeMap::new();
    for (value, index) in array.whole()?.iter().zip(indices) {
        if !index.is_empty() {
            cells_of.entry(*value).or_default().extend(index.clone());
        }
        if cells_of.len() > MOST_VALUES {
            return Ok(());
        }
    }
    for (value, cells) in cells_of {
        let name = format!("{}={value}", array.name);
        let set = sets.place(&name, &name);
        sets.add_cells(set, &cells).map_err(|problem| (array.origin.place(0), problem))?;
    }
    Ok(())
}

fn shape(code: i64) -> Result<Shape, MeshProblem> {
    Ok(match code {
        3 => Shape::Line2,
        5 => Shape::Triangle3,
        9 => Shape::Quad4,
        10 => Shape::Tet4,
        12 => Shape::Hex8,
        13 => Shape::Wedge6,
        21 => Shape::Line3,
        22 => Shape::Triangle6,
        23 => Shape::Quad8,
        24 => Shape::Tet10,
        25 => Shape::Hex20,
        26 => Shape::Wedge15,
        28 => Shape::Quad9,
        29 => Shape::Hex27,
        _ => return Err(VolumeProblem::Kind { found: name(code).into() }.into()),
    })
}

fn name(code: i64) -> String {
    let name = match code {
        2 => "several vertices",
        4 => "line through several points",
        6 => "strip of triangles",
        7 => "polygon",
        8 => "pixel",
        11 => "voxel",
        15 | 16 => "prism over a polygon",
        32 => "wedge of 18 nodes",
        42 => "polyhedron",
        68..=81 => "Lagrange or Bézier",
        _ => return code.to_string(),
    };
    format!("{code} ({name})")
}
