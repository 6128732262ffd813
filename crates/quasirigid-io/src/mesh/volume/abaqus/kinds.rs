//! Cell types of Abaqus: from a name such as `C3D10M` to a shape and the order of its nodes.
//! Letters of the formulation (`R`, `H`, `T`, ...) leave the geometry as it is and are accepted only where Abaqus has them.

use quasirigid_mesh::Shape;

use super::VolumeProblem;
use crate::pyramid;

/// A kind of cell in the order of Abaqus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Kind {
    pub(super) shape: Shape,
    order: &'static [u8],
    /// Whether it is a pyramid of five nodes, which becomes two tetrahedra.
    pub(super) pyramid: bool,
}

/// First letters, letters that may follow the number, and the shape by the number.
type Family = (&'static str, &'static str, fn(u32) -> Option<Shape>);

/// Quadratic lines have their middle between their ends.
const LINE3: &[u8] = &[0, 2, 1];
/// The node in the middle of C3D27 comes before those of its faces, which are bottom, top and the sides in turn.
const HEX27: &[u8] =
    &[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 26, 24, 23, 25, 21, 22, 20];

impl Kind {
    /// Number of nodes.
    pub(super) fn nodes(self) -> usize {
        if self.pyramid { pyramid::NODES } else { self.shape.nodes() }
    }

    /// Index in the order of Abaqus of a node in the order of [`Shape`].
    pub(super) fn place(self, node: usize) -> usize {
        self.order.get(node).map_or(node, |place| usize::from(*place))
    }

    /// The kind of a type such as `C3D10M`: family, nodes, and letters that leave its geometry as it is.
    pub(super) fn of(name: &str) -> Result<Self, VolumeProblem> {
        let refused = || VolumeProblem::Kind { found: name.into() };
        let upper = name.to_ascii_uppercase();
        if matches!(upper.as_str(), "C3D5" | "C3D5H") {
            return Ok(Self { shape: Shape::Tet4, order: &[], pyramid: true });
        }
        let families: [Family; 9] = [
            ("C3D", "RIHTMSP", solid),
            ("STRI", "", triangle_shell),
            ("M3D", "R", face),
            ("CPS", "RIHTM", face),
            ("CPE", "RIHTM", face),
            ("B", "HOSRT", beam),
            ("T3D", "HT", truss),
            ("S", "RTHSW5", face),
            ("SFM3D", "R", face),
        ];
        let shape = families.iter().find_map(|(family, letters, shape)| {
            let rest = upper.strip_prefix(family)?;
            let digits = rest.len() - rest.trim_start_matches(|letter: char| letter.is_ascii_digit()).len();
            let (number, suffix) = rest.split_at(digits);
            suffix.chars().all(|letter| letters.contains(letter)).then(|| shape(number.parse().ok()?))?
        });
        let shape = shape.ok_or_else(refused)?;
        let order = match shape {
            Shape::Line3 => LINE3,
            Shape::Hex27 => HEX27,
            _ => &[],
        };
        Ok(Self { shape, order, pyramid: false })
    }
}

fn solid(nodes: u32) -> Option<Shape> {
    match nodes {
        4 => Some(Shape::Tet4),
        6 => Some(Shape::Wedge6),
        8 => Some(Shape::Hex8),
        10 => Some(Shape::Tet10),
        15 => Some(Shape::Wedge15),
        20 => Some(Shape::Hex20),
        27 => Some(Shape::Hex27),
        _ => None,
    }
}

fn face(nodes: u32) -> Option<Shape> {
    match nodes {
        3 => Some(Shape::Triangle3),
        4 => Some(Shape::Quad4),
        6 => Some(Shape::Triangle6),
        8 => Some(Shape::Quad8),
        9 => Some(Shape::Quad9),
        _ => None,
    }
}

/// `STRI3` and `STRI65`, of six nodes.
fn triangle_shell(number: u32) -> Option<Shape> {
    match number {
        3 => Some(Shape::Triangle3),
        65 => Some(Shape::Triangle6),
        _ => None,
    }
}

/// `B31`, `B32` and `B33`: beams in space.
fn beam(number: u32) -> Option<Shape> {
    match number {
        31 | 33 => Some(Shape::Line2),
        32 => Some(Shape::Line3),
        _ => None,
    }
}

fn truss(nodes: u32) -> Option<Shape> {
    match nodes {
        2 => Some(Shape::Line2),
        3 => Some(Shape::Line3),
        _ => None,
    }
}
