use quasirigid_mesh::Shape;

use super::{MeshProblem, VolumeProblem};

/// Nodes of a pyramid, of which two tetrahedra are made: the index in the order of gmsh of each. The edges are in the order of their lesser
/// corners, then of their greater ones; the fourteenth is the middle of the base.
pub(super) fn pyramid(code: u64) -> Option<&'static [usize]> {
    match code {
        7 => Some(&PYRAMID14[..5]),
        19 => Some(&PYRAMID14[..13]),
        14 => Some(&PYRAMID14),
        _ => None,
    }
}

const PYRAMID14: [usize; 14] = [0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12, 13];
/// Type of a point, which is no cell.
pub(super) const POINT: u64 = 15;

/// A kind of cell in the order of gmsh.
#[derive(Clone, Copy)]
pub(super) struct Kind {
    pub(super) shape: Shape,
    order: Order,
}

impl Kind {
    /// Index in the order of gmsh of a node in the order of [`Shape`].
    pub(super) fn place(self, node: usize) -> usize {
        self.order.get(node).map_or(node, |place| usize::from(*place))
    }
}

/// Permutation: the index in the order of gmsh of each node in the order of [`Shape`]; empty where the two agree.
type Order = &'static [u8];

const SAME_ORDER: Order = &[];
const TET10: Order = &[0, 1, 2, 3, 4, 5, 6, 7, 9, 8];
const WEDGE15: Order = &[0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11];
const HEX20: Order = &[0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15];
const HEX27: Order =
    &[0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26];

/// Kind of cell of a type of gmsh.
pub(super) fn kind(code: u64) -> Result<Kind, MeshProblem> {
    let (shape, order) = match code {
        1 => (Shape::Line2, SAME_ORDER),
        2 => (Shape::Triangle3, SAME_ORDER),
        3 => (Shape::Quad4, SAME_ORDER),
        4 => (Shape::Tet4, SAME_ORDER),
        5 => (Shape::Hex8, SAME_ORDER),
        6 => (Shape::Wedge6, SAME_ORDER),
        8 => (Shape::Line3, SAME_ORDER),
        9 => (Shape::Triangle6, SAME_ORDER),
        10 => (Shape::Quad9, SAME_ORDER),
        11 => (Shape::Tet10, TET10),
        12 => (Shape::Hex27, HEX27),
        16 => (Shape::Quad8, SAME_ORDER),
        17 => (Shape::Hex20, HEX20),
        18 => (Shape::Wedge15, WEDGE15),
        _ => return Err(VolumeProblem::Kind { found: name(code).into() }.into()),
    };
    Ok(Kind { shape, order })
}

fn name(code: u64) -> String {
    match code {
        13 => "13 (wedge of 18 nodes)".into(),
        20..=28 => format!("{code} (third order or higher)"),
        _ => code.to_string(),
    }
}
