use nalgebra::Vector3;

use crate::elements::assembly::affine::{Field as Shape, Piece};
use crate::elements::assembly::attachment::Attachment;
use crate::model::{Coordinate, Pair};

/// A rigid piece placed on the body, with the coordinates that move it.
pub(in crate::elements) struct MovingBody {
    /// Mass and moments about the base.
    pub piece: Piece,
    /// Place of the base (m), in the file's frame.
    pub base: Vector3<f64>,
    /// One shape per coordinate, outermost first.
    pub shapes: Vec<Shape>,
    /// Curvature of the path of each pair of coordinates, `G_jk`.
    pub curvature: Vec<Vec<Shape>>,
    /// Whether the piece has an orientation; a material point has none.
    pub rotations: bool,
    /// Name and unit of each coordinate.
    pub coordinates: Vec<Coordinate>,
    /// Place watched on the piece: its name, and its position from the base.
    pub marker: (String, Vector3<f64>),
    /// Other places on the piece at which springs and forces may act.
    pub places: Vec<(String, Vector3<f64>)>,
}

impl MovingBody {
    /// Position field of the piece from a pole.
    pub fn position(&self, pole: Vector3<f64>) -> Shape {
        Shape::position(self.base - pole)
    }

    /// Invariants of the coordinates of the piece with each other, numbered from `start`. (I4)–(I6)
    pub fn pairs(&self, pole: Vector3<f64>, start: usize) -> impl Iterator<Item = (usize, usize, Pair)> + '_ {
        let rho = self.position(pole);
        let count = self.shapes.len();
        (0..count * count).map(move |entry| {
            let (j, k) = (entry / count, entry % count);
            let pair = self.piece.pair(&rho, &self.shapes[j], &self.shapes[k], &self.curvature[j][k]);
            (start + j, start + k, pair)
        })
    }

    /// Places on the piece, with its coordinates numbered from `start`: the watched one, then the others.
    pub fn attachments(&self, start: usize) -> impl Iterator<Item = Attachment> + '_ {
        let all = std::iter::once(&self.marker).chain(&self.places);
        all.map(move |(name, s)| self.place(name, s, start))
    }

    /// A place on the piece, at `s` (m) from its base, with its coordinates numbered from `start`.
    pub fn place(&self, name: &str, s: &Vector3<f64>, start: usize) -> Attachment {
        let displaced = |shape: &Shape| -> [f64; 3] { (shape.constant + shape.linear * s).into() };
        let turn = |shape: &Shape| -> [f64; 3] {
            // the axial vector of a skew matrix
            let L = &shape.linear;
            [L[(2, 1)], L[(0, 2)], L[(1, 0)]]
        };
        let shapes = || self.shapes.iter().enumerate();
        let curved = self.curvature.iter().enumerate().flat_map(|(j, row)| {
            row.iter().enumerate().map(move |(k, G)| (start + j, start + k, displaced(G)))
        });
        Attachment {
            name: name.to_owned(),
            position: self.base + s,
            shapes: shapes().map(|(j, H)| (start + j, displaced(H))).collect(),
            rotations: self.rotations.then(|| shapes().map(|(j, H)| (start + j, turn(H))).collect()),
            curvature: curved.filter(|(.., G)| *G != [0.0; 3]).collect(),
        }
    }
}
