//! Outline of an element: vertices on places of the body, before the coordinates of the body are known.

use super::shapes::Triangulated;
use crate::{Assembly, End};

/// Outline of an element, in the file's frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Outline {
    pub vertices: Vec<Vertex>,
    pub lines: Vec<[usize; 2]>,
    pub triangles: Vec<[usize; 3]>,
    /// Radius of points and lines (m).
    pub radius: Option<f64>,
    /// Direction and a point (m) of the axis that the first cyclic coordinate of the element turns the outline about.
    pub axis: Option<([f64; 3], [f64; 3])>,
}

/// Place of a vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Vertex {
    /// On the carrier (m).
    Still([f64; 3]),
    /// On the element itself, as it moves (m at equilibrium).
    Own([f64; 3]),
    /// At a place of another element.
    At(End),
}

impl Outline {
    /// Outline of the element's own places, in triangles.
    pub fn own((places, triangles): Triangulated) -> Self {
        Self { vertices: places.into_iter().map(Vertex::Own).collect(), triangles, ..Self::default() }
    }

    /// Outline of places on the carrier, in triangles.
    pub fn still((places, triangles): Triangulated) -> Self {
        Self { vertices: places.into_iter().map(Vertex::Still).collect(), triangles, ..Self::default() }
    }

    /// Line between the ends of a link. An end on the carrier is at `anchor`, or at the centre of mass of the carrier where the model gives
    /// it no place.
    pub fn link(body: &Assembly, [from, to]: [End; 2], anchor: Option<[f64; 3]>) -> Option<Self> {
        let center = || Some(body.carrier.as_ref()?.center_of_mass);
        let vertex = |end: End| match end {
            End::Carrier => Some(Vertex::Still(anchor.or_else(center)?)),
            _ => Some(Vertex::At(end)),
        };
        let vertices = vec![vertex(from)?, vertex(to)?];
        Some(Self { vertices, lines: vec![[0, 1]], ..Self::default() })
    }
}
